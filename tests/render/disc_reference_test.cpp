// Every pixel of a disc against tone(absolute luminance) computed on the CPU in double: place, shape, colour
// of the air and the sky behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/colour.h"
#include "render/disc_frame.h"
#include "render/eye/tone_curve.h"
#include "render/night/moon_light.h"
#include "render/night/moon_map.h"
#include "render/shaders/shared.h"
#include "render/sky/air_tables.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/light_tables_steps.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kSize = 128;

// The Moon's map and its coarser levels, asked as a texture unit asks: linear in place and in level.
class MoonPyramid {
  public:
    MoonPyramid() {
        levels_.emplace_back(night::moon_map().begin(), night::moon_map().end());
        for (std::size_t size = night::kMoonMapSize / 2; size > 0; size /= 2) {
            const std::vector<double>& fine = levels_.back();
            std::vector<double> coarse(size * size);
            for (std::size_t i = 0; i < coarse.size(); ++i) {
                const std::size_t corner = 4 * size * (i / size) + 2 * (i % size);
                coarse[i] = 0.25 * (fine[corner] + fine[corner + 1] + fine[corner + 2 * size] +
                                    fine[corner + 2 * size + 1]);
            }
            levels_.push_back(std::move(coarse));
        }
    }
    [[nodiscard]] double at(const glm::dvec3& selenographic, double level) const {
        const auto low = static_cast<std::size_t>(level);
        const glm::dvec2 place = shaders64::moon_map_place(selenographic);
        return glm::mix(in_level(low, place), in_level(low + 1, place), level - std::floor(level)) /
               night::kMoonMapOne;
    }

  private:
    [[nodiscard]] double in_level(std::size_t level, const glm::dvec2& place) const {
        const int size = night::kMoonMapSize >> level;
        const glm::dvec2 texel = place * static_cast<double>(size) - 0.5;
        const glm::dvec2 low = glm::floor(texel);
        const auto value = [&](int x, int y) {
            const int column = std::clamp(static_cast<int>(low.x) + x, 0, size - 1);
            const int row = std::clamp(static_cast<int>(low.y) + y, 0, size - 1);
            return levels_[level][static_cast<std::size_t>(row * size + column)];
        };
        const glm::dvec2 t = texel - low;
        return glm::mix(glm::mix(value(0, 0), value(1, 0), t.x), glm::mix(value(0, 1), value(1, 1), t.x),
                        t.y);
    }
    std::vector<std::vector<double>> levels_;
};

// What stands behind a view direction, without the renderer's disc geometry.
struct Reference {
    Reference(LightTables& tables, const Scene& frame_scene, double adaptation_cd_m2)
        : scene(frame_scene),
          light(step(tables, scene)),
          air(tables.air()),
          tone(eye::tone_parameters({}, adaptation_cd_m2)),
          pixel_rad(0.8 * kDegree / kSize) {}

    // Gnomonic coordinates about a body, in radii, of what is seen at `direction`.
    [[nodiscard]] glm::dvec3 on_body(const glm::dvec3& body, double radius_rad,
                                     const glm::dvec3& direction) const {
        const Horizontal seen_at = horizontal_of(direction);
        const glm::dvec3 straight =
            direction_of({light.refraction.true_from_apparent(seen_at.elevation_rad), seen_at.azimuth_rad});
        const glm::dvec3 right = glm::normalize(glm::cross(body, {0.0, 0.0, 1.0}));
        const glm::dvec3 up = glm::cross(right, body);
        const glm::dvec3 flat = straight / (glm::dot(straight, body) * std::tan(radius_rad));
        const double x = glm::dot(flat, right);
        const double y = glm::dot(flat, up);
        return {x, y, std::sqrt(std::max(0.0, 1.0 - x * x - y * y))};
    }
    [[nodiscard]] glm::dvec3 sky(const glm::dvec3& direction) const {
        const Horizontal at = horizontal_of(direction);
        return glm::dvec3{light.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kSky)};
    }
    // Where tables of straight rays are asked for the light of what is seen there.
    [[nodiscard]] double straight_rad(const glm::dvec3& direction) const {
        return std::max(light.straight_elevation_rad(horizontal_of(direction).elevation_rad),
                        light.straight_horizon_rad + 0.0048);
    }
    [[nodiscard]] glm::dvec3 sun(const glm::dvec3& direction) const {
        const glm::dvec3 at = on_body(scene.sun.direction_enu, scene.sun.angular_radius_rad, direction);
        const glm::dvec3 limb{0.53, 0.60, 0.72};
        const glm::dvec3 profile = (1.0 - limb * (1.0 - at.z)) / (1.0 - limb / 3.0);
        const double sine = std::sin(scene.sun.angular_radius_rad);
        const glm::dvec3 mean =
            air.direct_sun_xyz(scene.eye.height_m, straight_rad(direction), scene.sun.distance_au) /
            (std::numbers::pi * sine * sine);
        return kRec709FromXyz * mean * profile + sky(direction);
    }
    // Display linear.
    [[nodiscard]] glm::dvec3 moon(const glm::dvec3& direction) const {
        const Moon& m = scene.moon;
        const glm::dvec3 at = on_body(m.direction_enu, m.angular_radius_rad, direction);
        const glm::dvec3 right = glm::normalize(glm::cross(m.direction_enu, {0.0, 0.0, 1.0}));
        const glm::dvec3 normal =
            right * at.x + glm::cross(right, m.direction_enu) * at.y - m.direction_enu * at.z;
        const double lit = shaders64::lommel_seeliger(glm::dot(normal, m.to_sun_enu), at.z);
        const double sun_au = scene.sun.distance_au;
        const glm::dvec3 face = night::moon_tint_rgb() * night::moon_face_cd_m2(m, sun_au) * lit +
                                night::earthshine_tint_rgb() * night::earthshine_cd_m2(m.phase_angle_rad);
        const double pixels =
            pixel_rad / m.angular_radius_rad * night::kMoonMapSize / (2.0 * shaders64::kMoonMapReach);
        const double level = std::log2(pixels) - 0.5 * std::log2(std::max(at.z, 0.1));
        const double albedo = map.at(glm::transpose(m.enu_from_selenographic) * normal, std::max(level, 0.0));
        const glm::dvec3 passed = air.transmittance_rgb(scene.eye.height_m, straight_rad(direction));
        const shaders64::Fovea fovea = moon_fovea(scene, air, light, {}, tone);
        const glm::dvec3 own = face * albedo * passed;
        const double dimmed = shaders64::foveal_factor(
            fovea,
            shaders64::foveal_adaptation(night::moon_mean_cd_m2(m, sun_au) * shaders64::luminance_709(passed),
                                         shaders64::luminance_709(own)));
        const double behind = shaders64::luminance_709(sky(direction));
        const double share = shaders64::luminance_709(own) / (shaders64::luminance_709(own) + behind);
        const double photopic = shaders64::foveal_share(shaders64::luminance_709(own)) * share;
        return shaders64::seen_before(own * dimmed, photopic, sky(direction), tone);
    }

    Scene scene;
    SkyLight light;
    sky::AirTables air;
    shaders64::ToneParameters tone;
    double pixel_rad;
    MoonPyramid map;
};

