// The cloud field as crews meet it: bases where they are set, bands to break out of, light as in theory.
#include "tests/render/cloud/field/fixture.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>

#include "render/cloud/field/shapes.h"
#include "render/cloud/slab_light.h"
#include "tests/support/allocation_count.h"

namespace skyig::render::cloud::field {
namespace {

double mean_step_255(const std::vector<CloudSample>& a, const std::vector<CloudSample>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += step_255(a[i], b[i]);
    return sum / static_cast<double>(a.size());
}

CloudLayer sheet_of(double coverage) {
    CloudLayer layer = layer_of(CloudGenus::kStratocumulus, 1000.0, 300.0, coverage);
    layer.model = CloudModel::kLayer;
    layer.bottom_band_m = 30.0;
    layer.top_band_m = 30.0;
    return layer;
}

TEST(CloudField, BaseIsWhereItIsSet) {
    // Climbing by half metres: below the base nothing is near, above it the way is lost.
    for (const CloudGenus genus : {CloudGenus::kStratus, CloudGenus::kCumulus, CloudGenus::kNimbostratus}) {
        const CloudLayer layer = layer_of(genus, 300.0, 600.0, 1.0);
        double found_m = 0.0;
        for (double eye_m = 280.0; eye_m < 330.0 && found_m == 0.0; eye_m += 0.5) {
            const CloudSample ahead =
                seen(scene_of({layer}, eye_m), plain_light(), {ray_at(0.0, 1.0)}, {0.0F, 400.0F})[0];
            if (ahead.transmittance < 0.5F) found_m = eye_m;
        }
        std::printf("genus %d: base set 300 m, met at %.1f m\n", static_cast<int>(genus), found_m);
        EXPECT_NEAR(found_m, 300.0, 5.0);
    }
}

TEST(CloudField, CrossingABandedBaseIsSmooth) {
    const std::vector<CloudRay> rays = sphere_of_rays(20, 24);
    CloudLayer layer = layer_of(CloudGenus::kStratus, 1000.0, 400.0, 1.0);
    layer.bottom_band_m = 30.0;
    layer.top_band_m = 30.0;
    for (const double height_m : {970.0, 1000.0, 1400.0, 1430.0}) {
        const std::vector<CloudSample> under = seen(scene_of({layer}, height_m - 1.0), plain_light(), rays);
        const std::vector<CloudSample> at = seen(scene_of({layer}, height_m), plain_light(), rays);
        const std::vector<CloudSample> over = seen(scene_of({layer}, height_m + 1.0), plain_light(), rays);
        std::printf("at %.0f m: mean step %.2f and %.2f/255 a metre\n", height_m, mean_step_255(under, at),
                    mean_step_255(at, over));
        // Out of the top of thick cloud all changes within its band.
        const double bound = height_m < 1200.0 ? 2.0 : 6.0;
        EXPECT_LT(mean_step_255(under, at), bound);
        EXPECT_LT(mean_step_255(at, over), bound);
    }
}

TEST(CloudField, ScudHangsInTheBandAlone) {
    CloudLayer layer = layer_of(CloudGenus::kStratus, 1000.0, 400.0, 1.0);
    layer.bottom_band_m = 200.0;
    const std::vector<CloudRay> rays = sphere_of_rays(1, 64, -0.01, 0.01);
    const auto opacity = [&](double eye_m) {
        double sum = 0.0;
        for (const CloudSample& sample : seen(scene_of({layer}, eye_m), plain_light(), rays, {0.0F, 150.0F}))
            sum += static_cast<double>(1.0F - sample.transmittance) / 64.0;
        return sum;
    };
    const double plain = opacity(815.0);
    layer.bottom_scud = 0.6;
    const double loose = opacity(815.0);
    std::printf("185 m below the base, 150 m ahead: opacity %.3f, with scud %.3f\n", plain, loose);
    EXPECT_GT(loose, plain + 0.02);
    EXPECT_EQ(opacity(780.0), 0.0);
}

TEST(CloudField, AnAreaEndsItsClouds) {
    CloudLayer layer = layer_of(CloudGenus::kStratus, 1000.0, 400.0, 1.0);
    layer.area = WeatherArea{{20000.0, 0.0}, 0.0, {0.0, 0.0}, 5000.0, 1000.0};
    CloudField field(matrix());
    field.freeze(scene_of({layer}, 1200.0), plain_light());
    const CloudSample east = seen(field, {ray_at(0.0, 0.5 * kPi)})[0];
    const CloudSample west = seen(field, {ray_at(0.0, -0.5 * kPi)})[0];
    EXPECT_LT(east.transmittance, 0.01F);
    EXPECT_GT(east.distance_m, 13900.0F);
    EXPECT_LT(east.distance_m, 15500.0F);
    EXPECT_EQ(west, CloudSample{});
}

TEST(CloudField, AnAreaLiesWhereItIsTold) {
    // Due north, seen as much to the left as to the right, though the field's axes are no meridians.
    CloudLayer layer = layer_of(CloudGenus::kStratus, 1000.0, 1000.0, 1.0);
    layer.area = WeatherArea{{0.0, 30000.0}, 0.3, {0.0, 0.0}, 5000.0, 1000.0};
    CloudField field(matrix());
    field.freeze(scene_of({layer}, 1500.0), plain_light());
    const CloudSample left = seen(field, {ray_at(0.0, -0.14)})[0];
    const CloudSample right = seen(field, {ray_at(0.0, 0.14)})[0];
    std::printf("an area's rim: %.0f m to the left, %.0f m to the right\n",
                static_cast<double>(left.distance_m), static_cast<double>(right.distance_m));
    EXPECT_GT(left.distance_m, 20000.0F);
    // Its edge is as ragged as the cloud.
    EXPECT_NEAR(left.distance_m, right.distance_m, 500.0F);
}

TEST(CloudField, AllocatesNothing) {
    CloudField field(matrix());
    const Scene scene = scene_of({layer_of(CloudGenus::kCumulus, 1000.0, 1000.0, 0.5), sheet_of(0.5)}, 2.0);
    const CloudLight light = plain_light();
    const std::vector<CloudRay> rays = sphere_of_rays(4, 33);
    std::vector<CloudSample> samples(rays.size());
    const std::uint64_t before = tests::allocation_count_of_this_thread();
    field.freeze(scene, light);
    field.march(rays, {}, kRay_rad, samples);
    EXPECT_EQ(tests::allocation_count_of_this_thread(), before);
}

TEST(CloudField, OverlappingLayersAddTheirExtinction) {
    const CloudLayer one = slab_of(1000.0, 400.0, 1.0);
    const CloudLayer two = slab_of(1200.0, 400.0, 0.5);
    const CloudSample up = seen(scene_of({one, two}, 2.0), plain_light(), {ray_at(0.5 * kPi, 0.0)})[0];
    EXPECT_NEAR(up.transmittance, std::exp(-1.5F), 0.005F);
}

TEST(CloudField, AnvilsAreDrawnOutIntoThreads) {
    Shape shape = shape_of(matrix()->noise, CloudGenus::kCumulonimbus, {});
    ASSERT_GT(shape.fibres.weight, 0.0F);
    // The threads alone.
    for (Flat& flat : shape.flats)
        flat.weight = 0.0F;
    for (Fine& fine : shape.fines)
        fine.weight = 0.0F;
    std::fill(std::begin(shape.lift), std::end(shape.lift), 0.0F);
    const auto values = [&](const glm::dvec2& shift_m, float height_m) {
        std::vector<float> found;
        Points points{};
        for (int i = 0; i < 40 * kRays; ++i) {
            const int lane = i % kRays;
            points.east_m[lane] = static_cast<float>(1931.0 * i + shift_m.x);
            points.north_m[lane] = static_cast<float>(733.0 * i + shift_m.y);
            points.height_m[lane] = height_m;
            if (lane + 1 < kRays) continue;
            kernels().values(shape, 1000.0F, points);
            found.insert(found.end(), std::begin(points.value), std::end(points.value));
        }
        return found;
    };
    const std::vector<float> there = values({}, 900.0F);
    const auto change = [&](const glm::dvec2& shift_m) {
        double sum = 0.0;
        const std::vector<float> beside = values(shift_m, 900.0F);
        for (std::size_t i = 0; i < there.size(); ++i)
            sum += static_cast<double>(std::abs(beside[i] - there[i]));
        return sum / static_cast<double>(there.size());
    };
    const double along = change(300.0 * glm::normalize(glm::dvec2{5.0, 1.0}));
    const double across = change(300.0 * glm::normalize(glm::dvec2{-1.0, 5.0}));
    std::printf("threads of an anvil: 300 m along them %.4f, across %.4f\n", along, across);
    EXPECT_GT(across, 3.0 * along);
    for (const float value : values({}, 590.0F))
        EXPECT_EQ(value, 0.0F);
}

TEST(CloudField, LightInLanesIsTheSlabModels) {
    double largest = 0.0;
    for (const Kernels* variant : variants()) {
        for (const float g : {kIceG, kWaterG}) {
            for (const float mu0 : {-0.4F, 0.05F, 0.5F, 1.0F}) {
                const CloudScatter scatter(mu0, {g, 1.0F, CloudPhase::kHenyeyGreenstein});
                const CloudScatter::Ray ray = scatter.ray(0.3F, 0.2F);
                Sources sources{};
                for (int i = 0; i < kRays; ++i) {
                    sources.towards[i] = 0.02F * static_cast<float>(i * i);
                    sources.above[i] = 0.5F * sources.towards[i];
                    sources.below[i] = static_cast<float>(i % 9);
                }
                variant->sources((g < 0.8F ? matrix()->ice : matrix()->water).nodes(), g, mu0, 0.3F, 0.2F,
                                 sources);
                for (int i = 0; i < kRays; ++i) {
                    const float exact = ray.source({sources.towards[i], sources.above[i], sources.below[i]});
                    largest = std::max(largest, static_cast<double>(std::abs(sources.sent[i] - exact)) /
                                                    (1e-4 + static_cast<double>(exact)));
                }
            }
        }
    }
    std::printf("largest relative difference of a point's light %.2e\n", largest);
    EXPECT_LT(largest, 2e-2);
}

TEST(CloudField, CrossingASheetDoesNotPop) {
    const std::vector<CloudRay> rays = sphere_of_rays(20, 24);
    double largest = 0.0;
    std::vector<CloudSample> last;
    for (double eye_m = 960.0; eye_m <= 1340.0; eye_m += 1.0) {
        std::vector<CloudSample> now = seen(scene_of({sheet_of(0.8)}, eye_m), plain_light(), rays);
        if (!last.empty()) largest = std::max(largest, mean_step_255(last, now));
        last = std::move(now);
    }
    std::printf("through a sheet by metres: largest mean step %.2f/255\n", largest);
    EXPECT_LT(largest, 3.0);
}

TEST(CloudField, ASheetIsDrawnAsItIsTold) {
    const std::vector<CloudRay> rays = sphere_of_rays(12, 40, 0.2, 1.4);
    CloudLayer told = sheet_of(0.5);
    told.look = CloudLook{};
    const auto mean = [&](const CloudLayer& layer) {
        glm::dvec4 sum{0.0};
        for (const CloudSample& sample : seen(scene_of({layer}, 2.0), plain_light(), rays)) {
            EXPECT_TRUE(is_sound(sample));
            sum +=
                glm::dvec4(glm::dvec3(sample.light_cd_m2), 1.0 - static_cast<double>(sample.transmittance));
        }
        return sum / static_cast<double>(rays.size());
    };
    const glm::dvec4 plain = mean(told);
    told.look->density_offset = 0.3;
    EXPECT_GT(mean(told).w, plain.w + 0.02);
    told.look->density_offset = 0.0;
    told.look->colour = {1.0, 0.5, 0.25};
    EXPECT_NEAR(mean(told).y, 0.5 * plain.y, 1e-3 * plain.y);
    told.look->colour = glm::dvec3(1.0);
    told.look->self_shadow = 3.0;
    EXPECT_LT(mean(told).y, plain.y);
    // Scrolled by a whole world, all is where it was.
    told.look->self_shadow = 1.0;
    told.look->tiles[1].scroll_m_s = {131.072, 0.0};
    told.age_s = 1000.0;
    EXPECT_NEAR(mean(told).y, plain.y, 1e-3 * plain.y);
    told.age_s = 10.3;
    EXPECT_NE(mean(told), plain);
}

struct View {
    double sun_zenith_deg, view_zenith_deg, azimuth_deg;
    bool above;
};

// pi L / (mu0 F0) of a slab as the field draws it.
double drawn_brf(double depth, const View& view, CloudLight& light, CloudRay& ray) {
    const double sun = 0.5 * kPi - view.sun_zenith_deg * kPi / 180.0;
    const double zenith = view.view_zenith_deg * kPi / 180.0;
    // Light that travels forwards, from the Sun in the south to the north, is seen looking south.
    const double azimuth = kPi - view.azimuth_deg * kPi / 180.0;
    ray = ray_at(view.above ? zenith - 0.5 * kPi : 0.5 * kPi - zenith, azimuth);
    light = beam_light(sun);
    const Scene scene = scene_of({slab_of(1000.0, 400.0, depth)}, view.above ? 1450.0 : 950.0);
    return static_cast<double>(seen(scene, light, {ray})[0].light_cd_m2.y) * kPi / (1000.0 * std::sin(sun));
}

TEST(CloudField, AMarchedSlabSendsTheModelsLight) {
    double worst = 0.0;
    for (const double depth : {1.0, 4.0, 16.0}) {
        for (const View& view : {View{0, 30, 0, true}, View{60, 60, 0, true}, View{60, 30, 180, true},
                                 View{30, 0, 0, false}, View{60, 60, 180, false}, View{30, 60, 90, false}}) {
            CloudLight light;
            CloudRay ray;
            const double drawn = drawn_brf(depth, view, light, ray);
            const glm::vec3& source = light.beams[CloudLight::kSun].direction_enu;
            const float told =
                slab_brf(SlabModel::kMarch, Slab{static_cast<float>(depth), kWaterG, 1.0F}, view.above,
                         source.z, std::abs(ray.direction_enu.z), glm::dot(ray.direction_enu, source));
            std::printf("depth %.0f, sun %.0f, view %.0f/%.0f %s: %.4f, model %.4f\n", depth,
                        view.sun_zenith_deg, view.view_zenith_deg, view.azimuth_deg,
                        view.above ? "top" : "base", drawn, static_cast<double>(told));
            worst = std::max(worst, std::abs(drawn / static_cast<double>(told) - 1.0));
        }
    }
    std::printf("worst %.1f %%\n", 100.0 * worst);
    EXPECT_LT(worst, 0.03);
}

TEST(CloudField, AMarchedSlabSendsTheTrueLight) {
    std::ifstream file(SKYIG_REFERENCE "/weather/cloud_slab_truth.csv");
    if (!file) GTEST_SKIP() << "no weather/cloud_slab_truth.csv beside this clone";
    std::vector<double> errors;
    for (std::string line; std::getline(file, line);) {
        double depth = 0.0;
        double g = 0.0;
        double albedo = 0.0;
        View view{};
        char side = 0;
        double truth = 0.0;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%c_brf,%lf,%lf,%lf", &depth, &g, &albedo,
                        &view.sun_zenith_deg, &side, &view.view_zenith_deg, &view.azimuth_deg, &truth) != 8)
            continue;
        if ((depth != 1.0 && depth != 4.0 && depth != 16.0) || albedo != 1.0 || truth < 1e-4) continue;
        view.above = side == 'R';
        CloudLight light;
        CloudRay ray;
        errors.push_back(std::abs(drawn_brf(depth, view, light, ray) / truth - 1.0));
    }
    ASSERT_GT(errors.size(), 50U);
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2];
    std::printf("%zu rows: median error %.1f %%, 90th percentile %.1f %%, worst %.1f %%\n", errors.size(),
                100.0 * median, 100.0 * errors[errors.size() * 9 / 10], 100.0 * errors.back());
    EXPECT_LT(median, 0.1);
}

