// Targets of luminance: what they hold is what the display shows, before the eye; half floats hold as much.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/eye/tone_curve.h"
#include "render/geometry.h"
#include "tests/render/light_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

class Luminance : public GlTest {
  protected:
    // Edges of discs and of the horizon mix what lies on both sides: as codes on the display, as light here.
    static bool on_an_edge(const Scene& scene, const glm::dvec3& direction_enu, double pixel_rad) {
        const auto rim = [&](const glm::dvec3& body, double radius_rad) {
            const glm::dvec3 centre = seen(scene, body);
            const double away_rad =
                std::atan2(glm::length(glm::cross(centre, direction_enu)), glm::dot(centre, direction_enu));
            return away_rad < radius_rad + 2.0 * pixel_rad && away_rad > 0.7 * radius_rad - 2.0 * pixel_rad;
        };
        const double horizon = refraction_of(scene).horizon_elevation_rad();
        return std::abs(std::asin(direction_enu.z) - horizon) < 2.0 * pixel_rad ||
               rim(scene.sun.direction_enu, scene.sun.angular_radius_rad) ||
               rim(scene.moon.direction_enu, scene.moon.angular_radius_rad);
    }

    // Who looks at the Moon adapts to it: its display has a law of its own, which disc_reference_test holds.
    static bool on_the_moon(const Scene& scene, const glm::dvec3& direction_enu) {
        const glm::dvec3 centre = seen(scene, scene.moon.direction_enu);
        return glm::length(glm::cross(centre, direction_enu)) < scene.moon.angular_radius_rad &&
               glm::dot(centre, direction_enu) > 0.0;
    }

    // Looks at the body of the hour, through pixels of which some fit into its disc.
    static Scene looking_at_a_body(const std::string& name, Scene scene) {
        const bool by_day = name == "dawn" || name == "noon";
        const Horizontal body =
            horizontal_of(seen(scene, by_day ? scene.sun.direction_enu : scene.moon.direction_enu));
        add_view(scene, symmetric_frustum(4.0, kWidth, kHeight),
                 view_from_enu(body.azimuth_rad / kDegree, body.elevation_rad / kDegree, 5.0));
        add_view(scene, symmetric_frustum(50.0, kWidth, kHeight),
                 view_from_enu(body.azimuth_rad / kDegree + 20.0, 12.0, 5.0));
        return scene;
    }
};

TEST_F(Luminance, ToneOfItIsWhatIsShownWithinACode) {
    const std::vector<Channel> channels{{"narrow", kWidth, kHeight}, {"wide", kWidth, kHeight}};
    for (const auto& [name, plain] : four_times()) {
        Scene scene = looking_at_a_body(name, plain);
        scene.stars.enabled = false;
        Renderer renderer(channels, without_glare());
        const auto shown = draw(renderer, scene);
        const auto tone = eye::tone_parameters(without_glare(), renderer.prepare(scene).adaptation_cd_m2);
        const auto light = draw_light(channels, scene);
        double worst = 0.0;
        double brightest_cd_m2 = 0.0;
        int compared = 0;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const double pixel_rad = pixel_angle_rad(channels[c], scene.views[c].frustum);
            for (int y = 0; y < kHeight; y += 2) {
                for (int x = y / 2 % 3; x < kWidth; x += 3) {
                    const glm::dvec3 direction =
                        glm::transpose(scene.views[c].view_from_enu) * light[c].view_direction_at(x, y);
                    if (on_an_edge(scene, direction, pixel_rad)) continue;
                    const glm::dvec3 here = light[c].at(x, y);
                    brightest_cd_m2 = std::max(brightest_cd_m2, largest(here));
                    if (on_the_moon(scene, direction)) continue;
                    const glm::dvec3 code = 255.0 * shaders64::shown(here, tone);
                    const Rgb drawn = shown[c].at(x, y);
                    worst = std::max(worst, largest(glm::abs(code - glm::dvec3{drawn.r, drawn.g, drawn.b})));
                    ++compared;
                }
            }
        }
        std::printf("%-6s up to %.3g cd/m2: %.2f codes over %d pixels\n", name.c_str(), brightest_cd_m2,
                    worst, compared);
        EXPECT_GT(brightest_cd_m2, name == "noon" ? 1e9 : 1e3) << "the body is not in the picture";
        // Half a code is the rounding to 8 bits.
        EXPECT_LE(worst, 1.5) << name;
    }
}

