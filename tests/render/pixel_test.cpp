// Drawn pixels against tone(absolute luminance) of the same direction, computed on the CPU in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "tests/render/dome_light.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/steadiness.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 640;
constexpr int kHeight = 512;

class Pixel : public GlTest {};

TEST_F(Pixel, SmoothLightIsWithinACodeOfTheExactColour) {
    const std::vector<Channel> channels{{"only", kWidth, kHeight}};
    const Frustum frustum = symmetric_frustum(40.0, kWidth, kHeight);
    auto scenes = four_times();
    scenes.push_back({"10 km", make_scene(25.0, 180.0, -30.0, 0.0, 10000.0)});
    scenes.push_back({"sunset 10 km", make_scene(-2.0, 180.0, -30.0, 0.0, 10000.0)});
    scenes.push_back({"sun -9", make_scene(-9.0, 180.0, -30.0, 0.0, 300.0)});
    for (auto& [name, scene] : scenes) {
        scene.stars.enabled = scene.sun.enabled = scene.moon.enabled = false;
        const double source = name == "dawn" ? 120.0 : name == "dusk" ? 235.0 : 180.0;
        add_view(scene, frustum, view_from_enu(source + 15.0, 6.0, 5.0));
        Renderer renderer(channels, undithered());
        const auto pictures = draw(renderer, scene);
        const double horizon = refraction_of(scene).horizon_elevation_rad();
        const double edge = 1.5 * pixel_angle_rad(channels[0], frustum);
        std::vector<double> errors;
        for (int y = 0; y < kHeight; y += 3) {
            for (int x = 0; x < kWidth; x += 3) {
                const glm::dvec3 direction = glm::transpose(scene.views[0].view_from_enu) *
                                             view_direction(channels[0], frustum, x + 0.5, kHeight - y - 0.5);
                if (std::abs(std::asin(direction.z) - horizon) < edge) continue;
                const glm::dvec3 exact = renderer.reference_colour(direction) * 255.0;
                const Rgb drawn = pictures[0].at(x, y);
                errors.push_back(std::max(
                    {std::abs(drawn.r - exact.x), std::abs(drawn.g - exact.y), std::abs(drawn.b - exact.z)}));
            }
        }
        std::sort(errors.begin(), errors.end());
        const double p99 = errors[errors.size() * 99 / 100];
        std::printf("%-13s codes: median %.2f, p99 %.2f, largest %.2f\n", name.c_str(),
                    errors[errors.size() / 2], p99, errors.back());
        // Half a code of each is the rounding to 8 bits.
        EXPECT_LE(p99, 0.8) << name;
        EXPECT_LE(errors.back(), 1.0) << name;
    }
}

// Forty scenes and views; what is on top of smooth light is switched off.
std::vector<Scene> forty_scenes(const Channel& channel) {
    std::vector<Scene> scenes;
    int view = 0;
    for (const double height_m : {0.0, 300.0, 3e3, 12e3, 400e3}) {
        for (const double sun_deg : {80.0, 35.0, 8.0, 0.5, -1.5, -6.0, -12.0, -30.0}) {
            Scene scene = make_scene(sun_deg, 120.0, 25.0, 250.0, height_m);
            scene.stars.enabled = scene.sun.enabled = scene.moon.enabled = false;
            scene.night.starlight = scene.night.galactic_light = false;
            scene.time_s = 100.0 * ++view;
            const double half_deg = view % 3 == 0 ? 80.0 : view % 3 == 1 ? 30.0 : 4.0;
            add_view(
                scene, symmetric_frustum(half_deg, channel.width_px, channel.height_px),
                view_from_enu(120.0 + 47.0 * view, view % 5 == 0 ? -35.0 : 4.0 * (view % 5), 21.0 * view));
            scenes.push_back(scene);
        }
    }
    return scenes;
}

