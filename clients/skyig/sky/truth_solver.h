// Rows answered by the reference solver: the truth that the models are held against.
#pragma once

#include "clients/skyig/sky/cases.h"
#include "render/sky/reference/sky_solver.h"

namespace skyig::clients::sky {

/// Luminance is known to half a percent (one sigma) where 40,000 paths reach that. The same row gets the same
/// answer whatever stands beside it.
class TruthSolver final : public Solver {
  public:
    explicit TruthSolver(const render::sky::AirLaw& law) : solver_(law) {}

    void begin(double altitude_m, double sun_zenith_deg) override;
    [[nodiscard]] glm::dvec3 xyz(double view_zenith_deg, double rel_azimuth_deg) override;

  private:
    render::sky::reference::SkySolver solver_;
    render::sky::reference::View view_;
};

}  // namespace skyig::clients::sky
