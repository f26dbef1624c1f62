// How much fog lies up to a thing among patches, against a sum of a metre's steps over the field's own value.
#include "render/patch_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/cloud/field/field_maker.h"

namespace skyig::render {
namespace {

struct Patches {
    Scene scene;
    cloud::CloudLight light;
    cloud::field::FieldMaker& maker = shared_maker();

    // Its noise takes a while.
    static cloud::field::FieldMaker& shared_maker() {
        static cloud::field::FieldMaker made;
        return made;
    }
    Patches(double eye_m, double coverage) {
        scene.eye = {47.3, 8.4, eye_m};
        CloudLayer& fog = scene.weather.clouds[scene.weather.cloud_count++];
        fog.genus = CloudGenus::kFogPatches;
        fog.base_m = 0.0;
        fog.thickness_m = 40.0;
        fog.top_band_m = 10.0;
        fog.coverage = coverage;
        fog.extinction_per_m = 0.028;
        fog.seed = 5;
    }
    [[nodiscard]] CloudLayer& fog() { return scene.weather.clouds[0]; }
    [[nodiscard]] cloud::CloudMoment moment() const { return {scene, scene.eye, light}; }

    /// Metres of full density.
    [[nodiscard]] double way_m(const glm::dvec3& direction, double distance_m) {
        using namespace cloud::field;
        const auto& field = static_cast<const CloudField&>(maker.freeze(0, moment())).field();
        const Layer& own = field.layers[0];
        double sum_m = 0.0;
        Points points{};
        for (double first_m = 0.0; first_m < distance_m; first_m += kRays) {
            for (int i = 0; i < kRays; ++i) {
                const glm::dvec3 at_m = (first_m + i + 0.5) * direction;
                points.north_m[i] = static_cast<float>(at_m.y);
                points.east_m[i] = static_cast<float>(at_m.x) + field.closing * points.north_m[i];
                points.height_m[i] = 1.0F;
            }
            kernels().values(own.shape, own.thickness_m, points);
            for (int i = 0; i < kRays; ++i) {
                const double along_m = first_m + i + 0.5;
                if (along_m > distance_m) break;
                const double x = std::clamp(
                    static_cast<double>((points.value[i] - own.threshold) / own.shape.edge), 0.0, 1.0);
                const double height_m = scene.eye.height_m + along_m * direction.z;
                const double band = height_m < 0.0 ? 0.0 : std::clamp((50.0 - height_m) / 10.0, 0.0, 1.0);
                sum_m += x * x * (3.0 - 2.0 * x) * band;
            }
        }
        return sum_m;
    }
};

glm::dvec3 towards(double elevation_deg, double azimuth_deg) {
    const double elevation = glm::radians(elevation_deg), azimuth = glm::radians(azimuth_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
            std::sin(elevation)};
}

TEST(PatchColumns, HoldTheFogOfEachPath) {
    struct View {
        double eye_m, elevation_deg;
    };
    double largest = 0.0;
    int compared = 0;
    for (const View& view : {View{3.0, 0.0}, View{3.0, 2.0}, View{30.0, -2.0}, View{45.0, -1.0},
                             View{150.0, -12.0}, View{600.0, -40.0}, View{600.0, -90.0}}) {
        Patches patches(view.eye_m, 0.5);
        PatchColumns columns;
        columns.update(patches.maker, patches.moment());
        ASSERT_TRUE(columns.shown());
        double own = 0.0;
        for (int i = 0; i < 24; ++i) {
            const glm::dvec3 direction = towards(view.elevation_deg, 15.0 * i + 7.0);
            const double ground_m =
                view.elevation_deg < 0.0 ? view.eye_m / std::sin(glm::radians(-view.elevation_deg)) : 1e9;
            for (const double distance_m : {90.0, 250.0, 600.0, 880.0}) {
                const double to_m = std::min(distance_m, ground_m);
                const double expected = std::exp(-0.028 * patches.way_m(direction, to_m));
                if (expected < 0.05) continue;
                const double got = std::exp(-columns.optical_depth(direction, to_m));
                own = std::max(own, std::abs(got / expected - 1.0));
                EXPECT_NEAR(got, expected, 0.05 * expected)
                    << "from " << view.eye_m << " m, " << view.elevation_deg << " deg, azimuth "
                    << 15.0 * i + 7.0 << ", " << to_m << " m";
                ++compared;
            }
        }
        std::printf("from %3.0f m, %3.0f deg: contrast within %.3f\n", view.eye_m, view.elevation_deg, own);
        largest = std::max(largest, own);
    }
    std::printf("%d paths among patches: contrast within %.3f\n", compared, largest);
    RecordProperty("largest_relative_error", std::to_string(largest));
    EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace skyig::render
