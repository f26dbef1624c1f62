#include "clients/skyig/sky/model_solver.h"

namespace skyig::clients::sky {

ModelSolver::ModelSolver(const Atmosphere& atmosphere)
    : settings_(atmosphere.sky),
      tables_(atmosphere.air, render::sky::models::orders_of(atmosphere.sky.model)) {}

void ModelSolver::begin(double altitude_m, double sun_zenith_deg) {
    sky_.begin(settings_, tables_, altitude_m, glm::radians(90.0 - sun_zenith_deg), true);
    sky_.build_all();
}

glm::dvec3 ModelSolver::xyz(double view_zenith_deg, double rel_azimuth_deg) {
    return sky_.xyz(static_cast<float>(glm::radians(90.0 - view_zenith_deg)),
                    static_cast<float>(glm::radians(rel_azimuth_deg)));
}

}  // namespace skyig::clients::sky
