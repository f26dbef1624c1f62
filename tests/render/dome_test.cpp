// The dome without GL: what interpolation between its vertices costs in display codes, that its shape holds,
// and that what changes does not jump.
#include "render/dome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/render/dome_light.h"
#include "tests/render/scenes.h"

namespace skyig::render {
namespace {

using tests::DomeLight;
using tests::kDegree;
using tests::make_scene;
using tests::NamedScene;

constexpr double kPixel_rad = 8e-4;

NamedScene with_visibility(NamedScene named, double visibility_m) {
    named.scene.air.visibility_m = visibility_m;
    return named;
}

// Another scene of the same frame is a jump of the clock: nothing of the one before is left.
class Frames {
  public:
    explicit Frames(const Quality& quality = {}) : frame_(DisplaySettings{}, quality) {}
    const SkyFrame& of(Scene scene) {
        scene.time_s = time_s_ += 100.0;
        // New air takes its time, all else is a jump.
        const bool new_air = visibility_m_ > 0.0 && scene.air.visibility_m != visibility_m_;
        visibility_m_ = scene.air.visibility_m;
        const int frames =
            new_air ? 2 * static_cast<int>(LightTables::kAirLatencyFrames) + Dome::kLongestFade : 1;
        for (int i = 0; i < frames; ++i)
            frame_.prepare(scene, kPixel_rad);
        return frame_;
    }

