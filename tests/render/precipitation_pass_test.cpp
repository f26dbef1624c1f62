// What falls, as it is drawn: where streaks point, that channels agree, that nothing glows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "render/gl/texture.h"
#include "render/precipitation/fall.h"
#include "render/sky_frame.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;
using Kind = Precipitation::Kind;

constexpr int kWidth = 640;
constexpr int kHeight = 512;

class PrecipitationPicture : public GlTest {};

// Hazy air, the Sun behind: even light before which streaks stand out.
Scene falling_scene(Kind kind, double rate_mm_h, double speed_m_s) {
    Scene scene = make_scene(25.0, 180.0, -30.0, 40.0, 300.0);
    scene.air.visibility_m = 4000.0;
    scene.weather.precipitations[0] = {kind, rate_mm_h, 3000.0};
    scene.weather.precipitation_count = 1;
    scene.weather.wind_m_s = {4.0, -1.0, 0.0};
    scene.weather.eye_velocity_m_s = {0.0, speed_m_s, 0.0};
    return scene;
}

Scene dry(Scene scene) {
    scene.weather.precipitation_count = 0;
    return scene;
}

double difference_of_green(const Picture& wet, const Picture& without, int x, int y) {
    return wet.at(x, y).g - without.at(x, y).g;
}

// Angle between the streaks of a picture and the way that the wind takes them across it, by the structure
// tensor of what they add: gradients, in axes along and across the way to its vanishing point, summed.
double off_the_wind_deg(const Picture& wet, const Picture& without, const ChannelView& view,
                        const glm::dvec3& wind_enu) {
    const Channel channel{"only", kWidth, kHeight};
    const ImagePlane plane = image_plane(view.frustum);
    const glm::dvec3 wind = view.view_from_enu * wind_enu;
    double along_along = 0.0;
    double along_across = 0.0;
    double across_across = 0.0;
    for (int y = 1; y + 1 < kHeight; ++y) {
        for (int x = 1; x + 1 < kWidth; ++x) {
            const auto at = [&](int dx, int dy) { return difference_of_green(wet, without, x + dx, y + dy); };
            // Scharr's, which turns with what it looks at; y up.
            const double gx =
                3 * (at(1, -1) + at(1, 1) - at(-1, -1) - at(-1, 1)) + 10 * (at(1, 0) - at(-1, 0));
            const double gy =
                3 * (at(-1, -1) + at(1, -1) - at(-1, 1) - at(1, 1)) + 10 * (at(0, -1) - at(0, 1));
            // What goes through this pixel's ray with the wind goes this way on the plane.
            const glm::dvec2 place{plane.left + (x + 0.5) / kWidth * (plane.right - plane.left),
                                   plane.top - (y + 0.5) / kHeight * (plane.top - plane.bottom)};
            const glm::dvec2 way =
                glm::normalize(glm::dvec2{wind.x + place.x * wind.z, wind.y + place.y * wind.z});
            const double along = gx * way.x + gy * way.y;
            const double across = gy * way.x - gx * way.y;
            along_along += along * along;
            along_across += along * across;
            across_across += across * across;
        }
    }
    EXPECT_GT(across_across, 3.0 * along_along) << "no streaks";
    return 0.5 * std::atan2(2.0 * along_across, across_across - along_along) / kDegree;
}

