// What a disc's pixels add up to: the body's illuminance, at any field of view; and which way up the Moon's
// face stands.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "render/discs.h"
#include "render/gl/draw.h"
#include "render/gl/framebuffer.h"
#include "render/night/moon_light.h"
#include "render/sky_frame.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kSize = 400;

// Shows luminance as it is, `mean_cd_m2` at so much of white that the brightest parts stay below the
// shoulder.
constexpr double kShown = 0.17;
shaders32::ToneParameters linear_tone(double mean_cd_m2) {
    shaders32::ToneParameters tone{};
    tone.log2_gain = static_cast<float>(std::log2(kShown / mean_cd_m2));
    tone.exponent = 1.0F;
    tone.photopic = 1.0F;
    tone.inv_display_max = 1.0F;
    tone.shoulder = 1.0F;
    tone.encode_power = 1.0F;
    return tone;
}

class DiscSum : public GlTest {
  protected:
    // Looks at a direction; `draw` gets the view's matrix. Sum over pixels of what is shown times their solid
    // angle.
    template <class Draw>
    double summed(const glm::dvec3& centre, double half_width_deg, Draw draw) {
        const Horizontal at = horizontal_of(centre);
        const glm::dmat3 view = view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 20.0);
        const double tangent = std::tan(half_width_deg * kDegree);
        const glm::dmat4 clip = glm::dmat4{glm::dvec4{1.0 / tangent, 0.0, 0.0, 0.0},
                                           {0.0, 1.0 / tangent, 0.0, 0.0},
                                           {0.0, 0.0, 0.0, -1.0},
                                           glm::dvec4{0.0}} *
                                glm::dmat4{view};
        gl::Framebuffer target(kSize, kSize);
        target.bind();
        gl::set_common_state();
        gl::set_blend(gl::Blend::kCoverage);
        draw(glm::mat4{clip});
        std::vector<std::byte> rgba(std::size_t{kSize} * kSize * 4);
        target.read_rgba8(rgba);
        double sum = 0.0;
        const double step = 2.0 * tangent / kSize;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const double u = (x + 0.5) * step - tangent, v = (y + 0.5) * step - tangent;
                const std::size_t i = (static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)) * 4;
                const glm::dvec3 rgb{std::to_integer<int>(rgba[i]), std::to_integer<int>(rgba[i + 1]),
                                     std::to_integer<int>(rgba[i + 2])};
                sum +=
                    shaders64::luminance_709(rgb / 255.0) * step * step * std::pow(1.0 + u * u + v * v, -1.5);
            }
        }
        return sum;
    }
    // Of a pixel at the middle of that view.
    static double pixel_rad(double half_width_deg) {
        return 2.0 * std::tan(half_width_deg * kDegree) / kSize;
    }
};

constexpr std::array kHalfWidths_deg{0.5, 2.0, 5.0, 15.0};

TEST_F(DiscSum, SunsPixelsAddUpToItsIlluminanceAtAnyFieldOfView) {
    const Scene scene = make_scene(40.0, 180.0, -40.0, 0.0, 0.0);
    SkyFrame frame(undithered(), {});
    frame.prepare(scene, 1e-3);
    const SkyLight& light = frame.light();
    const Horizontal airless = horizontal_of(scene.sun.direction_enu);
    const Horizontal seen_at{light.refraction.apparent_from_true(airless.elevation_rad), airless.azimuth_rad};
    const double lux = frame.air().direct_sun_xyz(0.0, seen_at.elevation_rad).y;
    const double mean = lux / (std::numbers::pi * std::pow(std::sin(scene.sun.angular_radius_rad), 2.0));
    const double flattened = light.refraction.vertical_scale(seen_at.elevation_rad);
    SunDisc disc{gl::Placement::kFlat};
    for (const double half_width_deg : kHalfWidths_deg) {
        // The sky is left out: it is 1e5 times darker.
        disc.prepare(scene, frame, pixel_rad(half_width_deg), linear_tone(mean), false);
        const double shown =
            summed(direction_of(seen_at), half_width_deg, [&](const glm::mat4& clip) { disc.draw(clip); });
        const double ratio = shown / kShown * mean / (lux * flattened);
        std::printf("Sun, half width %4.1f deg: sum over illuminance %.4f\n", half_width_deg, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.01) << half_width_deg;
    }
}

