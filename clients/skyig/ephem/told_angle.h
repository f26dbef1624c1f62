// Angles of a circle as they are written, in lines and tables alike.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace skyig::clients::ephem {

/// With so many decimals, at least `width` wide, and never as 360: what rounds up to it is 0.
[[nodiscard]] inline std::string told_in_circle(double angle_deg, int decimals, int width = 0) {
    const double half_a_unit = 0.5 * std::pow(10.0, -decimals);
    return fmt::format("{:{}.{}f}", angle_deg + half_a_unit < 360.0 ? angle_deg : 0.0, width, decimals);
}

}  // namespace skyig::clients::ephem