TEST(CloudField, TwoMetresChangeLittle) {
    for (const double eye_m : {2.0, 12000.0}) {
        const std::vector<CloudRay> rays =
            eye_m < 1000.0 ? sphere_of_rays(20, 60, 0.02, 0.6) : sphere_of_rays(20, 60, -0.6, -0.065);
        const Scene here = scene_of({layer_of(CloudGenus::kCumulus, 1500.0, 900.0, 0.5)}, eye_m);
        Scene there = here;
        there.eye.height_m += 2.0;
        const double step = mean_step_255(seen(here, plain_light(), rays), seen(there, plain_light(), rays));
        std::printf("from %.0f m: mean step over 2 m %.3f/255\n", eye_m, step);
        EXPECT_LT(step, 1.5);
    }
}

// Part of the rays through cloud, of a patch of neighbours, that are brighter by a quarter than all round
// them.
double lone_dots(const CloudField& field, double azimuth_rad) {
    constexpr int kSide = 96;
    std::vector<CloudRay> rays;
    for (int i = 0; i < kSide * kSide; ++i)
        rays.push_back(ray_at(0.05 + 0.0025 * (i / kSide), azimuth_rad + 0.0025 * (i % kSide)));
    const std::vector<CloudSample> samples = seen(field, rays);
    int cloudy = 0;
    int dots = 0;
    for (int y = 1; y + 1 < kSide; ++y) {
        for (int x = 1; x + 1 < kSide; ++x) {
            const auto at = static_cast<std::size_t>(y * kSide + x);
            // Far clouds are finer than the rays, and rims are bright.
            if (samples[at].transmittance > 0.01F || samples[at].distance_m > 6000.0F) continue;
            float round = 0.0F;
            for (const int step : {-kSide - 1, -kSide, 1 - kSide, -1, 1, kSide - 1, kSide, kSide + 1})
                round =
                    std::max(round, samples[static_cast<std::size_t>(y * kSide + x + step)].light_cd_m2.y);
            ++cloudy;
            dots += samples[at].light_cd_m2.y > 1.25F * round ? 1 : 0;
        }
    }
    EXPECT_GT(cloudy, 200);
    return static_cast<double>(dots) / std::max(cloudy, 1);
}

