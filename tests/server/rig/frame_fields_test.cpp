// The list of fields that travel leaves nothing of a scene out, and carries any values that its types hold.
#include "server/rig/frame_fields.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "render/cloud/field/texture.h"
#include "server/rig/frame_coder.h"
#include "server/rig/messages.h"

namespace skyig::server::rig {
namespace {

using Picture = FrameCoder::Picture;

// A member more of any of these breaks this: visit it in frame_fields.h, then name it here.
[[maybe_unused]] void members_of_a_state() {
    [[maybe_unused]] const auto& [scene, eyes, thinned, world_utc_ns, slots] = FrameState{};
    [[maybe_unused]] const auto& [frame, time, eye, sun, moon, stars, planets, air, ground, sea, weather, sky,
                                  night, overlay, views, view_count] = scene;
    [[maybe_unused]] const auto& [latitude, longitude, height] = eye;
    [[maybe_unused]] const auto& [sun_on, sun_way, sun_far, sun_wide, unobscured] = sun;
    [[maybe_unused]] const auto& [moon_on, moon_way, moon_far, moon_wide, to_sun, phase, axes, axis, umbra,
                                  penumbra, sunlit] = moon;
    [[maybe_unused]] const auto& [planet_way, magnitude, bv] = planets[0];
    [[maybe_unused]] const auto& [stars_on, intensity, turn, velocity, years] = stars;
    [[maybe_unused]] const auto& [air_on, visibility, contrast, temperature, pressure, humidity] = air;
    [[maybe_unused]] const auto& [ground_kind, albedo, snow, wet, ground_wind, ground_wind_from] = ground;
    [[maybe_unused]] const auto& [sea_height, sea_temperature, clarity, whitecaps, waves, wave_count] = sea;
    [[maybe_unused]] const auto& [wave_height, length, period, wave_way, wave_phase, leading, breaker] =
        waves[0];
    [[maybe_unused]] const auto& [lines, warning] = overlay;
    [[maybe_unused]] const auto& [frustum, view_from_enu, showing, pattern, texts, windscreen] = views[0];
    [[maybe_unused]] const auto& [left, right, bottom, top] = frustum;
    [[maybe_unused]] const auto& [across, upright, repeat_across, repeat_upright, parallel] = showing;
}

[[maybe_unused]] void members_of_a_weather() {
    [[maybe_unused]] const auto& [clouds, cloud_count, obscurants, obscurant_count, precipitations,
                                  precipitation_count, lightnings, lightning_count, wind, eye_velocity] =
        render::Weather{};
    [[maybe_unused]] const auto& [genus, model, base, thickness, bottom_band, top_band, coverage, extinction,
                                  drift, age, bottom_scud, top_scud, severity, seed, area, look] = clouds[0];
    [[maybe_unused]] const auto& [tiles, density_offset, self_shadow, colour] = render::CloudLook{};
    [[maybe_unused]] const auto& [picture, noise, times, scroll, weight] = tiles[0];
    [[maybe_unused]] const auto& [centre, area_axis, half_size, corner, perimeter] = render::WeatherArea{};
    [[maybe_unused]] const auto& [kind, fog_base, fog_top, fog_bottom_band, fog_top_band, fog_extinction,
                                  fog_coverage, fog_drift, fog_seed, fog_area] = obscurants[0];
    [[maybe_unused]] const auto& [falling, rate, falls_from] = precipitations[0];
    [[maybe_unused]] const auto& [layer, flashes, flash_seed] = lightnings[0];
}

[[maybe_unused]] void members_of_skies() {
    [[maybe_unused]] const auto& [model, day_cycle, cie, preetham, windlight, scintillation] =
        render::SkySettings{};
    [[maybe_unused]] const auto& [desaturation] = day_cycle;
    [[maybe_unused]] const auto& [type, zenith] = cie;
    [[maybe_unused]] const auto& [turbidity, zenith_of_multi] = preetham;
    [[maybe_unused]] const auto& [blue_horizon, haze_horizon, blue_density, haze_density, density,
                                  max_altitude, sunlight, ambient, glow_size, glow_floor, glow_power,
                                  horizon_drop, unit, places_sun, sun_angle, east_angle] = windlight;
    [[maybe_unused]] const auto& [night_model, airglow, zodiacal, starlight, galactic, structure, seed,
                                  activity, cities, city_count] = render::NightSettings{};
    [[maybe_unused]] const auto& [latitude, longitude, radius, zenith_cd_m2, population] = cities[0];
}

/// Gives every field any value of its kind.
class Filling {
  public:
    /// \param full  all that may be given is given, all lists are as long as they can be
    Filling(unsigned seed, std::span<const Picture> pictures, bool full = false)
        : random_(seed), pictures_(pictures), full_(full) {}

