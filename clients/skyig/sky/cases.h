// Adds the light of the sky to a table: every row of a CSV file gets luminance and chromaticity of its
// direction.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <istream>
#include <ostream>
#include <string>
#include <string_view>

namespace skyig::clients::sky {

/// Columns that have to be there, in any order and case, and those that are appended.
inline constexpr std::array<std::string_view, 4> kCaseColumns{"altitude_m", "sun_zenith_deg",
                                                              "view_zenith_deg", "rel_azimuth_deg"};
inline constexpr std::array<std::string_view, 3> kSkyColumns{"skyig_Y_cd_m2", "skyig_x", "skyig_y"};

/// Answers the rows of one table. begin() is called once for each pair of altitude and Sun, before its
/// directions.
class Solver {
  public:
    virtual ~Solver() = default;
    /// \param altitude_m  above the model's ground, 0..1e9; \param sun_zenith_deg  0..180
    virtual void begin(double altitude_m, double sun_zenith_deg) = 0;
    /// XYZ in cd/m2, finite. \param view_zenith_deg  0 up .. 180 down; \param rel_azimuth_deg  from the Sun's
    [[nodiscard]] virtual glm::dvec3 xyz(double view_zenith_deg, double rel_azimuth_deg) = 0;

  protected:
    Solver() = default;
    Solver(const Solver&) = default;
    Solver& operator=(const Solver&) = default;
};

struct CaseCount {
    std::size_t rows = 0;
    std::size_t bad_rows = 0;
    /// Pairs of altitude and Sun.
    std::size_t tables = 0;
};

/// Called once, when the heading has turned out usable.
using OpenOutput = std::function<std::ostream&()>;

/// Reads `input` whole and writes it with kSkyColumns appended, in the same order; black has chromaticity 0,
/// 0. Tells one line with name, line and column on `errors` for every row that is bad; such a row's new
/// columns stay empty, and one with a wrong number of fields is left out. Lines with '#' and empty lines are
/// left out. \throws std::runtime_error when the heading cannot be used or the input fails
CaseCount run_cases(std::istream& input, const std::string& input_name, const OpenOutput& open_output,
                    std::ostream& errors, Solver& solver);

}  // namespace skyig::clients::sky
