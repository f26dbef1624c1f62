// Clouds of closed form as they are drawn: what a pixel shows, seams, motion, what stands behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/eye/tone_curve.h"
#include "render/geometry.h"
#include "tests/render/fake_clouds.h"
#include "tests/render/light_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr int kWidth = 320;
constexpr int kHeight = 256;

class CloudPicture : public GlTest {
  protected:
    static Quality small_map() {
        Quality quality;
        quality.cloud_map_size = 512;
        return quality;
    }

    static Scene noon(double height_m, double pitch_deg) {
        Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, height_m);
        scene.sun.enabled = false;
        add_view(scene, symmetric_frustum(30.0, kWidth, kHeight), view_from_enu(150.0, pitch_deg, 3.0));
        return scene;
    }

    static glm::dvec3 direction_at(const Scene& scene, int x, int y, std::size_t channel = 0) {
        const Channel shape{"", kWidth, kHeight, {}};
        return glm::transpose(scene.views[channel].view_from_enu) *
               view_direction(shape, scene.views[channel].frustum, x + 0.5, kHeight - y - 0.5);
    }

    static Picture drawn(Renderer& renderer, const Scene& scene) {
        renderer.prepare(scene);
        Picture picture{kWidth, kHeight, std::vector<std::byte>(std::size_t{kWidth} * kHeight * 4)};
        renderer.draw(0);
        renderer.read_back(0, picture.rgba);
        return picture;
    }
};

int largest_step(const Picture& a, const Picture& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        largest =
            std::max(largest, std::abs(std::to_integer<int>(a.rgba[i]) - std::to_integer<int>(b.rgba[i])));
    return largest;
}

TEST_F(CloudPicture, PixelShowsWhatTheToneCurveMakesOfCloudAirAndSky) {
    const FakeSheet smooth{.wavelength_m = 0.0, .least_transmittance = 0.3, .most_transmittance = 0.3};
    for (const double least : {0.0, 0.3, 0.8}) {
        FakeSheet sheet = smooth;
        sheet.least_transmittance = sheet.most_transmittance = least;
        for (const double pitch_deg : {4.0, 40.0}) {
            Scene scene = noon(500.0, pitch_deg);
            add_layer(scene, sheet);
            Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), small_map());
            renderer.draw_clouds(fake_clouds(sheet));
            const Picture picture = drawn(renderer, scene);
            const double horizon = refraction_of(scene).horizon_elevation_rad();
            double worst = 0.0;
            int compared = 0;
            for (int y = 0; y < kHeight; y += 3) {
                for (int x = 0; x < kWidth; x += 3) {
                    const glm::dvec3 direction = direction_at(scene, x, y);
                    if (std::abs(std::asin(direction.z) - horizon) < 0.01) continue;
                    const glm::dvec3 code = 255.0 * renderer.reference_colour(direction);
                    const Rgb shown = picture.at(x, y);
                    const glm::dvec3 off = glm::abs(code - glm::dvec3{shown.r, shown.g, shown.b});
                    worst = std::max({worst, off.x, off.y, off.z});
                    ++compared;
                }
            }
            std::printf("T %.1f, pitch %.0f: %.2f codes over %d pixels\n", least, pitch_deg, worst, compared);
            EXPECT_GT(compared, 8000);
            // Half a code is the rounding to 8 bits, half the dome's own budget.
            EXPECT_LE(worst, 1.6) << least << " " << pitch_deg;
        }
    }
}

TEST_F(CloudPicture, EdgeOfTheHorizonDoesNotShowThroughThickCloud) {
    // Fog: everything is of one colour.
    const FakeSheet fog{.light_cd_m2 = glm::vec3{4000.0F}, .fog_per_m = 0.05};
    Scene scene = noon(500.0, 0.0);
    add_layer(scene, fog);
    Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), small_map());
    renderer.draw_clouds(fake_clouds(fog));
    const Picture picture = drawn(renderer, scene);
    int least = 255, most = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            least = std::min(least, picture.at(x, y).g);
            most = std::max(most, picture.at(x, y).g);
        }
    }
    std::printf("in fog: codes %d..%d, %d rays\n", least, most, renderer.prepare(scene).cloud_rays);
    EXPECT_LE(most - least, 1);
    EXPECT_TRUE(renderer.prepare(scene).plan.needs(Pass::kNearClouds));
}

