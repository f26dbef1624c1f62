// From the world's state to the renderer's scene, once a frame.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "render/scene.h"
#include "server/ephemeris/earth_orientation.h"
#include "server/ephemeris/sky_clockwork.h"
#include "server/weather/weather_builder.h"
#include "server/world/world.h"

namespace skyig::server {

/// Angles of what is drawn, for people (reports, `skyig shot`): airless, topocentric.
struct SkyAngles {
    double sun_elevation_deg = 0.0;
    double sun_azimuth_deg = 0.0;
    double moon_elevation_deg = 0.0;
    double moon_azimuth_deg = 0.0;
    /// Part of the Moon's disc that is lit, 0..1.
    double moon_lit_fraction = 0.0;
};

/// Keeps what the ephemeris has computed for the frames to come, and the weather that is on its way to what
/// is told; all else of a scene depends on the world alone.
///
/// The eye is the ownship's position plus the mean of all channels' offsets, turned by the attitude; the
/// scene's axes are east-north-up there. A view's axes: ownship, then its group, then the view itself, each
/// yaw, pitch, roll. build() allocates nothing. Cost: under 10 microseconds while time runs on.
class SceneBuilder {
  public:
    /// \param model  which series place the bodies
    /// \param orientation  UT1 and pole as measured; without rows the built-in tables hold
    /// \param ground  below the air; its wind is the world's; snow and water come on top as they
    /// fall, until a host says how much there is
    /// \param sky  what draws the day sky; where it says the Sun's place, the Sun stands there
    /// \param night  what shines in the dark one
    /// \param weather  how layers are drawn and how they change
    explicit SceneBuilder(ephemeris::Model model = ephemeris::Model::kSeries,
                          ephemeris::EarthOrientation orientation = {}, const render::SkySettings& sky = {},
                          const render::Ground& ground = {}, const render::NightSettings& night = {},
                          const weather::WeatherSettings& weather = {})
        : orientation_(std::move(orientation)),
          sky_(sky),
          ground_(ground),
          night_(night),
          clockwork_(model),
          weather_(weather) {}

    [[nodiscard]] render::Scene build(const world::World& world, std::uint64_t frame_number);

    /// Largest distance of a view's eye point from the one eye that is drawn, in the last scene.
    [[nodiscard]] double eye_spread_m() const noexcept { return eye_spread_m_; }
    /// The last scene's date lay outside what the ephemeris knows and was brought to the nearest that it
    /// does.
    [[nodiscard]] bool date_clamped() const noexcept { return instant_.clamped; }
    /// The last scene's date lies beyond the announced leap seconds.
    [[nodiscard]] bool leap_seconds_assumed() const noexcept { return instant_.leap_seconds_assumed; }
    /// Layers of weather for which the last scene had no place.
    [[nodiscard]] std::size_t weather_left_out() const noexcept { return weather_.left_out(); }
    [[nodiscard]] const ephemeris::EarthOrientation& orientation() const noexcept { return orientation_; }

  private:
    void place_eye(const world::World& world, render::Scene& scene);
    void aim_views(const world::World& world, render::Scene& scene) noexcept;

    ephemeris::EarthOrientation orientation_;
    render::SkySettings sky_;
    render::Ground ground_;
    render::NightSettings night_;
    ephemeris::OffsetsOfDay offsets_;
    ephemeris::SkyClockwork clockwork_;
    weather::WeatherBuilder weather_;
    /// Of the frame at hand: east-north-up at the ownship from that at the eye, row by row as the library
    /// fills it.
    std::vector<double> ownship_from_eye_ = std::vector<double>(9);
    double eye_spread_m_ = 0.0;
    ephemeris::Instant instant_;
};

[[nodiscard]] SkyAngles sky_angles(const render::Scene& scene) noexcept;

}  // namespace skyig::server
