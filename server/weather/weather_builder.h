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
#include "server/weather/ramps.h"
#include "server/world/world.h"

namespace skyig::server::weather {

struct WeatherSettings {
    /// How long a change takes, >= 0.
    double transition_s = 10.0;
    /// Height of the ground above the ellipsoid: wind and unnamed clouds go by the height above it.
    double elevation_m = 0.0;
    render::CloudModel clouds = render::CloudModel::kAuto;
    /// They make the air, the stars and the colours of the sky, and scale the clouds; none: the host does.
    std::optional<config::Keyframes> keyframes;
};

[[nodiscard]] WeatherSettings weather_settings(const config::Weather& weather) noexcept;

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

    /// How wet rain has made the land below the eye, 0..1: it soaks in minutes and dries in half an hour.
    [[nodiscard]] double wet() const noexcept { return wet_; }

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
    void soak(double time_s, bool at_once) noexcept;
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
    /// What rains on the ground below the eye in this frame.
    double rain_mm_h_ = 0.0;
    double wet_ = 0.0;
    /// Of clouds, by the keyframes.
    double cloud_cover_ = 1.0;
};

}  // namespace skyig::server::weather
