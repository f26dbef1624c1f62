// Slab models against this project's radiative-transfer truth (tests/data/weather), and where numbers end.
#include "render/cloud/slab_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "clients/csv.h"

namespace skyig::render::cloud {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Row {
    Slab64 slab;
    double sun_deg;  // < 0: even light
    std::string quantity;
    double view_deg;
    double azimuth_deg;
    double value;
    std::string method;
};

std::vector<Row> truth() {
    std::ifstream file(SKYIG_TEST_DATA "/weather/cloud_slab_truth.csv");
    clients::CsvReader reader(file);
    static_cast<void>(reader.next());
    std::vector<Row> rows;
    while (const auto record = reader.next()) {
        const auto number = [&](std::size_t i) {
            return clients::parse_number(record->fields[i]).value_or(-1.0);
        };
        rows.push_back({{number(0), number(1), number(2)},
                        number(3),
                        record->fields[4],
                        number(5),
                        number(6),
                        number(7),
                        record->fields[9]});
    }
    return rows;
}

double brf(SlabModel model, const Row& row) {
    const bool above = row.quantity == "R_brf";
    const double sun = row.sun_deg * kDegree;
    const double view = row.view_deg * kDegree;
    const double scatter = std::sin(sun) * std::sin(view) * std::cos(row.azimuth_deg * kDegree) +
                           (above ? -1.0 : 1.0) * std::cos(sun) * std::cos(view);
    return slab_brf(model, row.slab, above, std::cos(sun), std::cos(view), scatter);
}

// Median relative error of the BRF rows above 1e-4.
template <class Wanted>
double median_error(SlabModel model, const Wanted& wanted) {
    std::vector<double> errors;
    for (const Row& row : truth()) {
        if (row.quantity.find("brf") == std::string::npos || row.value <= 1e-4 || !wanted(row)) continue;
        errors.push_back(std::abs(brf(model, row) / row.value - 1.0));
    }
    EXPECT_GT(errors.size(), 30U);
    if (errors.empty()) return 1.0;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                     errors.end());
    return errors[errors.size() / 2];
}

bool thick(const Row& row) {
    return row.slab.optical_depth >= 16.0;
}
bool lossless(const Row& row) {
    return row.slab.albedo == 1.0;
}

TEST(SlabLight, TheDefaultModelIsNearTheTruth) {
    const double thick_lossless =
        median_error(SlabModel::kTable, [](const Row& row) { return thick(row) && lossless(row); });
    const double thick_lossy =
        median_error(SlabModel::kTable, [](const Row& row) { return thick(row) && !lossless(row); });
    const double all = median_error(SlabModel::kTable, [](const Row&) { return true; });
    std::printf("median relative error: thick %.4f, thick and absorbing %.4f, all %.4f\n", thick_lossless,
                thick_lossy, all);
    EXPECT_LT(thick_lossless, 0.012);
    EXPECT_LT(thick_lossy, 0.015);
    EXPECT_LT(all, 0.015);
}

TEST(SlabLight, AMarchedSlabIsNearTheTruth) {
    for (const double depth : {1.0, 4.0, 16.0}) {
        const double error = median_error(SlabModel::kMarch, [&](const Row& row) {
            return row.slab.optical_depth == depth && lossless(row);
        });
        std::printf("depth %g marched: median relative error %.4f\n", depth, error);
        EXPECT_LT(error, 0.06) << depth;
    }
}

TEST(SlabLight, EachSimplerModelIsAsFarOffAsItsReferenceSays) {
    const auto all = [](const Row&) { return true; };
    const double tms = median_error(SlabModel::kTms, all);
    const double single = median_error(SlabModel::kSingle, all);
    const double particles = median_error(SlabModel::kParticles, all);
    EXPECT_LT(tms, 0.2);
    EXPECT_GT(tms, 0.05);
    EXPECT_GT(single, 0.9);
    EXPECT_GT(particles, 0.8);
}

TEST(SlabLight, FluxesAreTheTruthsAndKeepEnergy) {
    double worst = 0.0;
    for (const Row& row : truth()) {
        if (row.method != "AD" || row.value < 1e-3) continue;
        const SlabFluxes<double> fluxes = row.sun_deg < 0.0
                                              ? slab_fluxes_diffuse(row.slab)
                                              : slab_fluxes(row.slab, std::cos(row.sun_deg * kDegree));
        const double value = row.quantity == "R_flux"          ? fluxes.reflected
                             : row.quantity == "T_direct_flux" ? fluxes.direct
                                                               : fluxes.transmitted - fluxes.direct;
        worst = std::max(worst, std::abs(value / row.value - 1.0));
        if (lossless(row)) {
            EXPECT_NEAR(fluxes.transmitted + fluxes.reflected, 1.0, 1e-9);
        }
    }
    std::printf("worst relative error of a flux: %.4f\n", worst);
    EXPECT_LT(worst, 0.06);
}

