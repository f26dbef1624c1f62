// Light of a plane slab of cloud, for one case or for a table of them: every row of a CSV file gets what
// skyig has for its quantity.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "render/cloud/slab_light.h"

namespace skyig::clients::cloud {

/// Columns that have to be there, in any order and case, and the one that is appended.
inline constexpr std::array<std::string_view, 7> kCaseColumns{
    "optical_depth", "asymmetry_g",     "single_scattering_albedo", "sun_zenith_deg",
    "quantity",      "view_zenith_deg", "rel_azimuth_deg"};
inline constexpr std::string_view kValueColumn = "skyig_value";

enum class Quantity : std::size_t { kReflectedBrf, kTransmittedBrf, kReflected, kDiffuse, kDirect };
/// By Quantity: as tests/data/weather has them.
inline constexpr std::array<std::string_view, 5> kQuantityNames{"R_brf", "T_brf", "R_flux", "T_diffuse_flux",
                                                                "T_direct_flux"};

struct Case {
    render::cloud::Slab64 slab;
    /// None: even light on the whole top; it has fluxes alone.
    std::optional<double> sun_zenith_deg = 0.0;
    double view_zenith_deg = 0.0;
    /// 0 where the light goes on in the Sun's direction.
    double rel_azimuth_deg = 0.0;
};

/// Fluxes are the same for all models: those that light the ground.
[[nodiscard]] double value_of(render::cloud::SlabModel model, const Case& slab_case, Quantity quantity);

struct CaseCount {
    std::size_t rows = 0;
    std::size_t bad_rows = 0;
};

/// Called once, when the heading has turned out usable.
using OpenOutput = std::function<std::ostream&()>;

/// Writes `input` with kValueColumn appended, in the same order. Tells one line with name, line and column on
/// `errors` for every row that is bad; its new column stays empty, and a row with a wrong number of fields is
/// left out. Lines with '#' and empty lines are left out. \throws std::runtime_error when the heading cannot
/// be used or the input fails
CaseCount run_cases(std::istream& input, const std::string& input_name, const OpenOutput& open_output,
                    std::ostream& errors, render::cloud::SlabModel model);

}  // namespace skyig::clients::cloud
