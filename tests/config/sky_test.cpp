// [sky] and its tables: the models of the day sky and their parameters.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.h"

namespace skyig::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string with(std::string_view lines) {
    return fmt::format(
        "version = 1\n{}\n[[channel]]\nname = \"centre\"\nwidth_px = 64\nheight_px = 48\nleft_deg = -30\n"
        "right_deg = 30\nbottom_deg = -25\ntop_deg = 25\n",
        lines);
}

std::string error_of(const std::string& text) {
    const LoadResult result = parse_config(text, "site.toml");
    EXPECT_EQ(result.errors.size(), 1U) << text;
    return result.errors.empty() ? std::string{} : to_text(result.errors.front());
}

TEST(SkySettings, ReadsTheModelsWithTheirParameters) {
    const LoadResult result = parse_config(with(R"(
[sky]
model = "windlight"
star_scintillation = false
[sky.daycycle]
desaturation = 0.3
[sky.cie]
type = 16
zenith_luminance_cd_m2 = 5000
[sky.preetham]
turbidity = 4
zenith = "multi"
[sky.windlight]
blue_horizon = [0.1, 0.2, 0.3]
haze_horizon = 0.4
blue_density = [0.5, 0.6, 0.7]
haze_density = 0.8
density_per_m = 1e-3
max_altitude_m = 2000
sunlight = [1, 2, 3]
ambient = [4, 5, 6]
glow_size = 7
glow_floor = 0.01
glow_power = -0.9
horizon_drop = 0.1
unit_cd_m2 = 12000
sun_angle_deg = 33
east_angle_deg = -20
)"),
                                           "site.toml");
    ASSERT_TRUE(result) << to_text(result.errors.front());
    const Sky& sky = result.config->sky;
    EXPECT_EQ(sky.model, SkyModel::kWindlight);
    EXPECT_FALSE(sky.star_scintillation);
    EXPECT_TRUE(Sky{}.star_scintillation);
    EXPECT_EQ(sky.day_cycle.desaturation, 0.3);
    EXPECT_EQ(sky.cie.type, 16);
    EXPECT_EQ(sky.cie.zenith_luminance_cd_m2, 5000.0);
    EXPECT_EQ(sky.preetham.turbidity, 4.0);
    EXPECT_TRUE(sky.preetham.zenith_of_multi);
    const WindlightSky& look = sky.windlight;
    EXPECT_EQ(look.blue_horizon, (std::array{0.1, 0.2, 0.3}));
    EXPECT_EQ(look.blue_density, (std::array{0.5, 0.6, 0.7}));
    EXPECT_EQ(look.sunlight, (std::array{1.0, 2.0, 3.0}));
    EXPECT_EQ(look.ambient, (std::array{4.0, 5.0, 6.0}));
    EXPECT_EQ(look.haze_horizon, 0.4);
    EXPECT_EQ(look.haze_density, 0.8);
    EXPECT_EQ(look.density_per_m, 1e-3);
    EXPECT_EQ(look.max_altitude_m, 2000.0);
    EXPECT_EQ(look.glow_size, 7.0);
    EXPECT_EQ(look.glow_floor, 0.01);
    EXPECT_EQ(look.glow_power, -0.9);
    EXPECT_EQ(look.horizon_drop, 0.1);
    EXPECT_EQ(look.unit_cd_m2, 12000.0);
    EXPECT_EQ(look.sun_angle_deg, 33.0);
    EXPECT_EQ(look.east_angle_deg, -20.0);
}

TEST(SkySettings, TellsWhatIsWrongInTheirTables) {
    EXPECT_THAT(error_of(with("[sky]\nmodel = \"mutli\"")), HasSubstr("did you mean \"multi\"?"));
    EXPECT_THAT(error_of(with("[sky.cie]\ntype = 17")), HasSubstr("sky.cie.type: is 17; it must be 1..16"));
    EXPECT_THAT(error_of(with("[sky]\ncie = 3")), HasSubstr("it must be a table: [sky.cie]"));
    EXPECT_THAT(error_of(with("[sky.windlight]\nsunlight = [1, 2]")), HasSubstr("[red, green, blue]"));
    EXPECT_THAT(error_of(with("[sky.windlight]\nsunlight = [1, 2, -1]")), HasSubstr("0..10"));
    EXPECT_THAT(error_of(with("[sky.windlite]")), HasSubstr("did you mean \"windlight\"?"));
    EXPECT_THAT(error_of(with("[sky.preetham]\nturbidity = 1.5")), HasSubstr("2..10"));
}

TEST(NightSettings, ReadsSourcesAndCities) {
    const LoadResult result = parse_config(with(R"(
[night]
model = "mean"
zodiacal = false
solar_activity = 0.7
milky_way_structure = 0.5
seed = 9
[[night.city]]
latitude_deg = 47.4
longitude_deg = 8.5
population = 400000
)"),
                                           "site.toml");
    ASSERT_TRUE(result) << to_text(result.errors.front());
    const Night& night = result.config->night;
    EXPECT_EQ(night.model, NightModel::kMean);
    EXPECT_FALSE(night.zodiacal);
    EXPECT_TRUE(night.airglow);
    EXPECT_EQ(night.solar_activity, 0.7);
    EXPECT_EQ(night.milky_way_structure, 0.5);
    EXPECT_EQ(night.seed, 9);
    ASSERT_EQ(night.cities.size(), 1U);
    EXPECT_EQ(night.cities[0].population, 400000.0);
    EXPECT_EQ(night.cities[0].radius_km, 8.0);
}

TEST(NightSettings, RefusesWhatACityCannotBe) {
    const auto city = [](const std::string& light) {
        return with("[[night.city]]\nlatitude_deg = 1\nlongitude_deg = 2\n" + light);
    };
    EXPECT_THAT(error_of(city("zenith_cd_m2 = 0.01\npopulation = 5\n")),
                HasSubstr("night.city[1].population: stands beside zenith_cd_m2"));
    EXPECT_THAT(error_of(city("radius_km = 5\n")),
                AllOf(HasSubstr("night.city[1].zenith_cd_m2"), HasSubstr("or population in its place")));
    EXPECT_THAT(error_of(city("zenith_cd_m2 = 0\n")), HasSubstr("night.city[1].zenith_cd_m2: is 0"));
    EXPECT_THAT(error_of(city("zenith_cd_m2 = 0.021\n")), HasSubstr("0.02 cd/m2"));
    EXPECT_THAT(error_of(city("population = 0\n")), HasSubstr("night.city[1].population: is 0"));
    EXPECT_THAT(error_of(city("population = 1000000\nradius_km = 6\n")),
                HasSubstr("night.city[1].population: is 8842 a km2 of its disc; at most 8000"));
    EXPECT_TRUE(parse_config(city("population = 1000000\nradius_km = 7\n"), "site.toml"));
    EXPECT_THAT(error_of(with("[[night.city]]\nlatitude_deg = 1\npopulation = 5\n")),
                HasSubstr("night.city[1].longitude_deg"));
    EXPECT_THAT(error_of(with("[night]\ncity = 3\n")), HasSubstr("[[night.city]]"));
    EXPECT_THAT(error_of(with("[night]\nairglo = true\n")), HasSubstr("airglow"));
}

}  // namespace
}  // namespace skyig::config
