// The components that a host may switch, in real datagrams.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

namespace cigi = protocol::cigi;
using cigi::ComponentClass;

class WorldComponentsTest : public ::testing::Test {
  protected:
    HostBench bench_;
};

TEST_F(WorldComponentsTest, ComponentsSwitchSkyAndWeather) {
    bench_.control(ComponentClass::kCelestialSphere, 0, 0, 0);
    bench_.control(ComponentClass::kCelestialSphere, 2, 0, 0);
    EXPECT_FALSE(bench_.world.celestial().sun);
    EXPECT_TRUE(bench_.world.celestial().moon);
    EXPECT_FALSE(bench_.world.celestial().stars);
    bench_.control(ComponentClass::kCelestialSphere, 3, 0, 0);
    EXPECT_FALSE(bench_.world.clock().running());
    bench_.control(ComponentClass::kAtmosphere, 0, 0, 0);
    EXPECT_FALSE(bench_.world.air().model_enabled);

    cigi::WeatherControl layer;
    layer.layer_id = 2;
    layer.weather_enable = true;
    cigi::WeatherControl regional = layer;
    regional.scope = cigi::WeatherScope::kRegional;
    regional.entity_region_id = 6;
    cigi::EnvRegionControl region;
    region.region_id = 6;
    region.region_state = cigi::RegionState::kActive;
    region.size_x = region.size_y = 1000.0F;
    bench_.send(kHostA, layer, regional, region);
    bench_.control(ComponentClass::kGlobalLayeredWeather, 0, 2, 0);
    bench_.control(ComponentClass::kRegionalLayeredWeather, 1, 6, 0, 2);
    EXPECT_FALSE(bench_.world.weather().layers()[0].weather_enable);
    EXPECT_FALSE(bench_.world.weather().layers()[1].weather_enable);
    bench_.control(ComponentClass::kRegionalLayeredWeather, 0, 6, 0);
    EXPECT_EQ(bench_.world.weather().regions()[0].region_state, cigi::RegionState::kInactive);
    cigi::ShortComponentControl again;
    again.component_class = ComponentClass::kRegionalLayeredWeather;
    again.component_id = 1;
    again.instance_id = 6;
    again.component_state = 1;
    again.data_1 = 2;
    bench_.send(kHostA, again);
    EXPECT_TRUE(bench_.world.weather().layers()[1].weather_enable);
    EXPECT_EQ(bench_.world.counters().component_unknown, 0U);
}

TEST_F(WorldComponentsTest, ComponentsShowTestPatterns) {
    const auto shown = [this](std::size_t i) { return bench_.world.views().all()[i].pattern; };
    bench_.control(ComponentClass::kView, 0, 2, 1);
    EXPECT_EQ(shown(0), config::Pattern::kOff);
    EXPECT_EQ(shown(1), config::Pattern::kChecker);
    bench_.control(ComponentClass::kViewGroup, 0, 0, 5);
    EXPECT_EQ(shown(0), config::Pattern::kSeam);
    EXPECT_EQ(shown(2), config::Pattern::kSeam);
    bench_.control(ComponentClass::kView, 0, 3, 0);
    EXPECT_EQ(shown(2), config::Pattern::kOff);
    EXPECT_EQ(bench_.world.counters().component_unknown, 0U);
    bench_.control(ComponentClass::kView, 0, 3, 10);  // no such pattern
    bench_.control(ComponentClass::kView, 0, 99, 1);  // no such view
    bench_.control(ComponentClass::kViewGroup, 0, 7, 1);
    EXPECT_EQ(bench_.world.counters().component_unknown, 3U);
    EXPECT_EQ(shown(2), config::Pattern::kOff);
}

/// The rows of the published table: class and component.
std::set<std::pair<int, int>> published_components() {
    std::ifstream page(SKYIG_SOURCE_DIR "/docs/protocols.md");
    std::set<std::pair<int, int>> all;
    static const std::regex kRow(R"(^\| (\d+)[^|]*\| ([\d, ]+) \| [a-z ]+ \| [^|]+ \|$)");
    static const std::regex kNumber(R"(\d+)");
    for (std::string line; std::getline(page, line);) {
        std::smatch row;
        if (!std::regex_match(line, row, kRow)) continue;
        const std::string ids = row[2];
        for (std::sregex_iterator id(ids.begin(), ids.end(), kNumber), end; id != end; ++id)
            all.emplace(std::stoi(row[1]), std::stoi(id->str()));
    }
    return all;
}

TEST_F(WorldComponentsTest, ComponentsAreThoseOfThePublishedTable) {
    const std::set<std::pair<int, int>> published = published_components();
    EXPECT_EQ(published.size(), 11U);
    // Something is there under number 1 of each kind: view, view group, region, layer, event.
    cigi::ViewDefinition grouped;
    grouped.view_id = 3;
    grouped.group_id = 1;
    bench_.send(kHostA, grouped);
    cigi::EnvRegionControl region;
    region.region_id = 1;
    region.region_state = cigi::RegionState::kActive;
    region.size_x = region.size_y = 1000.0F;
    cigi::WeatherControl global;
    global.layer_id = 1;
    cigi::WeatherControl regional = global;
    regional.scope = cigi::WeatherScope::kRegional;
    regional.entity_region_id = 1;
    bench_.send(kHostA, region, global, regional);
    for (int component_class = 0; component_class <= 15; ++component_class) {
        for (int id = 0; id < 8; ++id) {
            const std::uint64_t before = bench_.world.counters().component_unknown;
            bench_.control(static_cast<ComponentClass>(component_class), id, 1, 1, 1);
            const bool known = bench_.world.counters().component_unknown == before;
            EXPECT_EQ(known, published.contains({component_class, id}))
                << "class " << component_class << ", component " << id;
        }
    }
}

TEST_F(WorldComponentsTest, ComponentsThatAreNotThereAreCounted) {
    bench_.control(ComponentClass::kCelestialSphere, 4, 0, 1);
    bench_.control(ComponentClass::kCelestialSphere, 0, 0, 2);
    bench_.control(ComponentClass::kGlobalLayeredWeather, 0, 256, 1);
    bench_.control(ComponentClass::kRegionalLayeredWeather, 0, 9, 1);
    bench_.control(ComponentClass::kRegionalLayeredWeather, 1, 9, 1, 4'000'000'000U);
    bench_.control(ComponentClass::kSystem, 0, 0, 1);
    bench_.control(ComponentClass::kEvent, 0, 99, 1);
    bench_.control(ComponentClass::kEntity, 0, 0, 1);
    EXPECT_EQ(bench_.world.counters().component_unknown, 8U);
    EXPECT_TRUE(bench_.world.celestial().sun);
    EXPECT_EQ(bench_.lines_with("not in the component table"), 1U);
}

}  // namespace
}  // namespace skyig::server::world
