// What is drawn through a warp stands where known geometry has it, and an identity changes no code.
#include "render/warp_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/gl/texture.h"
#include "tests/render/direction_dome.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/warps.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

class WarpedPicture : public GlTest {};

Channel warped_channel(std::shared_ptr<const warp::Warp> warp, int width_px = kWidth,
                       int height_px = kHeight) {
    return {.name = "only", .width_px = width_px, .height_px = height_px, .warp = std::move(warp)};
}

TEST_F(WarpedPicture, EveryPixelShowsTheDirectionThatTheWarpSays) {
    const CurvedScreen curved;
    const CurvedScreen wide{50.0 * kDegree, 0.6};
    for (const auto& [yaw, pitch, roll] :
         {std::array{0.0, 0.0, 0.0}, {33.0, 25.0, 10.0}, {200.0, -60.0, 80.0}}) {
        const glm::dmat3 view = view_from_enu(yaw, pitch, roll);
        const auto error_deg = [&](const Channel& channel, const Frustum& frustum, bool refines,
                                   const auto& truth) {
            DirectionDome dome(refines);
            return dome.worst_error_deg(channel, {frustum, view}, longest_edge_rad(channel, frustum), truth);
        };
        const auto flat = [](const Frustum& frustum) {
            return [plane = image_plane(frustum)](const glm::dvec2& screen) {
                return glm::dvec3{glm::mix(plane.left, plane.right, screen.x),
                                  glm::mix(plane.bottom, plane.top, screen.y), -1.0};
            };
        };
        const auto on = [](const CurvedScreen& screen) {
            return [screen](const glm::dvec2& place) { return screen.direction(place); };
        };
        const Channel identity = warped_channel(identity_warp(kWidth, kHeight));
        const Channel bent = warped_channel(curved.warp(kWidth, kHeight));
        const Channel far = warped_channel(wide.warp(kWidth, kHeight));
        const Frustum off_axis{-0.2, 0.8, -0.1, 0.6};
        const double plain_deg = error_deg(identity, curved.frustum(), true, flat(curved.frustum()));
        const double off_axis_deg = error_deg(identity, off_axis, true, flat(off_axis));
        const double bent_deg = error_deg(bent, curved.frustum(), true, on(curved));
        const double wide_deg = error_deg(far, wide.frustum(), true, on(wide));
        const double coarse_deg = error_deg(bent, curved.frustum(), false, on(curved));
        std::printf(
            "worst pixel: identity %.5f deg, off axis %.5f, curved %.4f, curved 100 deg %.4f, "
            "curved without refinement %.3f\n",
            plain_deg, off_axis_deg, bent_deg, wide_deg, coarse_deg);
        EXPECT_LT(plain_deg, 0.001);
        EXPECT_LT(off_axis_deg, 0.001);
        EXPECT_LT(bent_deg, 0.05);
        EXPECT_LT(wide_deg, 0.05);
        EXPECT_GT(coarse_deg, bent_deg);
    }
}

TEST_F(WarpedPicture, IdentityChangesNoCode) {
    Renderer flat({{"only", kWidth, kHeight}}, {});
    Renderer warped({warped_channel(identity_warp(kWidth, kHeight))}, {});
    auto scenes = four_times();
    add_waves(scenes[1].scene);
    double time_s = 0.0;
    for (auto& [name, scene] : scenes) {
        scene.time_s = time_s += 1000.0;
        add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(120.0, 3.0, 5.0));
        EXPECT_TRUE(draw(flat, scene)[0].rgba == draw(warped, scene)[0].rgba) << name;
    }
}

