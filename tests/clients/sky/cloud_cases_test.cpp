// Tables of slab cases as people have them: what is read, what is told of bad rows, what comes out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "clients/skyig/cloud/cases.h"
#include "clients/skyig/options.h"

namespace skyig::clients::cloud {
namespace {

using render::cloud::SlabModel;
using ::testing::HasSubstr;

struct Outcome {
    CaseCount count;
    std::string text;
    std::string errors;
};

Outcome run(const std::string& table) {
    std::istringstream input(table);
    std::ostringstream output;
    std::ostringstream errors;
    Outcome outcome;
    outcome.count = run_cases(
        input, "in.csv", [&]() -> std::ostream& { return output; }, errors, SlabModel::kTable);
    outcome.text = output.str();
    outcome.errors = errors.str();
    return outcome;
}

constexpr std::string_view kHeading =
    "optical_depth,asymmetry_g,single_scattering_albedo,sun_zenith_deg,quantity,view_zenith_deg,"
    "rel_azimuth_deg,note\n";

/// Rows under the usual heading.
Outcome run_rows(std::string_view rows) {
    std::string table{kHeading};
    table.append(rows);
    return run(table);
}

TEST(CloudCases, KeepsColumnsAndAppendsTheDrawnFunctionsValue) {
    const Outcome made = run_rows(
        "0,0.85,1,30,R_brf,0,0,none\n"
        "16,0.85,1,diffuse,R_flux,,,\"a, b\"\r\n"
        "2,0.85,1,0,T_direct_flux,,,through\n");
    EXPECT_EQ(made.errors, "");
    EXPECT_EQ(made.count.rows, 3U);
    const Case even{{16.0, 0.85, 1.0}, std::nullopt, 0.0, 0.0};
    std::ostringstream value;
    value.precision(7);
    value << value_of(SlabModel::kTable, even, Quantity::kReflected);
    EXPECT_THAT(made.text, HasSubstr("rel_azimuth_deg,note,skyig_value\n"));
    EXPECT_THAT(made.text, HasSubstr("R_brf,0,0,none,0\n"));
    EXPECT_THAT(made.text, HasSubstr("\"a, b\"," + value.str() + "\r\n"));
    EXPECT_THAT(made.text, HasSubstr("through,0.1353353\n"));
}

TEST(CloudCases, BadRowsAreToldByLineAndColumnAndStayEmpty) {
    const Outcome made = run_rows(
        "x,0.85,1,30,R_brf,0,0,a\n"
        "1,0.85,1,30,glow,0,0,b\n"
        "1,0.85,1,diffuse,T_brf,0,0,c\n"
        "1,0.85\n");
    EXPECT_EQ(made.count.bad_rows, 4U);
    EXPECT_THAT(made.errors, HasSubstr("in.csv:2: optical_depth: 'x' is not a number"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:3: quantity: 'glow' is none of R_brf"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:4: sun_zenith_deg: 'diffuse' is not a number"));
    EXPECT_THAT(made.errors, HasSubstr("in.csv:5: not a whole row"));
    EXPECT_THAT(made.text, HasSubstr("0,0,a,\n"));
}

TEST(CloudCases, AHeadingWithoutAColumnSaysWhich) {
    try {
        run("optical_depth\n1\n");
        FAIL() << "was taken";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("in.csv:1: no column 'asymmetry_g'"));
    }
}

TEST(CloudCommand, TakesATableOrOneCase) {
    const char* const one[] = {"skyig", "cloud", "--optical-depth", "30", "--sun-zenith", "60", "--json"};
    const Invocation invocation = read_command_line(7, one);
    ASSERT_TRUE(std::holds_alternative<CloudOptions>(invocation.options)) << invocation.error;
    EXPECT_EQ(std::get<CloudOptions>(invocation.options).optical_depth, 30.0);
    const char* const neither[] = {"skyig", "cloud", "--model", "tms"};
    EXPECT_EQ(read_command_line(4, neither).exit_status, 2);
    const char* const unknown[] = {"skyig", "cloud", "--optical-depth", "1", "--model", "magic"};
    EXPECT_EQ(read_command_line(6, unknown).exit_status, 2);
}

}  // namespace
}  // namespace skyig::clients::cloud
