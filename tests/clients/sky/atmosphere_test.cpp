// What may be given as the air, and what is told of a file that is wrong.
#include "clients/skyig/sky/atmosphere.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "clients/skyig/options.h"
#include "config/air_file.h"

namespace skyig::clients {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Atmosphere, AAndBAreTheTruthTablesMedia) {
    EXPECT_TRUE(sky::load_atmosphere("A").air == render::sky::atmosphere_a());
    EXPECT_TRUE(sky::load_atmosphere("B").air == render::sky::atmosphere_b());
}

TEST(Atmosphere, AFileHoldsAirAndSkyAsAConfigurationDoes) {
    const auto read = config::parse_air_file(
        "[air]\nvisibility_m = 7000\n[sky]\nmodel = \"cie\"\n[sky.cie]\ntype = 3\n", "haze.toml");
    ASSERT_TRUE(read);
    EXPECT_EQ(read.file->air.visibility_m, 7000.0);
    EXPECT_EQ(read.file->sky.model, config::SkyModel::kCie);
    EXPECT_EQ(read.file->sky.cie.type, 3);
    EXPECT_FALSE(read.file->planet);
}

TEST(Atmosphere, AFileMayDescribeAnotherPlanet) {
    const std::string path = testing::TempDir() + "mars.toml";
    std::ofstream(path) << "[planet]\nground_radius_m = 3389.5e3\naerosol_albedo_blue = 0.76\n";
    const sky::Atmosphere mars = sky::load_atmosphere(path);
    EXPECT_EQ(mars.air.ground_radius_m, 3389.5e3);
    EXPECT_LT(mars.air.aerosol_scattering_per_m[0] / mars.air.aerosol_extinction_per_m[0], 0.75F);
    std::filesystem::remove(path);
}

TEST(Atmosphere, MistakesAreToldAllAtOnceWithTheirPlaces) {
    const std::string path = testing::TempDir() + "wrong.toml";
    std::ofstream(path) << "[air]\nvisbility_m = 7000\n[planet]\naerosol_g = 2\n";
    try {
        static_cast<void>(sky::load_atmosphere(path));
        ADD_FAILURE();
    } catch (const sky::AtmosphereErrors& errors) {
        EXPECT_THAT(
            errors.lines,
            ElementsAre(HasSubstr("wrong.toml:2:1: air.visbility_m: unknown key; did you mean"),
                        HasSubstr("wrong.toml:4:13: planet.aerosol_g: is 2; it must be -0.95..0.95")));
    }
    std::filesystem::remove(path);
    EXPECT_THROW(static_cast<void>(sky::load_atmosphere("/nowhere/air.toml")), sky::AtmosphereErrors);
}

Invocation invoke(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "skyig");
    return read_command_line(static_cast<int>(arguments.size()), arguments.data());
}

TEST(SkyCommandLine, OptionsArrive) {
    const Invocation made =
        invoke({"sky", "--model", "single", "--atmosphere", "A", "--cases", "in.csv", "--out", "out.csv"});
    const auto& options = std::get<SkyOptions>(made.options);
    EXPECT_EQ(options.model, "single");
    EXPECT_EQ(options.atmosphere, "A");
    EXPECT_EQ(options.cases_path, "in.csv");
    EXPECT_EQ(options.out_path, "out.csv");
    const Invocation unknown = invoke({"sky", "--model", "best", "--cases", "in.csv"});
    EXPECT_EQ(unknown.exit_status, 2);
    EXPECT_THAT(unknown.error, HasSubstr("windlight"));
    EXPECT_EQ(invoke({"sky"}).exit_status, 2);
    EXPECT_TRUE(std::get<SkyOptions>(invoke({"sky", "--truth", "--cases", "in.csv"}).options).truth);
    EXPECT_EQ(invoke({"sky", "--truth", "--model", "multi", "--cases", "in.csv"}).exit_status, 2);
}

TEST(SkyCommandLine, ShotTakesAModel) {
    const Invocation made = invoke({"shot", "--sky", "daycycle", "--out", "a.png"});
    EXPECT_EQ(std::get<ShotOptions>(made.options).still.sky_model, config::SkyModel::kDayCycle);
}

}  // namespace
}  // namespace skyig::clients