TEST_F(Luminance, OfAStarIsShownWithThePointsOwnGain) {
    const std::vector<Channel> channels{{"c", kWidth, kHeight}};
    Scene scene = make_scene(-35.0, 0.0, -40.0, 90.0, 0.0);
    add_view(scene, symmetric_frustum(8.0, kWidth, kHeight), view_from_enu(90.0, 50.0, 0.0));
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        const double place_deg = static_cast<double>(i);
        scene.planets[i] = {at(48.0 + place_deg, 87.0 + 1.3 * place_deg), 3.0 - 1.5 * place_deg, 0.8};
    }
    Renderer renderer(channels, undithered());
    const auto shown = draw(renderer, scene)[0];
    const auto tone = eye::tone_parameters(undithered(), renderer.prepare(scene).adaptation_cd_m2);
    const auto light = draw_light(channels, scene)[0];
    scene.stars.enabled = false;
    const auto sky = draw_light(channels, scene)[0];
    double worst = 0.0;
    int bright_pixels = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 star = light.at(x, y) - sky.at(x, y);
            // Of stars near the threshold the eye sees a part.
            if (star.y > 0.0 && star.y < 0.02) continue;
            const glm::dvec3 display = shaders64::display_linear(sky.at(x, y), tone) +
                                       star * (tone.point_gain * tone.inv_display_max);
            const glm::dvec3 code = 255.0 * shaders64::encoded(display, tone);
            const Rgb drawn = shown.at(x, y);
            worst = std::max(worst, largest(glm::abs(code - glm::dvec3{drawn.r, drawn.g, drawn.b})));
            bright_pixels += star.y > 0.0 ? 1 : 0;
        }
    }
    std::printf("%.2f codes over %d pixels of stars\n", worst, bright_pixels);
    EXPECT_GT(bright_pixels, 50);
    EXPECT_LE(worst, 1.5);
}

// A scene whose sky has this luminance, or whose ground has.
struct Extreme {
    const char* name;
    Scene scene;
    double least_cd_m2, most_cd_m2;  // of what has to be in the picture
};

std::vector<Extreme> extremes() {
    Scene dark = make_scene(-50.0, 0.0, -40.0, 90.0, 0.0);
    dark.ground.albedo = 0.002;
    add_view(dark, symmetric_frustum(40.0, kWidth, kHeight), view_from_enu(180.0, 0.0, 3.0));
    Scene moonlit = make_scene(-50.0, 0.0, 40.0, 180.0, 0.0);
    moonlit.ground.albedo = 0.002;
    add_view(moonlit, symmetric_frustum(10.0, kWidth, kHeight), view_from_enu(180.0, 40.0, 3.0));
    Scene sun = make_scene(50.0, 180.0, -40.0, 90.0, 3000.0);
    add_view(sun, symmetric_frustum(2.0, kWidth, kHeight), view_from_enu(180.0, 50.0, 3.0));
    Scene glaring = make_scene(50.0, 180.0, -40.0, 90.0, 0.0);
    glaring.sky.model = SkyModel::kCie;
    glaring.sky.cie.zenith_luminance_cd_m2 = 1e9;
    add_view(glaring, symmetric_frustum(40.0, kWidth, kHeight), view_from_enu(0.0, 30.0, 3.0));
    return {{"moonless", dark, 2e-6, 1e-4},
            {"full Moon", moonlit, 0.1, 1e3},
            {"Sun", sun, 3e3, 1e9},
            {"1e9 sky", glaring, 1e5, 1e9}};
}

TEST_F(Luminance, OfScenesFromAMillionthToABillionFitsHalfFloatsWithoutBands) {
    const std::vector<Channel> channels{{"c", kWidth, kHeight}};
    for (const Extreme& extreme : extremes()) {
        const auto whole = draw_light(channels, extreme.scene)[0];
        Renderer renderer(channels, undithered(), {}, Target::kHalfLuminance);
        const auto half = draw_light(renderer, extreme.scene)[0];
        const auto tone =
            eye::tone_parameters(undithered(), renderer.prepare(extreme.scene).adaptation_cd_m2);
        double least = 1e30, most = 0.0, worst_pct = 0.0, worst_codes = 0.0;
        // Where half floats have to be exact; darker parts show nothing.
        const double deepest = renderer.prepare(extreme.scene).adaptation_cd_m2 / 500.0;
        for (int y = 0; y < kHeight; y += 2) {
            for (int x = y / 2 % 3; x < kWidth; x += 3) {
                const glm::dvec3 exact = whole.at(x, y);
                const glm::dvec3 stored = half.at(x, y);
                ASSERT_TRUE(std::isfinite(stored.x + stored.y + stored.z)) << extreme.name;
                const double here = shaders64::luminance_709(exact);
                least = std::min(least, here);
                most = std::max(most, here);
                if (here > deepest)
                    worst_pct =
                        std::max(worst_pct, 100.0 * std::abs(shaders64::luminance_709(stored) / here - 1.0));
                worst_codes = std::max(worst_codes, 255.0 * largest(glm::abs(shaders64::shown(stored, tone) -
                                                                             shaders64::shown(exact, tone))));
            }
        }
        std::printf("%-9s %.2g .. %.2g cd/m2: half floats off by %.2f %%, %.3f codes\n", extreme.name, least,
                    most, worst_pct, worst_codes);
        EXPECT_LT(least, extreme.least_cd_m2) << extreme.name;
        EXPECT_GT(most, extreme.most_cd_m2) << extreme.name;
        EXPECT_LE(worst_pct, 1.0) << extreme.name;
        EXPECT_LE(worst_codes, 0.3) << extreme.name;
    }
}

}  // namespace
}  // namespace skyig::render
