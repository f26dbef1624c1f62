// Pictures of error against cost.
#pragma once

#include <string>

#include "clients/bench/report.h"

namespace skyig::clients::bench {

/// A stand-alone SVG: cost of one call in ns to the right, largest error upwards, both logarithmic; one
/// colour and line a series, one shape a model. It brings its own background, light or dark as the reader's
/// system is. Points without an entry, or with an error or cost of zero, cannot be drawn and are left out;
/// without any point it says so.
[[nodiscard]] std::string to_svg(const Report& report, const Plot& plot);

/// The same for curves: x logarithmic, y 0 to 1, one colour each. Points with x <= 0 are left out.
[[nodiscard]] std::string to_svg(const CurvePlot& plot);

/// `text` as character data or attribute value of XML.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace skyig::clients::bench
