// From the world's weather to the renderer's, once a frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/weather.h"
#include "render/scene.h"
#include "server/weather/drifts.h"
#include "server/weather/gather.h"
#include "server/weather/ground_cover.h"
#include "server/weather/ramps.h"
#include "server/world/world.h"

namespace skyig::server::weather {

/// Numbers of render::CloudGenus, 0 with them.
inline constexpr std::size_t kCloudGenera = 11;

struct WeatherSettings {
    /// How long a change takes, >= 0.
    double transition_s = 10.0;
    /// Height of the ground above the ellipsoid: wind and unnamed clouds go by the height above it.
    double elevation_m = 0.0;
    render::CloudModel clouds = render::CloudModel::kAuto;
    /// They make the air, the stars and the colours of the sky, and scale the clouds; none: the host does.
    std::optional<config::Keyframes> keyframes;
    /// Of genera that are drawn as sheets of their own, by render::CloudGenus.
    std::array<std::optional<render::CloudLook>, kCloudGenera> looks;
};

[[nodiscard]] WeatherSettings weather_settings(const config::Weather& weather);

/// Fills the scene's weather, and its air's visibility while that changes. What is told is shown after
/// `transition_s`; the first frame, a jump of the clock and the world's reset are shown at once.
///
/// The air is drawn down to a visibility of 1 km; what it dims beyond that is fog over the ground, with the
/// height of the air's own haze. Depends on the world's state and scene time, frame by frame: two builders
/// that see the same worlds make the same scenes, bit for bit. Allocates at construction only.
class WeatherBuilder {
  public:
    explicit WeatherBuilder(const WeatherSettings& settings = {});

    /// \param scene  its eye, time, air, stars and sky are set
    void build(const world::World& world, render::Scene& scene);

    /// Of the last frame: layers for which the scene has no place, the furthest.
    [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }

    /// Of the land below the eye: it soaks in minutes, dries in half an hour and whitens in an hour. A reset
    /// of the world clears it; a clock that is set finds it as wet as it will be, under the snow that lay.
    [[nodiscard]] const GroundCover& ground() const noexcept { return ground_; }

  private:
    [[nodiscard]] bool jumped(const world::World& world, double time_s) noexcept;
    void settle_air(render::Scene& scene, bool at_once) noexcept;
    void move_eye(const render::Eye& eye, double time_s, bool at_once, render::Weather& weather) noexcept;
    void show(const EyePlane& plane, const render::Scene& scene, render::Weather& weather) noexcept;
    void show_cloud(const ShownLayer& layer, const render::Scene& scene,
                    const std::optional<render::WeatherArea>& area, render::Weather& weather) noexcept;
    void show_obscurant(const ShownLayer& layer, const render::Scene& scene,
                        const std::optional<render::WeatherArea>& area, render::Weather& weather) noexcept;
    void add(const render::Obscurant& made, render::Weather& weather) noexcept;
    void show_falling(const ShownLayer& layer, const render::Scene& scene,
                      const std::optional<render::WeatherArea>& area, render::Weather& weather) noexcept;
    void cover_ground(const render::Scene& scene, bool at_once) noexcept;
    void carry(const world::AirState& air, double time_s) noexcept;
    [[nodiscard]] glm::dvec3 wind_at_eye(const world::World& world, const EyePlane& plane,
                                         const render::Eye& eye) const noexcept;

    WeatherSettings settings_;
    Gatherer gatherer_;
    Ramps ramps_;
    Drifts drifts_;
    Glide air_place_{0.0};  // on render::ExtinctionScale
    std::array<std::uint8_t, Ramps::kMost> order_{};
    std::array<double, Ramps::kMost> distance_m_{};
    std::optional<double> time_s_;
    std::uint64_t resets_ = 0;
    glm::dvec3 eye_ecef_m_{0.0};
    glm::dvec3 eye_velocity_ecef_m_s_{0.0};
    bool eye_moves_ = false;
    std::size_t left_out_ = 0;
    /// What falls on the ground below the eye in this frame.
    Reaching reaching_;
    GroundCover ground_;
    /// Of clouds, by the keyframes.
    double cloud_cover_ = 1.0;
};

}  // namespace skyig::server::weather
