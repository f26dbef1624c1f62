#include "config/night.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 3> kModelNames{"sources", "mean", "seed"};

// Both are 0.02 cd/m2 at the zenith of clear air: a brighter glow would show before a town's light is drawn.
constexpr double kMostZenith_cd_m2 = 0.02;
constexpr double kMostHeads_per_km2 = 8000.0;

void read_city_light(TableReader& table, City& city) {
    const bool by_zenith = table.has("zenith_cd_m2");
    if (!by_zenith && !table.has("population"))
        table.require("zenith_cd_m2", "cd/m2 at the zenith over its centre, or population in its place");
    std::optional<double> zenith_cd_m2, heads;
    table.number("zenith_cd_m2", zenith_cd_m2, {0.0, kMostZenith_cd_m2, "cd/m2", true});
    city.zenith_cd_m2 = zenith_cd_m2.value_or(0.0);
    const Value* population = table.number("population", heads, {0.0, 1e8, {}, true});
    if (population == nullptr) return;
    city.population = *heads;
    if (by_zenith)
        table.error(*population, "population", "stands beside zenith_cd_m2; only one of them may be given");
    const double heads_per_km2 = city.population / (std::numbers::pi * city.radius_km * city.radius_km);
    if (heads_per_km2 > kMostHeads_per_km2)
        table.error(*population, "population",
                    fmt::format("is {:.0f} a km2 of its disc; at most {:.0f}: give a wider radius_km",
                                heads_per_km2, kMostHeads_per_km2));
}

void read_city(TableReader& table, City& city) {
    table.number("latitude_deg", city.latitude_deg, {-90.0, 90.0, "degrees"});
    table.number("longitude_deg", city.longitude_deg, {-360.0, 360.0, "degrees"});
    table.require("latitude_deg", "degrees north");
    table.require("longitude_deg", "degrees east");
    table.number("radius_km", city.radius_km, {0.1, 100.0, "km"});
    read_city_light(table, city);
    table.finish();
}

void read_cities(TableReader& night, ErrorList& errors, std::vector<City>& cities) {
    const Value* value = night.any("city");
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr) {
        night.error(*value, "city", "must be tables: write [[night.city]] in double brackets");
        return;
    }
    if (list->items.size() > kMaxCities) {
        night.error(*value, "city",
                    fmt::format("is there {} times; at most {}", list->items.size(), kMaxCities));
        return;
    }
    for (const Value& item : list->items) {
        const auto* table = std::get_if<Table>(&item.data);
        if (table == nullptr) {
            night.error(item, "city", fmt::format("holds {}; write [[night.city]] tables", type_name(item)));
            continue;
        }
        TableReader reader(errors, table, item.place, fmt::format("night.city[{}]", cities.size() + 1));
        read_city(reader, cities.emplace_back());
    }
}

}  // namespace

void read_night(TableReader table, ErrorList& errors, Night& night) {
    table.choice("model", night.model, kModelNames);
    table.boolean("airglow", night.airglow);
    table.boolean("zodiacal", night.zodiacal);
    table.boolean("starlight", night.starlight);
    table.boolean("galactic_light", night.galactic_light);
    table.number("milky_way_structure", night.milky_way_structure, {0.0, 1.0, {}});
    table.integer("seed", night.seed, 0, std::numeric_limits<int>::max());
    table.number("solar_activity", night.solar_activity, {0.0, 1.0, {}});
    read_cities(table, errors, night.cities);
    table.finish();
}

}  // namespace skyig::config
