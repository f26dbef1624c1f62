#include "clients/skyig/frame/rig.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numeric>
#include <utility>

#include "render/clouds.h"
#include "server/from_config.h"

namespace skyig::clients {

namespace {

constexpr double kRate_hz = 60.0;
constexpr double kSpeed_m_s = 100.0;

/// A craft that flies east, so that clouds have to be followed.
void fly_on(render::Scene& scene) {
    constexpr double kMetresADegree = 111'320.0;
    scene.time_s += 1.0 / kRate_hz;
    ++scene.frame_number;
    scene.weather.eye_velocity_m_s = {kSpeed_m_s, 0.0, 0.0};
    scene.eye.longitude_deg +=
        kSpeed_m_s / kRate_hz / (kMetresADegree * std::cos(glm::radians(scene.eye.latitude_deg)));
}

/// The same view turned to the right about its own upward axis.
render::ChannelView turned(const render::ChannelView& view, double right_deg) {
    const double a = glm::radians(right_deg);
    const glm::dmat3 turn{glm::dvec3{std::cos(a), 0.0, -std::sin(a)}, glm::dvec3{0.0, 1.0, 0.0},
                          glm::dvec3{std::sin(a), 0.0, std::cos(a)}};
    render::ChannelView out = view;
    out.view_from_enu = turn * view.view_from_enu;
    return out;
}

}  // namespace

Still still_of(const RigSetting& setting, const RigSize& size, const server::Clock& clock) {
    StillOptions options;
    options.utc = setting.utc;
    options.weather_preset = setting.weather;
    options.height_m = setting.height_m;
    options.heading_deg = setting.heading_deg;
    options.pitch_deg = setting.pitch_deg;
    options.width_px = size.width_px;
    options.height_px = size.height_px;
    Still still = make_still(options, clock);
    const config::Channel first = still.config.channels.front();
    for (int i = 1; i < size.channels; ++i) {
        still.config.channels.push_back(first);
        const auto index = static_cast<std::size_t>(i);
        still.scene.views[index] = turned(still.scene.views[0], i == 1 ? 60.0 : -60.0);
        still.scene.view_count = index + 1;
    }
    return still;
}

Rig::Rig(Still still, const server::Clock& clock)
    : clock_(clock),
      scene_(std::move(still.scene)),
      renderer_(server::render_channels(still.config), server::display_settings(still.config),
                server::quality(still.config)) {
    if (scene_.weather.cloud_count > 0) renderer_.draw_clouds(render::scene_clouds());
}

FrameTime Rig::frame() {
    fly_on(scene_);
    const std::int64_t begin_ns = clock_.monotonic_ns();
    const std::int64_t processor_ns = clock_.processor_ns();
    renderer_.prepare(scene_);
    for (std::size_t channel = 0; channel < scene_.view_count; ++channel)
        renderer_.draw(channel);
    return {static_cast<double>(clock_.monotonic_ns() - begin_ns) * 1e-6,
            static_cast<double>(clock_.processor_ns() - processor_ns) * 1e-6};
}

double quantile(std::vector<double> values, double q) {
    const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace skyig::clients
