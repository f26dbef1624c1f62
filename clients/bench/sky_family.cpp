#include "clients/bench/sky_family.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "clients/bench/directions.h"
#include "clients/bench/sky_models.h"
#include "clients/bench/truth_table.h"

namespace skyig::clients::bench {

namespace {

namespace sky = render::sky;

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
constexpr const char* kLuminance = "luminance";
constexpr const char* kChromaticity = "chromaticity";
/// Rows that are not known better say little of a model.
constexpr double kLargestTruthError = 0.02;

/// What a row of a truth table asks, and its answer.
struct Case {
    double eye_height_m = 0.0;
    double sun_zenith_deg = 0.0;
    double view_zenith_deg = 0.0;
    double relative_azimuth_deg = 0.0;
    double luminance_cd_m2 = 0.0;
    glm::dvec2 xy{0.0};
};

/// Rows of one air in the order of the table, which keeps rows of one Sun together.
struct CaseSet {
    std::string name;
    sky::AirModel air;
    std::vector<Case> cases;
};

/// Where models fail differently; the gaps have no rows.
struct SunRange {
    const char* name;
    double first_deg;
    double last_deg;
};
constexpr std::array<SunRange, 3> kRanges{
    {{"sun 0..80", 0.0, 80.0}, {"sun 85..88", 84.0, 88.5}, {"sun 90..92", 89.0, 92.5}}};

struct TableOfTruth {
    const char* file;
    const char* name;
    sky::AirModel (*air)();
};
constexpr std::array<TableOfTruth, 4> kTables{{{"ground_A.csv", "ground, A", sky::atmosphere_a},
                                               {"ground_B.csv", "ground, B", sky::atmosphere_b},
                                               {"air_B_10000m.csv", "10 km, B", sky::atmosphere_b},
                                               {"air_B_400000m.csv", "400 km, B", sky::atmosphere_b}}};

/// Nothing in `cases` where the truth is dark or too noisy.
void add_row(const TruthTable& table, std::size_t row, std::vector<Case>& cases) {
    Case asked;
    asked.luminance_cd_m2 = table.number(row, "Y_cd_m2");
    if (!(asked.luminance_cd_m2 > 0.0) || table.number(row, "rel_se_Y") > kLargestTruthError) return;
    asked.eye_height_m = table.number(row, "altitude_m");
    asked.sun_zenith_deg = table.number(row, "sun_zenith_deg");
    asked.view_zenith_deg = table.number(row, "view_zenith_deg");
    asked.relative_azimuth_deg = table.number(row, "rel_azimuth_deg");
    asked.xy = {table.number(row, "x"), table.number(row, "y")};
    cases.push_back(asked);
}

std::vector<CaseSet> read_tables(const std::filesystem::path& folder) {
    std::vector<CaseSet> sets;
    for (const TableOfTruth& known : kTables) {
        const TruthTable table(folder / known.file);
        sets.push_back({known.name, known.air(), {}});
        for (std::size_t row = 0; row < table.rows(); ++row)
            add_row(table, row, sets.back().cases);
    }
    return sets;
}

/// A set for each visibility.
std::vector<CaseSet> read_scenes(const std::filesystem::path& path) {
    const TruthTable table(path);
    std::vector<CaseSet> sets;
    double before_m = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        render::Air air;
        air.visibility_m = table.number(row, "visibility_m");
        if (sets.empty() || air.visibility_m != before_m) {
            sky::AirModel model = sky::air_model(air);
            model.refractivity = 0.0;  // as the reference solver has it
            sets.push_back({fmt::format("visibility {:g} km", 1e-3 * air.visibility_m), model, {}});
        }
        before_m = air.visibility_m;
        add_row(table, row, sets.back().cases);
    }
    return sets;
}

struct SkySamples {
    ErrorSamples luminance_percent;
    ErrorSamples chromaticity;

    void add(const Case& asked, const glm::dvec3& xyz) {
        luminance_percent.add(100.0 * (xyz.y / asked.luminance_cd_m2 - 1.0));
        const double sum = xyz.x + xyz.y + xyz.z;
        if (sum > 0.0) chromaticity.add(glm::distance(glm::dvec2(xyz.x, xyz.y) / sum, asked.xy));
    }
    void tell(const std::string& cases, std::vector<ErrorEntry>& entries) const {
        if (luminance_percent.figures().count == 0) return;
        entries.push_back({kLuminance, cases, "%", luminance_percent.figures()});
        entries.push_back({kChromaticity, cases, "xy", chromaticity.figures()});
    }
};

/// Tables of one air, of either kind when first asked for.
class SharedAir {
  public:
    explicit SharedAir(const sky::AirModel& air) : model_(air) {}