TEST_F(CloudPicture, CommonEdgeOfChannelsDiffersByAtMostOneCode) {
    const FakeSheet sheet{.wavelength_m = 2500.0};
    const double x = std::tan(30.0 * kDegree) * kWidth / (kWidth - 1);
    const double y = x * kHeight / kWidth;
    const Frustum frustum{-std::atan(x), std::atan(x), -std::atan(y), std::atan(y)};
    for (const double height_m : {500.0, 9000.0}) {
        Scene scene = make_scene(48.0, 185.0, -10.0, 40.0, height_m);
        for (const double yaw_deg : {120.0, 180.0})
            add_view(scene, frustum, view_from_enu(yaw_deg, 0.0, 0.0));
        add_layer(scene, sheet);
        const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
        Renderer renderer(channels, undithered(), small_map());
        renderer.draw_clouds(fake_clouds(sheet));
        const auto pictures = draw(renderer, scene);
        int worst = 0, contrast = 0;
        for (int row = 8; row < kHeight; ++row) {
            const Rgb left = pictures[0].at(kWidth - 1, row);
            worst = std::max(worst, difference(left, pictures[1].at(0, row)));
            contrast = std::max(contrast, difference(left, pictures[0].at(kWidth - 1, row - 8)));
        }
        std::printf("seam at %.0f m: %d codes, clouds step by %d\n", height_m, worst, contrast);
        EXPECT_GT(contrast, 10) << "no clouds on the seam";
        EXPECT_LE(worst, 1);
    }
}

// An eye at 250 m/s below a sheet 2 km above it.
Scene flown(Scene scene, int frame) {
    scene.frame_number = static_cast<std::uint64_t>(frame);
    scene.time_s = frame / 30.0;
    scene.eye.latitude_deg += glm::degrees(250.0 * scene.time_s / kEarthRadius_m);
    return scene;
}

TEST_F(CloudPicture, FollowsTheEyeWithinTwoPixelsAndWithoutSteps) {
    const FakeSheet sheet{.height_m = 3000.0,
                          .wavelength_m = 3000.0,
                          .least_transmittance = 0.2,
                          .most_transmittance = 1.0,
                          .light_cd_m2 = glm::vec3{25e3F}};
    Scene scene = noon(1000.0, 35.0);
    add_layer(scene, sheet);
    Quality quality = small_map();
    quality.cloud_map_size = 1024;
    // An eye that is still adapting would be told as clouds that have moved.
    DisplaySettings adapted = without_glare();
    adapted.fixed_adaptation_cd_m2 = 8000.0;
    Renderer renderer({{"only", kWidth, kHeight}}, adapted, quality);
    renderer.draw_clouds(fake_clouds(sheet));
    // Pixels of 60 deg over 1280.
    constexpr double kPixel_rad = 9.0e-4;
    Picture last = drawn(renderer, flown(scene, 0));
    Picture last_exact = last;
    int largest = 0, exact_step = 0;
    double worst_px = 0.0;
    for (int frame = 1; frame <= 56; ++frame) {
        const Scene now = flown(scene, frame);
        const Picture picture = drawn(renderer, now);
        largest = std::max(largest, largest_step(picture, last));
        last = picture;
        if (frame < 55) continue;
        Renderer anew({{"only", kWidth, kHeight}}, adapted, quality);
        anew.draw_clouds(fake_clouds(sheet));
        const Picture exact = drawn(anew, now);
        exact_step = largest_step(exact, last_exact);
        last_exact = exact;
        // How far the picture is off, by the slope of the exact one.
        double off = 0.0, slope = 0.0;
        for (int y = 2; y < kHeight - 2; ++y) {
            for (int x = 2; x < kWidth - 2; ++x) {
                const double dx = 0.5 * (exact.at(x + 1, y).g - exact.at(x - 1, y).g);
                const double dy = 0.5 * (exact.at(x, y + 1).g - exact.at(x, y - 1).g);
                const double difference_here = picture.at(x, y).g - exact.at(x, y).g;
                off += difference_here * difference_here;
                slope += dx * dx + dy * dy;
            }
        }
        // The picture's own pixels are four of the rig's.
        const double own_rad = pixel_angle_rad({"", kWidth, kHeight, {}}, now.views[0].frustum);
        worst_px = std::max(worst_px, std::sqrt(off / std::max(slope, 1.0)) * own_rad / kPixel_rad);
    }
    std::printf(
        "250 m/s, 2 km below: off by %.2f px of 60 deg / 1280; steps %d codes, of exact pictures %d\n",
        worst_px, largest, exact_step);
    EXPECT_LE(worst_px, 2.0);
    EXPECT_LE(largest, exact_step + 2);
}

TEST_F(CloudPicture, TwoRunsAreAlikeToTheBit) {
    const FakeSheet sheet{.wavelength_m = 2500.0};
    Scene scene = noon(1000.0, 20.0);
    add_layer(scene, sheet);
    Renderer first({{"only", kWidth, kHeight}}, {}, small_map());
    Renderer second({{"only", kWidth, kHeight}}, {}, small_map());
    for (Renderer* renderer : {&first, &second})
        renderer->draw_clouds(fake_clouds(sheet));
    for (int frame = 0; frame < 30; ++frame) {
        const Scene now = flown(scene, frame);
        ASSERT_EQ(drawn(first, now).rgba, drawn(second, now).rgba) << frame;
    }
}

