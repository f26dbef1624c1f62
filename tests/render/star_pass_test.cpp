// Stars: position, energy and colour of what is drawn, independent of field of view and sub-pixel offset.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/geometry.h"
#include "render/night/star_catalogue.h"
#include "render/sky_frame.h"
#include "render/star_field.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

class StarPass : public GlTest {};

// A moonless night with one star straight ahead: the view is turned to it.
Scene night_towards(const glm::dvec3& direction_enu) {
    Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 0.0);
    scene.night.starlight = scene.night.galactic_light = false;  // an even sky behind the star
    const Horizontal at = horizontal_of(direction_enu);
    const glm::dmat3 view = view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0);
    add_view(scene, symmetric_frustum(5.0, 128, 128), view);
    return scene;
}

// The brightest star of the fixture's sky that is well above the horizon.
const night::CatalogueStar& brightest_star() {
    const Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 0.0);
    const auto stars = night::star_catalogue();
    const auto brightness = [&](const night::CatalogueStar& star) {
        const glm::dvec3 d = scene.stars.enu_from_gcrs * glm::dvec3{star.direction_gcrs};
        return d.z > 0.5 ? -star.vmag : -100.0F;
    };
    return *std::max_element(stars.begin(), stars.end(),
                             [&](const auto& a, const auto& b) { return brightness(a) < brightness(b); });
}

// As it is seen.
glm::dvec3 brightest_direction() {
    const Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 0.0);
    return seen(scene,
                glm::normalize(scene.stars.enu_from_gcrs * glm::dvec3{brightest_star().direction_gcrs}));
}

TEST_F(StarPass, StarStandsWhereItsDirectionIs) {
    const Scene scene = night_towards(brightest_direction());
    const auto picture = draw({{"only", 128, 128}}, scene, undithered())[0];
    double sum = 0.0, x = 0.0, y = 0.0;
    const Rgb sky = picture.at(3, 3);
    for (int row = 56; row < 72; ++row) {
        for (int column = 56; column < 72; ++column) {
            const double light = std::max(0, picture.at(column, row).g - sky.g - 1);
            sum += light;
            x += light * (column + 0.5);
            y += light * (row + 0.5);
        }
    }
    ASSERT_GT(sum, 100.0);
    EXPECT_NEAR(x / sum, 64.0, 0.1);
    EXPECT_NEAR(y / sum, 64.0, 0.1);
}

