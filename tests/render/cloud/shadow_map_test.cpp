// Shadows on the ground: as much of them as the area's mean says, lying still under drifting clouds.
#include "render/cloud/shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/cloud/field/field_maker.h"
#include "render/cloud_shade.h"
#include "render/ground_shadow.h"
#include "tests/render/cloud/lit_tables.h"

namespace skyig::render {
namespace {

using cloud::ShadowMap;

struct Day {
    Scene scene;
    cloud::CloudLight light;
    glm::dvec3 source_enu{0.0, 0.0, 1.0};

    Day(double coverage, double elevation_deg, CloudGenus genus = CloudGenus::kCumulus) {
        scene.eye = {46.5, 7.9, 3000.0};
        CloudLayer& layer = scene.weather.clouds[scene.weather.cloud_count++];
        layer.genus = genus;
        layer.model = CloudModel::kVolume;
        layer.base_m = 1200.0;
        layer.thickness_m = 500.0;
        layer.coverage = coverage;
        layer.seed = 4;
        const double elevation_rad = glm::radians(elevation_deg);
        source_enu = {0.6 * std::cos(elevation_rad), -0.8 * std::cos(elevation_rad), std::sin(elevation_rad)};
    }
    [[nodiscard]] CloudLayer& layer() { return scene.weather.clouds[0]; }
    [[nodiscard]] double mean() const {
        return static_cast<double>(CloudShade(scene.weather, 0.1).at(0.0, source_enu.z).direct);
    }
    void update(ShadowMap& map, cloud::CloudMaker& maker, double mean_passed, bool jumped = false) const {
        // A scene begins with its shadows.
        const bool begins = map.begun() == 0;
        map.update(maker, {{scene, scene.eye, light}, source_enu, 0.0093, mean_passed, jumped || begins});
    }
};

double mean_of(const ShadowMap& map, double half_m) {
    double sum = 0.0;
    constexpr int kSide = 150;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 place =
            half_m * (2.0 * (glm::dvec2{i % kSide, i / kSide} + 0.5) / double{kSide} - 1.0);
        sum += static_cast<double>(map.at(glm::vec2{place}));
    }
    return sum / (kSide * kSide);
}

cloud::field::FieldMaker& maker() {
    static cloud::field::FieldMaker field_maker;
    return field_maker;
}

TEST(ShadowMap, MeanIsTheAreasMean) {
    for (const double elevation_deg : {80.0, 50.0, 25.0, 8.0}) {
        for (const double coverage : {0.2, 0.5, 0.8}) {
            const Day day(coverage, elevation_deg);
            // What clouds leave before the map is told the mean: asked for their own, it changes nothing.
            cloud::CloudBeam beam{glm::vec3{day.source_enu}, 0.0F};
            const auto& source = maker().freeze(0, {day.scene, day.scene.eye, day.light});
            std::vector<glm::vec2> places;
            for (int i = 0; i < 10000; ++i)
                places.emplace_back(600.0F * static_cast<float>(i % 100 - 50),
                                    600.0F * static_cast<float>(i / 100 - 50));
            std::vector<float> passed(places.size());
            source.shadow(beam, 200.0F, places, passed);
            double own = 0.0;
            for (const float part : passed)
                own += static_cast<double>(part) / 10000.0;

            ShadowMap map;
            day.update(map, maker(), day.mean());
            const double found = mean_of(map, 30e3);
            std::printf(
                "Sun at %2.0f deg, coverage %.1f: clouds leave %.3f, area %.3f, map %.3f, contrast %.2f\n",
                elevation_deg, coverage, own, day.mean(), found, static_cast<double>(map.contrast()));
            EXPECT_NEAR(found, day.mean(), 0.03);
            EXPECT_NEAR(own, day.mean(), 0.05);
            EXPECT_EQ(map.at({1e6F, 0.0F}), map.mean());
        }
    }
}

// The mean that all light under clouds goes by, against beams through the field itself.
TEST(ShadowMap, TheAreasMeanIsWhatBeamsThroughTheFieldLeave) {
    struct Kind {
        CloudGenus genus;
        double thickness_m;
        double extinction_per_m = 0.0;
    };
    double largest = 0.0;
    for (const Kind& kind : {Kind{CloudGenus::kCumulus, 500.0}, Kind{CloudGenus::kCumulus, 1500.0},
                             Kind{CloudGenus::kStratocumulus, 400.0}, Kind{CloudGenus::kStratus, 300.0},
                             Kind{CloudGenus::kAltocumulus, 350.0}, Kind{CloudGenus::kNimbostratus, 2000.0},
                             Kind{CloudGenus::kFogPatches, 40.0, 0.1}}) {
        for (const double elevation_deg : {80.0, 50.0, 25.0, 8.0, 4.0}) {
            for (const double coverage : {0.2, 0.5, 0.8}) {
                Day day(coverage, elevation_deg, kind.genus);
                day.layer().thickness_m = kind.thickness_m;
                day.layer().extinction_per_m = kind.extinction_per_m;
                const auto& source = maker().freeze(0, {day.scene, day.scene.eye, day.light});
                std::vector<glm::vec2> places;
                for (int i = 0; i < 2500; ++i)
                    places.emplace_back(1013.0F * static_cast<float>(i % 50 - 25),
                                        1013.0F * static_cast<float>(i / 50 - 25));
                std::vector<float> passed(places.size());
                source.shadow({glm::vec3{day.source_enu}, 0.0F}, 200.0F, places, passed);
                double own = 0.0;
                for (const float part : passed)
                    own += static_cast<double>(part) / 2500.0;
                const double off = day.mean() - own;
                if (std::abs(off) > std::abs(largest)) largest = off;
                EXPECT_NEAR(day.mean(), own, 0.12)
                    << "genus " << static_cast<int>(kind.genus) << ", " << kind.thickness_m << " m, Sun at "
                    << elevation_deg << " deg, coverage " << coverage;
            }
        }
    }
    std::printf("furthest from the field: %+.3f of the beam\n", largest);
    RecordProperty("largest_error", std::to_string(largest));
}

TEST(ShadowMap, LiesStillOnTheGroundAndDriftsWithTheClouds) {
    Day day(0.5, 40.0);
    ShadowMap map;
    day.update(map, maker(), 0.5);
    std::vector<float> first;
    for (int i = 0; i < 400; ++i)
        first.push_back(map.at({31.0F * static_cast<float>(i), -500.0F}));
    // A second at 200 m/s over a wind of 10 m/s from the west: what lay there lies 200 m back now.
    double worst_step = 0.0;
    for (int frame = 1; frame <= 30; ++frame) {
        const float before = map.at({800.0F, 300.0F});
        day.scene.eye = {46.5, 7.9 + frame / 30.0 * 200.0 / (111.32e3 * std::cos(glm::radians(46.5))),
                         3000.0};
        day.layer().drift_m = {frame / 30.0 * 10.0, 0.0};
        day.update(map, maker(), 0.5);
        worst_step = std::max(
            worst_step, std::abs(static_cast<double>(map.at({800.0F - 190.0F / 30.0F, 300.0F}) - before)));
    }
    double off = 0.0;
    for (int i = 0; i < 400; ++i)
        off = std::max(
            off, static_cast<double>(std::abs(map.at({31.0F * static_cast<float>(i) - 190.0F, -500.0F}) -
                                              first[static_cast<std::size_t>(i)])));
    std::printf("after a second of flight: off by %.4f at most, %.4f from frame to frame\n", off, worst_step);
    EXPECT_LT(off, 0.03);
    EXPECT_LT(worst_step, 0.01);
}

TEST(ShadowMap, AnEyeThatIsCarriedElsewhereHasItsShadowsAtOnce) {
    Day day(0.5, 40.0);
    ShadowMap map;
    day.update(map, maker(), 0.5);
    const std::uint64_t before = map.revision();
    // A host puts the craft 100 km to the north, and then beside the pole and to its other side.
    for (const glm::dvec2 place :
         {glm::dvec2{47.4, 7.9}, glm::dvec2{89.999, 0.0}, glm::dvec2{89.999, 90.0}}) {
        day.scene.eye = {place.x, place.y, 3000.0};
        day.update(map, maker(), 0.5);
        ShadowMap anew;
        day.update(anew, maker(), 0.5);
        EXPECT_GT(anew.contrast(), 0.1F);
        double off = 0.0;
        for (int i = 0; i < 400; ++i) {
            const glm::vec2 at{31.0F * static_cast<float>(i), -500.0F};
            off = std::max(off, static_cast<double>(std::abs(map.at(at) - anew.at(at))));
        }
        EXPECT_EQ(off, 0.0) << place.x << " " << place.y;
        EXPECT_EQ(map.begun(), map.revision());
    }
    EXPECT_GT(map.begun(), before);
}

TEST(ShadowMap, AnAreaThatIsToldFarAwayChangesItWithoutAPop) {
    Day day(0.5, 8.0);
    ShadowMap map;
    // A mean that these clouds do not leave by themselves.
    const double mean = day.mean() + 0.25;
    day.update(map, maker(), mean);
    const auto all = [&map] {
        std::vector<float> cells(map.cells().begin(), map.cells().end());
        return cells;
    };
    const std::vector<float> first = all();
    std::vector<float> before = first;
    CloudLayer elsewhere = day.layer();
    elsewhere.seed = 9;
    elsewhere.area = WeatherArea{.centre_m = {0.0, 400e3}, .half_size_m = {5e3, 5e3}};
    day.scene.weather.clouds[day.scene.weather.cloud_count++] = elsewhere;
    double worst = 0.0, changed = 0.0;
    for (int frame = 0; frame < 3 * ShadowMap::kFrames; ++frame) {
        day.update(map, maker(), mean);
        const std::vector<float> now = all();
        for (std::size_t i = 0; i < now.size(); ++i) {
            worst = std::max(worst, static_cast<double>(std::abs(now[i] - before[i])));
            changed = std::max(changed, static_cast<double>(std::abs(now[i] - first[i])));
        }
        before = now;
    }
    std::printf("an area far away: cells change by %.2f, in a frame by %.4f\n", changed, worst);
    EXPECT_GT(changed, 0.1);
    EXPECT_LT(worst, 0.03);
}

TEST(ShadowMap, GrowingCloudsChangeItWithoutAPop) {
    Day day(0.0, 50.0);
    ShadowMap map;
    day.update(map, maker(), day.mean());
    std::vector<glm::vec2> places;
    for (int i = 0; i < 900; ++i)
        places.emplace_back(150.0F * static_cast<float>(i % 30 - 15),
                            150.0F * static_cast<float>(i / 30 - 15));
    std::vector<float> before(places.size(), 1.0F);
    double worst = 0.0, changed = 0.0;
    for (int frame = 1; frame <= 600; ++frame) {
        day.layer().coverage = frame / 1800.0;
        day.layer().age_s = frame / 30.0;
        day.update(map, maker(), day.mean());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const float now = map.at(places[i]);
            worst = std::max(worst, static_cast<double>(std::abs(now - before[i])));
            before[i] = now;
            changed = std::max(changed, 1.0 - static_cast<double>(now));
        }
    }
    std::printf("20 s of growing to 0.33: the deepest shadow %.2f, the largest step of a frame %.4f\n",
                changed, worst);
    EXPECT_GT(changed, 0.5);
    EXPECT_LT(worst, 0.03);
    // At rest it does no more.
    for (int frame = 0; frame < 3 * ShadowMap::kFrames; ++frame)
        day.update(map, maker(), day.mean());
    const std::uint64_t at_rest = map.revision();
    day.update(map, maker(), day.mean());
    EXPECT_EQ(map.revision(), at_rest);
}