TEST_F(PrecipitationPicture, StreaksLieAlongTheRelativeWind) {
    struct Case {
        const char* name;
        Kind kind;
        double rate_mm_h, speed_m_s, yaw_deg, pitch_deg, roll_deg;
    };
    Renderer renderer({{"only", kWidth, kHeight}}, without_glare());
    for (const Case& c : {Case{"rain, standing", Kind::kRain, 20.0, 0.0, 0.0, 0.0, 0.0},
                          Case{"rain at 70 m/s, ahead", Kind::kRain, 20.0, 70.0, 0.0, 3.0, 15.0},
                          Case{"rain at 70 m/s, aslant", Kind::kRain, 20.0, 70.0, 50.0, 3.0, -20.0},
                          Case{"rain at 130 m/s, abeam", Kind::kRain, 20.0, 130.0, 90.0, 0.0, 0.0},
                          Case{"snow at 70 m/s, abeam", Kind::kSnow, 3.0, 70.0, -90.0, 10.0, 0.0},
                          Case{"hail at 30 m/s, abeam", Kind::kHail, 200.0, 30.0, 90.0, 0.0, 10.0}}) {
        Scene scene = falling_scene(c.kind, c.rate_mm_h, c.speed_m_s);
        // Streaks are some pixels wide.
        add_view(scene, symmetric_frustum(12.0, kWidth, kHeight),
                 view_from_enu(c.yaw_deg, c.pitch_deg, c.roll_deg));
        const auto without = draw(renderer, dry(scene));
        const auto wet = draw(renderer, scene);
        const double fall = precipitation::fall_speed_m_s(c.kind, c.rate_mm_h, scene.eye.height_m);
        const double off_deg =
            off_the_wind_deg(wet[0], without[0], scene.views[0], {4.0, -1.0 - c.speed_m_s, -fall});
        std::printf("%-24s %6.2f deg off the relative wind\n", c.name, off_deg);
        EXPECT_LT(std::abs(off_deg), 2.0) << c.name;
    }
}

TEST_F(PrecipitationPicture, ChannelsAgreeAtTheirCommonEdge) {
    const std::vector<Channel> channels{{"left", kWidth, kHeight}, {"right", kWidth, kHeight}};
    // The outermost pixel centres lie on the half angle.
    const double x = std::tan(30.0 * kDegree) * kWidth / (kWidth - 1);
    const double y = x * kHeight / kWidth;
    const Frustum frustum{-std::atan(x), std::atan(x), -std::atan(y), std::atan(y)};
    Renderer renderer(channels, without_glare());
    for (const Kind kind : {Kind::kRain, Kind::kSnow}) {
        for (const double speed_m_s : {0.0, 70.0}) {
            Scene scene = falling_scene(kind, kind == Kind::kRain ? 30.0 : 3.0, speed_m_s);
            for (const double view_yaw : {-30.0, 30.0})
                add_view(scene, frustum, view_from_enu(20.0, 5.0, -12.0, view_yaw));
            const auto wet = draw(renderer, scene);
            const auto without = draw(renderer, dry(scene));
            int worst = 0;
            int touched = 0;
            for (int row = 0; row < kHeight; ++row) {
                worst = std::max(worst, difference(wet[0].at(kWidth - 1, row), wet[1].at(0, row)));
                touched += difference(wet[0].at(kWidth - 1, row), without[0].at(kWidth - 1, row)) > 2;
            }
            std::printf("seam: %d codes at most, %d of its pixels in streaks\n", worst, touched);
            EXPECT_LE(worst, 1);
            EXPECT_GT(touched, 2);
        }
    }
}

TEST_F(PrecipitationPicture, IsTheSameOnReplayAndStandsWithTheClock) {
    Scene scene = falling_scene(Kind::kSleet, 10.0, 30.0);
    add_view(scene, symmetric_frustum(30.0, 320, 256), view_from_enu(10.0, 5.0, 0.0));
    const std::vector<Channel> channels{{"only", 320, 256}};
    std::vector<Picture> last;
    for (int run = 0; run < 2; ++run) {
        Renderer renderer(channels, without_glare());
        Scene now = scene;
        std::vector<Picture> pictures;
        for (int i = 0; i < 10; ++i) {
            now.time_s += 1.0 / 30.0;
            pictures = draw(renderer, now);
        }
        EXPECT_EQ(draw(renderer, now)[0].rgba, pictures[0].rgba) << "moves without time";
        if (run == 1) {
            EXPECT_EQ(pictures[0].rgba, last[0].rgba);
        }
        now.time_s += 1.0 / 30.0;
        EXPECT_NE(draw(renderer, now)[0].rgba, pictures[0].rgba) << "stands still";
        last = std::move(pictures);
    }
}