// What follows another renderer's things in a frame is still moved by the warp, not by what their clouds left
// bound.
TEST_F(WarpedPicture, MoonsGlareStandsWhereItDoesWithoutAWarpWhenThingsAndCloudsAreDrawn) {
    const FakeSheet sheet{.wavelength_m = 0.0,
                          .least_transmittance = 0.7,
                          .most_transmittance = 0.7,
                          .light_cd_m2 = glm::vec3{0.4F}};
    Scene scene = make_scene(-35.0, 90.0, 12.0, 270.0, 300.0);
    add_layer(scene, sheet);
    add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(270.0, 0.0, 0.0));
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    gl::Texture colour{gl::TexelFormat::kRgba32F, kWidth, kHeight};
    gl::Texture depth{gl::TexelFormat::kR32F, kWidth, kHeight};
    std::vector<float> depths(kPixels, 1.0F);
    std::fill_n(depths.begin(), kPixels / 3, 0.2F);
    colour.update(std::vector<float>(4 * kPixels, 0.01F));
    depth.update(depths);
    const auto picture_of = [&](const Channel& channel, bool glare) {
        DisplaySettings display = undithered();
        display.glare = glare;
        Renderer renderer({channel}, display);
        renderer.draw_clouds(fake_clouds(sheet));
        std::vector<std::byte> rgba(4 * kPixels);
        renderer.prepare(scene);
        renderer.draw_scene(0, {colour.name(), depth.name(), 1000.0});
        renderer.read_back(0, rgba);
        return rgba;
    };
    const Channel flat{"only", kWidth, kHeight};
    const std::vector<std::byte> glaring = picture_of(flat, true);
    EXPECT_FALSE(glaring == picture_of(flat, false)) << "there is a glare to be moved";
    EXPECT_TRUE(glaring == picture_of(warped_channel(identity_warp(kWidth, kHeight)), true));
}

TEST_F(WarpedPicture, SkyHasTheCodesOfTheDirectionsThatItsPixelsShow) {
    const CurvedScreen curved;
    Renderer renderer({warped_channel(curved.warp(kWidth, kHeight))}, without_glare());
    double time_s = 0.0;
    for (auto& [name, scene] : four_times()) {
        Scene viewed = scene;
        viewed.time_s = time_s += 1000.0;
        viewed.stars.enabled = false;
        add_view(viewed, curved.frustum(), view_from_enu(20.0, 30.0, 12.0));
        const Picture picture = draw(renderer, viewed)[0];
        double worst = 0.0;
        for (int y = 5; y < kHeight; y += 10) {
            for (int x = 5; x < kWidth; x += 10) {
                const glm::dvec3 direction = glm::transpose(viewed.views[0].view_from_enu) *
                                             view_direction(renderer.channels()[0], viewed.views[0].frustum,
                                                            x + 0.5, kHeight - y - 0.5);
                if (direction.z < 0.02) continue;
                const glm::dvec3 code = 255.0 * renderer.reference_colour(direction);
                const Rgb drawn = picture.at(x, y);
                worst = std::max({worst, std::abs(drawn.r - code.x), std::abs(drawn.g - code.y),
                                  std::abs(drawn.b - code.z)});
            }
        }
        std::printf("%s: %.2f codes\n", name.c_str(), worst);
        EXPECT_LT(worst, 1.6) << name;
    }
}

// A planet's light in a picture: its middle, from the upper left corner, and its sum of light times solid
// angle.
struct Spot {
    glm::dvec2 at_px{0.0};
    double sum_sr = 0.0;
};

Spot spot_near(const std::vector<float>& rgb, const Channel& channel, const ChannelView& view,
               const glm::dvec2& at_px) {
    const auto value = [&](int x, int y) {
        return static_cast<double>(
            rgb[(static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) * 3 + 1]);
    };
    const int left = static_cast<int>(at_px.x) - 6;
    const int top = static_cast<int>(at_px.y) - 6;
    const double sky = value(left, top);
    Spot spot;
    double sum = 0.0;
    for (int y = top; y <= top + 12; ++y) {
        for (int x = left; x <= left + 12; ++x) {
            const auto corner = [&](double dx, double dy) {
                return view_direction(channel, view.frustum, x + dx, kHeight - y - dy);
            };
            const double solid_sr = glm::length(
                glm::cross(corner(1.0, 0.5) - corner(0.0, 0.5), corner(0.5, 1.0) - corner(0.5, 0.0)));
            const double light = value(x, y) - sky;
            sum += light;
            spot.at_px += light * glm::dvec2{x + 0.5, y + 0.5};
            spot.sum_sr += light * solid_sr;
        }
    }
    spot.at_px /= sum;
    return spot;
}