TEST_F(DiscSum, MoonsPixelsAddUpToItsIlluminanceAtAnyFieldOfViewAndPhase) {
    MoonDisc disc{gl::Placement::kFlat};
    SkyFrame frame(undithered(), {});
    for (const double sun_azimuth_deg : {185.0, 90.0, 270.0, 220.0}) {
        Scene scene = make_scene(-2.0, sun_azimuth_deg, 40.0, 10.0, 0.0);
        // As in nature the Sun stands over the Moon's equator.
        const glm::dvec3 x = -scene.moon.direction_enu;
        const glm::dvec3 beside = scene.moon.to_sun_enu - x * glm::dot(x, scene.moon.to_sun_enu);
        const glm::dvec3 y = glm::normalize(sun_azimuth_deg < 200.0 ? beside : -beside);
        scene.moon.enu_from_selenographic = {x, y, glm::cross(x, y)};
        // Its own light stays; that of the sky, which is left out, goes with the Sun.
        scene.sun.direction_enu = at(-40.0, sun_azimuth_deg);
        frame.prepare(scene, 1e-3);
        const SkyLight& light = frame.light();
        const Horizontal airless = horizontal_of(scene.moon.direction_enu);
        const Horizontal seen_at{light.refraction.apparent_from_true(airless.elevation_rad),
                                 airless.azimuth_rad};
        const double passed = shaders64::luminance_709(
            night::moon_tint_rgb() * frame.air().transmittance_rgb(0.0, seen_at.elevation_rad));
        const double lux = passed * night::moon_illuminance_lux(scene.moon, 1.0);
        const double lit_share = 0.5 * (1.0 + std::cos(scene.moon.phase_angle_rad));
        const double mean = passed * night::moon_mean_cd_m2(scene.moon, 1.0) / lit_share;
        const double flattened = light.refraction.vertical_scale(seen_at.elevation_rad);
        for (const double half_width_deg : kHalfWidths_deg) {
            disc.prepare(scene, frame, pixel_rad(half_width_deg), linear_tone(mean), false, {}, {});
            const double shown = summed(direction_of(seen_at), half_width_deg,
                                        [&](const glm::mat4& clip) { disc.draw(clip); });
            const double ratio = shown / kShown * mean / (lux * flattened);
            std::printf("phase %3.0f deg, half width %4.1f deg: sum over illuminance %.4f\n",
                        scene.moon.phase_angle_rad / kDegree, half_width_deg, ratio);
            // A disc of five pixels is a phase of few samples.
            EXPECT_NEAR(ratio, 1.0, half_width_deg > 10.0 ? 0.06 : 0.02)
                << sun_azimuth_deg << " " << half_width_deg;
        }
    }
}

// Mean green of 5 x 5 pixels at a selenographic place, as the view shows it.
int green_at(const Picture& picture, const Scene& scene, double latitude_deg, double longitude_deg) {
    const double level = std::cos(latitude_deg * kDegree);
    const glm::dvec3 place{level * std::cos(longitude_deg * kDegree),
                           level * std::sin(longitude_deg * kDegree), std::sin(latitude_deg * kDegree)};
    const glm::dvec3 enu = scene.moon.direction_enu + std::sin(scene.moon.angular_radius_rad) *
                                                          (scene.moon.enu_from_selenographic * place);
    const glm::dvec2 at = picture_point({"", picture.width_px, picture.height_px}, scene.views[0],
                                        seen(scene, glm::normalize(enu)));
    int sum = 0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x)
            sum += picture.at(static_cast<int>(at.x) + x, static_cast<int>(at.y) + y).g;
    }
    return sum / 25;
}