// Light of a display whose white is 1, from its code.
double decoded(int code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// What one star adds to a picture: display linear times solid angle, summed over its footprint.
struct Footprint {
    double energy_sr = 0.0;
    double peak = 0.0;
    int brightest_code = 0;
};

class StarEnergy : public StarPass {
  protected:
    // Energy is measured below the shoulder of the tone curve, where the display is linear in the star's
    // light, as what a picture with stars has more than one without.
    Footprint footprint(Renderer& renderer, Scene scene, const glm::dvec3& star) {
        scene.stars.enabled = true;
        const Picture with = draw(renderer, scene)[0];
        scene.stars.enabled = false;
        const Picture without = draw(renderer, scene)[0];
        const Channel& channel = renderer.channels()[0];
        const Frustum& frustum = scene.views[0].frustum;
        const ImagePlane p = image_plane(frustum);
        const double on_axis_sr =
            (p.right - p.left) / channel.width_px * (p.top - p.bottom) / channel.height_px;
        const glm::dvec2 centre = picture_point(channel, scene.views[0], star);
        const glm::dvec3 middle = scene.views[0].view_from_enu * star;
        const double reach = kReachOnAxis_px * pixel_angle_rad(channel, frustum);
        const auto first = [](double at_px) { return std::max(0, static_cast<int>(at_px) - kReach_px); };
        const auto end = [](double at_px, int size) {
            return std::min(size, static_cast<int>(at_px) + kReach_px + 1);
        };
        Footprint result;
        for (int y = first(centre.y); y < end(centre.y, channel.height_px); ++y) {
            for (int x = first(centre.x); x < end(centre.x, channel.width_px); ++x) {
                const glm::dvec3 here =
                    view_direction(channel, frustum, x + 0.5, channel.height_px - y - 0.5);
                if (glm::length(here - middle) > reach) continue;
                const double added = decoded(with.at(x, y).g) - decoded(without.at(x, y).g);
                result.energy_sr += added * on_axis_sr * std::pow(-here.z, 3.0);
                result.peak = std::max(result.peak, added);
                result.brightest_code =
                    std::max({result.brightest_code, with.at(x, y).r, with.at(x, y).g, with.at(x, y).b});
            }
        }
        return result;
    }

    // Beyond the footprint, short of the next star; off the axis the same angle spans more pixels.
    static constexpr double kReachOnAxis_px = 5.0;
    static constexpr int kReach_px = 25;
    // Code of the start of the shoulder, 0.7 of full white.
    static constexpr int kShoulder = 218;
};

TEST_F(StarEnergy, ZoomMakesStarsStandOutAndLeavesTheSkyAlone) {
    const glm::dvec3 star = brightest_direction();
    const Channel channel{"only", 128, 128};
    Renderer renderer({channel}, undithered());
    Scene near = night_towards(star);
    Scene far = near;
    near.stars.intensity = far.stars.intensity = 0.6;
    near.views[0].frustum = symmetric_frustum(5.0, 128, 128);
    far.views[0].frustum = symmetric_frustum(15.0, 128, 128);
    const Footprint zoomed = footprint(renderer, near, star);
    const Footprint wide = footprint(renderer, far, star);
    ASSERT_LT(zoomed.brightest_code, kShoulder);
    // The same energy on pixels of a smaller solid angle.
    const double pixels = std::pow(std::tan(15.0 * kDegree) / std::tan(5.0 * kDegree), 2.0);
    std::printf("codes %d and %d, peak %.2f-fold of %.2f, energy %.3f-fold\n", zoomed.brightest_code,
                wide.brightest_code, zoomed.peak / wide.peak, pixels, zoomed.energy_sr / wide.energy_sr);
    EXPECT_NEAR(zoomed.peak / wide.peak / pixels, 1.0, 0.1);
    EXPECT_NEAR(zoomed.energy_sr / wide.energy_sr, 1.0, 0.05);

    near.stars.enabled = far.stars.enabled = false;
    const Picture zoomed_sky = draw(renderer, near)[0];
    const Picture wide_sky = draw(renderer, far)[0];
    for (const auto& [x, y] : {std::pair{4, 64}, std::pair{124, 64}, std::pair{64, 4}, std::pair{64, 124}}) {
        const glm::dvec3 direction =
            glm::transpose(near.views[0].view_from_enu) *
            view_direction(channel, near.views[0].frustum, x + 0.5, channel.height_px - y - 0.5);
        const glm::dvec2 there = picture_point(channel, far.views[0], direction);
        EXPECT_LE(difference(zoomed_sky.at(x, y),
                             wide_sky.at(static_cast<int>(there.x), static_cast<int>(there.y))),
                  1);
    }
}

TEST_F(StarPass, SwitchAndIntensityAreObeyed) {
    Scene scene = night_towards(brightest_direction());
    const int full = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    scene.stars.intensity = 0.02;
    const int faint = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    scene.stars.enabled = false;
    const int off = draw({{"only", 128, 128}}, scene, undithered())[0].at(64, 64).g;
    EXPECT_GT(full, faint);
    EXPECT_GT(faint, off);
}

TEST_F(StarPass, StarsFadeThroughDuskAndAreGoneByDay) {
    std::size_t last = 20000;
    for (const double sun : {-20.0, -12.0, -6.0, -3.0, 5.0}) {
        Scene scene = make_scene(sun, 0.0, -40.0, 90.0, 0.0);
        add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(0.0, 40.0, 0.0));
        Renderer renderer({{"only", 64, 64}}, undithered());
        renderer.prepare(scene);
        const std::size_t drawn = renderer.prepare(scene).stars_drawn;
        std::printf("sun %5.1f deg: %zu stars\n", sun, drawn);
        EXPECT_LE(drawn, last) << sun;
        last = drawn;
    }
    EXPECT_EQ(last, 0U);
}

