// Which cloud it is, where nobody says so.
#pragma once

#include "config/weather.h"

namespace skyig::server {

/// By height above the ground and amount: low ones are stratus, in the middle stratocumulus where they cover
/// more than half of the sky, else cumulus; altocumulus (altostratus where they leave nothing) up to 6 km,
/// cirrus (cirrostratus) above.
/// \param coverage  0..1
[[nodiscard]] config::LayerType likely_genus(double base_agl_m, double coverage) noexcept;

/// A usual thickness of the genus, metres.
[[nodiscard]] double usual_thickness_m(config::LayerType cloud) noexcept;

}  // namespace skyig::server