    [[nodiscard]] const sky::AirTables& tables(sky::Orders orders) {
        std::optional<sky::AirTables>& kept = orders == sky::Orders::kAll ? all_ : first_;
        if (!kept) kept.emplace(model_, orders);
        return *kept;
    }

  private:
    sky::AirModel model_;
    std::optional<sky::AirTables> all_;
    std::optional<sky::AirTables> first_;
};

/// Asks the model for every case; `take` gets each with the answer.
template <class Take>
void ask(MeasuredSky& model, SharedAir& air, const std::vector<Case>& cases, Take&& take) {
    model.enter(air.tables(model.orders()));
    std::pair<double, double> placed{-1.0, -1.0};
    for (const Case& asked : cases) {
        const std::pair<double, double> wanted{asked.eye_height_m, asked.sun_zenith_deg};
        if (wanted != placed) {
            // The tables' observer on the ground stands a centimetre above it.
            model.place(asked.eye_height_m + 0.01, (90.0 - asked.sun_zenith_deg) * kRadPerDegree);
            placed = wanted;
        }
        take(asked, glm::dvec3(model.xyz(static_cast<float>((90.0 - asked.view_zenith_deg) * kRadPerDegree),
                                         static_cast<float>(asked.relative_azimuth_deg * kRadPerDegree))));
    }
}

std::string all_tables(const SunRange& range) {
    return fmt::format("all tables, {}", range.name);
}

/// What is known of one model's errors so far.
struct Scores {
    std::array<SkySamples, kRanges.size()> all;
    std::vector<ErrorEntry> tables;
    std::vector<ErrorEntry> scenes;

    [[nodiscard]] std::vector<ErrorEntry> entries() const {
        std::vector<ErrorEntry> entries;
        for (std::size_t i = 0; i < kRanges.size(); ++i)
            all[i].tell(all_tables(kRanges[i]), entries);
        entries.insert(entries.end(), tables.begin(), tables.end());
        entries.insert(entries.end(), scenes.begin(), scenes.end());
        return entries;
    }
};

void score_table(const CaseSet& set, SharedAir& air, MeasuredSky& model, Scores& scores) {
    std::array<SkySamples, kRanges.size()> samples;
    ask(model, air, set.cases, [&](const Case& asked, const glm::dvec3& xyz) {
        for (std::size_t i = 0; i < kRanges.size(); ++i) {
            if (asked.sun_zenith_deg < kRanges[i].first_deg || asked.sun_zenith_deg > kRanges[i].last_deg)
                continue;
            samples[i].add(asked, xyz);
            scores.all[i].add(asked, xyz);
        }
    });
    for (std::size_t i = 0; i < kRanges.size(); ++i)
        samples[i].tell(fmt::format("{}, {}", set.name, kRanges[i].name), scores.tables);
}

void score_scene(const CaseSet& set, SharedAir& air, MeasuredSky& model, Scores& scores) {
    SkySamples samples;
    ask(model, air, set.cases, [&](const Case& asked, const glm::dvec3& xyz) { samples.add(asked, xyz); });
    samples.tell(set.name, scores.scenes);
}

/// In the order of the contestants.
std::vector<Scores> scores_of_all(const std::filesystem::path& truth) {
    std::vector<Scores> scores(sky_contestants().size());
    const auto for_each_model = [&](const std::vector<CaseSet>& sets, auto&& score) {
        for (const CaseSet& set : sets) {
            SharedAir air(set.air);
            for (std::size_t i = 0; i < scores.size(); ++i) {
                MeasuredSky model(sky_contestants()[i].model);
                score(set, air, model, scores[i]);
            }
        }
    };
    for_each_model(read_tables(truth / "sky"), score_table);
    for_each_model(read_scenes(truth / "sky_scene" / "scene.csv"), score_scene);
    return scores;
}

/// Bytes that the program has on the heap; 0 where the allocator does not tell.
std::size_t heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// What a picture holds: the tables of the air, and beside `multi` those of directions, which all models
/// share.
std::vector<SizeEntry> sizes_of(const SkyContestant& contestant) {
    if (!contestant.builds_air) return {};
    const std::size_t before = heap_bytes();
    const MeasuredSky model(contestant.model);
    const std::size_t made = heap_bytes();
    const sky::AirTables air(sky::air_model({}), model.orders());
    const std::size_t entered = heap_bytes();
    if (made <= before || entered <= made) return {};
    std::vector<SizeEntry> sizes{{"air", entered - made}};
    if (contestant.model == render::SkyModel::kMulti) sizes.push_back({"directions", made - before});
    return sizes;
}

std::string name_of(const SkyContestant& contestant) {
    return std::string(render::name_of(contestant.model));
}

std::shared_ptr<MeasuredSky> sky_of(const SkyContestant& contestant, SharedAir& air) {
    auto model = std::make_shared<MeasuredSky>(contestant.model);
    model->enter(air.tables(model->orders()));
    return model;
}

Work look_up_work(const std::shared_ptr<MeasuredSky>& model) {
    model->place(3000.0, 0.5);
    return repeat([model, asked = directions()](std::uint64_t i) {
        const glm::vec2& direction = (*asked)[i % kDirections];
        return static_cast<double>(model->xyz(direction.x, direction.y).y);
    });
}

/// The Sun climbs a little from call to call, as in flight.
Work view_work(const std::shared_ptr<MeasuredSky>& model) {
    return repeat([model](std::uint64_t i) {
        model->place(3000.0, 0.1 + 1e-4 * static_cast<double>(i % 1000));
        return static_cast<double>(model->xyz(1.0F, 1.0F).y);
    });
}

Work air_work(const SkyContestant& contestant) {
    return repeat([orders = render::sky::models::orders_of(contestant.model)](std::uint64_t i) {
        render::Air air;
        air.visibility_m = 40e3 + 10.0 * static_cast<double>(i % 1000);
        const sky::AirTables tables(sky::air_model(air), orders);
        return static_cast<double>(tables.transmittance(0.0, 1.0)[0]);
    });
}

}  // namespace

