// A description of the air alone, for tools that need no site: [air], [sky] and [night] as in a
// configuration, or [planet] in place of [air].
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"

namespace skyig::config {

/// [planet]: an exponential air by its numbers; what is not given is the Earth's.
struct Planet {
    double ground_radius_m = 6371.0e3;
    double top_height_m = 120.0e3;
    double molecule_height_m = 8000.0;
    double rayleigh_per_m = 1.16e-5;
    double aerosol_height_m = 1200.0;
    double aerosol_per_m = 2.0e-5;
    double aerosol_angstrom = 1.2;
    double aerosol_albedo_blue = 0.94;
    double aerosol_albedo_red = 0.94;
    double aerosol_g = 0.75;
    double ozone_dobson = 300.0;
    double ground_albedo_blue = 0.08;
    double ground_albedo_red = 0.2;
};

struct AirFile {
    Air air;
    Sky sky;
    Night night;
    /// Given: the air is this, and [air] says nothing.
    std::optional<Planet> planet;
};

/// Either a complete description or every error of the file.
struct AirFileResult {
    std::optional<AirFile> file;
    std::vector<ConfigError> errors;

    explicit operator bool() const noexcept { return file.has_value(); }
};

[[nodiscard]] AirFileResult load_air_file(const std::string& path);
/// The same from text; `file_name` only names it in errors.
[[nodiscard]] AirFileResult parse_air_file(std::string_view text, const std::string& file_name);

}  // namespace skyig::config
