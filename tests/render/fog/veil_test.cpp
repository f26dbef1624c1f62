#include "render/fog/veil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "render/geometry.h"

namespace skyig::render::fog {
namespace {

constexpr double kPi = std::numbers::pi;

double density(const Obscurant& o, double height_m) {
    if (height_m < o.base_m)
        return o.bottom_band_m > 0.0 ? std::max(0.0, 1.0 - (o.base_m - height_m) / o.bottom_band_m) : 0.0;
    if (height_m > o.top_m)
        return o.top_band_m > 0.0 ? std::max(0.0, 1.0 - (height_m - o.top_m) / o.top_band_m) : 0.0;
    return 1.0;
}

// Height along a ray, from the cosine rule in long double.
long double height_m(long double eye_m, long double sine, long double along_m) {
    const long double r = 6371.0e3L + eye_m;
    return std::sqrt(r * r + 2.0L * r * sine * along_m + along_m * along_m) - 6371.0e3L;
}

// Midpoints between all crossings of layers' ends, found in long double.
double summed_depth(std::span<const Obscurant> layers, double eye_m, double sine, double end_m) {
    const long double end = end_m;
    std::vector<long double> bends{0.0L, end};
    const long double fall = -static_cast<long double>(sine) * (6371.0e3L + eye_m);
    for (const Obscurant& o : layers) {
        for (const double over_m : {o.base_m - o.bottom_band_m, o.base_m, o.top_m, o.top_m + o.top_band_m}) {
            const long double rise = static_cast<long double>(over_m) - eye_m;
            const long double square = fall * fall + rise * (2.0L * (6371.0e3L + eye_m) + rise);
            if (square <= 0.0L) continue;
            for (const long double at : {fall - std::sqrt(square), fall + std::sqrt(square)})
                bends.push_back(std::clamp(at, 0.0L, end));
        }
    }
    std::sort(bends.begin(), bends.end());
    constexpr int kSteps = 4000;
    long double sum = 0.0L;
    for (std::size_t k = 0; k + 1 < bends.size(); ++k) {
        const long double step_m = (bends[k + 1] - bends[k]) / kSteps;
        for (int i = 0; i < kSteps && step_m > 0.0L; ++i) {
            const auto h = static_cast<double>(height_m(eye_m, sine, bends[k] + (i + 0.5L) * step_m));
            for (const Obscurant& o : layers)
                sum += static_cast<long double>(o.extinction_per_m * density(o, h)) * step_m;
        }
    }
    return static_cast<double>(sum);
}

Veil veil_of(std::span<const Obscurant> layers, double eye_m) {
    Veil veil;
    veil.lay(layers, eye_m);
    return veil;
}

struct Ray {
    const char* name;
    double eye_m, sine, end_m;
};

TEST(VeilDepth, IsTheSumAlongTheRay) {
    const std::array layers{
        Obscurant{.base_m = -1000.0, .top_m = 60.0, .top_band_m = 20.0, .extinction_per_m = 8e-3},
        Obscurant{.base_m = 300.0,
                  .top_m = 900.0,
                  .bottom_band_m = 100.0,
                  .top_band_m = 400.0,
                  .extinction_per_m = 5e-4},
        Obscurant{.base_m = 3000.0, .top_m = 3030.0, .extinction_per_m = 2e-3}};
    const double graze_60 = -std::sqrt(2.0 * 240.0 / 6371e3);
    const std::array rays{Ray{"level, in the fog", 2.0, 0.0, 3000.0},
                          Ray{"level, at the fog's top", 60.0, 0.0, 20e3},
                          Ray{"level, at a sharp base", 3000.0, 0.0, 30e3},
                          Ray{"level, at a sharp top", 3030.0, 0.0, 30e3},
                          Ray{"straight up", 2.0, 1.0, 10e3},
                          Ray{"straight down", 5000.0, -1.0, 5000.0},
                          Ray{"to the horizon's sky", 2.0, 1e-4, 400e3},
                          Ray{"grazing the fog from above", 300.0, 0.9999 * graze_60, 150e3},
                          Ray{"grazing it deeper", 300.0, 1.03 * graze_60, 150e3},
                          Ray{"through the thin layer twice", 10e3, -0.0469, 700e3},
                          Ray{"from far above", 400e3, -0.9, 447.7e3},
                          Ray{"below the ground's level", -400.0, 0.02, 60e3}};
    double largest = 0.0;
    double largest32 = 0.0;
    for (const Ray& ray : rays) {
        const Veil veil = veil_of(layers, ray.eye_m);
        const double wanted = summed_depth(layers, ray.eye_m, ray.sine, ray.end_m);
        const double got = veil.optical_depth(ray.sine, ray.end_m);
        const auto got32 = static_cast<double>(
            veil.optical_depth(static_cast<float>(ray.sine), static_cast<float>(ray.end_m)));
        const double whole = std::max(wanted, 1e-300);
        std::printf("%-30s %10.6f  double %9.1e  float %9.1e\n", ray.name, wanted, (got - wanted) / whole,
                    (got32 - got) / whole);
        if (wanted == 0.0) {
            EXPECT_EQ(got, 0.0) << ray.name;
            EXPECT_EQ(got32, 0.0) << ray.name;
            continue;
        }
        largest = std::max(largest, std::abs(got / wanted - 1.0));
        largest32 = std::max(largest32, std::abs(got32 / got - 1.0));
    }
    RecordProperty("largest_relative_error", std::to_string(largest));
    EXPECT_LT(largest, 1e-6);
    EXPECT_LT(largest32, 2e-4);
}

TEST(VeilDepth, HasTheLengthsOfTheHardCases) {
    // Path lengths in a 30 m layer of the reference's table, by an extinction of 1.
    const auto length = [](double base_m, double eye_m, double sine, double end_m) {
        const std::array layer{Obscurant{.base_m = base_m, .top_m = base_m + 30.0, .extinction_per_m = 1.0}};
        return veil_of(layer, eye_m).optical_depth(sine, end_m);
    };
    EXPECT_NEAR(length(1500.0, 1515.0, 0.0, 1e6), 13826.629, 0.002);
    EXPECT_NEAR(length(4000.0, 0.0, 0.004310155392, 1e6), 839.261, 0.01);
    EXPECT_NEAR(length(3000.0, 2999.0, -0.015683737949, 1e6), 1893.671, 0.01);
    // Tangent to its base from a great height.
    EXPECT_NEAR(length(3000.0, 30e3, -std::sqrt(1.0 - std::pow(6374e3 / 6401e3, 2.0)), 1e7), 39.1e3, 60.0);
    const auto single = [](double base_m, double eye_m, double sine) {
        const std::array layer{Obscurant{.base_m = base_m, .top_m = base_m + 30.0, .extinction_per_m = 1.0}};
        return static_cast<double>(veil_of(layer, eye_m).optical_depth(static_cast<float>(sine), 1e6F));
    };
    EXPECT_NEAR(single(1500.0, 1515.0, 0.0), 13826.63, 0.02);
    EXPECT_NEAR(single(4000.0, 0.0, 0.004310155392), 839.27, 0.1);
}

VeilSources midday() {
    VeilSources sources;
    sources.beams[0] = {direction_of({0.8, 0.0}), glm::dvec3{9e4, 8.5e4, 8e4}};
    sources.above_cd_m2 = glm::dvec3{3000.0, 4000.0, 6000.0};
    sources.ground_albedo = 0.1;
    return sources;
}

TEST(Veil, HardInputGivesFiniteLight) {
    for (const double extinction : {0.0, 1e-12, 1e-3, 1.0, 1e4}) {
        for (const double thickness_m : {0.0, 1e-6, 1.0, 300.0, 9000.0}) {
            for (const auto kind : {Obscurant::Kind::kFog, Obscurant::Kind::kSmoke, Obscurant::Kind::kSand}) {
                const std::array layer{Obscurant{.kind = kind,
                                                 .base_m = 100.0,
                                                 .top_m = 100.0 + thickness_m,
                                                 .bottom_band_m = thickness_m,
                                                 .extinction_per_m = extinction}};
                for (const double eye_m : {-400.0, 0.0, 100.0, 100.0 + thickness_m, 20e3, 4e5}) {
                    Veil veil = veil_of(layer, eye_m);
                    for (const double sun_rad : {-0.3, 0.0, 1e-9, 0.5, 0.5 * kPi}) {
                        VeilSources sources = midday();
                        sources.beams[0].direction_enu = direction_of({sun_rad, 0.0});
                        veil.light(sources);
                        for (const double view_rad : {-0.5 * kPi, -0.1, 0.0, sun_rad, 0.5 * kPi}) {
                            const auto seen = veil.seen(direction_of({view_rad, 0.0}), Veil::kEndless_m);
                            ASSERT_TRUE(std::isfinite(glm::dot(seen.added_cd_m2, glm::dvec3{1.0})) &&
                                        std::isfinite(seen.distance_m));
                            ASSERT_GE(std::min(seen.passed, seen.added_cd_m2.x), 0.0);
                            ASSERT_LE(seen.passed, seen.smooth_passed);
                            ASSERT_LE(seen.added_cd_m2.x, 1e8);
                        }
                    }
                }
            }
        }
    }
}

// Layers of one sort, cut somewhere, are one layer; light is continuous through top and base.
TEST(Veil, CutLayersAreOneAndTheEyeCrossesTheirEndsSmoothly) {
    const std::array one{Obscurant{.base_m = 0.0, .top_m = 200.0, .extinction_per_m = 0.02}};
    const std::array three{Obscurant{.base_m = 0.0, .top_m = 50.0, .extinction_per_m = 0.02},
                           Obscurant{.base_m = 50.0, .top_m = 51.0, .extinction_per_m = 0.02},
                           Obscurant{.base_m = 51.0, .top_m = 200.0, .extinction_per_m = 0.02}};
    const auto seen_from = [](std::span<const Obscurant> layers, double eye_m, double view_rad) {
        Veil veil = veil_of(layers, eye_m);
        veil.light(midday());
        return veil.seen(direction_of({view_rad, 1.0}), view_rad < 0.0 ? eye_m / -std::sin(view_rad) : 1e7);
    };
    double apart = 0.0;
    double step = 0.0;
    for (const double view_rad : {-1.2, -0.3, 0.05, 0.4, 1.5}) {
        for (const double eye_m : {2.0, 50.0, 120.0, 300.0}) {
            const double a = seen_from(one, eye_m, view_rad).added_cd_m2.y;
            apart = std::max(
                apart, std::abs(seen_from(three, eye_m, view_rad).added_cd_m2.y - a) / std::max(a, 100.0));
        }
        const double under = seen_from(one, 199.999, view_rad).added_cd_m2.y;
        const double over = seen_from(one, 200.001, view_rad).added_cd_m2.y;
        step = std::max(step, std::abs(over - under) / std::max(under, 1000.0));
    }
    std::printf("three layers for one: %.4f; 2 mm through the top: %.4f\n", apart, step);
    EXPECT_LT(apart, 0.04);
    EXPECT_LT(step, 0.005);
}

// Without absorption what comes in goes out or into the ground.
TEST(Veil, KeepsTheLightOfFogAndLosesThatOfSmoke) {
    VeilSources sources = midday();
    sources.ground_albedo = 0.0;
    for (const double depth : {0.5, 4.0, 32.0}) {
        const std::array fog{Obscurant{.base_m = 0.0, .top_m = 10.0, .extinction_per_m = 0.1 * depth}};
        Veil veil = veil_of(fog, 0.0);
        veil.light(sources);
        const double transmitted = veil.ground_share().y;
        // Up through the top: I0 - 2/3 I1 of the topmost segment, out of its source terms.
        const Veil::Segment& top = veil.segments().back();
        const double g = top.g / (1.0 + top.g);
        const double albedo = 1.0 - (1.0 - top.albedo.y) / top.kept;
        const double up = top.high_even.y / albedo - 2.0 / 3.0 * top.high_slope.y / (albedo * g);
        const double in = sources.above_cd_m2.y + sources.beams[0].lux.y * std::sin(0.8) / kPi;
        std::printf("depth %4.1f: through %.4f, back %.4f\n", depth, transmitted, up / in);
        EXPECT_NEAR(transmitted + up / in, 1.0, 0.004);
    }
    const std::array smoke{
        Obscurant{.kind = Obscurant::Kind::kSmoke, .base_m = 0.0, .top_m = 100.0, .extinction_per_m = 0.05}};
    Veil veil = veil_of(smoke, 0.0);
    veil.light(sources);
    EXPECT_LT(veil.ground_share().y, 0.2);
    // Nothing lets light vanish altogether, nor is there a limit to thickness.
    const std::array thick{Obscurant{.base_m = 0.0, .top_m = 1e3, .extinction_per_m = 10.0}};
    Veil dark = veil_of(thick, 0.0);
    dark.light(sources);
    EXPECT_GT(dark.ground_share().y, 5e-4);
    EXPECT_LT(dark.ground_share().y, 2e-3);
}

// Rows of the slab truth: two transport programs that agree (the reference's README).
TEST(Veil, HasTheLightOfTheTrueSlab) {
    const std::filesystem::path path = SKYIG_REFERENCE "/weather/cloud_slab_truth.csv";
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << "no " << path;
    std::map<std::string, std::vector<double>> errors;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<std::string> cells;
        std::stringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');)
            cells.push_back(cell);
        const bool above = cells[4] == "R_brf";
        if ((!above && cells[4] != "T_brf") || cells[2] != "1" || cells[3] == "diffuse") continue;
        const double depth = std::stod(cells[0]);
        const double truth = std::stod(cells[7]);
        if (truth < 1e-4) continue;
        const double sun = std::stod(cells[3]) * kPi / 180.0;
        const double view = std::stod(cells[5]) * kPi / 180.0;
        const double azimuth = std::stod(cells[6]) * kPi / 180.0;
        const std::array fog{Obscurant{.base_m = 0.0, .top_m = 1.0, .extinction_per_m = depth}};
        Veil veil = veil_of(fog, above ? 1.0 : 0.0);
        VeilSources sources;
        sources.ground_albedo = 0.0;
        sources.beams[0] = {direction_of({0.5 * kPi - sun, 0.0}), glm::dvec3{1.0}};
        veil.light(sources);
        // The view ray runs against the light: towards the Sun's side where that goes forwards.
        const double elevation = above ? view - 0.5 * kPi : 0.5 * kPi - view;
        const auto seen = veil.seen(direction_of({elevation, azimuth}), above ? 1.0 / std::cos(view) : 1e7);
        const double brf = kPi * seen.added_cd_m2.y / std::cos(sun);
        const std::string bin = std::string(above ? "above" : "below") + (depth <= 2.0   ? " 0.5-2"
                                                                          : depth <= 8.0 ? " 4-8"
                                                                                         : " 16-64");
        errors[bin].push_back(std::abs(brf / truth - 1.0));
    }
    ASSERT_EQ(errors.size(), 6U);
    for (auto& [bin, of] : errors) {
        std::sort(of.begin(), of.end());
        std::printf("seen from %-12s %3zu rows: median %.3f, p90 %.3f\n", bin.c_str(), of.size(),
                    of[of.size() / 2], of[of.size() * 9 / 10]);
        EXPECT_LT(of[of.size() / 2], 0.25) << bin;
    }
}

TEST(VeilMark, TellsWhatIsSeenAndNoMore) {
    std::array fog{Obscurant{.base_m = 0.0, .top_m = 100.0, .extinction_per_m = 0.01}};
    const auto mark = [&fog] {
        Veil veil = veil_of(fog, 2.0);
        veil.light(midday());
        return VeilMark(veil);
    };
    const VeilMark first = mark();
    EXPECT_FALSE(first.differs(mark(), 1e-9));
    fog[0].extinction_per_m = 0.0101;
    EXPECT_TRUE(first.differs(mark(), 1e-3));
    EXPECT_FALSE(first.differs(mark(), 0.05));
    EXPECT_TRUE(first.differs(VeilMark{}, 0.5));
}

}  // namespace
}  // namespace skyig::render::fog