// Streaks show the light around: lighter before the ground, darker before a bright sky, dark at night.
TEST_F(PrecipitationPicture, ShowsTheLightAround) {
    Scene scene = falling_scene(Kind::kSnow, 3.0, 0.0);
    scene.sun.direction_enu = at(60.0, 90.0);
    const Frustum frustum = symmetric_frustum(30.0, 320, 256);
    add_view(scene, frustum, view_from_enu(90.0, 35.0, 0.0));
    add_view(scene, frustum, view_from_enu(90.0, -45.0, 0.0));
    const std::vector<Channel> channels{{"sky", 320, 256}, {"ground", 320, 256}};
    Renderer renderer(channels, without_glare());
    const auto added = [&](const Scene& what) {
        const auto without = draw(renderer, dry(what));
        const auto wet = draw(renderer, what);
        std::array<double, 2> mean{};
        std::array<int, 2> most{};
        for (std::size_t i = 0; i < 2; ++i) {
            for (int y = 0; y < 256; ++y) {
                for (int x = 0; x < 320; ++x) {
                    const double more = difference_of_green(wet[i], without[i], x, y);
                    mean[i] += more / (320.0 * 256.0);
                    most[i] = std::max(most[i], static_cast<int>(more));
                }
            }
        }
        std::printf("mean codes added to the sky %.3f, to the ground %.3f; most %d, %d\n", mean[0], mean[1],
                    most[0], most[1]);
        return std::pair{mean, most};
    };
    const auto day = added(scene);
    EXPECT_LT(day.first[0], -0.05);
    EXPECT_GT(day.first[1], 0.2);
    scene.sun.direction_enu = at(-40.0, 90.0);
    scene.time_s += 1e4;  // the eye has had its time
    const auto night = added(scene);
    EXPECT_LE(std::max(night.second[0], night.second[1]), 6);
}

// The light that streaks add does not depend on how many pixels see it: a rod thinner than one fades.
TEST_F(PrecipitationPicture, AddsTheSameLightAtAnyResolution) {
    for (const Kind kind : {Kind::kRain, Kind::kSnow}) {
        std::vector<double> means;
        for (const int width : {160, 320, 800}) {
            const int height = width * 4 / 5;
            Scene scene = falling_scene(kind, kind == Kind::kRain ? 20.0 : 3.0, 0.0);
            add_view(scene, symmetric_frustum(30.0, width, height), view_from_enu(0.0, -45.0, 0.0));
            Renderer renderer({{"only", width, height}}, without_glare(), {}, Target::kLuminance);
            const auto mean_of = [&](const Scene& what) {
                std::vector<float> light(static_cast<std::size_t>(width * height) * 3);
                renderer.prepare(what);
                renderer.draw(0);
                renderer.read_luminance(0, light);
                double sum = 0.0;
                for (std::size_t i = 1; i < light.size(); i += 3)
                    sum += static_cast<double>(light[i]);
                return sum * 3.0 / static_cast<double>(light.size());
            };
            const double without = mean_of(dry(scene));
            means.push_back(mean_of(scene) - without);
        }
        std::printf("added by %s: %.3f, %.3f, %.3f cd/m2 at 160, 320, 800 px\n",
                    kind == Kind::kRain ? "rain" : "snow", means[0], means[1], means[2]);
        EXPECT_NEAR(means[0] / means[2], 1.0, 0.06);
        EXPECT_NEAR(means[1] / means[2], 1.0, 0.04);
    }
}