TEST(CloudField, GrazingLightIsNoMatterOfChance) {
    for (const double sun_deg : {0.7, 1.0, 2.0, 5.0}) {
        double worst = 0.0;
        for (const double azimuth_rad : {0.4, 1.9, 3.4, 5.0}) {
            CloudField field(matrix());
            field.freeze(scene_of({layer_of(CloudGenus::kCumulus, 1370.0, 460.0, 0.5)}, 1000.0),
                         beam_light(sun_deg * kPi / 180.0));
            worst = std::max(worst, lone_dots(field, azimuth_rad));
        }
        std::printf("Sun at %.1f deg: lone bright rays %.3f %%\n", sun_deg, 100.0 * worst);
        EXPECT_LT(worst, 3e-4);
    }
}

// As a map of 1024 x 1024 asks: 24 tiles of 32 x 32 rays, neighbours 2.5 mrad apart.
std::vector<CloudRay> tiles_of_rays(double lowest, double highest) {
    std::vector<CloudRay> rays;
    for (int tile = 0; tile < 24; ++tile) {
        const double elevation = lowest + (highest - lowest - 0.08) * std::pow((tile + 0.5) / 24.0, 1.5);
        for (int i = 0; i < 32 * 32; ++i)
            rays.push_back(ray_at(elevation + 0.0025 * (i / 32), 2.1 * tile + 0.0025 * (i % 32)));
    }
    return rays;
}