int changed_codes(const Picture& a, const Picture& b) {
    int changed = 0;
    for (int y = 0; y < a.height_px; ++y) {
        for (int x = 0; x < a.width_px; ++x)
            changed += difference(a.at(x, y), b.at(x, y)) > 0 ? 1 : 0;
    }
    return changed;
}

TEST_F(StarPass, ScreensThatReflectMoreThanTheDarkSkyShowStarsOverIt) {
    DisplaySettings display = undithered();
    display.max_luminance_cd_m2 = 100.0;
    display.reflected_cd_m2 = 3.0;
    Scene scene = night_towards(brightest_direction());
    Renderer renderer({{"only", 128, 128}}, display);
    const Picture with = draw(renderer, scene)[0];
    EXPECT_TRUE(renderer.prepare(scene).plan.needs(Pass::kStars));
    scene.stars.enabled = false;
    const Picture without = draw(renderer, scene)[0];
    std::printf("%d pixels show a star\n", changed_codes(with, without));
    EXPECT_EQ(without.at(3, 3).g, 0) << "the sky is below the screen's black";
    EXPECT_GT(changed_codes(with, without), 4);
}

TEST_F(StarPass, PlanetThatShowsInTheCornerAloneIsDrawn) {
    const Channel channel{"only", 64, 64};
    Scene scene = make_scene(3.0, 0.0, -40.0, 90.0, 0.0);
    const Frustum frustum = symmetric_frustum(65.0, channel.width_px, channel.height_px);
    add_view(scene, frustum, view_from_enu(180.0, 5.0, 0.0));
    const glm::dvec3 corner =
        glm::transpose(scene.views[0].view_from_enu) * view_direction(channel, frustum, 62.5, 62.5);
    SkyFrame frame(undithered(), {});
    const double axis_rad = pixel_angle_rad(channel, frustum);
    frame.prepare(scene, axis_rad);
    const Horizontal at = horizontal_of(corner);
    const auto sky_cd_m2 = static_cast<double>(
        shaders32::luminance_709(frame.light().rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kSky)));
    // As bright as it takes to show in the corner, and not on the axis: the sky there is no darker.
    const double on_axis_mag = half_code_mag(sky_cd_m2, frame.tone(), axis_rad * axis_rad);
    const double in_corner_mag =
        half_code_mag(sky_cd_m2, frame.tone(), smallest_pixel_sr({&channel, 1}, scene.channel_views()));
    std::printf("half a code: %.2f mag on the axis, %.2f in the corner\n", on_axis_mag, in_corner_mag);
    EXPECT_GT(in_corner_mag - on_axis_mag, 2.0);
    Quality forced;
    forced.forced.set(static_cast<std::size_t>(Pass::kStars));
    Renderer planned({channel}, undithered());
    Renderer all({channel}, undithered(), forced);
    int shown = 0;
    for (const double part : {-0.3, 0.1, 0.4, 0.7, 1.0}) {
        const double mag = std::lerp(on_axis_mag, in_corner_mag, part);
        scene.planets[1] = {corner, mag, 0.8};
        const Picture picture = draw(planned, scene)[0];
        EXPECT_EQ(changed_codes(picture, draw(all, scene)[0]), 0) << mag;
        scene.stars.enabled = false;
        const int changed = changed_codes(picture, draw(planned, scene)[0]);
        scene.stars.enabled = true;
        std::printf("%.2f mag: %d pixels\n", mag, changed);
        shown += changed > 0 ? 1 : 0;
    }
    EXPECT_GE(shown, 3);
}

}  // namespace
}  // namespace skyig::render
