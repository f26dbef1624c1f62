#include "clients/skyig/sky/atmosphere.h"

#include "config/air_file.h"
#include "server/from_config.h"

namespace skyig::clients::sky {
namespace {

render::sky::PlanetAir planet_of(const config::Planet& planet) {
    return {.ground_radius_m = planet.ground_radius_m,
            .top_height_m = planet.top_height_m,
            .molecule_height_m = planet.molecule_height_m,
            .rayleigh_per_m = planet.rayleigh_per_m,
            .aerosol_height_m = planet.aerosol_height_m,
            .aerosol_per_m = planet.aerosol_per_m,
            .aerosol_angstrom = planet.aerosol_angstrom,
            .aerosol_albedo_blue = planet.aerosol_albedo_blue,
            .aerosol_albedo_red = planet.aerosol_albedo_red,
            .aerosol_g = planet.aerosol_g,
            .ozone_dobson = planet.ozone_dobson,
            .ground_albedo_blue = planet.ground_albedo_blue,
            .ground_albedo_red = planet.ground_albedo_red};
}

}  // namespace

Atmosphere load_atmosphere(const std::string& name) {
    using namespace render::sky;
    if (name == "A") return {atmosphere_a(), atmosphere_a_law(), {}, {}};
    if (name == "B") return {atmosphere_b(), atmosphere_b_law(), {}, {}};
    const config::AirFileResult read = config::load_air_file(name);
    if (!read) {
        AtmosphereErrors errors;
        for (const config::ConfigError& error : read.errors)
            errors.lines.push_back(config::to_text(error));
        throw errors;
    }
    const config::AirFile& file = *read.file;
    const render::SkySettings sky = server::sky_settings(file.sky);
    const render::NightSettings night = server::night_settings(file.night);
    if (file.planet) {
        const PlanetAir planet = planet_of(*file.planet);
        return {planet_air(planet), planet_law(planet), sky, night};
    }
    const render::Air air = server::air_settings(file.air);
    return {air_model(air), air_law(air), sky, night};
}

}  // namespace skyig::clients::sky