TEST_F(PrecipitationPicture, FallsBehindWhatIsNearerAndBeforeWhatIsFarther) {
    Scene scene = falling_scene(Kind::kSnow, 3.0, 0.0);
    add_view(scene, symmetric_frustum(30.0, 320, 256), view_from_enu(0.0, 5.0, 0.0));
    const gl::Texture colour(gl::TexelFormat::kRgba32F, 320, 256);
    const gl::Texture depth(gl::TexelFormat::kR32F, 320, 256);
    colour.update(std::vector<float>(std::size_t{320} * 256 * 4, 50.0F));
    constexpr double kFar_m = 1000.0;
    Renderer renderer({{"only", 320, 256}}, without_glare());
    const auto picture = [&](const Scene& what) {
        std::vector<std::byte> rgba(std::size_t{320} * 256 * 4);
        renderer.prepare(what);
        renderer.draw_scene(0, {colour.name(), depth.name(), kFar_m});
        renderer.read_back(0, rgba);
        return rgba;
    };
    const auto changed = [&](double thing_m) {
        depth.update(std::vector<float>(std::size_t{320} * 256, static_cast<float>(thing_m / kFar_m)));
        const auto without = picture(dry(scene));
        const auto wet = picture(scene);
        int count = 0;
        for (std::size_t i = 0; i < wet.size(); i += 4)
            count += wet[i] != without[i];
        return count;
    };
    const int near = changed(1.0);
    const int amid = changed(6.0);
    const int far = changed(100.0);
    std::printf("pixels with snow before a thing at 1 m: %d, 6 m: %d, 100 m: %d\n", near, amid, far);
    EXPECT_EQ(near, 0);
    EXPECT_GT(amid, 50);
    EXPECT_GT(far, 2 * amid);
}

// A level floor 3 m below the eye up to 40 m away, then a wall; black, so that only air and film shine.
struct WetYard {
    static constexpr int kPixels_x = 160;
    static constexpr int kPixels_y = 128;
    static constexpr double kFar_m = 100.0;

    explicit WetYard(const ChannelView& view) {
        std::vector<float> depths;
        for (int row = kPixels_y - 1; row >= 0; --row) {
            for (int x = 0; x < kPixels_x; ++x) {
                const glm::dvec3 ray = direction_at(view, x, row);
                const double floor_m = ray.z < 0.0 ? 3.0 / -ray.z : 1e9;
                const double distance_m = std::min(floor_m, 40.0 / ray.y);
                const double along = -(view.view_from_enu * ray).z;
                depths.push_back(static_cast<float>(distance_m * along / kFar_m));
            }
        }
        colour.update(std::vector<float>(std::size_t{kPixels_x} * kPixels_y * 4, 0.0F));
        depth.update(depths);
    }
    static glm::dvec3 direction_at(const ChannelView& view, int x, int row) {
        return glm::transpose(view.view_from_enu) *
               view_direction({"only", kPixels_x, kPixels_y}, view.frustum, x + 0.5, kPixels_y - row - 0.5);
    }
    [[nodiscard]] std::vector<float> light(Renderer& renderer, const Scene& scene) const {
        std::vector<float> rgb(std::size_t{kPixels_x} * kPixels_y * 3);
        renderer.prepare(scene);
        renderer.draw_scene(0, {colour.name(), depth.name(), kFar_m});
        renderer.read_luminance(0, rgb);
        return rgb;
    }
    gl::Texture colour{gl::TexelFormat::kRgba32F, kPixels_x, kPixels_y};
    gl::Texture depth{gl::TexelFormat::kR32F, kPixels_x, kPixels_y};
};

