#include "config/air_file.h"

#include "config/document.h"
#include "config/schema.h"

namespace skyig::config {
namespace {

void read_planet(TableReader table, Planet& planet) {
    table.number("ground_radius_m", planet.ground_radius_m, {1e5, 1e8, "m"});
    table.number("top_height_m", planet.top_height_m, {1e3, 1e6, "m"});
    table.number("molecule_height_m", planet.molecule_height_m, {10.0, 1e6, "m"});
    table.number("rayleigh_per_m", planet.rayleigh_per_m, {0.0, 0.01, "1/m"});
    table.number("aerosol_height_m", planet.aerosol_height_m, {10.0, 1e6, "m"});
    table.number("aerosol_per_m", planet.aerosol_per_m, {0.0, 0.01, "1/m"});
    table.number("aerosol_angstrom", planet.aerosol_angstrom, {-2.0, 4.0, {}});
    table.number("aerosol_albedo_blue", planet.aerosol_albedo_blue, {0.0, 1.0, {}});
    table.number("aerosol_albedo_red", planet.aerosol_albedo_red, {0.0, 1.0, {}});
    table.number("aerosol_g", planet.aerosol_g, {-0.95, 0.95, {}});
    table.number("ozone_dobson", planet.ozone_dobson, {0.0, 1000.0, "DU"});
    table.number("ground_albedo_blue", planet.ground_albedo_blue, {0.0, 1.0, {}});
    table.number("ground_albedo_red", planet.ground_albedo_red, {0.0, 1.0, {}});
    table.finish();
}

}  // namespace

AirFileResult parse_air_file(std::string_view text, const std::string& file_name) {
    Table document;
    ConfigError syntax{file_name, 0, 0, {}, {}};
    if (!parse_document(text, document, syntax)) return {std::nullopt, {std::move(syntax)}};
    ErrorList errors(file_name);
    AirFile file;
    TableReader root(errors, &document, {}, {});
    read_air(root.table("air"), file.air);
    read_sky(root.table("sky"), file.sky);
    read_night(root.table("night"), errors, file.night);
    if (document.find("planet") != nullptr) file.planet.emplace();
    Planet unused;
    read_planet(root.table("planet"), file.planet ? *file.planet : unused);
    root.finish();
    if (errors.empty()) return {std::move(file), {}};
    return {std::nullopt, std::move(errors).sorted()};
}

AirFileResult load_air_file(const std::string& path) {
    ConfigError error;
    const std::optional<std::string> text = read_settings_text(path, error);
    if (!text) return {std::nullopt, {std::move(error)}};
    return parse_air_file(*text, path);
}

}  // namespace skyig::config
