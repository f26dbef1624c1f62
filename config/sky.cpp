#include "config/sky.h"

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 6> kModelNames{"multi", "single",   "daycycle",
                                                      "cie",   "preetham", "windlight"};
constexpr std::array<std::string_view, 2> kZenithNames{"printed", "multi"};

void read_colour(TableReader& table, std::string_view key, std::array<double, 3>& out) {
    table.numbers(key, out, {0.0, 10.0, {}}, "three numbers: [red, green, blue]");
}

void read_cie(TableReader table, CieSky& cie) {
    table.integer("type", cie.type, 1, 16);
    table.number("zenith_luminance_cd_m2", cie.zenith_luminance_cd_m2, {0.0, 1e6, "cd/m2"});
    table.finish();
}

void read_preetham(TableReader table, PreethamSky& preetham) {
    table.number("turbidity", preetham.turbidity, {2.0, 10.0, {}});
    table.choice("zenith", preetham.zenith_of_multi, kZenithNames);
    table.finish();
}

void read_windlight(TableReader table, WindlightSky& look) {
    read_colour(table, "blue_horizon", look.blue_horizon);
    table.number("haze_horizon", look.haze_horizon, {0.0, 10.0, {}});
    read_colour(table, "blue_density", look.blue_density);
    table.number("haze_density", look.haze_density, {0.0, 10.0, {}});
    table.number("density_per_m", look.density_per_m, {0.0, 1.0, "1/m"});
    table.number("max_altitude_m", look.max_altitude_m, {1.0, 100'000.0, "m"});
    read_colour(table, "sunlight", look.sunlight);
    read_colour(table, "ambient", look.ambient);
    table.number("glow_size", look.glow_size, {0.01, 100.0, {}});
    table.number("glow_floor", look.glow_floor, {0.001, 2.0, {}});
    table.number("glow_power", look.glow_power, {-3.0, 0.0, {}});
    table.number("horizon_drop", look.horizon_drop, {0.0, 0.5, {}});
    table.number("unit_cd_m2", look.unit_cd_m2, {0.0, 1e6, "cd/m2"});
    table.number("sun_angle_deg", look.sun_angle_deg, {-360.0, 360.0, "degrees"});
    table.number("east_angle_deg", look.east_angle_deg, {-360.0, 360.0, "degrees"});
    table.finish();
}

void read_day_cycle(TableReader table, DayCycleSky& cycle) {
    table.number("desaturation", cycle.desaturation, {0.0, 1.0, {}});
    table.finish();
}

}  // namespace

void read_sky(TableReader table, Sky& sky) {
    table.boolean("sun", sky.sun);
    table.boolean("moon", sky.moon);
    table.boolean("stars", sky.stars);
    table.number("star_intensity_pct", sky.star_intensity_pct, {0.0, 100.0, "%"});
    table.boolean("star_scintillation", sky.star_scintillation);
    table.choice("model", sky.model, kModelNames);
    read_day_cycle(table.table("daycycle"), sky.day_cycle);
    read_cie(table.table("cie"), sky.cie);
    read_preetham(table.table("preetham"), sky.preetham);
    read_windlight(table.table("windlight"), sky.windlight);
    table.finish();
}

}  // namespace skyig::config