  private:
    SkyFrame frame_;
    double time_s_ = 0.0;
    double visibility_m_ = 0.0;
};

TEST(Dome, CoversEveryDirectionWhateverTheHorizon) {
    SkyFrame frame({}, {});
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    for (const double height_m : {0.0, 0.2, 10e3, 400e3, 36e6}) {
        for (const double sun_deg : {90.0, 5.0, -12.0}) {
            frame.prepare(make_scene(sun_deg, 120.0, 20.0, 260.0, height_m), kPixel_rad);
            const DomeLight dome(frame);
            for (int i = 0; i < 300; ++i) {
                const glm::dvec3 d =
                    glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
                EXPECT_TRUE(dome.colour(d)) << height_m << " " << sun_deg << " " << d.z;
            }
        }
    }
}

double row_elevation_rad(const SkyFrame& frame, int row) {
    const Dome& dome = frame.dome();
    const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(dome.size().columns + 1);
    const glm::dvec3 d{frame.enu_from_mesh() * glm::dvec4{glm::dvec3{dome.vertices()[at].direction}, 1.0}};
    return std::atan2(d.z, std::hypot(d.x, d.y));
}

void expect_horizon_between_edge_rows(const SkyFrame& frame, double edge_rad) {
    const int first_sky = frame.dome().size().ground_rows + 1;
    const double below = row_elevation_rad(frame, first_sky - 1);
    const double above = row_elevation_rad(frame, first_sky);
    EXPECT_NEAR((above - below) / edge_rad, 1.0, 1e-3);
    EXPECT_NEAR(0.5 * (above + below), frame.light().horizon_elevation_rad, 1e-6 + 1e-3 * edge_rad);
}

TEST(Dome, RowsRiseAndTheHorizonLiesBetweenTheEdgeRows) {
    SkyFrame frame({}, {});
    for (const double edge_rad : {1e-4, 8e-4, 4e-3, 2e-2}) {
        for (const double sun_deg : {90.0, 30.0, 0.0, -18.0}) {
            frame.prepare(make_scene(sun_deg, 120.0, -40.0, 260.0, 1000.0), edge_rad);
            for (int row = 1; row <= frame.dome().size().rows(); ++row)
                EXPECT_GT(row_elevation_rad(frame, row), row_elevation_rad(frame, row - 1))
                    << row << " at " << sun_deg << ", " << edge_rad;
            expect_horizon_between_edge_rows(frame, edge_rad);
        }
    }
}

TEST(Dome, HorizonFollowsTheEyeInEveryFrame) {
    SkyFrame frame({}, {});
    const auto revision = [&] { return frame.triangles_revision(); };
    frame.prepare(make_scene(30.0, 120.0, -40.0, 260.0, 300.0), kPixel_rad);
    const auto first = revision();
    for (int i = 1; i < 60; ++i) {
        frame.prepare(make_scene(30.0, 120.0, -40.0, 260.0, 300.0 + 0.33 * i), kPixel_rad);
        expect_horizon_between_edge_rows(frame, kPixel_rad);
    }
    EXPECT_EQ(revision(), first) << "the mesh was laid out anew for a climb of 20 m";
}

TEST(Dome, LayoutServesUntilSomethingHasMovedFarEnough) {
    DomeLayout held;
    held.horizon_elevation_rad = -0.02;
    held.first_lights = true;
    held.first_elevation_rad = 0.3;
    const auto serves = [&held](auto change) {
        DomeLayout wanted = held;
        change(wanted);
        return still_serves(held, wanted);
    };
    EXPECT_TRUE(serves([](DomeLayout&) {}));
    EXPECT_TRUE(serves([](DomeLayout& l) { l.horizon_elevation_rad += 1.5e-3; }));
    EXPECT_FALSE(serves([](DomeLayout& l) { l.horizon_elevation_rad += 2.5e-3; }));
    EXPECT_TRUE(serves([](DomeLayout& l) { l.first_elevation_rad += 0.004; }));
    EXPECT_FALSE(serves([](DomeLayout& l) { l.first_elevation_rad += 0.006; }));
    EXPECT_FALSE(serves([](DomeLayout& l) { l.second_lights = true; }));
    EXPECT_FALSE(serves([](DomeLayout& l) { l.edge_rad *= 2.0; }));
    DomeLayout brighter = held;
    brighter.adaptation_cd_m2 *= 1.05;
    EXPECT_TRUE(still_fits(held, brighter));
    brighter.adaptation_cd_m2 *= 1.1;
    EXPECT_FALSE(still_fits(held, brighter));
    DomeLayout hazier = held;
    ++hazier.air;
    EXPECT_FALSE(still_fits(held, hazier));
}

TEST(Dome, InterpolatedColoursAreWithinHalfACodeOfTheExactOnes) {
    std::vector<NamedScene> scenes = tests::four_times();
    scenes.push_back({"sun 85", make_scene(85.0, 120.0, -20.0, 300.0, 0.0)});
    scenes.push_back({"sun 20", make_scene(20.0, 120.0, -20.0, 300.0, 1000.0)});
    scenes.push_back({"sun 5", make_scene(5.0, 120.0, -20.0, 300.0, 300.0)});
    scenes.push_back({"sun 0", make_scene(0.0, 120.0, -20.0, 300.0, 400.0)});
    scenes.push_back({"10 km", make_scene(25.0, 120.0, -20.0, 300.0, 10e3)});
    scenes.push_back({"sunset 10 km", make_scene(-2.0, 120.0, -20.0, 300.0, 10e3)});
    scenes.push_back({"sun -9", make_scene(-9.0, 120.0, -20.0, 300.0, 300.0)});
    scenes.push_back({"sun -14", make_scene(-14.0, 120.0, -20.0, 300.0, 300.0)});
    scenes.push_back(with_visibility({"haze 20 km", make_scene(1.0, 120.0, -20.0, 300.0, 300.0)}, 20e3));
    scenes.push_back(with_visibility({"mist 2 km", make_scene(30.0, 120.0, -20.0, 300.0, 300.0)}, 2e3));
    Frames frames;
    for (const NamedScene& named : scenes) {
        const SkyFrame& frame = frames.of(named.scene);
        const tests::CodeErrors errors = tests::interpolation_errors(frame, 4000, 0.25);
        const PlannedPass& planned = frame.plan()[Pass::kDome];
        std::printf("%-12s codes: median %.3f, p99 %.3f, largest %.3f; %d x %d, said %.2f\n",
                    named.name.c_str(), errors.median, errors.p99, errors.largest, planned.resolution.rows,
                    planned.resolution.columns, planned.error_codes);
        EXPECT_LT(errors.p99, 0.35) << named.name;
        EXPECT_LT(errors.largest, 0.6) << named.name;
        EXPECT_LT(planned.error_codes, 0.5) << named.name;
        EXPECT_GT(planned.error_codes, 0.3 * errors.p99) << named.name;
    }
}

TEST(Dome, BudgetDecidesHowFineItIs) {
    std::size_t last_vertices = Dome::kMaxVertices + 1;
    for (const double budget : {0.25, 0.5, 1.0, 2.0}) {
        Quality quality;
        quality.error_codes = budget;
        Frames frames(quality);
        const SkyFrame& frame = frames.of(make_scene(3.0, 120.0, -20.0, 300.0, 1000.0));
        const tests::CodeErrors errors = tests::interpolation_errors(frame, 4000, 0.25);
        const DomeSize& size = frame.dome().size();
        std::printf("budget %.2f codes: %3d + %2d rows x %3d columns, p99 %.3f, largest %.3f\n", budget,
                    size.sky_rows, size.ground_rows, size.columns, errors.p99, errors.largest);
        EXPECT_LT(errors.largest, 1.1 * budget);
        EXPECT_LT(frame.dome().vertices().size(), last_vertices);
        last_vertices = frame.dome().vertices().size();
    }
}

TEST(Dome, ASetClockOrAnEyeCarriedAwayShowsTheNewSkyAtOnce) {
    const Scene noon = make_scene(40.0, 180.0, -40.0, 20.0, 500.0);
    const Scene moonless = make_scene(-45.0, 350.0, -50.0, 80.0, 500.0);
    for (const double step_s : {39600.0, 0.03}) {
        SkyFrame frame({}, {});
        Scene scene = noon;
        for (int i = 0; i < 3; ++i, scene.time_s += 0.03)
            frame.prepare(scene, kPixel_rad);
        const double time_s = scene.time_s;
        scene = moonless;
        scene.time_s = time_s + step_s;
        frame.prepare(scene, kPixel_rad);
        EXPECT_LT(frame.adaptation_cd_m2(), 1e-3) << step_s;
        const DomeLight dome(frame);
        for (const double elevation_deg : {-20.0, 2.0, 30.0, 80.0}) {
            const glm::dvec3 direction = tests::at(elevation_deg, 100.0);
            const glm::dvec3 off =
                glm::abs(dome.colour(direction).value() - frame.exact_dome_colour(direction));
            EXPECT_LT(255.0 * std::max({off.x, off.y, off.z}), 1.0) << step_s << " s, " << elevation_deg;
        }
    }
}

TEST(Dome, NewAirFadesInAndEndsAtItsOwnColours) {
    SkyFrame frame({}, {});
    Scene scene = make_scene(20.0, 120.0, -20.0, 300.0, 300.0);
    frame.prepare(scene, kPixel_rad);
    scene.air.visibility_m = 30e3;
    std::vector<glm::dvec3> directions;
    for (const double elevation : {-10.0, -2.0, 1.0, 3.0, 10.0, 40.0})
        directions.push_back(tests::at(elevation, 150.0));
    const auto colours = [&] {
        const DomeLight dome(frame);
        std::vector<glm::dvec3> out;
        for (const glm::dvec3& direction : directions)
            out.push_back(dome.colour(direction).value() * 255.0);
        return out;
    };
    const std::vector<glm::dvec3> before = colours();
    std::vector<glm::dvec3> last = before;
    const auto largest_change = [&](const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
        double largest = 0.0;
        for (std::size_t k = 0; k < from.size(); ++k) {
            const glm::dvec3 d = glm::abs(to[k] - from[k]);
            largest = std::max({largest, d.x, d.y, d.z});
        }
        return largest;
    };
    double largest_step = 0.0;
    for (int i = 0; i < 130; ++i) {
        scene.time_s += 1.0 / 30.0;
        frame.prepare(scene, kPixel_rad);
        const std::vector<glm::dvec3> now = colours();
        largest_step = std::max(largest_step, largest_change(last, now));
        last = now;
    }
    const double whole = largest_change(before, last);
    std::printf("new air: %.1f codes in steps of at most %.2f\n", whole, largest_step);
    EXPECT_GT(whole, 20.0);
    EXPECT_LT(largest_step, 1.7 * whole / Dome::kLongestFade);
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const glm::dvec3 off = glm::abs(last[k] - frame.exact_colour(directions[k]) * 255.0);
        EXPECT_LT(std::max({off.x, off.y, off.z}), 0.6);
    }
}

// Everything that the plan drops of smooth light, drawn all the same.
TEST(Dome, LightThatThePlanDropsWouldChangeNoCodeByHalf) {
    Quality all;
    all.forced.set(static_cast<std::size_t>(Pass::kSunSky));
    all.forced.set(static_cast<std::size_t>(Pass::kMoonSky));
    SkyFrame planned({}, {});
    SkyFrame forced({}, all);
    double worst = 0.0;
    double time_s = 0.0;
    for (const double height_m : {0.0, 3e3, 12e3, 400e3}) {
        for (const double sun_deg : {60.0, 5.0, -4.0, -9.0, -22.0, -40.0}) {
            for (const double moon_deg : {50.0, -8.0}) {
                Scene scene = make_scene(sun_deg, 120.0, moon_deg, 250.0, height_m);
                scene.time_s = time_s += 100.0;
                planned.prepare(scene, kPixel_rad);
                forced.prepare(scene, kPixel_rad);
                for (const double elevation : {-60.0, -20.0, -15.0, -3.0, -0.5, 0.5, 3.0, 10.0, 30.0, 80.0}) {
                    for (const double azimuth : {120.0, 160.0, 250.0, 300.0}) {
                        const glm::dvec3 d = tests::at(elevation, azimuth);
                        const glm::dvec3 off =
                            glm::abs(planned.exact_colour(d) - forced.exact_colour(d)) * 255.0;
                        const double largest = std::max({off.x, off.y, off.z});
                        worst = std::max(worst, largest);
                        EXPECT_LE(largest, 0.5) << "sun " << sun_deg << ", moon " << moon_deg << ", "
                                                << height_m << " m, at " << elevation << " " << azimuth;
                    }
                }
            }
        }
    }
    std::printf("light that was dropped: at most %.3f codes\n", worst);
}

TEST(BendProfile, IntervalsOfACurveErrAlike) {
    BendProfile profile(400);
    const auto x = profile.positions_rad();
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = 3.0 * static_cast<double>(i) / static_cast<double>(x.size() - 1);
    profile.clear();
    const auto curve = [](double at) { return 100.0 * std::exp(-2.0 * at); };
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        profile.add(i, 4.0 * curve(x[i]));
    profile.finish(10.0);
    const double intervals = std::ceil(profile.intervals(0.2));
    std::vector<double> nodes(static_cast<std::size_t>(intervals) + 1);
    profile.place(nodes);
    EXPECT_EQ(nodes.front(), 0.0);
    EXPECT_EQ(nodes.back(), 3.0);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const double error =
            0.5 * (curve(nodes[i - 1]) + curve(nodes[i])) - curve(0.5 * (nodes[i - 1] + nodes[i]));
        EXPECT_GT(error, 0.13) << i;
        EXPECT_LT(error, 0.23) << i;
    }
}

}  // namespace
}  // namespace skyig::render