TEST_F(PrecipitationPicture, WetFloorMirrorsTheSkyAndAWallDoesNot) {
    Scene scene = make_scene(35.0, 180.0, -30.0, 40.0, 3.0);
    add_view(scene, symmetric_frustum(30.0, WetYard::kPixels_x, WetYard::kPixels_y),
             view_from_enu(0.0, -10.0, 0.0));
    const WetYard yard(scene.views[0]);
    Renderer renderer({{"only", WetYard::kPixels_x, WetYard::kPixels_y}}, without_glare(), {},
                      Target::kLuminance);
    const std::vector<float> dry = yard.light(renderer, scene);
    scene.ground.wet = 1.0;
    // The same air still, then one that has air over wet land from the first.
    const std::vector<float> just_wet = yard.light(renderer, scene);
    Renderer another({{"only", WetYard::kPixels_x, WetYard::kPixels_y}}, without_glare(), {},
                     Target::kLuminance);
    const std::vector<float> wet = yard.light(another, scene);
    SkyFrame frame({}, {}, {}, Target::kLuminance);
    frame.prepare(scene, 1e-3);
    double worst = 0.0;
    double wall = 0.0;
    for (int row = 2; row + 2 < WetYard::kPixels_y; ++row) {
        for (int x = 2; x + 2 < WetYard::kPixels_x; ++x) {
            const glm::dvec3 ray = WetYard::direction_at(scene.views[0], x, row);
            const std::size_t i =
                (static_cast<std::size_t>(row) * WetYard::kPixels_x + static_cast<std::size_t>(x)) * 3 + 1;
            const double before = static_cast<double>(dry[i]);
            const double added = static_cast<double>(wet[i]) - before;
            const double added_at_once = static_cast<double>(just_wet[i]) - before;
            const double floor_m = 3.0 / -ray.z;
            if (ray.z > 0.0 || floor_m > 42.0 / ray.y) {
                wall = std::max(wall, std::abs(added_at_once) / std::max(before, 1e-3));
            } else if (floor_m < 36.0 / ray.y) {
                const double share = 0.5 * shaders64::film_reflectance(-ray.z);
                const Horizontal at{std::asin(std::sqrt(ray.z * ray.z + 0.01)),
                                    horizontal_of(ray).azimuth_rad};
                const double sky = static_cast<double>(
                    frame.light().smooth_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kSky).y);
                worst = std::max(worst, std::abs(added / (share * (sky - before)) - 1.0));
            }
        }
    }
    std::printf("film against its formula: %.1f %%; wall changed by %.1e\n", 100.0 * worst, wall);
    EXPECT_LT(worst, 0.05);
    EXPECT_LT(wall, 1e-6);
}

TEST_F(PrecipitationPicture, DropsMakeRingsInTheWetFloor) {
    Scene scene = make_scene(35.0, 180.0, -30.0, 40.0, 3.0);
    add_view(scene, symmetric_frustum(30.0, WetYard::kPixels_x, WetYard::kPixels_y),
             view_from_enu(0.0, -35.0, 0.0));
    scene.ground.wet = 1.0;
    const WetYard yard(scene.views[0]);
    Renderer renderer({{"only", WetYard::kPixels_x, WetYard::kPixels_y}}, without_glare(), {},
                      Target::kLuminance);
    const std::vector<float> still = yard.light(renderer, scene);
    // The rings alone: the eye is above the streaks' top when they are compared.
    scene.weather.precipitations[0] = {Precipitation::Kind::kRain, 20.0, 100.0};
    scene.weather.precipitation_count = 1;
    std::vector<float> rained;
    for (int i = 0; i < 60; ++i) {
        scene.time_s += 1.0 / 30.0;
        rained = yard.light(renderer, scene);
    }
    scene.weather.precipitations[0].top_m = 0.0;
    const std::vector<float> rings = yard.light(renderer, scene);
    const std::vector<float> again = yard.light(renderer, scene);
    EXPECT_EQ(rings, again) << "time stands";
    double mean = 0.0;
    double rms = 0.0;
    for (std::size_t i = 1; i < rings.size(); i += 3) {
        const double change = static_cast<double>(rings[i]) / static_cast<double>(still[i]) - 1.0;
        mean += change * 3.0 / static_cast<double>(rings.size());
        rms += change * change * 3.0 / static_cast<double>(rings.size());
    }
    std::printf("rings: mean %.2f %%, rms %.2f %% of the floor's light\n", 100.0 * mean,
                100.0 * std::sqrt(rms));
    EXPECT_GT(std::sqrt(rms), 0.003);
    EXPECT_LT(std::abs(mean), 0.1);
}

}  // namespace
}  // namespace skyig::render