TEST_F(Pixel, DrawnDomeIsWithinACodeOfTheSameDomeInDouble) {
    const std::vector<Channel> channels{{"only", 96, 80}};
    Renderer renderer(channels, undithered());
    SkyFrame frame(undithered(), {});
    double worst = 0.0;
    for (const Scene& scene : forty_scenes(channels[0])) {
        const auto pictures = draw(renderer, scene);
        const double pixel_rad = finest_pixel_rad(channels, scene.channel_views());
        frame.prepare(scene, pixel_rad);
        const DomeLight dome(frame);
        for (int y = 0; y < channels[0].height_px; y += 3) {
            for (int x = y % 2; x < channels[0].width_px; x += 2) {
                const glm::dvec3 direction = glm::transpose(scene.views[0].view_from_enu) *
                                             view_direction(channels[0], scene.views[0].frustum, x + 0.5,
                                                            channels[0].height_px - y - 0.5);
                const auto colour = dome.colour(direction);
                ASSERT_TRUE(colour);
                const Rgb drawn = pictures[0].at(x, y);
                const glm::dvec3 off = glm::abs(glm::dvec3{drawn.r, drawn.g, drawn.b} - *colour * 255.0);
                worst = std::max({worst, off.x, off.y, off.z});
            }
        }
        frame.prepare(scene, pixel_rad);  // as draw() does at its end
    }
    std::printf("40 scenes: largest difference %.3f codes\n", worst);
    EXPECT_LE(worst, 0.75);  // half of it is the rounding to 8 bits
}

TEST_F(Pixel, PassesThatThePlanDropsWouldChangeNoCode) {
    const std::vector<Channel> channels{{"only", 320, 256}};
    Renderer plain(channels, undithered());
    std::map<unsigned long, std::unique_ptr<Renderer>> forced;
    int scenes = 0;
    int dropped_passes = 0;
    for (const double sun_deg : {60.0, 30.0, 8.0, -1.0, -4.0}) {
        for (const double height_m : {0.0, 2e3, 12e3, 400e3}) {
            Scene scene = make_scene(sun_deg, 120.0, -3.0 + 2.0 * scenes, 140.0, height_m);
            scene.time_s = 100.0 * ++scenes;
            scene.planets[1] = {at(25.0, 125.0), -3.9, 0.8};
            add_view(scene, symmetric_frustum(14.0, 320, 256), view_from_enu(125.0, 10.0, 0.0));
            const auto pictures = draw(plain, scene);
            const Plan plan = plain.prepare(scene).plan;
            Quality quality;
            for (const Pass pass : {Pass::kStars, Pass::kCorona, Pass::kSunDisc, Pass::kMoonDisc})
                quality.forced[static_cast<std::size_t>(pass)] = !plan.needs(pass);
            dropped_passes += static_cast<int>(quality.forced.count());
            auto& other = forced[quality.forced.to_ulong()];
            if (!other) other = std::make_unique<Renderer>(channels, undithered(), quality);
            EXPECT_EQ(draw(*other, scene)[0].rgba, pictures[0].rgba) << sun_deg << " " << height_m;
        }
    }
    std::printf("%d scenes, %d passes dropped\n", scenes, dropped_passes);
    EXPECT_GE(dropped_passes, scenes);
}

TEST_F(Pixel, DitherKeepsTheMeanAndStaysWithinACode) {
    const std::vector<Channel> channels{{"only", kWidth, kHeight}};
    Scene scene = make_scene(48.0, 185.0, -30.0, 0.0, 1500.0);
    add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(0.0, 30.0, 0.0));
    const auto plain = draw(channels, scene, undithered());
    const auto dithered = draw(channels, scene, {});
    double mean = 0.0;
    int largest = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const Rgb a = plain[0].at(x, y);
            const Rgb b = dithered[0].at(x, y);
            largest = std::max(largest, difference(a, b));
            mean += b.g - a.g;
        }
    }
    EXPECT_EQ(largest, 1);
    EXPECT_NEAR(mean / (kWidth * kHeight), 0.0, 0.06);
}

TEST_F(Pixel, SkyIsUpAndGroundIsDown) {
    const std::vector<Channel> channels{{"only", 64, 64}};
    Scene scene = make_scene(48.0, 185.0, -30.0, 0.0, 1500.0);
    add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(0.0, 0.0, 0.0));
    const auto picture = draw(channels, scene, undithered())[0];
    const Rgb high = picture.at(32, 2);
    const Rgb low = picture.at(32, 61);
    EXPECT_GT(high.b, high.r + 20) << "the top of the picture is not blue sky";
    EXPECT_GT(high.b - high.r, low.b - low.r + 20);
}

TEST_F(Pixel, BrightnessOfTheWholeRigFollowsOneAdaptation) {
    // Turning the aircraft changes what is seen, not how bright it is shown.
    const std::vector<Channel> channels{{"only", 64, 64}};
    Renderer renderer(channels, undithered());
    double adaptation = 0.0;
    for (const double yaw : {0.0, 90.0, 180.0}) {
        Scene scene = make_scene(10.0, 185.0, -30.0, 0.0, 1500.0);
        add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(yaw, 0.0, 0.0));
        const double now = renderer.prepare(scene).adaptation_cd_m2;
        if (adaptation > 0.0) {
            EXPECT_DOUBLE_EQ(now, adaptation);
        }
        adaptation = now;
    }
}

