// Adds the sky to a table: every row of a CSV file gets the place of its body at its time and site.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "clients/skyig/ephem/air.h"
#include "server/ephemeris/bodies.h"
#include "server/ephemeris/sky_state.h"

namespace skyig::clients::ephem {

/// The columns that are appended, in this order. What a row has no meaning for stays empty (azimuth and
/// elevation from the Earth's centre, a face for anything but the Moon).
inline constexpr std::array<std::string_view, 16> kBatchColumns{"skyig_ra_deg",
                                                                "skyig_dec_deg",
                                                                "skyig_az_deg",
                                                                "skyig_el_deg",
                                                                "skyig_el_refracted_deg",
                                                                "skyig_range_km",
                                                                "skyig_semidiameter_arcsec",
                                                                "skyig_phase_angle_deg",
                                                                "skyig_illuminated_fraction",
                                                                "skyig_bright_limb_deg",
                                                                "skyig_magnitude",
                                                                "skyig_subearth_lon_deg",
                                                                "skyig_subearth_lat_deg",
                                                                "skyig_subsolar_lon_deg",
                                                                "skyig_subsolar_lat_deg",
                                                                "skyig_axis_pa_deg"};

struct BatchSettings {
    /// Before every line that is told of the table.
    std::string input_name;
    /// The column of times: one of the usual ones, or any other of UTC times; empty = the first of the usual
    /// ones that is there.
    std::string time_column;
    /// For tables without a column `body`; the Moon if not given.
    std::optional<server::ephemeris::Body> body;
    /// For tables without columns `lat_deg`, `lon_deg`; the Earth's centre if not given.
    std::optional<server::ephemeris::Geodetic> site;
    server::ephemeris::Model model = server::ephemeris::Model::kSeries;
    AirSettings air{};
};

struct BatchCount {
    std::size_t rows = 0;
    std::size_t bad_rows = 0;
};

/// Called once, when the heading has turned out usable.
using OpenOutput = std::function<std::ostream&()>;

/// Reads `input`, writes it with kBatchColumns appended to the output, and tells one line on `errors` for
/// every row that is bad; such a row's new columns stay empty (a row with a wrong number of fields or of more
/// than kMostLineBytes is left out). Lines with '#' and empty lines are left out. Headings may be in
/// capitals. Throws std::runtime_error when the heading cannot be used or the input fails, after the rows
/// before that.
BatchCount run_batch(std::istream& input, const OpenOutput& open_output, std::ostream& errors,
                     const BatchSettings& settings);

}  // namespace skyig::clients::ephem