TEST(ShadowMap, RestsWhileCloudsDoNothingButDrift) {
    Day day(0.5, 40.0);
    ShadowMap map;
    day.update(map, maker(), 0.5);
    const std::uint64_t made = map.revision();
    // Ten metres a second for four seconds, and then as many until the shapes have changed.
    int frame = 1;
    for (; frame <= 120; ++frame) {
        day.layer().age_s = frame / 30.0;
        day.layer().drift_m = {frame / 3.0, 0.0};
        day.update(map, maker(), 0.5);
    }
    EXPECT_EQ(map.revision(), made);
    EXPECT_NEAR(map.origin_m().x, 40.0, 1e-9);
    for (; frame <= 480; ++frame) {
        day.layer().age_s = frame / 30.0;
        day.layer().drift_m = {frame / 3.0, 0.0};
        day.update(map, maker(), 0.5);
    }
    EXPECT_GT(map.revision(), made);
}

TEST(ShadowMap, ASunThatRisesBringsShadowsInFromTheMean) {
    const Day day(0.5, 40.0);
    ShadowMap map, anew;
    day.update(anew, maker(), 0.5);
    day.update(map, maker(), 0.5);
    map.stop();
    day.update(map, maker(), 0.5);
    EXPECT_TRUE(map.shown());
    EXPECT_EQ(map.contrast(), 0.0F);
    const auto line = [](const ShadowMap& of) {
        std::vector<float> passed;
        for (int i = 0; i < 400; ++i)
            passed.push_back(of.at({31.0F * static_cast<float>(i - 200), -500.0F}));
        return passed;
    };
    std::vector<float> before = line(map);
    float worst = 0.0F;
    for (int frame = 0; frame <= 2 * ShadowMap::kFrames; ++frame) {
        day.update(map, maker(), 0.5);
        const std::vector<float> now = line(map);
        for (std::size_t i = 0; i < now.size(); ++i)
            worst = std::max(worst, std::abs(now[i] - before[i]));
        before = now;
    }
    std::printf("shadows come in: contrast %.3f, the largest step of a frame %.4f\n",
                static_cast<double>(map.contrast()), static_cast<double>(worst));
    EXPECT_EQ(before, line(anew));
    EXPECT_LT(worst, 0.03F);
}