TEST_F(Pixel, EqualScenesGiveEqualPictures) {
    const std::vector<Channel> channels{{"only", 320, 256}};
    for (auto& [name, scene] : four_times()) {
        add_view(scene, symmetric_frustum(30.0, 320, 256), view_from_enu(170.0, 5.0, 0.0));
        EXPECT_EQ(draw(channels, scene, {})[0].rgba, draw(channels, scene, {})[0].rgba) << name;
    }
}

TEST_F(Pixel, AReplayedFlightDoesNotFlicker) {
    for (const Flight& flight : steadiness_flights()) {
        const Steps steps = largest_step(flight, 0, 110);
        std::printf("%-30s largest step from frame to frame: %d codes, at frame %d\n", flight.name.c_str(),
                    steps.largest, steps.at_frame);
        EXPECT_LE(steps.largest, 2) << flight.name;
    }
}

int brightest_green(const std::vector<Picture>& pictures) {
    int brightest = 0;
    for (const Picture& picture : pictures) {
        for (int y = 0; y < picture.height_px; ++y)
            for (int x = 0; x < picture.width_px; ++x)
                brightest = std::max(brightest, picture.at(x, y).g);
    }
    return brightest;
}

TEST_F(Pixel, HardScenesDrawWithoutGlErrorsAndTheSameAgain) {
    const std::vector<Channel> channels{{"narrow", 64, 64}, {"wide", 64, 64}, {"off", 64, 64}};
    Renderer renderer(channels, {});
    double time_s = 0.0;
    for (const double height : {-400.0, 0.0, 20e3, 100e3, 400e3, 36e6}) {
        for (const double sun : {90.0, 0.0, -0.1, -6.0, -18.0, -90.0}) {
            Scene scene = make_scene(sun, 10.0, -sun, 190.0, height);
            // A jump of the clock: nothing of the scene before is left in the adaptation.
            scene.time_s = time_s += 100.0;
            add_view(scene, symmetric_frustum(0.5, 64, 64), view_from_enu(10.0, 89.0, 0.0));
            add_view(scene, symmetric_frustum(85.0, 64, 64), view_from_enu(10.0, -90.0, 0.0));
            add_view(scene, {50 * kDegree, 80 * kDegree, -70 * kDegree, -5 * kDegree},
                     view_from_enu(10.0, 0.0, 170.0));
            const auto first = draw(renderer, scene);
            const auto second = draw(renderer, scene);
            for (std::size_t i = 0; i < channels.size(); ++i)
                EXPECT_EQ(first[i].rgba, second[i].rgba) << channels[i].name << " " << height << " " << sun;
            // From the ground to orbit some channel sees sunlit sky or ground at noon.
            if (sun == 90.0 && height <= 400e3) {
                const int brightest = brightest_green(first);
                std::printf("noon from %6.0f m: brightest code %d\n", height, brightest);
                EXPECT_GT(brightest, 40) << height;
            }
        }
    }
}

TEST_F(Pixel, ChannelThatWasNeverDrawnIsBlack) {
    Renderer renderer({{"drawn", 64, 64}, {"waiting", 128, 64}}, {});
    Scene scene = make_scene(48.0, 185.0, -30.0, 0.0, 1500.0);
    add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(0.0, 30.0, 0.0));
    const auto pictures = draw(renderer, scene);
    EXPECT_GT(brightest_green({pictures[0]}), 40);
    std::vector<std::byte> black(128 * 64 * 4);
    for (std::size_t i = 3; i < black.size(); i += 4)
        black[i] = std::byte{255};
    EXPECT_EQ(pictures[1].rgba, black);
}

TEST_F(Pixel, TooManyOrNoChannelsAreRefused) {
    EXPECT_THROW(Renderer({}, {}), std::runtime_error);
    EXPECT_THROW(Renderer(std::vector<Channel>(kMaxChannels + 1, Channel{"x", 8, 8}), {}),
                 std::runtime_error);
    EXPECT_THROW(Renderer({Channel{"x", 0, 8}}, {}), std::runtime_error);
}

}  // namespace
}  // namespace skyig::render
