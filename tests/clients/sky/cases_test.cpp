// Tables of directions as people have them: what is read, what is told of bad rows, what comes out.
#include "clients/skyig/sky/cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "clients/csv.h"
#include "clients/skyig/sky/model_solver.h"
#include "clients/skyig/sky/truth_solver.h"
#include "tests/render/sky/truth.h"

namespace skyig::clients::sky {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Tells what it was asked.
class Recorder final : public Solver {
  public:
    void begin(double altitude_m, double sun_zenith_deg) override {
        begun.emplace_back(altitude_m, sun_zenith_deg);
    }
    [[nodiscard]] glm::dvec3 xyz(double view_zenith_deg, double rel_azimuth_deg) override {
        return {view_zenith_deg, rel_azimuth_deg, 100.0};
    }
    std::vector<std::pair<double, double>> begun;
};

struct Outcome {
    CaseCount count;
    std::string text;
    std::string errors;
};

Outcome run(const std::string& table, Solver& solver) {
    std::istringstream input(table);
    std::ostringstream output;
    std::ostringstream errors;
    Outcome outcome;
    outcome.count = run_cases(
        input, "in.csv", [&]() -> std::ostream& { return output; }, errors, solver);
    outcome.text = output.str();
    outcome.errors = errors.str();
    return outcome;
}

TEST(SkyCases, KeepsEveryColumnAndTheOrderAndBuildsEachTableOnce) {
    Recorder solver;
    const Outcome made =
        run("# made by hand\n"
            "note,rel_azimuth_deg,Sun_Zenith_deg,view_zenith_deg,altitude_m\n"
            "\"a, b\",50,30,50,0\r\n"
            "c,0,60,100,0\n"
            "d,100,30,0,0\n",
            solver);
    EXPECT_EQ(made.errors, "");
    EXPECT_EQ(made.text,
              "note,rel_azimuth_deg,Sun_Zenith_deg,view_zenith_deg,altitude_m,skyig_Y_cd_m2,skyig_x,skyig_y\n"
              "\"a, b\",50,30,50,0,50,0.250000,0.250000\r\n"
              "c,0,60,100,0,0,0.500000,0.000000\n"
              "d,100,30,0,0,100,0.000000,0.500000\n");
    EXPECT_EQ(made.count.rows, 3U);
    EXPECT_EQ(made.count.tables, 2U);
    EXPECT_THAT(solver.begun, ElementsAre(std::pair(0.0, 30.0), std::pair(0.0, 60.0)));
}

TEST(SkyCases, BadRowsAreToldByLineAndColumnAndStayEmpty) {
    Recorder solver;
    const Outcome made =
        run("altitude_m,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg\n"
            "0,30,x,0\n"
            "0,181,10,0\n"
            "-1,30,10,0\n"
            "0,30,10\n"
            "0,180,180,-720\n",
            solver);
    EXPECT_EQ(made.count.rows, 5U);
    EXPECT_EQ(made.count.bad_rows, 4U);
    EXPECT_THAT(made.errors, HasSubstr("in.csv:2: view_zenith_deg: 'x' is not a number in [0, 180]"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:3: sun_zenith_deg: '181' is not"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:4: altitude_m: '-1' is not"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:5: 3 fields where the heading has 4"));
    EXPECT_THAT(made.text, HasSubstr("0,30,x,0,,,\n"));
    EXPECT_THAT(made.text, HasSubstr("0,180,180,-720,"));
}

TEST(SkyCases, HeadingsThatCannotBeUsedAreRefusedBeforeAnythingIsWritten) {
    Recorder solver;
    for (const auto& [table, part] :
         {std::pair{"", "no heading line"},
          std::pair{"altitude_m,view_zenith_deg\n", "no column 'sun_zenith_deg'"},
          std::pair{"altitude_m,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,skyig_x\n",
                    "column 'skyig_x' is there already"}}) {
        std::istringstream input(table);
        std::ostringstream errors;
        const auto never = []() -> std::ostream& { throw std::logic_error("opened"); };
        try {
            run_cases(input, "in.csv", never, errors, solver);
            ADD_FAILURE() << table;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr(part));
        }
    }
}

// The whole way of the verb: file in, look-ups as drawn, columns out.
TEST(SkyCases, MultiAgreesWithTheTruthTable) {
    ModelSolver solver(load_atmosphere("B"));
    std::ifstream file(SKYIG_TEST_DATA "/sky/air_B_400000m.csv");
    std::stringstream text;
    text << file.rdbuf();
    const Outcome made = run(text.str(), solver);
    EXPECT_EQ(made.count.bad_rows, 0U);
    EXPECT_EQ(made.count.tables, 4U);
    std::istringstream again(made.text);
    CsvReader reader(again);
    const std::vector<std::string> names = reader.next()->fields;
    const auto column = [&](const CsvRecord& record, std::string_view name) {
        const auto at = std::find(names.begin(), names.end(), name) - names.begin();
        return *parse_number(record.fields.at(static_cast<std::size_t>(at)));
    };
    render::sky::Errors errors;
    while (const std::optional<CsvRecord> record = reader.next()) {
        const double truth = column(*record, "Y_cd_m2");
        if (truth > 0.0 && column(*record, "rel_se_Y") <= 0.02 && column(*record, "sun_zenith_deg") < 89.0)
            errors.add(column(*record, "skyig_Y_cd_m2") / truth - 1.0);
    }
    std::printf("%zu rows, rms %.2f %%, largest %.1f %%\n", errors.count(), 100.0 * errors.rms(),
                100.0 * errors.largest());
    ASSERT_GT(errors.count(), 100U);
    EXPECT_LT(errors.rms(), 0.01);
}

TEST(TruthSolver, AgreesWithTheTruthTable) {
    TruthSolver solver(load_atmosphere("A").law);
    // Rows of ground_A.csv.
    const std::string rows =
        "altitude_m,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,Y_cd_m2\n"
        "0,0,0,0,12126\n"
        "0,0,30,0,3604.2\n";
    const Outcome made = run(rows, solver);
    std::istringstream again(made.text);
    CsvReader reader(again);
    (void)reader.next();
    while (const std::optional<CsvRecord> record = reader.next()) {
        const double truth = *parse_number(record->fields[4]);
        EXPECT_NEAR(*parse_number(record->fields[5]) / truth, 1.0, 0.01) << record->text;
    }
    const Outcome alone = run(rows.substr(0, rows.find("0,0,30")), solver);
    EXPECT_EQ(made.text.substr(0, alone.text.size()), alone.text) << "a row stands for itself";
}

TEST(ModelSolver, AnswersEveryAngleWithAFiniteColour) {
    for (std::size_t i = 0; i < render::kSkyModelNames.size(); ++i) {
        Atmosphere atmosphere = load_atmosphere("B");
        atmosphere.sky.model = static_cast<render::SkyModel>(i);
        ModelSolver solver(atmosphere);
        for (const double altitude_m : {0.0, 1e4, 4e5, 1e9}) {
            for (const double sun_deg : {0.0, 89.0, 95.0, 180.0}) {
                solver.begin(altitude_m, sun_deg);
                for (const double view_deg : {0.0, 60.0, 90.0, 120.0, 180.0}) {
                    const glm::dvec3 xyz = solver.xyz(view_deg, 200.0);
                    for (int k = 0; k < 3; ++k)
                        EXPECT_TRUE(std::isfinite(xyz[k]) && xyz[k] >= 0.0) << render::kSkyModelNames[i];
                }
            }
        }
    }
}

}  // namespace
}  // namespace skyig::clients::sky