    void operator()(bool& value) { value = below(2) == 1; }
    void operator()(double& value) { value = finite<double, std::uint64_t>(); }
    void operator()(float& value) { value = finite<float, std::uint32_t>(); }
    template <class Integer>
    void operator()(Integer& value) {
        value = static_cast<Integer>(random_());
    }
    template <class Enum>
    void one_of(Enum& value, std::size_t values) {
        value = static_cast<Enum>(below(values));
    }
    template <class Count>
    void count(Count& value, std::size_t most) {
        value = static_cast<Count>(full_ ? most : below(most + 1));
    }
    void text(render::OverlayLine& line) {
        std::string text(full_ ? line.kMost : below(line.kMost + 1), ' ');
        for (char& letter : text)
            letter = static_cast<char>(1 + below(255));
        line.say(text);
    }
    void picture(Picture& picture) {
        const std::size_t place = below(pictures_.size() + 1);
        picture = place > 0 ? pictures_[place - 1] : nullptr;
    }
    template <class Value>
    bool given(std::optional<Value>& value) {
        value.reset();
        if (full_ || below(2) == 1) value.emplace();
        return value.has_value();
    }
    void skip(std::size_t) {}

  private:
    std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }
    template <class Value, class Bits>
    Value finite() {
        for (;;) {
            const auto value = std::bit_cast<Value>(static_cast<Bits>(random_()));
            if (std::isfinite(value)) return value;
        }
    }

    std::mt19937_64 random_;
    std::span<const Picture> pictures_;
    bool full_;
};

/// Every field's bits, one after the other.
class Listing {
  public:
    template <class Value>
    void operator()(const Value& value) {
        add(&value, sizeof(value));
    }
    template <class Enum>
    void one_of(const Enum& value, std::size_t) {
        add(&value, sizeof(value));
    }
    template <class Count>
    void count(const Count& value, std::size_t) {
        add(&value, sizeof(value));
    }
    void text(const render::OverlayLine& line) {
        bits.append(line.text());
        bits += '\0';
    }
    void picture(const Picture& picture) {
        const void* place = picture.get();
        add(&place, sizeof(place));
    }
    template <class Value>
    bool given(const std::optional<Value>& value) {
        bits += value ? '1' : '0';
        return value.has_value();
    }
    void skip(std::size_t) {}

    std::string bits;

  private:
    void add(const void* value, std::size_t size) { bits.append(static_cast<const char*>(value), size); }
};

/// How many there are.
class Counting {
  public:
    template <class Value>
    void operator()(const Value&) {
        ++values;
    }
    template <class Value>
    void one_of(const Value&, std::size_t) {
        ++values;
    }
    template <class Value>
    void count(const Value&, std::size_t) {
        ++values;
    }
    void text(const render::OverlayLine&) { ++values; }
    void picture(const Picture&) { ++values; }
    template <class Value>
    bool given(const std::optional<Value>& value) {
        ++values;
        return value.has_value();
    }
    void skip(std::size_t skipped) { values += skipped; }

