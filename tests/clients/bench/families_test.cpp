#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>

#include "clients/bench/family.h"

namespace skyig::clients::bench {
namespace {

constexpr const char* kTruth = SKYIG_TEST_DATA;

TEST(Families, HaveNamesOfTheirOwnAndAreFoundByThem) {
    std::set<std::string_view> names;
    for (const Family& family : families()) {
        EXPECT_TRUE(names.insert(family.name).second) << family.name;
        EXPECT_EQ(find_family(family.name), &family);
    }
    EXPECT_EQ(find_family("nonsense"), nullptr);
}

/// What the pages need: models have the headline's error and cost, every plot has something to draw. Beside
/// light in slabs the clouds have ways to draw them, beside depths the fog has ranges: not all are headed.
void expect_complete(const Report& report) {
    bool any = false;
    for (const ModelEntry& model : report.models) {
        EXPECT_FALSE(model.what.empty()) << model.name;
        const ErrorEntry* error = find_error(model, report.headline.quantity, report.headline.cases);
        const CostEntry* headed = find_cost(model, report.headline.cost);
        if (report.family == "cloud" || report.family == "fog") {
            EXPECT_FALSE(model.errors.empty() && model.costs.empty()) << model.name;
            any = any || (error != nullptr && headed != nullptr);
        } else {
            ASSERT_NE(error, nullptr) << model.name;
            EXPECT_GT(error->figures.count, 0U);
            EXPECT_NE(headed, nullptr) << model.name;
            any = true;
        }
        if (report.family == "ephemeris") {
            EXPECT_EQ(report.headline.cost, "frame");
            const CostEntry* worst = find_cost(model, report.headline.worst_cost);
            ASSERT_NE(worst, nullptr) << model.name;
            EXPECT_GT(worst->floors.median, find_cost(model, report.headline.cost)->floors.median);
        }
        for (const CostEntry& cost : model.costs) {
            EXPECT_GT(cost.ns.median, 0.0) << model.name << ' ' << cost.name;
            EXPECT_GT(cost.floors.median, 0.0) << model.name << ' ' << cost.name;
            EXPECT_EQ(cost.instructions, std::optional<double>(7.0)) << model.name << ' ' << cost.name;
        }
        for (const Plot& plot : report.plots) {
            for (const PlotSeries& series : plot.series) {
                EXPECT_NE(find_error(model, series.quantity, plot.cases), nullptr) << series.quantity;
                EXPECT_NE(find_cost(model, series.cost), nullptr) << series.cost;
            }
        }
    }
    EXPECT_TRUE(any);
}

/// Bounds row by row are those of the tests of render/night; no source may stray from its tables as a whole.
void expect_night_near_its_tables(const Report& report) {
    for (const ModelEntry& model : report.models) {
        const ErrorEntry* all = find_error(model, "light", "all its rows");
        ASSERT_NE(all, nullptr) << model.name;
        EXPECT_LT(all->figures.rms, 0.5) << model.name;
        std::size_t rows = 0;
        for (const ErrorEntry& entry : model.errors)
            rows += &entry == all ? 0 : entry.figures.count;
        EXPECT_EQ(rows, all->figures.count) << model.name;
    }
}

TEST(Families, EachIsMeasuredWhole) {
    const server::SystemClock clock;
    for (const Family& family : families()) {
        std::vector<InstructionCount> counts;
        for (const Contender& contender : family.contenders())
            counts.push_back({std::string(family.name), contender.model, contender.cost, 7.0});
        const Report report = measure(family, kTruth, clock, {2, 2'000.0}, counts);
        SCOPED_TRACE(report.family);
        EXPECT_EQ(report.family, family.name);
        expect_complete(report);
        if (report.family == "night") expect_night_near_its_tables(report);
        const std::string json = to_json(report);
        EXPECT_EQ(to_json(report_from_json(json)), json);
        std::printf("%s", to_text(report).c_str());
    }
}

TEST(Families, CountsOfWhatThereIsNotAreRefused) {
    const server::SystemClock clock;
    const auto message_of = [&clock](const InstructionCount& count) -> std::string {
        try {
            (void)measure(*find_family("wire"), kTruth, clock, {1, 100.0}, std::vector{count});
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no complaint";
    };
    EXPECT_NE(message_of({"wire", "cigi33", "decod", 1.0}).find("'decod'"), std::string::npos);
    EXPECT_NE(message_of({"wire", "cigi32", "decode", 1.0}).find("'cigi32'"), std::string::npos);
    EXPECT_NE(message_of({"wired", "cigi33", "decode", 1.0}).find("'wired'"), std::string::npos);
    EXPECT_EQ(message_of({"wire", "cigi33", "decode", 1.0}), "no complaint");
    EXPECT_EQ(message_of({"ephemeris", "any", "thing", 1.0}), "no complaint");
}

TEST(Families, WireMessagesSurviveReadingAndWriting) {
    for (const ModelEntry& model : find_family("wire")->measure_errors(kTruth).models) {
        EXPECT_EQ(model.errors.at(0).figures.max, 0.0) << model.name;
        EXPECT_EQ(model.errors.at(0).figures.count, 64U);
    }
}

TEST(Families, EphemerisModelsStandOnALadder) {
    const Report report = find_family("ephemeris")->measure_errors(kTruth);
    ASSERT_EQ(report.models.size(), 3U);
    double coarser_arcsec = 3600.0;
    for (const ModelEntry& model : report.models) {
        const double max_arcsec = find_error(model, "all bodies", "1900-2100")->figures.max;
        EXPECT_LT(max_arcsec, coarser_arcsec) << model.name;
        coarser_arcsec = max_arcsec;
        for (const char* body : {"sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn"}) {
            const ErrorEntry* inner = find_error(model, body, "1950-2050");
            const ErrorEntry* whole = find_error(model, body, "1900-2100");
            ASSERT_TRUE(inner != nullptr && whole != nullptr);
            EXPECT_LE(inner->figures.max, whole->figures.max);
            EXPECT_LT(inner->figures.count, whole->figures.count);
            EXPECT_LE(whole->figures.rms, whole->figures.max);
        }
    }
    const ModelEntry& series = report.models.back();
    EXPECT_LE(find_error(series, "sun", "1900-2100")->figures.max, 0.1);
    EXPECT_LE(find_error(series, "moon", "1900-2100")->figures.max, 0.6);
    for (const char* planet : {"mercury", "venus", "mars", "jupiter", "saturn"})
        EXPECT_LE(find_error(series, planet, "1900-2100")->figures.max, 1.5) << planet;
}

TEST(Families, AMissingTruthTableIsNamed) {
    try {
        (void)find_family("ephemeris")->measure_errors("nowhere");
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("nowhere/ephemeris/geo_truth.csv"), std::string::npos);
    }
}

TEST(Families, CountedCallsAreToldInTheOrderTheyAreMade) {
    const Family& family = *find_family("wire");
    const std::string lines = make_counted_calls(family, 3);
    EXPECT_EQ(lines,
              "wire,cigi33,decode,3\nwire,cigi33-swapped,decode,3\nwire,cigi40,decode,3\n"
              "wire,cigi40-swapped,decode,3\n");
}

TEST(InstructionCounts, AreReadALineEach) {
    const auto counts =
        read_instruction_counts("# counted\nwire,cigi33,decode,301.5\n\nwire,cigi40,decode,12");
    ASSERT_EQ(counts.size(), 2U);
    EXPECT_EQ(counts[0].model, "cigi33");
    EXPECT_EQ(counts[0].instructions, 301.5);
    EXPECT_EQ(counts[1].cost, "decode");
}

TEST(InstructionCounts, ABadLineIsNamed) {
    for (const char* bad : {"a,b,c", "a,b,c,", "a,b,c,x", "a,b,c,1,2", "a,b,c,-1", "a,b,c,nan"}) {
        try {
            (void)read_instruction_counts(std::string("#\n") + bad);
            ADD_FAILURE() << bad;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace skyig::clients::bench
