#include "clients/bench/cloud_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "clients/bench/cloud_pictures.h"
#include "clients/bench/truth_table.h"
#include "render/cloud/slab_light.h"

namespace skyig::clients::bench {

namespace {

namespace cloud = render::cloud;
using cloud::SlabModel;

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr std::array<std::string_view, cloud::kSlabModels> kWhat{
    "seed 001: opacity and self-shadow exponential in density, whatever the direction",
    "the same with the cheap power in place of the exponential",
    "seed 004: lit where one sample towards the Sun is outside of the cloud",
    "seed 003: light handed from particle to particle (Harris and Lastra 2001)",
    "light scattered once",
    "Wrenninge 2013, 8 octaves",
    "Eddington's fluxes, spread evenly",
    "light scattered once past the cut forward peak, and what is left of Eddington's fluxes",
    "two orders of scattering and the rest from an adding-doubling table; the default",
    "what volumes draw: the tables' source function marched in 32 steps"};

struct Band {
    std::string_view name;
    double least;
    double most;
};
constexpr std::array<Band, 4> kBands{{{"depth 0.5..2", 0.0, 3.0},
                                      {"depth 4..8", 3.0, 10.0},
                                      {"depth 16..64", 10.0, 1e3},
                                      {"all depths", 0.0, 1e3}}};

struct Row {
    cloud::Slab64 slab;
    bool above;
    double mu0;
    double mu;
    double scatter;
    double value;
};

std::vector<Row> rows_of(const TruthTable& table) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::string& quantity = table.text(i, "quantity");
        if (quantity != "R_brf" && quantity != "T_brf") continue;
        const double value = table.number(i, "value");
        // Less is not seen, and the table's own noise.
        if (value <= 1e-4) continue;
        const double sun = table.number(i, "sun_zenith_deg") * kDegree;
        const double view = table.number(i, "view_zenith_deg") * kDegree;
        const bool above = quantity == "R_brf";
        rows.push_back(
            {{table.number(i, "optical_depth"), table.number(i, "asymmetry_g"),
              table.number(i, "single_scattering_albedo")},
             above,
             std::cos(sun),
             std::cos(view),
             std::sin(sun) * std::sin(view) * std::cos(table.number(i, "rel_azimuth_deg") * kDegree) +
                 (above ? -1.0 : 1.0) * std::cos(sun) * std::cos(view),
             value});
    }
    return rows;
}

void add_band(ModelEntry& entry, SlabModel model, const std::vector<Row>& rows, const Band& band,
              double albedo) {
    ErrorSamples all;
    std::vector<double> sizes;
    for (const Row& row : rows) {
        if (row.slab.albedo != albedo || row.slab.optical_depth < band.least ||
            row.slab.optical_depth >= band.most)
            continue;
        const double off =
            100.0 *
            (cloud::slab_brf(model, row.slab, row.above, row.mu0, row.mu, row.scatter) / row.value - 1.0);
        all.add(off);
        sizes.push_back(std::abs(off));
    }
    if (sizes.empty()) return;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    ErrorSamples median;
    median.add(*middle);
    const std::string cases = fmt::format("{}, albedo {}", band.name, albedo);
    entry.errors.push_back({"median", cases, "%", median.figures()});
    entry.errors.push_back({"radiance", cases, "%", all.figures()});
}

// Slabs and directions that fill the tables, as many as fit the first cache.
cloud::Slab slab_of(std::uint64_t i) {
    return {0.5F * static_cast<float>(1U << (i % 8U)), 0.85F, 1.0F};
}

double one_brf(SlabModel model, std::uint64_t i) {
    const float mu0 = 0.15F + 0.05F * static_cast<float>(i % 17U);
    const float mu = 0.1F + 0.06F * static_cast<float>(i % 13U);
    const float scatter = -0.9F + 0.15F * static_cast<float>(i % 11U);
    return static_cast<double>(cloud::slab_brf(model, slab_of(i), i % 2U == 0, mu0, mu, scatter));
}

}  // namespace

Report measure_cloud_errors(const std::filesystem::path& truth) {
    Report report;
    report.family = "cloud";
    report.title = "Light in cloud";
    report.cases =
        "pi L / (mu0 F0) of what leaves the top and the base of a plane slab, optical depths 0.5..64, g "
        "0.85, "
        "albedos 1 and 0.999, Sun 0..80 deg from the zenith, ten directions each; values above 1e-4. "
        "`skyig cloud` gives the same numbers for any table of cases";
    report.truth =
        "radiative transfer by this project's Monte Carlo program (`tests/data/weather`), whose own error is "
        "0.3 % in the median and 3 % at most. `median` is that of the sizes of the same errors: one figure";
    report.costs =
        "`direction` is one look-up for a slab and a direction in single precision; `step` what a marcher "
        "asks "
        "at a point; `ray` one ray of the cloud map (2e-3 rad, 3 deg up and more) through half a sky of "
        "cumulus, from a source that is frozen already.";
    report.floor = "one phase function of Henyey and Greenstein";
    report.headline = {"median", "depth 16..64, albedo 1", "direction"};
    const std::vector<Row> rows = rows_of(TruthTable(truth / "weather" / "cloud_slab_truth.csv"));
    for (std::size_t i = 0; i < cloud::kSlabModels; ++i) {
        ModelEntry entry{std::string(cloud::kSlabModelNames[i]), std::string(kWhat[i]), {}, {}};
        for (const double albedo : {1.0, 0.999}) {
            for (const Band& band : kBands)
                add_band(entry, static_cast<SlabModel>(i), rows, band, albedo);
        }
        report.models.push_back(std::move(entry));
    }
    for (ModelEntry& entry : cloud_pictures())
        report.models.push_back(std::move(entry));
    return report;
}

std::vector<Contender> cloud_contenders() {
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < cloud::kSlabModels; ++i) {
        const auto model = static_cast<SlabModel>(i);
        contenders.push_back({std::string(cloud::kSlabModelNames[i]), "direction",
                              repeat([model](std::uint64_t call) { return one_brf(model, call); })});
    }
    contenders.push_back(
        {"march", "step", [](std::uint64_t first, std::uint64_t count) {
             const cloud::CloudScatter scatter(0.6F);
             const cloud::CloudScatter::Ray ray = scatter.ray(0.3F, -0.4F);
             double sum = 0.0;
             for (std::uint64_t i = first; i < first + count; ++i) {
                 const auto above = 0.25F * static_cast<float>(i % 64U);
                 sum += static_cast<double>(ray.source({above / 0.6F, above, 17.0F - above}));
             }
             return sum;
         }});
    for (Contender& contender : cloud_picture_contenders())
        contenders.push_back(std::move(contender));
    return contenders;
}

Work cloud_floor() {
    return repeat([](std::uint64_t i) {
        return static_cast<double>(cloud::cloud_phase(cloud::CloudPhase::kHenyeyGreenstein, 0.85F,
                                                      -0.9F + 0.15F * static_cast<float>(i % 11U)));
    });
}

}  // namespace skyig::clients::bench
