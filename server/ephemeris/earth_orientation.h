// UT1 and the pole as measured: a file of Earth orientation, read once and looked up each frame.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/ephemeris/time.h"

namespace skyig::server::ephemeris {

/// A row of a file, at 0h UTC of its day if `mjd` is whole.
struct EarthOrientationRow {
    double mjd = 0.0;
    double ut1_minus_utc_s = 0.0;
    double x_arcsec = 0.0;
    double y_arcsec = 0.0;
};

/// UT1 and pole between two days of a file, linear in TT (of UT1 - TT, which has no leap seconds). From the
/// file's ends it goes over to the built-in tables (known_offsets(), pole 0) within a day each; further away,
/// and where it holds nothing, it says nothing. Rows before 1972 give the pole only, since the clock's UTC is
/// UT1 there. Immutable, so that any number of threads may ask.
class EarthOrientation {
  public:
    /// Knows nothing.
    EarthOrientation() = default;
    /// At least two rows, ascending; read_earth_orientation() sees to what files get wrong. Fewer: as none.
    explicit EarthOrientation(const std::vector<EarthOrientationRow>& rows);

    /// Offsets for make_instant(). Allocates nothing.
    [[nodiscard]] TimeOffsets at(const UtcClockTime& utc) const noexcept;
    /// The same for who has looked up `known` = known_offsets(utc) already.
    [[nodiscard]] TimeOffsets at(const UtcClockTime& utc, const KnownOffsets& known) const noexcept;

    [[nodiscard]] bool empty() const noexcept { return days_.empty(); }
    [[nodiscard]] std::size_t size() const noexcept { return days_.size(); }
    /// Of the first and the last row; 0 without rows.
    [[nodiscard]] double first_mjd() const noexcept { return first_mjd_; }
    [[nodiscard]] double last_mjd() const noexcept { return last_mjd_; }

  private:
    struct Day {
        /// Modified Julian date in TT.
        double tt_mjd = 0.0;
        double ut1_minus_tt_s = 0.0;
        double x_rad = 0.0;
        double y_rad = 0.0;
    };

    [[nodiscard]] Day between(double tt_mjd) const noexcept;

    std::vector<Day> days_;
    /// From where UT1 is the file's (never, if all of it is before 1972), and how far the tables are from it
    /// at both ends.
    double ut1_from_tt_mjd_ = std::numeric_limits<double>::infinity();
    double correction_at_first_s_ = 0.0;
    double correction_at_last_s_ = 0.0;
    double first_mjd_ = 0.0;
    double last_mjd_ = 0.0;
};

/// Either the file's content or one line that says which file, which line and what would be right.
struct EarthOrientationResult {
    std::optional<EarthOrientation> orientation;
    std::string error;

    explicit operator bool() const noexcept { return orientation.has_value(); }
};

/// Reads one of three forms, told apart by the first line that is neither empty nor begins with '#':
/// - IERS finals2000A (.all, .data, .daily), fixed columns: MJD 8-15, pole x 19-27, y 38-46 arcsec,
///   UT1-UTC 59-68 s of Bulletin A; rows in which these are blank (beyond the predictions) are left out;
/// - IERS EOP 20 C04, text columns: year, month, day, hour, MJD, x, y arcsec, UT1-UTC s, more;
/// - commas under the heading mjd,ut1_minus_utc_s,x_arcsec,y_arcsec.
/// Days ascend from 1900 to 2100, at most 31 apart, at least two of them; |UT1-UTC| <= 1 s, |x|, |y| <= 1
/// arcsec. At most 16 MiB. Does not throw on anything that a file may hold.
[[nodiscard]] EarthOrientationResult read_earth_orientation(const std::string& path);

/// The same from text; `file_name` only names it in the error.
[[nodiscard]] EarthOrientationResult parse_earth_orientation(std::string_view text,
                                                             const std::string& file_name);

}  // namespace skyig::server::ephemeris
