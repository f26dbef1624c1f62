#include "clients/skyig/sky/truth_solver.h"

namespace skyig::clients::sky {

namespace reference = render::sky::reference;

void TruthSolver::begin(double altitude_m, double sun_zenith_deg) {
    view_.eye_height_m = altitude_m;
    view_.sun_zenith_rad = glm::radians(sun_zenith_deg);
}

glm::dvec3 TruthSolver::xyz(double view_zenith_deg, double rel_azimuth_deg) {
    view_.view_zenith_rad = glm::radians(view_zenith_deg);
    view_.relative_azimuth_rad = glm::radians(rel_azimuth_deg);
    constexpr reference::Effort kEffort{0.005, 40 * reference::kPathsARound, 1};
    return solver_.radiance(view_, kEffort).xyz;
}

}  // namespace skyig::clients::sky