// What a black mark at that distance keeps of its contrast, among patches of fog: by the march, and by a sum
// of a metre's steps over the field's own value in double.
TEST(CloudField, ContrastAmongPatchesOfFogIsThatOfThePath) {
    constexpr double kEye_m = 3.0;
    constexpr double kPerM = 2.996 / 100.0 - 2.996 / 1500.0;
    CloudField field(matrix());
    double largest = 0.0;
    int compared = 0;
    int gaps = 0;
    for (int place = 0; place < 24; ++place) {
        CloudLayer fog = layer_of(CloudGenus::kFogPatches, 0.0, 40.0, 0.5);
        fog.top_band_m = 10.0;
        fog.extinction_per_m = kPerM;
        fog.drift_m = kWorld_m * glm::dvec2(std::fmod(0.7548776662466927 * place, 1.0),
                                            std::fmod(0.5698402909980532 * place, 1.0));
        field.freeze(scene_of({fog}, kEye_m), plain_light());
        const Layer& layer = field.field().layers[0];
        const double azimuth = 2.4 * place;
        const std::array<CloudRay, 1> ray{
            {{glm::vec3{glm::dvec3{std::sin(azimuth), std::cos(azimuth), 0.0}}}}};
        double depth = 0.0;
        for (int first = 0; first < 640; first += kRays) {
            Points points{};
            for (int i = 0; i < kRays; ++i) {
                const double along_m = first + i + 0.5;
                points.north_m[i] = static_cast<float>(along_m * std::cos(azimuth));
                points.east_m[i] = static_cast<float>(along_m * std::sin(azimuth)) +
                                   field.field().closing * points.north_m[i];
                points.height_m[i] = static_cast<float>(kEye_m);
            }
            kernels().values(layer.shape, layer.thickness_m, points);
            for (const float value : points.value) {
                const double x =
                    std::clamp(static_cast<double>((value - layer.threshold) / layer.shape.edge), 0.0, 1.0);
                depth += kPerM * x * x * (3.0 - 2.0 * x);
            }
            const double to_m = first + kRays;
            if (depth > 3.0) break;
            std::array<CloudSample, 1> sample;
            field.march(ray, {0.0F, static_cast<float>(to_m)}, 1e-3F, sample);
            const double marched = static_cast<double>(sample[0].transmittance);
            largest = std::max(largest, std::abs(marched / std::exp(-depth) - 1.0));
            ++compared;
            gaps += depth == 0.0 ? 1 : 0;
        }
    }
    std::printf("%d marks among patches, %d of them through a gap alone: contrast within %.2f %%\n", compared,
                gaps, 100.0 * largest);
    RecordProperty("largest_relative_error", std::to_string(largest));
    EXPECT_GT(compared, 60);
    EXPECT_GT(gaps, 5);
    EXPECT_LT(largest, 0.05);
}

