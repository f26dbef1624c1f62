// Coverage as oktas mean it: the part of the layer that hides what is behind it, seen straight down.
#include "render/cloud/field/coverage.h"

#include "render/cloud/field/shapes.h"
#include "tests/render/cloud/field/fixture.h"

namespace skyig::render::cloud::field {
namespace {

struct Seen {
    double hidden = 0.0;  // part of the rays with opacity above 0.5
    double opacity = 0.0;
};

// From 500 m over the layer, at places spread over the world by letting it drift.
Seen straight_down(CloudLayer layer, int places) {
    const std::vector<CloudRay> rays = sphere_of_rays(2, 4, -0.5 * kPi, -0.5 * kPi + 0.15);
    CloudField field(matrix());
    const CloudLight dark;
    Seen sum;
    for (int i = 0; i < places; ++i) {
        layer.drift_m = kWorld_m * glm::dvec2(std::fmod(0.7548776662466927 * i, 1.0),
                                              std::fmod(0.5698402909980532 * i, 1.0));
        field.freeze(scene_of({layer}, layer.base_m + layer.thickness_m + 500.0), dark);
        for (const CloudSample& sample : seen(field, rays)) {
            sum.hidden += sample.transmittance < 0.5F ? 1.0 : 0.0;
            sum.opacity += static_cast<double>(1.0F - sample.transmittance);
        }
    }
    const double count = static_cast<double>(rays.size()) * places;
    return {sum.hidden / count, sum.opacity / count};
}

struct Case {
    CloudGenus genus;
    const char* name;
    double thickness_m;
    double extinction_per_m;
    double severity = 0.0;
    bool sheet = false;
};

TEST(Coverage, IsWhatIsAskedFor) {
    // Ice is asked for dense enough to hide anything.
    const std::vector<Case> cases = {{CloudGenus::kCumulus, "Cu", 1000.0, 0.0},
                                     {CloudGenus::kCumulus, "Cu, thick", 2500.0, 0.0},
                                     {CloudGenus::kStratocumulus, "Sc", 400.0, 0.0},
                                     {CloudGenus::kStratus, "St", 300.0, 0.0},
                                     {CloudGenus::kAltocumulus, "Ac", 350.0, 0.0},
                                     {CloudGenus::kCumulonimbus, "Cb, young", 8000.0, 0.0},
                                     {CloudGenus::kCumulonimbus, "Cb, grown", 8000.0, 0.0, 1.0},
                                     {CloudGenus::kAltostratus, "As", 1500.0, 0.0},
                                     {CloudGenus::kNimbostratus, "Ns", 3000.0, 0.0},
                                     {CloudGenus::kCirrus, "Ci", 1000.0, 0.01},
                                     {CloudGenus::kCirrostratus, "Cs", 1000.0, 0.01},
                                     {CloudGenus::kCirrocumulus, "Cc", 250.0, 0.04},
                                     {CloudGenus::kCirrus, "Ci, sheet", 1000.0, 0.01, 0.0, true},
                                     {CloudGenus::kCirrostratus, "Cs, sheet", 1000.0, 0.01, 0.0, true},
                                     {CloudGenus::kCirrocumulus, "Cc, sheet", 250.0, 0.04, 0.0, true},
                                     // Half as dense as in a patch hides just half of what is behind.
                                     {CloudGenus::kFogPatches, "fog", 40.0, 2.0 * std::log(2.0) / 40.0}};
    for (const Case& c : cases) {
        double worst = 0.0;
        for (const double asked : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            // All steps of the two that matter most.
            if (c.thickness_m != 1000.0 && c.thickness_m != 400.0 && (asked == 0.3 || asked == 0.7)) continue;
            CloudLayer layer = layer_of(c.genus, 1000.0, c.thickness_m, asked);
            layer.extinction_per_m = c.extinction_per_m;
            layer.severity = c.severity;
            if (c.sheet) layer.model = CloudModel::kAuto;
            const Seen measured = straight_down(layer, 1200);
            std::printf("%-10s asked %.0f %%: hidden %5.1f %%, mean opacity %5.1f %%\n", c.name,
                        100.0 * asked, 100.0 * measured.hidden, 100.0 * measured.opacity);
            worst = std::max(worst, std::abs(measured.hidden - asked));
        }
        EXPECT_LT(worst, 0.03) << c.name;
    }
}

TEST(Coverage, KeepsFromFarWhatRaysDoNotResolve) {
    // From 400 km, rays half a kilometre wide and more, straight down.
    const std::vector<CloudRay> rays = sphere_of_rays(8, 64, -0.5 * kPi, -0.5 * kPi + 0.3);
    for (const double asked : {0.2, 0.5, 0.8}) {
        CloudField field(matrix());
        field.freeze(scene_of({layer_of(CloudGenus::kCumulus, 1000.0, 1000.0, asked)}, 400e3), plain_light());
        for (const float ray_rad : {1e-5F, 1.2e-3F, 1e-2F}) {
            double opacity = 0.0;
            for (const CloudSample& sample : seen(field, rays, {}, ray_rad))
                opacity +=
                    static_cast<double>(1.0F - sample.transmittance) / static_cast<double>(rays.size());
            std::printf("asked %.0f %%, rays of %.0e rad from 400 km: mean opacity %.1f %%\n", 100.0 * asked,
                        static_cast<double>(ray_rad), 100.0 * opacity);
            EXPECT_NEAR(opacity, asked, 0.12);
        }
    }
}

TEST(Coverage, OfNothingShowsExactlyNothing) {
    const std::vector<CloudRay> rays = sphere_of_rays(12, 16);
    for (const double eye_m : {2.0, 1500.0, 9000.0}) {
        const Scene scene = scene_of({layer_of(CloudGenus::kCumulus, 1000.0, 1000.0, 0.0)}, eye_m);
        for (const CloudSample& sample : seen(scene, plain_light(), rays))
            EXPECT_EQ(sample, CloudSample{});
    }
}

TEST(Coverage, OfAllLeavesNoHole) {
    const std::vector<CloudRay> rays = sphere_of_rays(40, 90, 0.05, 0.5 * kPi);
    for (const CloudGenus genus : {CloudGenus::kCumulus, CloudGenus::kStratocumulus, CloudGenus::kStratus,
                                   CloudGenus::kAltocumulus, CloudGenus::kNimbostratus}) {
        CloudLayer layer = layer_of(genus, 1000.0, 600.0, 1.0);
        layer.extinction_per_m = 30.0 / 600.0;
        float most = 0.0F;
        for (const CloudSample& sample : seen(scene_of({layer}, 2.0), plain_light(), rays))
            most = std::max(most, sample.transmittance);
        std::printf("genus %d: least opacity %.5f\n", static_cast<int>(genus),
                    1.0 - static_cast<double>(most));
        // Of the Sun's disc, 1e9 cd/m2, less than a thousandth of the cloud's light is left.
        EXPECT_LT(most, 1e-9F);
    }
}

TEST(Coverage, ThresholdsFallAsItGrows) {
    for (std::size_t g = 1; g < kGenera; ++g) {
        float last = 1e9F;
        for (double part = 0.0; part <= 1.0; part += 1.0 / 64.0) {
            const float threshold = matrix()->coverage.threshold(static_cast<CloudGenus>(g), part, 20.0);
            EXPECT_LE(threshold, last) << g << " at " << part;
            last = threshold;
        }
    }
}

TEST(Coverage, NoShapeChangesFasterThanItsReach) {
    // Else the march would pass over clouds.
    constexpr float kApart_m = 40.0F;
    for (std::size_t g = 0; g < kGenera; ++g) {
        Shape shape = shape_of(matrix()->noise, static_cast<CloudGenus>(g), {});
        for (Fine& fine : shape.fines)
            fine.weight = 0.0F;
        float largest = 0.0F;
        for (int n = 0; n < 1000 * kRays / 2; n += kRays / 2) {
            Points points{};
            for (int i = 0; i < kRays; ++i) {
                const double place = n + i / 2;
                const double turn = i % 2 == 0 ? 0.0 : 0.37 * place;
                const double away_m = i % 2 == 0 ? 0.0 : static_cast<double>(kApart_m);
                points.east_m[i] = static_cast<float>(std::fmod(0.7548776662466927 * place, 1.0) * kWorld_m +
                                                      away_m * std::sin(turn));
                points.north_m[i] = static_cast<float>(std::fmod(0.5698402909980532 * place, 1.0) * kWorld_m +
                                                       away_m * std::cos(turn));
            }
            kernels().values(shape, 1000.0F, points);
            for (std::size_t i = 0; i < kRays; i += 2)
                largest = std::max(largest, std::abs(points.value[i] - points.value[i + 1]));
        }
        std::printf("genus %zu: reach %.0f m, found %.0f m\n", g, static_cast<double>(shape.reach_m),
                    static_cast<double>(kApart_m / largest));
        EXPECT_LT(shape.reach_m, 1.05F * kApart_m / largest);
    }
}

// The largest change of any sample as coverage grows by a part.
double largest_step(CloudGenus genus, double part) {
    const std::vector<CloudRay> rays = sphere_of_rays(14, 40, 0.06, 1.4);
    double largest = 0.0;
    for (const double from : {0.2, 0.5, 0.8}) {
        const CloudLight light = plain_light();
        const Scene before = scene_of({layer_of(genus, 1200.0, 900.0, from)}, 2.0);
        const Scene after = scene_of({layer_of(genus, 1200.0, 900.0, from + part)}, 2.0);
        const std::vector<CloudSample> a = seen(before, light, rays);
        const std::vector<CloudSample> b = seen(after, light, rays);
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, step_255(a[i], b[i]));
    }
    return largest;
}

TEST(Coverage, GrowsWithoutPops) {
    // Over all of the sky in a minute, 60 frames a second. What changes most are thin clouds beside the Sun.
    constexpr double kFrame = 1.0 / 3600.0;
    for (const CloudGenus genus : {CloudGenus::kCumulus, CloudGenus::kStratocumulus, CloudGenus::kStratus}) {
        const double step = largest_step(genus, kFrame);
        std::printf("genus %d: largest step %.2f/255 a frame of a minute's ramp, %.2f/255 of ten seconds'\n",
                    static_cast<int>(genus), step, largest_step(genus, 6.0 * kFrame));
        EXPECT_LT(step, 3.0);
    }
}

}  // namespace
}  // namespace skyig::render::cloud::field