TEST_F(CloudPicture, LightOfItIsWhatTheDisplayShowsWithinACode) {
    const FakeSheet sheet{.wavelength_m = 15e3, .least_transmittance = 0.1};
    Scene scene = noon(500.0, 30.0);
    add_layer(scene, sheet);
    Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), small_map());
    renderer.draw_clouds(fake_clouds(sheet));
    const Picture picture = drawn(renderer, scene);
    const auto tone = eye::tone_parameters(without_glare(), renderer.prepare(scene).adaptation_cd_m2);
    Renderer of_light({{"only", kWidth, kHeight}}, without_glare(), small_map(), Target::kLuminance);
    of_light.draw_clouds(fake_clouds(sheet));
    of_light.prepare(scene);
    of_light.draw(0);
    std::vector<float> rgb(std::size_t{kWidth} * kHeight * 3);
    of_light.read_luminance(0, rgb);
    std::vector<double> off;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float* light =
                &rgb[(static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) * 3];
            const glm::dvec3 code = 255.0 * shaders64::shown({light[0], light[1], light[2]}, tone);
            const Rgb shown = picture.at(x, y);
            const glm::dvec3 apart = glm::abs(code - glm::dvec3{shown.r, shown.g, shown.b});
            off.push_back(std::max({apart.x, apart.y, apart.z}));
        }
    }
    std::sort(off.begin(), off.end());
    std::printf("light against display: %.2f codes at most, %.2f of 99 %%\n", off.back(),
                off[off.size() * 99 / 100]);
    EXPECT_LE(off.back(), 1.6);
}

TEST_F(CloudPicture, DimsStarsAndTheSunAndLeavesClearSkyAlone) {
    Scene night = make_scene(-35.0, 0.0, -40.0, 90.0, 0.0);
    add_view(night, symmetric_frustum(20.0, kWidth, kHeight), view_from_enu(90.0, 50.0, 0.0));
    Scene day = make_scene(50.0, 180.0, -40.0, 90.0, 500.0);
    add_view(day, symmetric_frustum(2.0, kWidth, kHeight), view_from_enu(180.0, 50.0, 0.0));
    const auto light_of = [&](Scene scene, double transmittance, bool stars) {
        const FakeSheet sheet{.wavelength_m = 0.0,
                              .least_transmittance = transmittance,
                              .most_transmittance = transmittance,
                              .light_cd_m2 = glm::vec3{0.0F}};
        scene.stars.enabled = stars;
        add_layer(scene, sheet);
        Renderer renderer({{"only", kWidth, kHeight}}, without_glare(), small_map(), Target::kLuminance);
        renderer.draw_clouds(fake_clouds(sheet));
        renderer.prepare(scene);
        renderer.draw(0);
        std::vector<float> rgb(std::size_t{kWidth} * kHeight * 3);
        renderer.read_luminance(0, rgb);
        double sum = 0.0, most = 0.0;
        for (const float value : rgb) {
            sum += static_cast<double>(value);
            most = std::max(most, static_cast<double>(value));
        }
        return glm::dvec2{sum, most};
    };
    const double stars = light_of(night, 1.0, true).x - light_of(night, 1.0, false).x;
    const double dimmed = light_of(night, 0.25, true).x - light_of(night, 0.25, false).x;
    std::printf("stars through 0.25: %.4f of their light\n", dimmed / stars);
    EXPECT_NEAR(dimmed / stars, 0.25, 0.005);
    const double sun = light_of(day, 1.0, true).y;
    const double cirrus = light_of(day, 0.5, true).y;
    const double stratus = light_of(day, 1e-9, true).y;
    std::printf("Sun %.3g, through 0.5 %.3g, through 1e-9 %.3g cd/m2\n", sun, cirrus, stratus);
    EXPECT_GT(sun, 1e9);
    EXPECT_NEAR(cirrus / sun, 0.5, 0.01);
    EXPECT_LT(stratus, 1e5);

    Renderer plain({{"only", kWidth, kHeight}}, undithered(), small_map());
    Renderer empty({{"only", kWidth, kHeight}}, undithered(), small_map());
    empty.draw_clouds(fake_clouds({.least_transmittance = 1.0}));
    Scene layered = day;
    add_layer(layered, {});
    layered.weather.clouds[0].coverage = 1e-9;  // the light on the ground goes by it
    EXPECT_EQ(drawn(plain, day).rgba, drawn(empty, layered).rgba);
}

}  // namespace
}  // namespace skyig::render