    std::size_t values = 0;
};

std::string bits_of(FrameState& state) {
    Listing listing;
    FrameFields<FrameState, Listing>(state, listing).all();
    return listing.bits;
}

class FrameFieldsTest : public ::testing::Test {
  protected:
    std::unique_ptr<FrameState> any_state(unsigned seed, bool full = false) {
        auto state = std::make_unique<FrameState>();
        Filling filling(seed, pictures, full);
        FrameFields<FrameState, Filling>(*state, filling).all();
        return state;
    }

    const std::array<Picture, 2> pictures{
        std::make_shared<render::cloud::field::Texture>(16, std::vector<float>(256, 0.25F)),
        std::make_shared<render::cloud::field::Texture>(16, std::vector<float>(256, 0.5F))};
    const FrameCoder coder{pictures};
};

TEST_F(FrameFieldsTest, AreAsManyAsAStateHasValuesWhatsoeverIsGiven) {
    constexpr std::size_t kVector = 3, kMatrix = 9, kGiven = 1, kLength = 1;
    constexpr std::size_t kFrame = 4, kEyes = 6, kPlace = 1 + 3, kText = 4;
    constexpr std::size_t kSun = 4 + kVector, kMoon = 7 + 3 * kVector + kMatrix;
    constexpr std::size_t kStars = 3 + kMatrix + kVector, kPlanets = 5 * (2 + kVector), kAir = 6;
    constexpr std::size_t kGround = 6 + kGiven, kSea = 4 + kLength + 16 * 7;
    constexpr std::size_t kArea = kGiven + 7, kLook = kGiven + 3 * 6 + 2 + kVector;
    constexpr std::size_t kClouds = kLength + 16 * (13 + 2 + kArea + kLook);
    constexpr std::size_t kObscurants = kLength + 16 * (8 + 2 + kArea);
    constexpr std::size_t kWeather = kClouds + kObscurants + kLength + 5 * 3 + kLength + 8 * 3 + 2 * kVector;
    constexpr std::size_t kSky = 5 + 2 * (kGiven + 1) + 12 + 4 * kVector;
    constexpr std::size_t kNight = 8 + kLength + 8 * 5;
    constexpr std::size_t kViews = kLength + 16 * (4 + kMatrix + 5 + 3);
    constexpr std::size_t kAll = kFrame + kEyes + kPlace + kText + kSun + kMoon + kStars + kPlanets + kAir +
                                 kGround + kSea + kWeather + kSky + kNight + kViews;
    for (const bool full : {false, true}) {
        const auto state = any_state(1, full);
        Counting counting;
        FrameFields<FrameState, Counting>(*state, counting).all();
        EXPECT_EQ(counting.values, kAll);
    }
}

TEST_F(FrameFieldsTest, AnyValuesTravelToTheLastBit) {
    std::vector<std::byte> bytes(std::size_t{1} << 16U);
    auto taken = std::make_unique<FrameState>();
    std::size_t largest = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        const auto state = any_state(seed);
        const std::size_t size = coder.encode(*state, bytes);
        ASSERT_GT(size, 0U);
        largest = std::max(largest, size);
        ASSERT_TRUE(coder.decode(std::span(bytes).first(size), *taken)) << seed;
        ASSERT_EQ(bits_of(*taken), bits_of(*state)) << seed;
    }
    std::printf("  every field any number of its kind: %zu bytes at most\n", largest);
}

TEST_F(FrameFieldsTest, TheFullestSceneHasRoom) {
    std::vector<std::byte> bytes(std::size_t{1} << 16U);
    const auto state = any_state(1, true);
    const std::size_t size = coder.encode(*state, bytes);
    std::printf("  the fullest scene: %zu bytes of %zu\n", size, kMostStateBytes);
    EXPECT_LE(size, kMostStateBytes);
    EXPECT_EQ(coder.encode(*state, std::span(bytes).first(size - 1)), 0U);
}

}  // namespace
}  // namespace skyig::server::rig
