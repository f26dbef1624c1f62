// Numerically hard cases of the cloud field: rays that graze, layers at the eye, nothing and too much.
#include "tests/render/cloud/field/fixture.h"
#include "tests/render/cloud/field/kernels_double.h"

namespace skyig::render::cloud::field {
namespace {

// One ray through one shell, by each instruction set.
struct Shell {
    const char* name;
    double eye_m, low_m, high_m, sine;
    bool rising;
    bool to_far;  // the way to the far end, else the path inside
    double expected_m;
};

// Radius 6 371 000 m; values from 50-digit arithmetic.
const std::vector<Shell> kShells = {
    {"level from the ground to 1500 m", 0.0, 0.0, 1500.0, 0.0, true, true, 138257.911},
    {"half a metre below, 1e-4 rad", 1499.5, 0.0, 1500.0, 1e-4, true, true, 1966.322},
    {"from the base up 30 m", 1500.0, 1500.0, 1530.0, 0.0499791693, true, false, 599.6869},
    {"level inside 30 m", 1515.0, 1500.0, 1530.0, 0.0, true, true, 13826.629},
    {"level at the base", 1500.0, 0.0, 1500.0, 0.0, true, true, 0.0},
    {"30 m at 200 km", 0.0, 4000.0, 4030.0, 0.004310155392, true, false, 839.261},
    {"from below the tangent, 200 km", 2999.0, 3000.0, 3030.0, -0.015683737949, true, false, 1893.671},
    {"from inside, past the far base", 3015.0, 3000.0, 3030.0, -0.015763698479, true, false, 1903.192},
};

TEST(CloudField, MeetsShellsAsExactlyAsFloatsCan) {
    for (const Kernels* variant : variants()) {
        for (const Shell& shell : kShells) {
            Parts parts{};
            std::fill(std::begin(parts.sine), std::end(parts.sine), static_cast<float>(shell.sine));
            variant->parts(static_cast<float>(shell.eye_m), static_cast<float>(shell.low_m),
                           static_cast<float>(shell.high_m), shell.rising, parts);
            const double found =
                static_cast<double>(shell.to_far ? parts.to_m[0] : parts.to_m[0] - parts.from_m[0]);
            std::printf("%s, %s: %.3f m, exact %.3f\n", variant->name, shell.name, found, shell.expected_m);
            EXPECT_NEAR(found, shell.expected_m, 0.03 + 3e-5 * shell.expected_m) << shell.name;
        }
    }
}

TEST(CloudField, MeetsShellsExactlyInDoubles) {
    std::printf("%-34s %14s %14s %14s\n", "", "exact", "double", "float");
    for (const Shell& shell : kShells) {
        const doubles::Shell exact =
            doubles::shell(shell.eye_m, shell.low_m, shell.high_m, shell.sine, shell.rising);
        const double in_double = shell.to_far ? exact.to_m : exact.to_m - exact.from_m;
        Parts parts{};
        std::fill(std::begin(parts.sine), std::end(parts.sine), static_cast<float>(shell.sine));
        portable::kernels().parts(static_cast<float>(shell.eye_m), static_cast<float>(shell.low_m),
                                  static_cast<float>(shell.high_m), shell.rising, parts);
        const float in_float = shell.to_far ? parts.to_m[0] : parts.to_m[0] - parts.from_m[0];
        std::printf("%-34s %14.6f %14.6f %14.6f\n", shell.name, shell.expected_m, in_double,
                    static_cast<double>(in_float));
        // As many digits as the expected values and their angles are told with.
        EXPECT_NEAR(in_double, shell.expected_m, 0.001 + 1e-6 * shell.expected_m) << shell.name;
    }
}

struct HardScene {
    const char* name;
    Scene scene;
    std::vector<CloudRay> rays;
};

std::vector<HardScene> hard_scenes() {
    const CloudLayer broken = layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 0.5);
    const CloudLayer thin = layer_of(CloudGenus::kStratus, 4000.0, 30.0, 0.7);
    CloudLayer sheet = layer_of(CloudGenus::kCirrus, 8000.0, 500.0, 0.6);
    sheet.model = CloudModel::kAuto;
    CloudLayer drifted = broken;
    drifted.drift_m = {24.0 * 3600.0 * 15.0, -24.0 * 3600.0 * 7.0};
    const std::vector<CloudRay> all = sphere_of_rays(24, 40), level = sphere_of_rays(8, 60, -0.01, 0.03);
    return {{"no cover", scene_of({layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 0.0)}, 2.0), all},
            {"all covered", scene_of({layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 1.0)}, 2.0), all},
            {"depth 1e-6", scene_of({slab_of(1000.0, 500.0, 1e-6)}, 2.0), all},
            {"depth 1e4", scene_of({slab_of(1000.0, 500.0, 1e4)}, 2.0), all},
            {"broken, from the ground", scene_of({broken}, 0.0), all},
            {"broken, at its base", scene_of({broken}, 1200.0), all},
            {"broken, at its top", scene_of({broken}, 2100.0), all},
            {"broken, inside", scene_of({broken}, 1600.0), all},
            {"broken, from 12 km", scene_of({broken}, 12e3), all},
            {"broken, from 400 km", scene_of({broken}, 400e3), all},
            {"broken, after a day of wind", scene_of({drifted}, 2.0), all},
            {"30 m, level rays", scene_of({thin}, 2.0), level},
            {"30 m, level inside", scene_of({thin}, 4015.0), level},
            {"sheet", scene_of({sheet}, 2.0), all}};
}

