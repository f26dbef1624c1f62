// The Milky Way in pictures: drawn pixels against the exact light, its place in the plan, seams, what it
// costs to leave out.
#include "render/milky_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/night/starlight.h"
#include "render/sky_frame.h"
#include "tests/render/gl_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

// Stars off; the view stands on the brightest part of the belt that is well up.
Scene moonless(double height_m = 600.0) {
    Scene scene = make_scene(-35.0, 0.0, -40.0, 170.0, height_m);
    scene.stars.enabled = false;
    return scene;
}

glm::dvec3 brightest_direction(const Scene& scene) {
    glm::dvec3 best{0.0, 0.0, 1.0};
    double most = 0.0;
    for (int l = 0; l < 360; l += 4) {
        const double longitude_rad = l * kDegree;
        const glm::dvec3 direction =
            scene.stars.enu_from_gcrs * (glm::transpose(night::galactic_from_gcrs()) *
                                         glm::dvec3{std::cos(longitude_rad), std::sin(longitude_rad), 0.0});
        const double belt = night::starlight_s10(longitude_rad, 0.0).belt;
        if (direction.z > 0.4 && direction.z < 0.85 && belt > most) {
            most = belt;
            best = direction;
        }
    }
    return best;
}

void look_at(Scene& scene, const glm::dvec3& direction, const Channel& channel, double half_width_deg) {
    const Horizontal at = horizontal_of(direction);
    add_view(scene, symmetric_frustum(half_width_deg, channel.width_px, channel.height_px),
             view_from_enu(at.azimuth_rad / kDegree, at.elevation_rad / kDegree, 0.0));
}

struct Codes {
    double p99 = 0.0;
    double largest = 0.0;
    double brightest = 0.0;
};

class MilkyWayPicture : public GlTest {
  protected:
    Codes off_by(const Scene& scene, const Channel& channel) {
        Renderer renderer({channel}, undithered());
        const auto picture = draw(renderer, scene)[0];
        std::vector<double> errors;
        Codes codes;
        for (int y = 0; y < channel.height_px; y += 2) {
            for (int x = 0; x < channel.width_px; x += 2) {
                const glm::dvec3 direction =
                    glm::transpose(scene.views[0].view_from_enu) *
                    view_direction(channel, scene.views[0].frustum, x + 0.5, channel.height_px - y - 0.5);
                const glm::dvec3 exact = 255.0 * renderer.reference_colour(direction);
                const Rgb drawn = picture.at(x, y);
                const glm::dvec3 off = glm::abs(glm::dvec3{drawn.r, drawn.g, drawn.b} - exact);
                errors.push_back(std::max({off.x, off.y, off.z}));
                codes.brightest = std::max(codes.brightest, exact.y);
            }
        }
        std::sort(errors.begin(), errors.end());
        codes.p99 = errors[errors.size() * 99 / 100];
        codes.largest = errors.back();
        return codes;
    }
};

TEST_F(MilkyWayPicture, DrawnPixelsAreWithinACodeOfTheExactLight) {
    const Channel channel{"only", 320, 256};
    for (const double height_m : {600.0, 12e3, 400e3}) {
        for (const bool low : {false, true}) {
            Scene scene = moonless(height_m);
            glm::dvec3 direction = brightest_direction(scene);
            if (low) direction.z = 0.1;
            look_at(scene, direction, channel, 30.0);
            const Codes codes = off_by(scene, channel);
            std::printf("%6.0f m, %s: p99 %.2f, largest %.2f codes of up to %.0f\n", height_m,
                        low ? "low" : "high", codes.p99, codes.largest, codes.brightest);
            EXPECT_LT(codes.p99, 1.2);  // two roundings, half a code each
            EXPECT_LT(codes.largest, height_m < 50e3 ? 2.0 : 3.0);
        }
    }
}