TEST_F(WarpedPicture, PointsOfLightStandWhereTheWarpHasThemAndKeepTheirLight) {
    const CurvedScreen curved;
    const Channel channel = warped_channel(curved.warp(kWidth, kHeight));
    Scene scene = make_scene(-40.0, 0.0, -40.0, 90.0, 600.0);
    scene.night.starlight = scene.night.galactic_light = scene.night.airglow = false;
    scene.stars.enabled = true;
    add_view(scene, curved.frustum(), view_from_enu(10.0, 45.0, 20.0));
    Scene empty = scene;
    std::vector<glm::dvec2> places{{0.07, 0.1}, {0.93, 0.88}, {0.5, 0.5}, {0.2, 0.8}, {0.85, 0.3}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 d = glm::transpose(scene.views[0].view_from_enu) * curved.direction(places[i]);
        scene.planets[i].direction_enu = d;
        scene.planets[i].magnitude = -4.0;
        empty.planets[i].magnitude = 30.0;
    }
    Renderer with({channel}, {}, {}, Target::kLuminance);
    Renderer without({channel}, {}, {}, Target::kLuminance);
    std::vector<float> rgb(std::size_t{kWidth} * kHeight * 3);
    std::vector<float> sky(rgb.size());
    for (const auto& [renderer, what, out] : {std::tuple{&with, &scene, &rgb}, {&without, &empty, &sky}}) {
        renderer->prepare(*what);
        renderer->draw(0);
        renderer->read_luminance(0, *out);
    }
    std::transform(rgb.begin(), rgb.end(), sky.begin(), rgb.begin(), std::minus<>{});
    double worst_px = 0.0;
    double least = 1e9;
    double most = 0.0;
    for (const glm::dvec2& place : places) {
        const glm::dvec3 d = glm::transpose(scene.views[0].view_from_enu) * curved.direction(place);
        // Air lifts them, and dims them by where they stand.
        const glm::dvec2 flat_px = picture_point({"flat", kWidth, kHeight}, scene.views[0], seen(scene, d));
        const auto screen = channel.warp->screen_of({flat_px.x / kWidth, 1.0 - flat_px.y / kHeight});
        ASSERT_TRUE(screen);
        const glm::dvec2 truth_px{screen->x * kWidth, (1.0 - screen->y) * kHeight};
        const Spot spot = spot_near(rgb, channel, scene.views[0], truth_px);
        worst_px = std::max(worst_px, glm::length(spot.at_px - truth_px));
        const double air = std::pow(10.0, -0.4 * 0.2 / std::max(d.z, 0.1));
        least = std::min(least, spot.sum_sr / air);
        most = std::max(most, spot.sum_sr / air);
    }
    std::printf("points: %.3f px off, light from %.4g to %.4g lx\n", worst_px, least, most);
    EXPECT_LT(worst_px, 0.15);
    EXPECT_GT(least, 0.0);
    EXPECT_LT(most / least, 1.1);
}

TEST_F(WarpedPicture, ResampledPictureIsTheDirectOne) {
    const CurvedScreen curved;
    Scene scene = make_scene(20.0, 60.0, -30.0, 300.0, 400.0);
    add_view(scene, curved.frustum(), view_from_enu(20.0, 10.0, 12.0));
    Channel channel = warped_channel(curved.warp(kWidth, kHeight));
    const Picture direct = draw({channel}, scene, undithered())[0];
    channel.drawing = WarpDrawing::kResampled;
    channel.render_scale = 1.5;
    const Picture resampled = draw({channel}, scene, undithered())[0];
    int far = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x)
            far += difference(direct.at(x, y), resampled.at(x, y)) > 2 ? 1 : 0;
    }
    std::printf("resampled: %d of %d pixels differ by more than 2 codes\n", far, kWidth * kHeight);
    EXPECT_LT(far, kWidth * kHeight / 500);  // what there is lies on the horizon's edge
}

}  // namespace
}  // namespace skyig::render
