#include "render/cloud/lightning.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "render/geometry.h"
#include "render/mixed_bits.h"
#include "render/sky/sea_waves.h"

namespace skyig::render::cloud {

namespace {

constexpr double kPi = std::numbers::pi;

constexpr double kSlot_s = 1.0;
static_assert(kLongestFlash_s < kSlot_s);
// Flashes of one slot beyond this are left out: 420 a minute, of which one in a million slots has more.
constexpr int kMostInSlot = 20;
constexpr double kMostPerSlot = 7.0;

constexpr int kMostStrokes = 5;
constexpr double kRise_s = 0.008;
constexpr double kFade_s = 0.05;

// A typical stroke radiates 1e9 W of light from 0.4 to 1.1 um (a hundredth of the least superbolt: Turman
// 1977, "Detection of lightning superbolts") for some 0.4 ms; of white light over that band a watt is about
// 100 lm.
constexpr double kStroke_lm_s = 1e9 * 4e-4 * 100.0;
constexpr double kStroke_cd_s = kStroke_lm_s / (4.0 * kPi);
// Later strokes are weaker than the first.
constexpr double kLaterStrokes = 0.4;

// Of light near 15000 K, of luminance 1.
const glm::vec3 kColour{0.785F, 0.993F, 1.706F};

// The square without an area.
constexpr double kTile_m = 60e3;

// Counts up the random numbers of one flash.
class Chance {
  public:
    explicit Chance(std::uint64_t key) noexcept : key_(mixed(key)) {}
    double operator()() noexcept { return unit_of(mixed(key_ ^ mixed(++count_))); }

