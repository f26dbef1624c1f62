#include "server/from_config.h"

#include <glm/glm.hpp>
#include <memory>
#include <utility>

#include "render/warp/blend.h"
#include "render/warp/warp.h"

namespace skyig::server {

static_assert(config::kMaxChannels == render::kMaxChannels);
static_assert(static_cast<int>(config::WarpDrawing::kResampled) ==
              static_cast<int>(render::WarpDrawing::kResampled));
static_assert(config::kMaxTextScale == render::kMaxTextScale);

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

namespace {

render::Screen screen(const config::Screen& settings) noexcept {
    render::Screen screen;
    screen.max_luminance_cd_m2 = settings.max_luminance_cd_m2;
    screen.adaptation_luminance_cd_m2 = settings.adaptation_cd_m2;
    screen.srgb = !settings.gamma.has_value();
    screen.gamma = settings.gamma.value_or(screen.gamma);
    screen.black_cd_m2 = settings.black_cd_m2;
    screen.reflected_cd_m2 = settings.reflected_cd_m2;
    return screen;
}

}  // namespace

namespace {

std::shared_ptr<const render::warp::Warp> warp_of(const config::Channel& channel) {
    if (!channel.warp) return nullptr;
    render::warp::Mesh mesh{channel.warp->columns, channel.warp->rows, channel.warp->at_edges, {}};
    mesh.picture.reserve(channel.warp->picture.size());
    for (const auto& [right, up] : channel.warp->picture)
        mesh.picture.emplace_back(right, up);
    return std::make_shared<render::warp::Warp>(std::move(mesh), channel.width_px, channel.height_px);
}

std::shared_ptr<const render::warp::Blend> blend_of(const config::Channel& channel) {
    if (!channel.blend) return nullptr;
    return std::make_shared<render::warp::Blend>(render::warp::Blend{
        channel.blend->width_px, channel.blend->height_px, channel.blend->weight, channel.blend->lift});
}

}  // namespace

std::vector<render::Channel> render_channels(const config::Config& config) {
    std::vector<render::Channel> channels;
    channels.reserve(config.channels.size());
    for (const config::Channel& channel : config.channels) {
        channels.push_back({channel.name, channel.width_px, channel.height_px});
        render::Channel& made = channels.back();
        if (channel.display) made.screen = screen(*channel.display);
        made.warp = warp_of(channel);
        made.drawing = static_cast<render::WarpDrawing>(channel.warp_drawing);
        made.render_scale = channel.render_scale;
        made.blend = blend_of(channel);
        made.text_scale = channel.overlay.value_or(config.overlay).scale;
    }
    return channels;
}

std::vector<render::Channel> render_channels(const config::Config& config, const std::string& node) {
    std::vector<render::Channel> channels = render_channels(config);
    for (std::size_t i = 0; !node.empty() && i < channels.size(); ++i)
        channels[i].elsewhere = config.channels[i].node != node;
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

namespace {

glm::dvec3 colour(const std::array<double, 3>& rgb) {
    return {rgb[0], rgb[1], rgb[2]};
}

render::WindlightSettings windlight_settings(const config::WindlightSky& look) noexcept {
    return {.blue_horizon = colour(look.blue_horizon),
            .haze_horizon = look.haze_horizon,
            .blue_density = colour(look.blue_density),
            .haze_density = look.haze_density,
            .density_per_m = look.density_per_m,
            .max_altitude_m = look.max_altitude_m,
            .sunlight = colour(look.sunlight),
            .ambient = colour(look.ambient),
            .glow_size = look.glow_size,
            .glow_floor = look.glow_floor,
            .glow_power = look.glow_power,
            .horizon_drop = look.horizon_drop,
            .unit_cd_m2 = look.unit_cd_m2,
            .places_sun = look.sun_angle_deg.has_value(),
            .sun_angle_rad = glm::radians(look.sun_angle_deg.value_or(0.0)),
            .east_angle_rad = glm::radians(look.east_angle_deg)};
}

static_assert(
    static_cast<int>(config::SkyModel::kMulti) == static_cast<int>(render::SkyModel::kMulti) &&
        static_cast<int>(config::SkyModel::kSingle) == static_cast<int>(render::SkyModel::kSingle) &&
        static_cast<int>(config::SkyModel::kDayCycle) == static_cast<int>(render::SkyModel::kDayCycle) &&
        static_cast<int>(config::SkyModel::kCie) == static_cast<int>(render::SkyModel::kCie) &&
        static_cast<int>(config::SkyModel::kPreetham) == static_cast<int>(render::SkyModel::kPreetham) &&
        static_cast<int>(config::SkyModel::kWindlight) == static_cast<int>(render::SkyModel::kWindlight),
    "one order of models in settings and scene");
static_assert(
    static_cast<int>(config::NightModel::kSources) == static_cast<int>(render::NightModel::kSources) &&
        static_cast<int>(config::NightModel::kMean) == static_cast<int>(render::NightModel::kMean) &&
        static_cast<int>(config::NightModel::kSeed) == static_cast<int>(render::NightModel::kSeed) &&
        config::kMaxCities <= render::kMaxCities,
    "one order of models, and room for every city");

}  // namespace

render::SkySettings sky_settings(const config::Sky& sky) noexcept {
    return {
        .model = static_cast<render::SkyModel>(sky.model),
        .day_cycle = {.desaturation = sky.day_cycle.desaturation},
        .cie = {.type = sky.cie.type, .zenith_luminance_cd_m2 = sky.cie.zenith_luminance_cd_m2},
        .preetham = {.turbidity = sky.preetham.turbidity, .zenith_of_multi = sky.preetham.zenith_of_multi},
        .windlight = windlight_settings(sky.windlight),
        .star_scintillation = sky.star_scintillation};
}

render::NightSettings night_settings(const config::Night& night) noexcept {
    render::NightSettings settings{.model = static_cast<render::NightModel>(night.model),
                                   .airglow = night.airglow,
                                   .zodiacal = night.zodiacal,
                                   .starlight = night.starlight,
                                   .galactic_light = night.galactic_light,
                                   .structure = night.milky_way_structure,
                                   .seed = static_cast<std::uint32_t>(night.seed),
                                   .solar_activity = night.solar_activity};
    for (const config::City& city : night.cities) {
        settings.cities[settings.city_count++] = {.latitude_deg = city.latitude_deg,
                                                  .longitude_deg = city.longitude_deg,
                                                  .radius_m = 1e3 * city.radius_km,
                                                  .zenith_cd_m2 = city.zenith_cd_m2,
                                                  .population = city.population};
    }
    return settings;
}

render::Ground ground_settings(const config::Ground& ground) noexcept {
    render::Ground settings;
    settings.kind =
        ground.surface == config::Surface::kSea ? render::Ground::Kind::kSea : render::Ground::Kind::kLand;
    settings.albedo = ground.albedo;
    settings.snow = ground.snow_pct / 100.0;
    return settings;
}

render::Air air_settings(const config::Air& air) noexcept {
    return {.model_enabled = true,
            .visibility_m = air.visibility_m,
            .visibility_contrast = air.visibility_contrast,
            .temperature_c = air.temperature_c,
            .pressure_hpa = air.pressure_hpa,
            .humidity_pct = air.humidity_pct};
}

render::Quality quality(const config::Config& config) {
    render::Quality quality;
    quality.error_codes =
        config.quality.error_pct ? *config.quality.error_pct / render::kCode_pct : config.quality.error_codes;
    return quality;
}

namespace {

static_assert(
    static_cast<int>(config::ToneOperator::kHybrid) == static_cast<int>(render::ToneOperator::kHybrid) &&
        static_cast<int>(config::ToneOperator::kTumblin) ==
            static_cast<int>(render::ToneOperator::kTumblin) &&
        static_cast<int>(config::ToneOperator::kTumblinSafe) ==
            static_cast<int>(render::ToneOperator::kTumblinSafe) &&
        static_cast<int>(config::ToneOperator::kReinhard) ==
            static_cast<int>(render::ToneOperator::kReinhard) &&
        static_cast<int>(config::ToneOperator::kWard) == static_cast<int>(render::ToneOperator::kWard) &&
        static_cast<int>(config::ToneOperator::kLinear) == static_cast<int>(render::ToneOperator::kLinear),
    "one order of operators in settings and eye");
static_assert(static_cast<int>(config::AdaptationSource::kSky) ==
                      static_cast<int>(render::AdaptationSource::kSky) &&
                  static_cast<int>(config::AdaptationSource::kView) ==
                      static_cast<int>(render::AdaptationSource::kView) &&
                  static_cast<int>(config::AdaptationSource::kViewMean) ==
                      static_cast<int>(render::AdaptationSource::kViewMean) &&
                  static_cast<int>(config::AdaptationPace::kPhysiological) ==
                      static_cast<int>(render::AdaptationPace::kPhysiological),
              "one order of ways to adapt in settings and eye");

}  // namespace

render::DisplaySettings display_settings(const config::Config& config) {
    render::DisplaySettings settings = render::before_screen({}, screen(config.display));
    const config::Eye& eye = config.eye;
    settings.dither = config.display.dither;
    settings.tone = static_cast<render::ToneOperator>(eye.tone);
    settings.highlight_room = eye.highlight_room;
    settings.shoulder = eye.shoulder;
    settings.night_colours = eye.night_colours;
    settings.adapt_to = static_cast<render::AdaptationSource>(eye.adapt_to);
    settings.fixed_adaptation_cd_m2 = eye.adaptation_cd_m2.value_or(0.0);
    settings.adapt_pace = static_cast<render::AdaptationPace>(eye.pace);
    settings.adapt_up_s = eye.adapt_up_s;
    settings.adapt_down_s = eye.adapt_down_s;
    settings.glare = eye.glare;
    return settings;
}

namespace {

constexpr bool same(config::Thinning a, render::Thin b) {
    return static_cast<int>(a) == static_cast<int>(b);
}
static_assert(same(config::Thinning::kCloudRefresh, render::Thin::kCloudRefresh) &&
                  same(config::Thinning::kPrecipitation, render::Thin::kPrecipitation) &&
                  same(config::Thinning::kWaves, render::Thin::kWaves) &&
                  same(config::Thinning::kGlare, render::Thin::kGlare) &&
                  same(config::Thinning::kMilkyWay, render::Thin::kMilkyWay) &&
                  same(config::Thinning::kCloudTones, render::Thin::kCloudTones) &&
                  same(config::Thinning::kCloudShadows, render::Thin::kCloudShadows),
              "one number for what can be left out in settings and plan");

}  // namespace

render::Thin thin_of(config::Thinning thinning) noexcept {
    return static_cast<render::Thin>(thinning);
}

}  // namespace skyig::server