TEST_F(MilkyWayPicture, IsDroppedWithItsReason) {
    const Channel channel{"only", 64, 64};
    const auto reason_of = [&](Scene scene) {
        look_at(scene, {0.0, 0.5, 0.5}, channel, 30.0);
        Renderer renderer({channel}, {});
        const PlannedPass planned = renderer.prepare(scene).plan[Pass::kMilkyWay];
        return std::pair{planned.needed, std::string(planned.reason)};
    };
    EXPECT_TRUE(reason_of(moonless()).first);
    Scene day = moonless();
    day.sun.direction_enu = at(30.0, 0.0);
    EXPECT_FALSE(reason_of(day).first);
    EXPECT_NE(reason_of(day).second.find("daylight"), std::string::npos);
    Scene dusk = moonless();
    dusk.sun.direction_enu = at(-7.0, 0.0);
    EXPECT_FALSE(reason_of(dusk).first);
    EXPECT_NE(reason_of(dusk).second.find("half a code"), std::string::npos);
    Scene off = moonless();
    off.night.starlight = off.night.galactic_light = false;
    EXPECT_EQ(reason_of(off).second, "switched off");
    Scene seed = moonless();
    seed.night.model = NightModel::kSeed;
    EXPECT_FALSE(reason_of(seed).first);
}

TEST_F(MilkyWayPicture, NeighbouringChannelsAgree) {
    const std::vector<Channel> channels{{"wide", 256, 128}, {"narrow", 128, 128}};
    Scene scene = moonless();
    const glm::dvec3 direction = brightest_direction(scene);
    look_at(scene, direction, channels[0], 45.0);
    look_at(scene, direction, channels[1], 20.0);
    Renderer renderer(channels, undithered());
    const auto pictures = draw(renderer, scene);
    int largest = 0;
    for (int y = 4; y < 124; y += 3) {
        for (int x = 4; x < 124; x += 3) {
            const glm::dvec3 d = view_direction(channels[1], scene.views[1].frustum, x + 0.5, 128 - y - 0.5);
            const ImagePlane plane = image_plane(scene.views[0].frustum);
            const double u = (-d.x / d.z - plane.left) / (plane.right - plane.left) * 256.0;
            const double v = 128.0 - (-d.y / d.z - plane.bottom) / (plane.top - plane.bottom) * 128.0;
            if (u < 1.0 || u > 255.0 || v < 1.0 || v > 127.0) continue;
            const Rgb a = pictures[1].at(x, y);
            const Rgb b = pictures[0].at(static_cast<int>(u), static_cast<int>(v));
            largest = std::max(largest, difference(a, b));
        }
    }
    std::printf("neighbours differ by at most %d codes\n", largest);
    EXPECT_LE(largest, 3);  // a pixel of the wide one spans two of the narrow one, and each rounds twice
}

TEST(MilkyWayFrames, NoVertexJumpsWhileTheSkyTurns) {
    SkyFrame frame({}, {});
    Scene scene = moonless();
    const Scene start = scene;
    std::vector<MilkyWayVertex> before;
    float largest = 0.0F;
    float brightest = 0.0F;
    for (int i = 0; i < 240; ++i) {
        // Sixty times the real sky's pace.
        const double turn_rad = 60.0 * 7.29e-5 * i / 30.0;
        const glm::dmat3 turn{std::cos(turn_rad),
                              -std::sin(turn_rad),
                              0.0,
                              std::sin(turn_rad),
                              std::cos(turn_rad),
                              0.0,
                              0.0,
                              0.0,
                              1.0};
        scene.stars.enu_from_gcrs = turn * start.stars.enu_from_gcrs;
        scene.time_s = i / 30.0;
        frame.prepare(scene, 8e-4);
        const auto now = frame.milky_way().vertices();
        const auto t = static_cast<float>(night::MilkyWayMap::warped(3e-4));
        for (std::size_t k = 0; k < before.size(); ++k) {
            const auto code = [t](const MilkyWayVertex& v) {
                return 255.0F * v.colour.y * t * (1.0F + v.bend * t);
            };
            largest = std::max(largest, std::abs(code(now[k]) - code(before[k])));
        }
        for (const MilkyWayVertex& vertex : now)
            brightest = std::max(brightest, 255.0F * vertex.colour.y * t);
        before.assign(now.begin(), now.end());
    }
    std::printf("largest step of a vertex %.4f codes of %.1f\n", static_cast<double>(largest),
                static_cast<double>(brightest));
    EXPECT_GT(brightest, 3.0F);
    EXPECT_GT(largest, 0.0F);
    EXPECT_LT(largest, 0.5F);
}

}  // namespace
}  // namespace skyig::render