TEST(CloudField, FloatsMarchAsDoublesDo) {
    std::printf("%-28s %10s %10s %10s\n", "in 255ths", "mean", "1 in 100", "worst");
    for (const HardScene& hard : hard_scenes()) {
        std::vector<std::vector<CloudSample>> seen_by;
        for (const Kernels* variant : {&portable::kernels(), &doubles::kernels()}) {
            CloudField field(matrix(), *variant);
            field.freeze(hard.scene, plain_light());
            seen_by.push_back(seen(field, hard.rays));
        }
        std::vector<double> steps;
        double sum = 0.0;
        for (std::size_t i = 0; i < hard.rays.size(); ++i) {
            steps.push_back(step_255(seen_by[0][i], seen_by[1][i]));
            sum += steps.back();
        }
        std::sort(steps.begin(), steps.end());
        const double mean = sum / static_cast<double>(steps.size());
        std::printf("%-28s %10.5f %10.5f %10.5f\n", hard.name, mean, steps[steps.size() * 99 / 100],
                    steps.back());
        EXPECT_LT(mean, 0.005) << hard.name;
        EXPECT_LT(steps.back(), 0.3) << hard.name;
    }
}

TEST(CloudField, IsSoundWhateverTheEyeAndTheRay) {
    std::vector<CloudRay> rays = sphere_of_rays(18, 12);
    for (const double elevation : {0.0, 1e-7, -1e-7, 0.5 * kPi, -0.5 * kPi})
        rays.push_back(ray_at(elevation, 1.0));
    rays.push_back({glm::vec3(0.0F, 0.0F, 1.0F)});
    rays.push_back({glm::vec3(0.0F, 0.0F, -1.0F)});
    CloudLayer thin = layer_of(CloudGenus::kStratus, 3000.0, 30.0, 0.7);
    CloudLayer sheet = layer_of(CloudGenus::kCirrus, 8000.0, 500.0, 0.6);
    sheet.model = CloudModel::kLayer;
    for (const double sun_rad : {0.5 * kPi, 0.3, 0.0, -0.05, -0.5 * kPi}) {
        for (const double eye_m : {-400.0, 0.0, 1000.0, 1500.0, 2000.0, 2500.0, 3000.0, 3015.0, 3030.0,
                                   8000.0, 12000.0, 100e3, 400e3}) {
            const Scene scene =
                scene_of({layer_of(CloudGenus::kCumulus, 1000.0, 1000.0, 0.5), thin, sheet}, eye_m);
            for (const CloudSample& sample : seen(scene, plain_light(sun_rad), rays))
                ASSERT_TRUE(is_sound(sample)) << eye_m << " " << sun_rad;
        }
    }
}

