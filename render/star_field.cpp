#include "render/star_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"
#include "render/night/star_catalogue.h"
#include "render/night/star_colour.h"

namespace skyig::render {

namespace {

constexpr std::size_t kAirSteps = 192;
constexpr double kFade_mag = 0.8;

// Steps crowd at the horizon, where air mass and refraction run away.
double step_of_elevation(double elevation_rad, double lowest_rad) {
    const double share = (elevation_rad - lowest_rad) / (0.5 * std::numbers::pi - lowest_rad);
    return std::sqrt(std::clamp(share, 0.0, 1.0)) * static_cast<double>(kAirSteps - 1);
}

double elevation_of_step(std::size_t step, double lowest_rad) {
    const double share = static_cast<double>(step) / static_cast<double>(kAirSteps - 1);
    return lowest_rad + share * share * (0.5 * std::numbers::pi - lowest_rad);
}

// A direction turned towards the zenith by a small angle; the zenith stays.
glm::vec3 lifted(const glm::vec3& d, float angle_rad) {
    const float level = std::sqrt(d.x * d.x + d.y * d.y);
    if (level < 1e-6F) return d;
    const float sine = std::sin(angle_rad);
    const float cosine = std::cos(angle_rad);
    const float shrink = cosine - sine * d.z / level;
    return {d.x * shrink, d.y * shrink, d.z * cosine + level * sine};
}

}  // namespace

double half_code_mag(double background_cd_m2, const shaders64::ToneParameters& tone,
                     double pixel_rad) noexcept {
    const auto code = [&](double added) {
        const glm::dvec3 behind = shaders64::display_linear(glm::dvec3{background_cd_m2}, tone);
        return 255.0 * shaders64::encoded(behind + glm::dvec3{added}, tone).y;
    };
    constexpr double kSmall = 1e-4;
    const double added = kSmall * 0.5 / (code(kSmall) - code(0.0));
    const double sigma_rad = kStarSigma_px * pixel_rad;
    const double lux =
        added * 2.0 * std::numbers::pi * sigma_rad * sigma_rad / (tone.point_gain * tone.inv_display_max);
    return -2.5 * std::log10(lux / night::star_illuminance_lux(0.0));
}

StarField::StarField() {
    sources_.reserve(night::star_catalogue().size());
    for (const night::CatalogueStar& star : night::star_catalogue()) {
        const auto colour = glm::vec3{night::star_colour_of_bv(star.bv)};
        const auto lux = static_cast<float>(night::star_illuminance_lux(star.vmag));
        sources_.push_back({star.direction_gcrs, star.proper_motion_rad_yr, colour * lux, star.vmag});
    }
    std::stable_sort(sources_.begin(), sources_.end(),
                     [](const Source& a, const Source& b) { return a.magnitude < b.magnitude; });
    stars_.resize(sources_.size() + kPlanetCount);
    air_.resize(kAirSteps);
}

struct StarField::Frame {
    const SkyLight& light;
    shaders32::ToneParameters tone;
    double lowest_rad;  // airless elevation of what is seen on the horizon
    float lowest_sine;
    glm::vec3 moon_enu;
    float moon_chord;  // 0: the Moon covers nothing
};

void StarField::tabulate_air(const SkyLight& light, const sky::AirTables& air) {
    const double lowest_rad = light.refraction.setting_elevation_rad();
    for (std::size_t i = 0; i < kAirSteps; ++i) {
        const double elevation_rad = elevation_of_step(i, lowest_rad);
        const double seen_rad = light.refraction.apparent_from_true(elevation_rad);
        air_[i] = {
            glm::vec3{air.transmittance_rgb(light.eye_height_m, light.straight_elevation_rad(seen_rad))},
            static_cast<float>(seen_rad - elevation_rad)};
    }
}

StarField::Air StarField::air_at(double elevation_rad, double lowest_rad) const noexcept {
    const double step = step_of_elevation(elevation_rad, lowest_rad);
    const auto low = std::min(static_cast<std::size_t>(step), kAirSteps - 2);
    const auto share = static_cast<float>(step - static_cast<double>(low));
    return {glm::mix(air_[low].transmittance, air_[low + 1].transmittance, share),
            glm::mix(air_[low].lift_rad, air_[low + 1].lift_rad, share)};
}

void StarField::add(const glm::vec3& direction_enu, const glm::vec3& illuminance_lux,
                    const Frame& frame) noexcept {
    if (direction_enu.z < frame.lowest_sine) return;
    const glm::vec3 from_moon = direction_enu - frame.moon_enu;
    if (glm::dot(from_moon, from_moon) < frame.moon_chord * frame.moon_chord) return;
    const Horizontal airless = horizontal_of(glm::dvec3{direction_enu});
    const Air air = air_at(airless.elevation_rad, frame.lowest_rad);
    const Horizontal seen{airless.elevation_rad + static_cast<double>(air.lift_rad), airless.azimuth_rad};
    const glm::vec3 behind = frame.light.rgb_cd_m2(seen.elevation_rad, seen.azimuth_rad, Side::kSky);
    stars_[count_++] = {lifted(direction_enu, air.lift_rad), illuminance_lux * air.transmittance,
                        shaders32::display_linear(behind, frame.tone)};
}

void StarField::update(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                       const shaders64::ToneParameters& tone, double limit_mag) {
    tabulate_air(light, air);
    const double lowest_rad = light.refraction.setting_elevation_rad();
    const double moon_chord = scene.moon.enabled ? 2.0 * std::sin(0.5 * scene.moon.angular_radius_rad) : 0.0;
    const Frame frame{light,
                      eye::single_precision(tone),
                      lowest_rad,
                      static_cast<float>(std::sin(lowest_rad)),
                      glm::vec3{scene.moon.direction_enu},
                      static_cast<float>(moon_chord)};
    const auto intensity = static_cast<float>(scene.stars.intensity);
    const auto shown = [&](double magnitude) {
        return intensity * static_cast<float>(smooth_step(limit_mag, limit_mag - kFade_mag, magnitude));
    };

    count_ = 0;
    for (const Planet& planet : scene.planets) {
        const float share = shown(planet.magnitude);
        const glm::dvec3 light_lux =
            night::star_colour_of_bv(planet.bv) * night::star_illuminance_lux(planet.magnitude);
        if (share > 0.0F) add(glm::vec3{planet.direction_enu}, glm::vec3{light_lux} * share, frame);
    }
    const glm::mat3 enu_from_gcrs{scene.stars.enu_from_gcrs};
    const glm::vec3 aberration{scene.stars.earth_velocity_c};
    const auto years = static_cast<float>(scene.stars.years_since_j2000);
    for (const Source& source : sources_) {
        const float share = shown(static_cast<double>(source.magnitude));
        if (share <= 0.0F) break;
        const glm::vec3 direction = glm::normalize(
            enu_from_gcrs * (source.direction_gcrs + source.motion_rad_per_yr * years + aberration));
        add(direction, source.illuminance_lux * share, frame);
    }
}

}  // namespace skyig::render