  private:
    std::uint64_t key_;
    std::uint64_t count_ = 0;
};

// Poisson, by inversion of its sums: for one chance it never falls as the mean rises.
int count_of(double mean, double chance) {
    double term = std::exp(-mean);
    double sum = term;
    int count = 0;
    while (chance >= sum && count < kMostInSlot) {
        ++count;
        term *= mean / count;
        sum += term;
    }
    return count;
}

// One stroke: light of kStroke_cd_s by 1, over time.
double stroke(double since_s) {
    if (since_s <= 0.0) return 0.0;
    const double risen = std::min(since_s / kRise_s, 1.0);
    return risen * std::exp(-since_s / kFade_s) / kFade_s;
}

double intensity_cd(Chance& chance, double since_s) {
    const int strokes = 3 + static_cast<int>(3.0 * chance());
    const double length_s = 0.2 + 0.3 * chance();
    // A flash of many: some are several times as strong as others (lognormal, near enough).
    const double strength = std::exp(1.2 * (chance() + chance() + chance() - 1.5));
    double sum = 0.0;
    for (int i = 0; i < kMostStrokes; ++i) {
        const double place = chance();
        if (i >= strokes) continue;
        const double begins_s = i == 0             ? 0.0
                                : i == strokes - 1 ? length_s
                                                   : length_s * (i - 0.4 + 0.8 * place) / (strokes - 1);
        sum += (i == 0 ? 1.0 : kLaterStrokes) * stroke(since_s - begins_s);
    }
    // Nothing is left when the flash is over.
    const double ends = smooth_step(kLongestFlash_s, 0.7 * kLongestFlash_s, since_s);
    return strength * kStroke_cd_s * ends * sum;
}

glm::dvec2 in_area(const WeatherArea& area, double x, double y) {
    const glm::dvec2 half_m = area.half_size_m + area.corner_radius_m;
    const glm::dvec2 at_m = half_m * glm::dvec2{2.0 * x - 1.0, 2.0 * y - 1.0};
    // A circle's corners are folded in.
    const glm::dvec2 beyond_m = glm::max(glm::abs(at_m) - area.half_size_m, glm::dvec2{0.0});
    const double past = glm::length(beyond_m) / std::max(area.corner_radius_m, 1e-3);
    const glm::dvec2 inside_m = at_m - glm::sign(at_m) * beyond_m * (1.0 - 1.0 / std::max(past, 1.0));
    const double sine = std::sin(area.axis_rad);
    const double cosine = std::cos(area.axis_rad);
    return area.centre_m +
           glm::dvec2{sine * inside_m.x + cosine * inside_m.y, cosine * inside_m.x - sine * inside_m.y};
}

// The nearest of the places that repeat over the Earth.
glm::dvec2 near_eye(const glm::dvec2& eye_m, double x, double y) {
    const glm::dvec2 apart_m = kTile_m * glm::dvec2{x, y} - eye_m;
    return apart_m - kTile_m * glm::round(apart_m / kTile_m);
}

struct Where {
    const CloudLayer& layer;
    std::size_t index;
    glm::dvec2 eye_m;
    double eye_height_m;
};

void add(Flashes& sum, const Where& where, std::uint64_t key, double slot_begins_s, double time_s) {
    Chance chance(key);
    const double since_s = time_s - slot_begins_s - kSlot_s * chance();
    if (since_s <= 0.0 || since_s >= kLongestFlash_s || sum.count == Flashes::kMost) return;
    const double x = chance();
    const double y = chance();
    const CloudLayer& layer = where.layer;
    const glm::dvec2 at_m = layer.area ? in_area(*layer.area, x, y) : near_eye(where.eye_m, x, y);
    const double height_m = layer.base_m + layer.thickness_m * (0.1 + 0.5 * chance());
    const double cd = intensity_cd(chance, since_s);
    if (cd > 0.0) sum.flashes[sum.count++] = {{at_m, height_m - where.eye_height_m}, cd, where.index};
}

}  // namespace

Flashes flashes_at(const Scene& scene) noexcept {
    Flashes sum;
    constexpr double kLongestTime_s = 1e12;
    if (!(std::abs(scene.time_s) < kLongestTime_s)) return sum;
    const glm::dvec2 eye_m = sky::sea_anchor(scene.eye).eye_m;
    for (const Lightning& lightning : scene.weather.all_lightnings()) {
        if (!(lightning.flashes_per_min > 0.0) || lightning.layer >= scene.weather.cloud_count) continue;
        const Where where{scene.weather.clouds[lightning.layer], lightning.layer, eye_m, scene.eye.height_m};
        const double mean = std::min(lightning.flashes_per_min / 60.0 * kSlot_s, kMostPerSlot);
        const auto now = static_cast<std::int64_t>(std::floor(scene.time_s / kSlot_s));
        for (const std::int64_t slot : {now - 1, now}) {
            // By the seed alone: where the layer stands among others changes with them and with the eye.
            const std::uint64_t key = mixed(static_cast<std::uint64_t>(slot)) ^ mixed(mixed(lightning.seed));
            const int count = count_of(mean, unit_of(mixed(key)));
            for (int i = 0; i < count; ++i) {
                add(sum, where, key + 1 + static_cast<std::uint64_t>(i), static_cast<double>(slot) * kSlot_s,
                    scene.time_s);
            }
        }
    }
    return sum;
}

glm::vec3 flash_on_cloud_cd_m2(const Flash& flash, const glm::dvec3& place_m, double optical_depth,
                               double g) noexcept {
    constexpr double kChannel_m = 150.0;
    const double distance_m = glm::distance(flash.place_m, place_m);
    if (!(distance_m < kFlashReach_m)) return glm::vec3{0.0F};
    const double near_m = std::max(distance_m, kChannel_m);
    const double passed = std::exp(-std::max(optical_depth, 0.0) * (1.0 - g));
    const double ends = smooth_step(kFlashReach_m, 0.6 * kFlashReach_m, distance_m);
    return static_cast<float>(flash.intensity_cd * passed * ends / (kPi * near_m * near_m)) * kColour;
}

FlashLight light_of(const Flashes& flashes, const Scene& scene, double extinction_per_m) noexcept {
    FlashLight light;
    constexpr double kLeast_m = 500.0;
    constexpr double kMostSentOn = 0.1;
    for (const Flash& flash : flashes.all()) {
        const glm::dvec2 along_m{flash.place_m};
        const double over_ground_m = std::max(flash.place_m.z + scene.eye.height_m, kLeast_m);
        const double to_ground_m = std::hypot(glm::length(along_m), over_ground_m);
        const double lux = flash.intensity_cd * over_ground_m / (to_ground_m * to_ground_m * to_ground_m);
        const double to_eye_m = std::max(glm::length(flash.place_m), kLeast_m);
        const double sent_on =
            std::min(std::max(extinction_per_m, 0.0) * to_eye_m, kMostSentOn) / (4.0 * kPi);
        light.ground_lux += static_cast<float>(lux) * kColour;
        light.sky_cd_m2 += static_cast<float>(flash.intensity_cd / (to_eye_m * to_eye_m) * sent_on) * kColour;
    }
    return light;
}

}  // namespace skyig::render::cloud
