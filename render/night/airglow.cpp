#include "render/night/airglow.h"

#include <algorithm>
#include <cmath>

#include "render/geometry.h"
#include "render/night/star_colour.h"

namespace skyig::render::night {

namespace {

constexpr double kThickness_m = 8e3;

}  // namespace

double airglow_zenith_s10(double solar_activity) noexcept {
    return 145.0 * (1.0 + std::clamp(solar_activity, 0.0, 1.0));
}

AirglowPath airglow_path(double elevation_rad, double height_m, bool ground) noexcept {
    const double height = std::max(height_m, 0.0);
    const double layer_m = kEarthRadius_m + kAirglowHeight_m;
    const double level = (kEarthRadius_m + height) * std::cos(elevation_rad) / layer_m;
    // A ray that only grazes the layer fades out over its thickness.
    const double grazes = std::clamp(0.5 + (1.0 - level) * layer_m / kThickness_m, 0.0, 1.0);
    const double slant2 = std::max(0.0, (1.0 - level) * (1.0 + level)) + kThickness_m / layer_m;
    const double once = grazes / std::sqrt(slant2);
    const double below = std::clamp(0.5 + (kAirglowHeight_m - height) / kThickness_m, 0.0, 1.0);
    const bool falls = elevation_rad < 0.0;
    // An upward ray meets what of the layer is above the eye. A downward one meets what is below, and unless
    // the ground ends it comes up through the whole on the other side.
    if (!falls) return {0.0, below * once};
    return {(1.0 - below) * once, ground ? 0.0 : once};
}

glm::dvec3 airglow_colour() noexcept {
    // Radiance in rayleigh times photon energy times the observer's x, y and z, line by line, then continuum.
    constexpr glm::dvec3 kXyz = glm::dvec3{0.58, 0.9993, 0.0030} * (250.0 / 557.7) +
                                glm::dvec3{1.02, 0.7690, 0.0011} * (60.0 / 589.3) +
                                glm::dvec3{0.6424, 0.2650, 0.0} * (120.0 / 630.0) +
                                glm::dvec3{1068.6, 1068.6, 1068.6} * (0.35 / 560.0);
    const double sum = kXyz.x + kXyz.y + kXyz.z;
    return linear_rec709_of_xy({kXyz.x / sum, kXyz.y / sum});
}

}  // namespace skyig::render::night
