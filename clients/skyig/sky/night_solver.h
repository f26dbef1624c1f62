// Rows answered by all that the renderer draws from dusk to dawn: sky of Sun and Moon, and the dark sky's own
// light.
#pragma once

#include <optional>

#include "clients/skyig/sky/atmosphere.h"
#include "clients/skyig/sky/cases.h"
#include "render/night/milky_way_map.h"
#include "render/night/night_sky.h"
#include "render/plan.h"
#include "render/sky/air_tables.h"
#include "render/sky/models/day_sky.h"
#include "render/sky_light.h"

namespace skyig::clients::sky {

/// Of the Moon, at its mean distance.
struct MoonPlace {
    double phase_angle_deg = 0.0;
    double elevation_deg = 45.0;
    /// From the Sun.
    double rel_azimuth_deg = 180.0;
};

/// A real sky; turned about the vertical so that its Sun stands where the rows have theirs.
struct RealSky {
    glm::dmat3 enu_from_gcrs{1.0};
    glm::dvec3 sun_enu{0.0, 0.0, -1.0};
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
};

/// The eye of altitude 0 stands on the ground; elevations are airless. What the plan fades out is faded out:
/// the dark sky by day, twilight by night.
class NightSolver final : public Solver {
  public:
    /// \param real  not given: zodiacal light and starlight at their means, whatever the settings' model, and
    /// no town
    NightSolver(const Atmosphere& atmosphere, const std::optional<MoonPlace>& moon,
                const std::optional<RealSky>& real);

    void begin(double altitude_m, double sun_zenith_deg) override;
    [[nodiscard]] glm::dvec3 xyz(double view_zenith_deg, double rel_azimuth_deg) override;

  private:
    void light_by_sun_and_moon(const render::Plan& plan);

    std::optional<MoonPlace> moon_;
    render::Scene scene_;
    render::Scene dark_scene_;  // the same under the real sky's own Sun
    render::sky::AirTables tables_;
    render::sky::models::DaySky sun_sky_;
    render::sky::models::DaySky moon_sky_;
    render::night::NightSky night_sky_;
    render::night::MilkyWayMap milky_way_;
    render::SkyLight light_;
};

}  // namespace skyig::clients::sky