TEST(ShadowMap, PlanSaysWhetherAnyAreCast) {
    Day day(0.5, 50.0);
    tests::LitTables lit(day.scene);
    ShadowMap map;
    plan_clouds(lit.plan, day.scene, 512, 256, false);
    plan_cloud_shadows(lit.plan, map, false);
    EXPECT_FALSE(lit.plan.needs(Pass::kCloudShadows));
    day.update(map, maker(), day.mean());
    plan_cloud_shadows(lit.plan, map, true);
    EXPECT_TRUE(lit.plan.needs(Pass::kCloudShadows));
    EXPECT_EQ(lit.plan[Pass::kCloudShadows].resolution.columns, ShadowMap::kCells);
    plan_cloud_shadows(lit.plan, map, false);
    EXPECT_FALSE(lit.plan.needs(Pass::kCloudShadows));
}

TEST(GroundShadow, LeavesTheMeanLightOfTheGroundAsItIs) {
    Day day(0.5, 50.0);
    day.scene.sun.direction_enu = day.source_enu;
    tests::LitTables lit(day.scene);
    DeferredAir air;
    air.update(day.scene, lit.plan, lit.tables, lit.sky);
    GroundShadow shadow;
    shadow.update(maker(), {day.scene, day.scene.eye, day.light}, lit.tables.air(), lit.sky, true);
    ASSERT_TRUE(shadow.shown());
    double change = 0.0, ground = 0.0, deepest = 1.0;
    for (int i = 0; i < 3000; ++i) {
        // Even over the ground within 25 km.
        const double away_m = 25e3 * std::sqrt((i + 0.5) / 3000.0);
        const glm::dvec3 direction = direction_of({-std::atan2(3000.0, away_m), i * 2.39996});
        const Horizontal at = horizontal_of(direction);
        const auto mean_cd_m2 =
            static_cast<double>(lit.sky.smooth_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kGround).y);
        const double here = shadow.change_cd_m2(air, direction, 1e-3).y;
        EXPECT_GT(mean_cd_m2 + here, 0.0);
        change += here;
        ground += mean_cd_m2;
        deepest = std::min(deepest, 1.0 + here / mean_cd_m2);
    }
    std::printf("shadows change the ground's mean by %.2f %%; the deepest leaves %.2f of it\n",
                100.0 * change / ground, deepest);
    EXPECT_NEAR(change / ground, 0.0, 0.03);
    EXPECT_LT(deepest, 0.6);
}

}  // namespace
}  // namespace skyig::render