TEST(CloudField, LayersWithoutThicknessOrSenseAreLeftOut) {
    const CloudLayer flat = layer_of(CloudGenus::kCumulus, 1000.0, 0.0, 1.0);
    const CloudLayer inverted = layer_of(CloudGenus::kCumulus, 1000.0, -50.0, 1.0);
    CloudLayer unknown = layer_of(CloudGenus::kCumulus, 1000.0, 500.0, 1.0);
    unknown.base_m = std::nan("");
    for (const CloudSample& sample :
         seen(scene_of({flat, inverted, unknown}, 2.0), plain_light(), sphere_of_rays(6, 8)))
        EXPECT_EQ(sample, CloudSample{});
}

TEST(CloudField, ThickestCloudIsDarkGreyNotBlack) {
    // Optical depth 1e4: Eddington's transmission is 1.1e-3 of 1000 lx, spread over pi.
    const Scene scene = scene_of({slab_of(1000.0, 2000.0, 1e4)}, 2.0);
    const std::vector<CloudSample> samples =
        seen(scene, beam_light(0.5 * kPi), sphere_of_rays(4, 8, 0.3, 1.5));
    for (const CloudSample& sample : samples) {
        EXPECT_TRUE(is_sound(sample));
        EXPECT_EQ(sample.transmittance < 0.006F, true);
        EXPECT_GT(sample.light_cd_m2.y, 0.1F);
        EXPECT_LT(sample.light_cd_m2.y, 1.0F);
    }
}

TEST(CloudField, ThinnestCloudTakesWhatItsDepthSays) {
    for (const double depth : {1e-8, 1e-6, 1e-4, 1e-2}) {
        const Scene scene = scene_of({slab_of(1000.0, 500.0, depth)}, 2.0);
        const CloudSample up = seen(scene, beam_light(1.0), {ray_at(0.5 * kPi, 0.0)})[0];
        EXPECT_NEAR(static_cast<double>(1.0F - up.transmittance), -std::expm1(-depth), 1.3e-7 + 1e-3 * depth);
        const double per_depth = static_cast<double>(up.light_cd_m2.y) / depth;
        std::printf("depth %.0e: light per depth %.4f cd/m2\n", depth, per_depth);
        EXPECT_GT(per_depth, 5.0);
        EXPECT_LT(per_depth, 1e4);
    }
}

TEST(CloudField, InsideAllIsOneColour) {
    const Scene scene = scene_of({slab_of(1000.0, 2000.0, 100.0)}, 2000.0);
    const std::vector<CloudSample> samples = seen(scene, plain_light(), sphere_of_rays(8, 16, -0.2, 0.2));
    float low = 1e9F;
    float high = 0.0F;
    for (const CloudSample& sample : samples) {
        low = std::min(low, sample.light_cd_m2.y);
        high = std::max(high, sample.light_cd_m2.y);
        // Of an extinction of 0.05 a metre, mean way 20 m.
        EXPECT_NEAR(sample.distance_m, 20.0F, 2.0F);
    }
    EXPECT_LT(high / low, 1.2F);
}

TEST(CloudField, ADayOfWindMovesEverythingByTheWindAlone) {
    // What drifts over an eye that goes with the wind does not change, at any hour, wherever tiles repeat.
    const std::vector<CloudRay> rays = sphere_of_rays(10, 24, 0.1, 1.5);
    CloudLayer layer = layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 0.5);
    CloudField field(matrix());
    std::vector<CloudSample> last;
    double largest = 0.0;
    for (int frame = 0; frame <= 24 * 60; ++frame) {
        const double time_s = 60.0 * frame;
        const double whole_worlds = std::floor(15.0 * time_s / kWorld_m) * kWorld_m;
        // The same place twice: once as the wind brought it, once from its own world.
        layer.drift_m = {15.0 * time_s, -7.0 * time_s};
        field.freeze(scene_of({layer}, 2.0), plain_light());
        if (frame % 97 != 0) continue;
        const std::vector<CloudSample> drifted = seen(field, rays);
        layer.drift_m = {15.0 * time_s - whole_worlds, -7.0 * time_s + 8.0 * kWorld_m};
        field.freeze(scene_of({layer}, 2.0), plain_light());
        const std::vector<CloudSample> wrapped = seen(field, rays);
        for (std::size_t i = 0; i < rays.size(); ++i)
            largest = std::max(largest, step_255(drifted[i], wrapped[i]));
    }
    std::printf("24 h of wind: largest difference to the wrapped drift %.4f/255\n", largest);
    EXPECT_LT(largest, 0.2);
}