class DiscReference : public GlTest {
  protected:
    // Compares the pixels that lie well inside the disc and above the horizon.
    void expect_drawn_as_computed(const char* name, Scene scene, bool is_sun, int most_codes) {
        const glm::dvec3 body = is_sun ? scene.sun.direction_enu : scene.moon.direction_enu;
        const double radius = is_sun ? scene.sun.angular_radius_rad : scene.moon.angular_radius_rad;
        const Horizontal at = horizontal_of(seen(scene, body));
        add_view(scene, symmetric_frustum(0.4, kSize, kSize),
                 view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 20.0));
        scene.stars.enabled = false;
        // A jump of the clock: nothing of the scene before is left in the adaptation.
        scene.time_s = time_s_ += 100.0;
        const double adaptation = renderer_.prepare(scene).adaptation_cd_m2;
        const Picture picture = draw(renderer_, scene)[0];
        const Reference reference(tables_, scene, adaptation);
        int compared = 0, worst = 0, darkest = 255, brightest = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 direction =
                    glm::transpose(scene.views[0].view_from_enu) *
                    view_direction(renderer_.channels()[0], scene.views[0].frustum, x + 0.5, kSize - y - 0.5);
                const glm::dvec3 place = reference.on_body(body, radius, direction);
                if (std::hypot(place.x, place.y) > 0.96) continue;
                if (horizontal_of(direction).elevation_rad < reference.light.horizon_elevation_rad + 2e-4)
                    continue;
                const glm::dvec3 display =
                    is_sun ? shaders64::display_linear(reference.sun(direction), reference.tone)
                           : reference.moon(direction);
                const glm::dvec3 exact = shaders64::encoded(display, reference.tone) * 255.0;
                const Rgb drawn = picture.at(x, y);
                worst = std::max(worst, static_cast<int>(std::ceil(std::max({std::abs(drawn.r - exact.x),
                                                                             std::abs(drawn.g - exact.y),
                                                                             std::abs(drawn.b - exact.z)}) -
                                                                   0.5)));
                darkest = std::min(darkest, drawn.g);
                brightest = std::max(brightest, drawn.g);
                ++compared;
            }
        }
        std::printf("%-26s %5d pixels, green %3d..%3d: %d codes at most\n", name, compared, darkest,
                    brightest, worst);
        EXPECT_GT(compared, 500) << name;
        EXPECT_LE(worst, most_codes) << name;
    }

  private:
    // One air for all scenes of a test: its tables are the costly part.
    Renderer renderer_{{{"only", kSize, kSize}}, without_glare()};
    LightTables tables_;
    double time_s_ = 0.0;
};

TEST_F(DiscReference, SunIsToneOfItsOwnLightOverItsSkyHoweverMuchOfItIsHidden) {
    for (const double unobscured : {1.0, 0.3}) {
        Scene hazy = make_scene(6.0, 200.0, -40.0, 20.0, 0.0);
        hazy.air.visibility_m = 4000.0;
        hazy.sun.unobscured = unobscured;
        expect_drawn_as_computed("hazy Sun", hazy, true, 2);
        hazy.sun.direction_enu = at(3.0, 200.0);
        expect_drawn_as_computed("hazy Sun at 3 deg", hazy, true, 2);
    }
}

TEST_F(DiscReference, SettingSunIsToneOfItsLightOverItsSky) {
    expect_drawn_as_computed("Sun at FL360, 3.5 deg down", make_scene(-3.5, 200.0, -40.0, 20.0, 10972.8),
                             true, 2);
}

TEST_F(DiscReference, MoonIsToneOfItsFaceOverTheSkyOfEachOfItsPoints) {
    expect_drawn_as_computed("half Moon by day", make_scene(35.0, 120.0, 30.0, 210.0, 0.0), false, 2);
    expect_drawn_as_computed("Moon low in twilight", make_scene(-3.0, 290.0, 2.0, 275.0, 100.0), false, 2);
    expect_drawn_as_computed("full Moon rising at dusk", make_scene(-1.0, 280.0, 0.2, 100.0, 0.0), false, 2);
    Scene high = make_scene(-4.0, 100.0, -3.2, 280.0, 10972.8);
    expect_drawn_as_computed("Moon setting at FL360", high, false, 2);
}

}  // namespace
}  // namespace skyig::render
