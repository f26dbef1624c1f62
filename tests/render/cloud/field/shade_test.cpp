// Where the field's clouds leave the ground in shadow.
#include <algorithm>
#include <ctime>

#include "tests/render/cloud/field/fixture.h"

namespace skyig::render::cloud::field {
namespace {

CloudBeam beam_at(double elevation_rad, double azimuth_rad) {
    return {ray_at(elevation_rad, azimuth_rad).direction_enu, 0.0F};
}

TEST(CloudFieldShade, LiesAwayFromTheSunByHeightOverTangent) {
    constexpr double kMiddle_m = 1600.0;
    for (const double elevation_deg : {70.0, 45.0, 20.0, 8.0, 4.0}) {
        // One flat cloud of half a kilometre round a place north-east of the eye.
        CloudLayer lone = slab_of(kMiddle_m - 50.0, 100.0, 20.0);
        lone.area = WeatherArea{{700.0, 400.0}, 0.0, {}, 500.0, 1.0};
        CloudField field(matrix());
        field.freeze(scene_of({lone}, 300.0), plain_light());
        const double elevation_rad = glm::radians(elevation_deg);
        const double azimuth_rad = glm::radians(140.0);
        const double away_m = kMiddle_m / std::tan(elevation_rad);
        const glm::dvec2 towards{std::sin(azimuth_rad), std::cos(azimuth_rad)};
        const glm::dvec2 expected = glm::dvec2{700.0, 400.0} - away_m * towards;
        std::vector<glm::vec2> places;
        constexpr int kSide = 96;
        const double cell_m = (3000.0 + 0.2 * away_m) / kSide;
        for (int i = 0; i < kSide * kSide; ++i)
            places.emplace_back(expected + cell_m * glm::dvec2{i % kSide - kSide / 2, i / kSide - kSide / 2});
        std::vector<float> passed(places.size());
        field.shadow(beam_at(elevation_rad, azimuth_rad), 1.0F, places, passed);
        glm::dvec2 sum{0.0};
        double weight = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            sum += static_cast<double>(1.0F - passed[i]) * glm::dvec2{places[i]};
            weight += static_cast<double>(1.0F - passed[i]);
        }
        ASSERT_GT(weight, 10.0);
        const double off_m = glm::length(sum / weight - expected);
        // The Earth is round: the ray has climbed higher by then.
        std::printf("Sun at %.0f deg: shadow %.0f m away, off height over tangent by %.1f m (%.2f %%)\n",
                    elevation_deg, away_m, off_m, 100.0 * off_m / std::max(away_m, kMiddle_m));
        EXPECT_LT(off_m, 0.05 * std::max(away_m, kMiddle_m));
    }
}

// An eye on the ground sees as much of the Sun as its place is lit.
TEST(CloudFieldShade, IsWhatTheMarchTowardsTheSunLeaves) {
    const auto model = [](CloudModel as, double thickness_m) {
        CloudLayer layer = layer_of(CloudGenus::kCumulus, 900.0, thickness_m, 0.45);
        layer.model = as;
        return layer;
    };
    for (const CloudLayer& layer : {model(CloudModel::kVolume, 400.0), model(CloudModel::kLayer, 100.0)}) {
        double mean = 0.0, mean_shade = 0.0, off = 0.0;
        constexpr int kPlaces = 600;
        for (int i = 0; i < kPlaces; ++i) {
            Scene scene = scene_of({layer}, 0.0);
            scene.eye.latitude_deg += 0.007 * (i % 20);
            scene.eye.longitude_deg += 0.011 * (i / 20);
            CloudField field(matrix());
            field.freeze(scene, plain_light());
            const CloudBeam beam = beam_at(0.5 + 0.0015 * i, 0.4 * i);
            const float seen_through = seen(field, {{beam.direction_enu}}, {}, 1e-4F)[0].transmittance;
            const glm::vec2 here{0.0F};
            float passed = 0.0F;
            field.shadow(beam, 1.0F, {&here, 1}, {&passed, 1});
            off += static_cast<double>((passed - seen_through) * (passed - seen_through)) / kPlaces;
            mean += static_cast<double>(seen_through) / kPlaces;
            mean_shade += static_cast<double>(passed) / kPlaces;
        }
        std::printf("model %d: march leaves %.4f, shade %.4f, rms apart %.4f\n",
                    static_cast<int>(layer.model), mean, mean_shade, std::sqrt(off));
        EXPECT_LT(std::sqrt(off), 0.1);
        EXPECT_NEAR(mean_shade, mean, 0.02);
    }
}

TEST(CloudFieldShade, IsAlikeOnAllInstructionSets) {
    const Scene scene = scene_of({layer_of(CloudGenus::kCumulus, 900.0, 600.0, 0.45)}, 500.0);
    std::vector<glm::vec2> places;
    for (int i = 0; i < 20000; ++i)
        places.emplace_back(64.0F * static_cast<float>(i % 100), 64.0F * static_cast<float>(i / 100));
    std::vector<float> first(places.size());
    for (const Kernels* variant : variants()) {
        CloudField field(matrix(), *variant);
        field.freeze(scene, plain_light());
        std::vector<float> passed(places.size());
        const std::clock_t begin = std::clock();
        field.shadow(beam_at(0.6, 2.0), 30.0F, places, passed);
        const double us = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        if (variant == variants().front()) first = passed;
        float worst = 0.0F;
        for (std::size_t i = 0; i < places.size(); ++i)
            worst = std::max(worst, std::abs(passed[i] - first[i]));
        std::printf("%s: %.3f us a place, off portable by %.1e at most\n", variant->name,
                    us / static_cast<double>(places.size()), static_cast<double>(worst));
        EXPECT_LT(worst, 0.01F);
    }
}

}  // namespace
}  // namespace skyig::render::cloud::field