TEST(CloudField, AnswersDependOnTheRayAlone) {
    const std::vector<CloudRay> rays = sphere_of_rays(20, 20, -0.2, 1.5);
    for (const Kernels* variant : variants()) {
        CloudField field(matrix(), *variant);
        field.freeze(scene_of({layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 0.5)}, 2.0), plain_light());
        const std::vector<CloudSample> together = seen(field, rays);
        for (std::size_t i = 0; i < rays.size(); i += 7)
            ASSERT_EQ(seen(field, {rays[i]})[0], together[i]) << variant->name << " " << i;
        const std::vector<CloudRay> turned(rays.rbegin(), rays.rend());
        const std::vector<CloudSample> other = seen(field, turned);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(other[rays.size() - 1 - i], together[i]) << variant->name << " " << i;
    }
}

TEST(CloudField, VariantsDrawTheSameClouds) {
    const std::vector<CloudRay> rays = sphere_of_rays(20, 40, 0.05, 1.5);
    const Scene scene = scene_of({layer_of(CloudGenus::kCumulus, 1200.0, 900.0, 0.5)}, 2.0);
    std::vector<CloudSample> first;
    for (const Kernels* variant : variants()) {
        CloudField field(matrix(), *variant);
        field.freeze(scene, plain_light());
        const std::vector<CloudSample> samples = seen(field, rays);
        if (first.empty()) first = samples;
        double sum = 0.0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            sum += step_255(samples[i], first[i]);
        std::printf("%s: mean difference to portable %.4f/255\n", variant->name,
                    sum / static_cast<double>(rays.size()));
        EXPECT_LT(sum / static_cast<double>(rays.size()), 0.1);
    }
}

TEST(CloudField, RaysAreCutByTheirRange) {
    const std::vector<CloudRay> rays = sphere_of_rays(6, 30, 0.1, 1.2);
    CloudField field(matrix());
    field.freeze(scene_of({layer_of(CloudGenus::kCirrus, 3000.0, 900.0, 0.8)}, 2.0), plain_light());
    const std::vector<CloudSample> whole = seen(field, rays);
    const std::vector<CloudSample> near = seen(field, rays, {0.0F, 6000.0F});
    const std::vector<CloudSample> far = seen(field, rays, {6000.0F, 1e7F});
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_NEAR(near[i].transmittance * far[i].transmittance, whole[i].transmittance, 0.03F);
        const float joined = near[i].light_cd_m2.y + near[i].transmittance * far[i].light_cd_m2.y;
        EXPECT_NEAR(joined, whole[i].light_cd_m2.y, 0.03F * whole[i].light_cd_m2.y + 3.0F);
    }
}

// A march that went back would add what it has added.
TEST(CloudField, NothingIsAddedTwiceUnderALowBase) {
    CloudLayer layer = layer_of(CloudGenus::kCumulus, 609.6, 609.6, 0.75);
    layer.bottom_band_m = layer.top_band_m = 30.0;
    layer.seed = 3844975861U;
    Scene scene = scene_of({layer}, 450.0);
    scene.eye.latitude_deg = 47.4582;
    scene.eye.longitude_deg = 8.5555;
    CloudField field(matrix());
    field.freeze(scene, plain_light());
    const std::vector<CloudRay> rays = sphere_of_rays(40, 120, 0.0, 1.5);
    const std::vector<CloudSample> whole = seen(field, rays, {0.0F, 400.0F}, 0.05F);
    const std::vector<CloudSample> near = seen(field, rays, {0.0F, 240.0F}, 0.05F);
    const std::vector<CloudSample> far = seen(field, rays, {240.0F, 400.0F}, 0.05F);
    double worst = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float joined = near[i].transmittance * far[i].transmittance;
        worst = std::max(worst, static_cast<double>(std::abs(joined - whole[i].transmittance)));
    }
    std::printf("what passes in two parts against in one: off by %.4f at most\n", worst);
    EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace skyig::render::cloud::field
