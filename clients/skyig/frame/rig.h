// A rig of channels that flies through a scene, for what its frames take. It draws into an OpenGL context
// that must be current.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "clients/skyig/still/still.h"
#include "render/renderer.h"
#include "server/clock.h"

namespace skyig::clients {

struct RigSize {
    std::string_view name;
    int width_px;
    int height_px;
    int channels;
};
inline constexpr RigSize kOneChannel{"1280x1024", 1280, 1024, 1};
inline constexpr RigSize kThreeChannels{"3 x 1280x1024", 1280, 1024, 3};

struct RigSetting {
    std::string_view name;
    std::string_view utc;
    /// A preset; empty: no weather.
    std::string_view weather;
    double height_m;
    double heading_deg;
    double pitch_deg;
};
inline constexpr RigSetting kDay{"day", "2026-06-21T09:00:00Z", "", 600.0, 300.0, 5.0};
inline constexpr RigSetting kNight{"night", "2026-01-15T23:00:00Z", "", 600.0, 150.0, 20.0};
inline constexpr RigSetting kBroken{"broken cloud", "2026-06-21T09:00:00Z", "broken", 300.0, 300.0, 5.0};
inline constexpr RigSetting kInCloud{"in cloud", "2026-06-21T09:00:00Z", "broken", 900.0, 300.0, 5.0};

/// \throws StillErrors
[[nodiscard]] Still still_of(const RigSetting& setting, const RigSize& size, const server::Clock& clock);

struct FrameTime {
    double wall_ms = 0.0;
    /// Of all threads: other work on the machine touches it less.
    double processor_ms = 0.0;
};

class Rig {
  public:
    Rig(Still still, const server::Clock& clock);

    [[nodiscard]] render::Scene& scene() noexcept { return scene_; }
    [[nodiscard]] render::Renderer& renderer() noexcept { return renderer_; }

    /// Flies on and draws all channels, finished. \return what it took
    FrameTime frame();

  private:
    const server::Clock& clock_;
    render::Scene scene_;
    render::Renderer renderer_;
};

/// Until then shaders are compiled, and the first cloud map is blended in.
inline constexpr int kWarmUpFrames = 20;

/// \param values  not empty
[[nodiscard]] double quantile(std::vector<double> values, double q);
[[nodiscard]] double mean(const std::vector<double>& values);

}  // namespace skyig::clients
