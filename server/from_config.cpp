#include "server/from_config.h"

#include "render/scene.h"

namespace skyig::server {

static_assert(config::kMaxChannels == render::kMaxChannels);

ephemeris::UtcClockTime start_time(const config::Start& start, const Clock& clock) {
    constexpr std::int64_t kNsPerSecond = 1'000'000'000;
    if (start.utc) {
        const config::UtcDateTime& utc = *start.utc;
        const auto time = ephemeris::UtcClockTime::from_civil(
            {utc.year, utc.month, utc.day, utc.hour, utc.minute, utc.second});
        if (time) return *time;
    }
    const std::int64_t now_ns = clock.utc_ns();
    return ephemeris::UtcClockTime::from_unix(now_ns / kNsPerSecond,
                                              static_cast<std::int32_t>(now_ns % kNsPerSecond));
}

std::vector<render::Channel> render_channels(const config::Config& config) {
    std::vector<render::Channel> channels;
    channels.reserve(config.channels.size());
    for (const config::Channel& channel : config.channels)
        channels.push_back({channel.name, channel.width_px, channel.height_px});
    return channels;
}

ephemeris::Model ephemeris_model(const config::Config& config) noexcept {
    switch (config.ephemeris.model) {
        case config::EphemerisModel::kAlmanac:
            return ephemeris::Model::kAlmanac;
        case config::EphemerisModel::kErfa:
            return ephemeris::Model::kErfa;
        case config::EphemerisModel::kSeries:
            break;
    }
    return ephemeris::Model::kSeries;
}

ephemeris::EarthOrientationResult load_earth_orientation(const config::Config& config,
                                                         const std::string& settings_file) {
    const std::string& path = config.ephemeris.earth_orientation;
    if (path.empty()) return {ephemeris::EarthOrientation{}, {}};
    ephemeris::EarthOrientationResult result = ephemeris::read_earth_orientation(path);
    if (!result)
        result.error = config::to_text({settings_file, 0, 0, "ephemeris.earth_orientation", result.error});
    return result;
}

render::DisplaySettings display_settings(const config::Config& config) {
    render::DisplaySettings settings;
    settings.max_luminance_cd_m2 = config.display.max_luminance_cd_m2;
    settings.adaptation_luminance_cd_m2 = config.display.adaptation_cd_m2;
    settings.srgb = !config.display.gamma.has_value();
    settings.gamma = config.display.gamma.value_or(settings.gamma);
    settings.dither = config.display.dither;
    settings.tone = config.eye.tone == config::ToneOperator::kLinear ? render::ToneOperator::kLinear
                                                                     : render::ToneOperator::kHybrid;
    settings.adapt_up_s = config.eye.adapt_up_s;
    settings.adapt_down_s = config.eye.adapt_down_s;
    return settings;
}

}  // namespace skyig::server
