#include "server/world/weather_store.h"

#include <gtest/gtest.h>

namespace skyig::server::world {
namespace {

using protocol::cigi::EnvRegionControl;
using protocol::cigi::RegionState;
using protocol::cigi::WeatherControl;
using protocol::cigi::WeatherScope;

WeatherControl layer(WeatherScope scope, int region, int id, float visibility = 1000.0F) {
    WeatherControl control;
    control.scope = scope;
    control.entity_region_id = static_cast<std::uint16_t>(region);
    control.layer_id = static_cast<std::uint8_t>(id);
    control.visibility = visibility;
    return control;
}

EnvRegionControl region(int id, RegionState state) {
    EnvRegionControl control;
    control.region_id = static_cast<std::uint16_t>(id);
    control.region_state = state;
    return control;
}

TEST(WeatherStore, SameLayerIsReplacedOthersAreKept) {
    WeatherStore store;
    EXPECT_TRUE(store.set(layer(WeatherScope::kGlobal, 0, 1, 1000.0F)));
    EXPECT_TRUE(store.set(layer(WeatherScope::kGlobal, 0, 2, 2000.0F)));
    EXPECT_TRUE(store.set(layer(WeatherScope::kRegional, 7, 1, 3000.0F)));
    EXPECT_TRUE(
        store.set(layer(WeatherScope::kGlobal, 99, 1, 4000.0F)));  // a global layer's region means nothing
    ASSERT_EQ(store.layers().size(), 3U);
    EXPECT_EQ(store.layers()[0].visibility, 4000.0F);
    EXPECT_EQ(store.layers()[1].visibility, 2000.0F);
    EXPECT_EQ(store.layers()[2].visibility, 3000.0F);
}

TEST(WeatherStore, DestroyedRegionTakesItsLayersWithIt) {
    WeatherStore store;
    EXPECT_TRUE(store.set(region(7, RegionState::kActive)));
    EXPECT_TRUE(store.set(region(8, RegionState::kInactive)));
    EXPECT_TRUE(store.set(layer(WeatherScope::kRegional, 7, 1)));
    EXPECT_TRUE(store.set(layer(WeatherScope::kRegional, 8, 1)));
    EXPECT_TRUE(store.set(layer(WeatherScope::kEntity, 7, 0)));
    EXPECT_TRUE(store.set(region(7, RegionState::kDestroyed)));
    ASSERT_EQ(store.regions().size(), 1U);
    EXPECT_EQ(store.regions()[0].region_id, 8);
    EXPECT_EQ(store.layers().size(), 2U);
    EXPECT_TRUE(store.set(region(7, RegionState::kDestroyed)));  // once more changes nothing
    EXPECT_EQ(store.layers().size(), 2U);
}

TEST(WeatherStore, FullStoreRefusesNewAndTakesKnown) {
    WeatherStore store;
    std::size_t kept = 0;
    for (int r = 0; r < 20; ++r) {
        for (int id = 0; id < 256; ++id)
            kept += store.set(layer(WeatherScope::kRegional, r, id)) ? 1U : 0U;
    }
    EXPECT_EQ(kept, WeatherStore::kMaxLayers);
    EXPECT_EQ(store.layers().size(), WeatherStore::kMaxLayers);
    EXPECT_TRUE(store.set(layer(WeatherScope::kRegional, 0, 5, 77.0F)));
    EXPECT_EQ(store.layers()[5].visibility, 77.0F);
    store.clear();
    EXPECT_TRUE(store.layers().empty());
}

}  // namespace
}  // namespace skyig::server::world