// Eddington's T = (2 + 3 mu0) / (4 + 3 (1 - g) tau) for thick cloud: what the reference states.
TEST(SlabLight, UnderThickCloudItIsAsDarkAsStated) {
    const Slab64 slab{30.0, 0.85, 1.0};
    EXPECT_NEAR(slab_fluxes(slab, 1.0).transmitted, 0.29, 0.015);
    EXPECT_NEAR(slab_fluxes(slab, 0.5).transmitted, 0.20, 0.015);
    EXPECT_NEAR(slab_fluxes(Slab64{1e4, 0.85, 1.0}, 1.0).transmitted, 1.1e-3, 1e-4);
}

template <class Real>
void expect_finite() {
    for (std::size_t m = 0; m < kSlabModels; ++m) {
        for (const Real depth : {Real(0), Real(1e-30), Real(1e-8), Real(1e-3), Real(3), Real(1e4)}) {
            for (const Real mu0 : {Real(0), Real(1e-6), Real(0.3), Real(1)}) {
                for (const Real mu : {Real(0), Real(1e-6), Real(0.3), Real(1)}) {
                    for (const Real scatter : {Real(-1), Real(0), Real(1)}) {
                        for (const Real albedo : {Real(1), Real(0.999), Real(0.9)}) {
                            for (const bool above : {true, false}) {
                                const Real value = slab_brf(static_cast<SlabModel>(m),
                                                            BasicSlab<Real>{depth, Real(0.85), albedo}, above,
                                                            mu0, mu, scatter);
                                ASSERT_TRUE(std::isfinite(value) && value >= Real(0))
                                    << kSlabModelNames[m] << " depth " << depth << " mu0 " << mu0 << " mu "
                                    << mu << " scatter " << scatter << " gives " << value;
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(SlabLight, EveryModelIsFiniteAtEveryEnd) {
    expect_finite<double>();
    expect_finite<float>();
}

TEST(SlabLight, SingleAndDoublePrecisionAgree) {
    double worst = 0.0;
    for (const float depth : {1e-3F, 0.1F, 1.0F, 30.0F, 1e3F}) {
        for (const float mu0 : {0.05F, 0.5F, 0.50001F, 1.0F}) {
            for (const bool above : {true, false}) {
                const auto single = static_cast<double>(
                    slab_brf(SlabModel::kTable, Slab{depth, 0.85F, 1.0F}, above, mu0, 0.5F, 0.3F));
                const double exact = slab_brf(SlabModel::kTable, Slab64{depth, 0.85F, 1.0}, above,
                                              static_cast<double>(mu0), 0.5, static_cast<double>(0.3F));
                if (exact > 1e-6) worst = std::max(worst, std::abs(single / exact - 1.0));
            }
        }
    }
    std::printf("worst relative difference of float: %.2g\n", worst);
    EXPECT_LT(worst, 5e-4);
}

TEST(SlabLight, NoCloudSendsNothingAndLetsAllThrough) {
    EXPECT_EQ(slab_brf(SlabModel::kTable, Slab{}, true, 0.5F, 0.5F, 0.0F), 0.0F);
    EXPECT_EQ(slab_fluxes(Slab{}, 0.5F).transmitted, 1.0F);
    EXPECT_EQ(slab_fluxes(Slab{}, 0.5F).reflected, 0.0F);
}

TEST(CloudPhase, EveryShapeHasAMeanOfOne) {
    for (const CloudPhase phase :
         {CloudPhase::kHenyeyGreenstein, CloudPhase::kTwoLobes, CloudPhase::kDroplets}) {
        double sum = 0.0;
        double mean_cosine = 0.0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double angle = std::numbers::pi * (i + 0.5) / kSteps;
            const double weight = 0.5 * std::sin(angle) * std::numbers::pi / kSteps;
            const double value = cloud_phase(phase, 0.85, std::cos(angle));
            sum += weight * value;
            mean_cosine += weight * value * std::cos(angle);
        }
        EXPECT_NEAR(sum, 1.0, 2e-4);
        EXPECT_NEAR(mean_cosine, phase == CloudPhase::kDroplets ? 0.869 : 0.85, 2e-3);
    }
}

}  // namespace
}  // namespace skyig::render::cloud
