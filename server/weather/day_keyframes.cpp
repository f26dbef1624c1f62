#include "server/weather/day_keyframes.h"

#include <array>
#include <cmath>

namespace skyig::server::weather {
namespace {

using config::Keyframe;

/// Of a contrast, that is left over at the visibility: 1 - (V - near) / (far - near).
constexpr double kLeft = 0.05;

std::array<double, 3> mix(const std::array<double, 3>& a, const std::array<double, 3>& b, double t) noexcept {
    return {std::lerp(a[0], b[0], t), std::lerp(a[1], b[1], t), std::lerp(a[2], b[2], t)};
}

Keyframe mix(const Keyframe& a, const Keyframe& b, double t) noexcept {
    Keyframe mixed;
    mixed.sky_colour = mix(a.sky_colour, b.sky_colour, t);
    mixed.fog_colour = mix(a.fog_colour, b.fog_colour, t);
    mixed.sun_colour = mix(a.sun_colour, b.sun_colour, t);
    mixed.ambient_colour = mix(a.ambient_colour, b.ambient_colour, t);
    mixed.star_opacity = std::lerp(a.star_opacity, b.star_opacity, t);
    mixed.cloud_cover = std::lerp(a.cloud_cover, b.cloud_cover, t);
    const double visibility_m =
        1.0 / std::lerp(1.0 / visibility_of_fog_m(a), 1.0 / visibility_of_fog_m(b), t);
    mixed.sky_fog_near_m = 0.0;
    mixed.sky_fog_far_m = visibility_m / (1.0 - kLeft);
    return mixed;
}

glm::dvec3 colour(const std::array<double, 3>& rgb) noexcept {
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

Keyframe look_at(const config::Keyframes& keyframes, double day) noexcept {
    constexpr std::size_t kSets = config::kKeyframeNames.size();
    const double s = (day - std::floor(day)) * static_cast<double>(kSets);
    // A day just below a whole one may round up to the last set and one.
    const std::size_t i = static_cast<std::size_t>(s) % kSets;
    const std::size_t next = (i + 1) % kSets;
    const double part = s - std::floor(s);
    const Keyframe good = mix(keyframes.good_day[i], keyframes.good_day[next], part);
    const Keyframe bad = mix(keyframes.bad_day[i], keyframes.bad_day[next], part);
    return mix(bad, good, keyframes.good);
}

double visibility_of_fog_m(const Keyframe& look) noexcept {
    return std::lerp(look.sky_fog_far_m, look.sky_fog_near_m, kLeft);
}

double solar_day(double utc_second_of_day, double longitude_deg) noexcept {
    const double day = utc_second_of_day / 86400.0 + longitude_deg / 360.0;
    return day - std::floor(day);
}

void put_look(const Keyframe& look, render::Scene& scene) noexcept {
    scene.air.visibility_m =
        visibility_of_fog_m(look) * std::log(scene.air.visibility_contrast) / std::log(kLeft);
    scene.stars.intensity *= look.star_opacity;
    // Other models have colours of their own; unused ones would only make their tables stale.
    if (scene.sky.model != render::SkyModel::kWindlight) return;
    render::WindlightSettings& sky = scene.sky.windlight;
    sky.blue_horizon = colour(look.sky_colour);
    // Grey in the model: as bright as the colour (Rec. 709).
    sky.haze_horizon =
        0.2126 * look.fog_colour[0] + 0.7152 * look.fog_colour[1] + 0.0722 * look.fog_colour[2];
    sky.sunlight = colour(look.sun_colour);
    sky.ambient = colour(look.ambient_colour);
}

}  // namespace skyig::server::weather
