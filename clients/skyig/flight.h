// A recorded flight from a CSV file, and where the aircraft is between two of its rows.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::clients {

/// One row. WGS84 degrees; height in metres as the file has it; attitude in CIGI's sense: yaw true and
/// clockwise, pitch nose up, roll right wing down.
struct FlightPoint {
    double time_s = 0.0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double altitude_m = 0.0;
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
};

/// At least one point; times strictly rising.
class Flight {
  public:
    /// \pre points is not empty and its times rise strictly (read_flight checks this).
    explicit Flight(std::vector<FlightPoint> points);

    [[nodiscard]] double first_time_s() const noexcept { return points_.front().time_s; }
    [[nodiscard]] double last_time_s() const noexcept { return points_.back().time_s; }
    [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }

    /// Straight between the two neighbouring rows, longitude and angles the short way round the circle;
    /// before the first and after the last row the flight stands still. Longitude and roll come out in [-180,
    /// 180], yaw in [0, 360).
    [[nodiscard]] FlightPoint at(double time_s) const noexcept;

  private:
    std::vector<FlightPoint> points_;
};

/// Reads comma-separated rows under a header line that names at least t_s, lat_deg, lon_deg, alt_msl_m (or
/// alt_m), yaw_deg, pitch_deg and roll_deg, in any order and among others; lines that begin with '#' and
/// empty lines are skipped. On the first thing that is wrong: nothing, and `error` is "name:line: what is
/// wrong".
[[nodiscard]] std::optional<Flight> read_flight(std::istream& text, std::string_view name,
                                                std::string& error);

/// read_flight on a file.
[[nodiscard]] std::optional<Flight> load_flight(const std::string& path, std::string& error);

}  // namespace skyig::clients