TEST(CloudField, TellsWhatARayCosts) {
    struct Case {
        const char* name;
        CloudLayer layer;
        double eye_m, lowest, highest;
    };
    CloudLayer sheet = layer_of(CloudGenus::kCirrus, 8000.0, 500.0, 0.6);
    sheet.model = CloudModel::kLayer;
    const CloudLayer broken = layer_of(CloudGenus::kCumulus, 1200.0, 1000.0, 0.5);
    for (const Case& c :
         {Case{"clear", layer_of(CloudGenus::kCumulus, 1200.0, 1000.0, 0.0), 2.0, 0.0, 1.57},
          Case{"broken Cu from below", broken, 2.0, 0.0, 1.57},
          Case{"overcast St from below", layer_of(CloudGenus::kStratus, 400.0, 400.0, 1.0), 2.0, 0.0, 1.57},
          Case{"broken Cu from 12 km", broken, 12000.0, -1.57, -0.06},
          Case{"inside Cu", broken, 1700.0, -1.0, 1.57}, Case{"layer of Ci", sheet, 2.0, 0.0, 1.57}}) {
        const std::vector<CloudRay> rays = tiles_of_rays(c.lowest, c.highest);
        CloudField field(matrix());
        field.freeze(scene_of({c.layer}, c.eye_m), plain_light());
        double best = 1e9;
        for (int turn = 0; turn < 3; ++turn) {
            const std::clock_t start = std::clock();
            const std::vector<CloudSample> samples = seen(field, rays);
            const double taken_ns = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            EXPECT_TRUE(is_sound(samples[0]));
            best = std::min(best, taken_ns / static_cast<double>(rays.size()));
        }
        std::printf("%-24s %7.1f ns a ray (%s)\n", c.name, best, kernels().name);
    }
}

}  // namespace
}  // namespace skyig::render::cloud::field
