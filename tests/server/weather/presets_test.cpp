// Every preset against the figures of its definition, and where presets are found.
#include "config/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/server/weather/weather_bench.h"

namespace skyig::server::weather {
namespace {

using config::LayerType;
using testing::HasSubstr;

constexpr double kFoot_m = 0.3048;

config::Config with(const std::string& preset) {
    config::Config config = config::default_config();
    EXPECT_EQ(config::apply_preset(preset, config), "") << preset;
    return config;
}

const config::WeatherLayer* find(const config::Config& config, LayerType type) {
    const auto& layers = config.weather.layers;
    const auto at = std::find_if(layers.begin(), layers.end(), [&](const auto& l) { return l.type == type; });
    return at == layers.end() ? nullptr : &*at;
}

struct Row {
    const char* preset;
    double ground_visibility_m;
    LayerType cloud;
    double base_ft, top_ft, oktas;  // 0 oktas: no cloud
};

/// users-and-stations.md, 4.2; presets without a row there keep its order: never clearer, step by step.
constexpr std::array kRows{
    Row{"cavok", 50e3, LayerType::kCumulus, 0, 0, 0},
    Row{"few", 30e3, LayerType::kCumulus, 4500, 6000, 1.5},
    Row{"scattered", 15e3, LayerType::kCumulus, 4500, 6500, 3.5},
    Row{"broken", 10e3, LayerType::kCumulus, 2000, 4000, 6},
    Row{"overcast", 8e3, LayerType::kStratocumulus, 3000, 6000, 8},
    Row{"mvfr", 6e3, LayerType::kStratocumulus, 2000, 4000, 6},
    Row{"rain", 2.5e3, LayerType::kNimbostratus, 800, 5000, 8},
    Row{"snow", 1.2e3, LayerType::kNimbostratus, 900, 6000, 8},
    Row{"storm", 4e3, LayerType::kCumulonimbus, 2000, 40000, 6},
    Row{"cat1", 450, LayerType::kStratus, 220, 1500, 8},
    Row{"cat2", 207, LayerType::kStratus, 110, 1500, 8},
    Row{"cat3a", 97, LayerType::kCumulus, 0, 0, 0},
    Row{"cat3b", 27.6, LayerType::kCumulus, 0, 0, 0},
    Row{"fog", 150, LayerType::kCumulus, 0, 0, 0},
};

/// At the ground: the air and what lies and falls there.
double ground_visibility_m(const WeatherBench& bench) {
    double extinction = -std::log(0.05) / bench.scene.air.visibility_m;
    for (const render::Obscurant& obscurant : bench.weather().all_obscurants())
        extinction += obscurant.coverage * obscurant.extinction_per_m;
    return -std::log(0.05) / extinction;
}

TEST(Presets, AreWhatTheirDefinitionsSay) {
    for (const Row& row : kRows) {
        const config::Config config = with(row.preset);
        WeatherBench bench(config);
        bench.frame();
        EXPECT_NEAR(ground_visibility_m(bench), row.ground_visibility_m, 0.002 * row.ground_visibility_m)
            << row.preset;
        if (row.oktas == 0.0) {
            EXPECT_EQ(bench.weather().cloud_count, 0U) << row.preset;
            continue;
        }
        const config::WeatherLayer* cloud = find(config, row.cloud);
        ASSERT_NE(cloud, nullptr) << row.preset;
        EXPECT_NEAR(cloud->base_m, row.base_ft * kFoot_m, 1e-6) << row.preset;
        EXPECT_NEAR(cloud->base_m + cloud->thickness_m, row.top_ft * kFoot_m, 1e-6) << row.preset;
        EXPECT_DOUBLE_EQ(cloud->coverage, row.oktas / 8.0) << row.preset;
        ASSERT_EQ(bench.weather().cloud_count, 1U) << row.preset;
    }
}

TEST(Presets, HaveTheirExtras) {
    EXPECT_TRUE(find(with("storm"), LayerType::kCumulonimbus)->lightning);
    EXPECT_DOUBLE_EQ(find(with("storm"), LayerType::kRain)->rate_mm_h, 15.0);
    EXPECT_DOUBLE_EQ(with("snow").ground.snow_pct, 100.0);
    EXPECT_NEAR(find(with("cat3a"), LayerType::kFog)->thickness_m - 1000.0, 300.0 * kFoot_m, 1e-9);
    EXPECT_NEAR(find(with("cat1"), LayerType::kFog)->thickness_m - 1000.0, 220.0 * kFoot_m, 1e-9);
    const config::Config patchy = with("patchy-fog");
    const config::WeatherLayer* patches = find(patchy, LayerType::kFog);
    ASSERT_NE(patches, nullptr);
    EXPECT_DOUBLE_EQ(patches->coverage, 0.5);
    EXPECT_DOUBLE_EQ(patches->visibility_m, 100.0);
    // In the middle of one; the air between them is in it.
    WeatherBench bench(patchy);
    bench.frame();
    EXPECT_EQ(bench.weather().obscurant_count, 0U);
    ASSERT_EQ(bench.weather().cloud_count, 2U);
    const auto clouds = bench.weather().all_clouds();
    const auto drawn = std::find_if(clouds.begin(), clouds.end(), [](const render::CloudLayer& cloud) {
        return cloud.genus == render::CloudGenus::kFogPatches;
    });
    ASSERT_NE(drawn, clouds.end());
    EXPECT_EQ(drawn->coverage, 0.5);
    const double air_per_m = -std::log(0.05) / bench.scene.air.visibility_m;
    EXPECT_NEAR(-std::log(0.05) / (drawn->extinction_per_m + air_per_m), 100.0, 1e-6);
}

/// RVR by Allard of lights for which 600 m go with a MOR of 450 m.
TEST(Presets, RunwayVisualRangesGoByOneKindOfLight) {
    const double lights_m2 = std::exp(-std::log(0.05) / 450.0 * 600.0) * 600.0 * 600.0;
    struct Range {
        const char* preset;
        double rvr_m;
    };
    for (const Range& range : {Range{"cat2", 350.0}, Range{"cat3a", 200.0}, Range{"cat3b", 75.0}}) {
        const double sigma = std::log(lights_m2 / (range.rvr_m * range.rvr_m)) / range.rvr_m;
        const config::Config config = with(range.preset);
        EXPECT_NEAR(find(config, LayerType::kFog)->visibility_m, -std::log(0.05) / sigma,
                    0.01 * -std::log(0.05) / sigma)
            << range.preset;
    }
}

TEST(Presets, EveryNameHasAFileAndItsTextIsCompiledIn) {
    namespace fs = std::filesystem;
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(SKYIG_SOURCE_DIR) / "config" / "presets")) {
        ++files;
        std::ifstream in(entry.path());
        std::ostringstream text;
        text << in.rdbuf();
        EXPECT_EQ(config::preset_text(entry.path().filename().string()), text.str()) << entry.path();
    }
    EXPECT_EQ(files, config::kPresetNames.size());
    for (const std::string_view name : config::kPresetNames)
        EXPECT_EQ(with(std::string(name)).weather.preset, name);
}