Report measure_sky_errors(const std::filesystem::path& truth) {
    const std::vector<CaseSet> tables = read_tables(truth / "sky");
    const std::vector<CaseSet> scenes = read_scenes(truth / "sky_scene" / "scene.csv");
    Report report;
    report.family = "sky";
    report.title = "Light of the day sky";
    report.cases = fmt::format(
        "directions over the whole sphere, asked for through the look-ups that the renderer draws with, in "
        "two "
        "atmospheres (A: haze that absorbs, grass; B: grey haze, ozone) and by zenith angle of the Sun in "
        "degrees; "
        "air of scenes by visibility, eye at 0, 3 and 12 km, Sun at 60, 85 and 92 deg. Luminance: relative "
        "error; "
        "chromaticity: distance in CIE 1931 xy. Rows whose truth has a standard error above {:g} % are left "
        "out",
        100.0 * kLargestTruthError);
    report.truth =
        "spectral Monte Carlo tables of tests/data/sky, and of tests/data/sky_scene (`sky_truth_maker "
        "scene`)";
    report.costs =
        "`look-up` is the light of one direction, in shuffled order. `view` makes what a picture needs when "
        "the Sun "
        "has moved by 0.006 deg (`daycycle` then mostly mixes tables that it has), `air` when the weather "
        "has changed (that of `single` serves `daycycle`, that of `multi` "
        "the others); "
        "both whole, on one thread.";
    report.floor = "a sky of one colour, looked up in the same directions";
    report.headline = {kLuminance, all_tables(kRanges[0]), "look-up", "view"};
    const std::array<const char*, kRanges.size()> plots{"day", "low-sun", "twilight"};
    for (std::size_t i = 0; i < kRanges.size(); ++i) {
        report.plots.push_back(
            {plots[i],
             "Luminance",
             all_tables(kRanges[i]),
             {{"against a look-up", kLuminance, "look-up"}, {"against a new view", kLuminance, "view"}}});
    }
    const std::vector<Scores> scores = scores_of_all(truth);
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const SkyContestant& contestant = sky_contestants()[i];
        report.models.push_back(
            {name_of(contestant), contestant.what, scores[i].entries(), {}, sizes_of(contestant)});
    }
    return report;
}

std::vector<Contender> sky_contenders() {
    SharedAir air(sky::air_model({}));
    std::vector<Contender> contenders;
    for (const SkyContestant& contestant : sky_contestants()) {
        contenders.push_back({name_of(contestant), "look-up", look_up_work(sky_of(contestant, air))});
        contenders.push_back({name_of(contestant), "view", view_work(sky_of(contestant, air))});
        if (contestant.builds_air)
            contenders.push_back({name_of(contestant), "air", air_work(contestant), {}, 1});
    }
    return contenders;
}

Work sky_floor() {
    return one_colour_floor();
}

}  // namespace skyig::clients::bench
