// Pictures that sheets are made of: their grey is the density, they repeat without a seam, and far away they
// are their mean.
#include "render/cloud/field/texture.h"

#include <algorithm>

#include "render/cloud/field/shapes.h"
#include "tests/render/cloud/field/fixture.h"

namespace skyig::render::cloud::field {
namespace {

constexpr int kSide = 64;
constexpr int kTimes = 4;
constexpr double kTexel_m = kWorld_m / kTimes / kSide;

// Waves that fit the side, and one texel that stands out in a corner.
std::vector<float> grey() {
    std::vector<float> values;
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            const double x = 2.0 * kPi * column / kSide;
            const double y = 2.0 * kPi * row / kSide;
            values.push_back(
                static_cast<float>(0.5 + 0.2 * std::sin(3.0 * x + y) + 0.25 * std::cos(x - 5.0 * y)));
        }
    }
    values.back() = 1.0F;
    return values;
}

// In double, from the numbers themselves.
double bilinear(const std::vector<float>& values, double u, double v) {
    const auto at = [&](double column, double row) {
        const auto wrapped = [](double i) { return (static_cast<int>(i) % kSide + kSide) % kSide; };
        return static_cast<double>(values[static_cast<std::size_t>(wrapped(row) * kSide + wrapped(column))]);
    };
    const double c = std::floor(u);
    const double r = std::floor(v);
    const double low = std::lerp(at(c, r), at(c + 1.0, r), u - c);
    return std::lerp(low, std::lerp(at(c, r + 1.0), at(c + 1.0, r + 1.0), u - c), v - r);
}

CloudLayer pictured(const std::vector<float>& values) {
    CloudLayer layer = layer_of(CloudGenus::kCirrus, 8000.0, 1000.0, 1.0);
    layer.model = CloudModel::kAuto;
    layer.extinction_per_m = 1e-3;
    layer.look = CloudLook{};
    layer.look->tiles = {};
    for (CloudLook::Tile& tile : layer.look->tiles)
        tile.weight = 0.0;
    layer.look->tiles[0] = {.picture = std::make_shared<Texture>(kSide, values), .times = kTimes};
    return layer;
}

TEST(CloudTexture, DensityIsThePicturesGrey) {
    const std::vector<float> values = grey();
    const CloudLayer layer = pictured(values);
    const Shape shape = shape_of(matrix()->noise, *layer.look, {});
    double worst = 0.0;
    for (const Kernels* variant : variants()) {
        Points points{};
        for (int i = 0; i < 10 * kRays; ++i) {
            const int lane = i % kRays;
            points.east_m[lane] = static_cast<float>(713.7 * i - 2e5);
            points.north_m[lane] = static_cast<float>(1000.0 * std::sin(i) - 377.3 * i);
            if (lane + 1 < kRays) continue;
            variant->values(shape, 1000.0F, points);
            for (int k = 0; k < kRays; ++k) {
                const double u = static_cast<double>(points.east_m[k]) / kTexel_m +
                                 static_cast<double>(shape.flats[0].at[0]);
                const double v = static_cast<double>(points.north_m[k]) / kTexel_m +
                                 static_cast<double>(shape.flats[0].at[1]);
                worst = std::max(
                    worst, std::abs(static_cast<double>(points.value[k]) + 0.5 - bilinear(values, u, v)));
            }
        }
    }
    std::printf("grey against the picture: %.5f at most\n", worst);
    RecordProperty("largest_error", std::to_string(worst));
    // Half of a 255th and what single precision leaves of places 200 km away.
    EXPECT_LT(worst, 0.6 / 255.0);
}

TEST(CloudTexture, StraightUpItsOpticalDepthIsSeen) {
    const std::vector<float> values = grey();
    CloudField field(matrix());
    double worst = 0.0;
    for (int i = 0; i < 200; ++i) {
        CloudLayer layer = pictured(values);
        layer.drift_m = {1733.0 * i, -951.0 * i};
        field.freeze(scene_of({layer}, 100.0), plain_light());
        const float* at = field.field().layers[0].shape.flats[0].at;
        const double wanted =
            bilinear(values, static_cast<double>(at[0]), static_cast<double>(at[1])) * 1e-3 * 1000.0;
        const CloudSample up = seen(field, {ray_at(0.5 * kPi, 0.0)}, {}, 1e-5F)[0];
        worst = std::max(worst, std::abs(-std::log(static_cast<double>(up.transmittance)) - wanted));
    }
    std::printf("optical depth against the picture's: %.5f at most, of 1\n", worst);
    EXPECT_LT(worst, 0.01);
}

TEST(CloudTexture, RepeatsWithoutASeam) {
    std::vector<float> values = grey();
    values.back() = values[values.size() - 2];
    const CloudLayer layer = pictured(values);
    const Shape shape = shape_of(matrix()->noise, *layer.look, {});
    // Steps of a tenth of a texel over three repetitions, along both axes.
    double largest = 0.0;
    std::vector<float> line;
    for (const bool north : {false, true}) {
        line.clear();
        Points points{};
        for (int i = 0; i < 30 * kSide; ++i) {
            const auto place = static_cast<float>(0.1 * kTexel_m * i);
            const int lane = i % kRays;
            points.east_m[lane] = north ? 0.0F : place;
            points.north_m[lane] = north ? place : 0.0F;
            if (lane + 1 < kRays) continue;
            kernels().values(shape, 1000.0F, points);
            line.insert(line.end(), std::begin(points.value), std::end(points.value));
        }
        for (std::size_t i = 1; i < line.size(); ++i)
            largest = std::max(largest, std::abs(static_cast<double>(line[i] - line[i - 1])));
        const auto period = static_cast<std::size_t>(10 * kSide);
        for (std::size_t i = period; i < line.size(); ++i)
            EXPECT_NEAR(line[i], line[i - period], 1e-4F);
    }
    std::printf("largest step in a tenth of a texel: %.4f\n", largest);
    // The steepest wave, 0.25 * 5 * 2 pi / 64 and 0.2 * 3 of them, a tenth of it.
    EXPECT_LT(largest, 0.1 * (1.25 + 0.6) * 2.0 * kPi / kSide + 1.5 / 255.0);
}

TEST(CloudTexture, FarAwayItIsItsMean) {
    // Texels by turns black and white: a grain of many of them shows grey, one of a texel does not.
    std::vector<float> values;
    for (int i = 0; i < kSide * kSide; ++i)
        values.push_back((i + i / kSide) % 2 == 0 ? 0.0F : 1.0F);
    const Scene scene = scene_of({pictured(values)}, 100.0);
    CloudField field(matrix());
    field.freeze(scene, plain_light());
    const std::vector<CloudRay> rays = sphere_of_rays(6, 40, 1.2, 1.5);
    const auto spread = [&](float ray_rad) {
        float low = 1.0F;
        float high = 0.0F;
        for (const CloudSample& sample : seen(field, rays, {}, ray_rad)) {
            low = std::min(low, sample.transmittance);
            high = std::max(high, sample.transmittance);
        }
        return high - low;
    };
    const float near = spread(1e-5F);
    const float far = spread(static_cast<float>(8.0 * kTexel_m / 8000.0));
    std::printf("transmittance spreads by %.3f with fine rays, by %.3f with wide ones\n",
                static_cast<double>(near), static_cast<double>(far));
    EXPECT_GT(near, 0.4F);
    // What is left is the way through, which goes with the slope.
    EXPECT_LT(far, 0.03F);
}

}  // namespace
}  // namespace skyig::render::cloud::field