TEST_F(DiscSum, MoonsFaceStandsNorthUpFromTheNorthAndSouthUpFromTheSouth) {
    for (const bool from_north : {true, false}) {
        Scene scene = make_scene(-40.0, 0.0, 45.0, from_north ? 180.0 : 0.0, 0.0);
        scene.stars.enabled = false;
        scene.moon.to_sun_enu = -scene.moon.direction_enu;
        scene.moon.phase_angle_rad = 0.03;
        // Seen from the south the same Moon, low in the north, hangs head down.
        glm::dmat3& axes = scene.moon.enu_from_selenographic;
        if (!from_north) axes = {axes[0], -axes[1], -axes[2]};
        const Horizontal at = horizontal_of(seen(scene, scene.moon.direction_enu));
        add_view(scene, symmetric_frustum(0.4, kSize, kSize),
                 view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0));
        const Picture picture = draw({{"only", kSize, kSize}}, scene, undithered())[0];
        // By place on the picture: Crisium is right of the middle and above it with north up, Tycho far
        // below.
        const double radius_px =
            std::tan(scene.moon.angular_radius_rad) / std::tan(0.4 * kDegree) * kSize / 2;
        const double sign = from_north ? 1.0 : -1.0;
        const auto on_picture = [&](double right, double up) {
            return picture
                .at(static_cast<int>(kSize / 2 + sign * right * radius_px),
                    static_cast<int>(kSize / 2 - sign * up * radius_px))
                .g;
        };
        const int crisium = on_picture(0.82, 0.29), mirrored = on_picture(-0.94, 0.0);
        std::printf("Crisium %d, western limb %d, Tycho %d, Imbrium %d\n", crisium, mirrored,
                    on_picture(-0.14, -0.686), on_picture(-0.26, 0.59));
        EXPECT_GT(on_picture(-0.14, -0.686), on_picture(-0.26, 0.59) + 20)
            << "the south is bright, Imbrium dark";
        EXPECT_LT(crisium, on_picture(0.70, -0.45) - 20) << "a dark spot in the bright east";
        EXPECT_LT(on_picture(-0.80, 0.31), on_picture(0.60, -0.60) - 20) << "the west is an ocean";
        // And by selenographic place.
        EXPECT_LT(green_at(picture, scene, 17.0, 59.1), green_at(picture, scene, -35.0, 35.0) - 20);
        EXPECT_LT(green_at(picture, scene, 51.6, -9.4), green_at(picture, scene, 47.3, -0.6))
            << "Plato's floor";
    }
}

TEST_F(DiscSum, DarkSideOfACrescentGoesOverIntoItsSkyWithoutAnEdgeDarkerThanIt) {
    Scene scene = make_scene(-10.0, 240.0, 12.0, 235.0, 0.0);
    scene.stars.enabled = false;
    const Horizontal at = horizontal_of(seen(scene, scene.moon.direction_enu));
    add_view(scene, symmetric_frustum(0.5, kSize, kSize),
             view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0));
    const Picture picture = draw({{"only", kSize, kSize}}, scene, undithered())[0];
    const double radius_px = std::tan(scene.moon.angular_radius_rad) / std::tan(0.5 * kDegree) * kSize / 2;
    const auto up = [&](double radii) {
        return picture.at(kSize / 2, static_cast<int>(kSize / 2 - radii * radius_px));
    };
    std::printf("inside %d %d %d, outside %d %d %d\n", up(0.9).r, up(0.9).g, up(0.9).b, up(1.1).r, up(1.1).g,
                up(1.1).b);
    EXPECT_GE(up(0.9).g, up(1.1).g) << "earthlight brightens the dark side";
    EXPECT_LE(up(0.9).g, up(1.1).g + 25);
}

}  // namespace
}  // namespace skyig::render