TEST(Presets, TheirLayersAreAsAHostsAndComeBackAfterStandby) {
    config::Config config = world::three_channels();
    ASSERT_EQ(config::apply_preset("broken", config), "");
    config.weather.elevation_m = 400.0;
    config.weather.transition_s = 0.0;
    WeatherBench bench(config);
    EXPECT_NEAR(bench.frame().weather.clouds[0].base_m, 400.0 + 2000.0 * kFoot_m, 1e-3);
    cigi::WeatherControl off = cloud(1, cigi::CloudType::kCumulus, 1000.0F, 10.0F);
    off.weather_enable = false;
    bench.send(off);
    EXPECT_EQ(bench.frame().weather.cloud_count, 0U);
    bench.host.mode = cigi::IgMode::kStandby;
    bench.send();
    EXPECT_EQ(bench.frame().weather.cloud_count, 1U);
    EXPECT_NEAR(bench.weather().clouds[0].coverage, 0.75, 1e-6);
}

TEST(Presets, AFileOfOnesOwnIsOneToo) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "skyig_preset_test.toml";
    std::ofstream(path) << "version = 1\n[air]\nvisibility_m = 7000\n[[weather.layer]]\ntype = \"stratus\"\n"
                           "base_m = 200\nthickness_m = 150\ncoverage_pct = 90\n";
    const config::Config config = with(path.string());
    EXPECT_DOUBLE_EQ(config.air.visibility_m, 7000.0);
    ASSERT_EQ(config.weather.layers.size(), 1U);
    std::ofstream(path) << "version = 1\n[display]\ngamma = 2.2\n";
    config::Config untouched = config::default_config();
    const std::string fault = config::apply_preset(path.string(), untouched);
    EXPECT_THAT(fault, HasSubstr("skyig_preset_test.toml:2:2: display: unknown key"));
    std::filesystem::remove(path);
    EXPECT_THAT(config::apply_preset("ovrcast", untouched), HasSubstr("did you mean \"overcast\"?"));
    EXPECT_THAT(config::apply_preset("./nothing.toml", untouched),
                HasSubstr("nothing.toml: cannot be opened"));
}

}  // namespace
}  // namespace skyig::server::weather
