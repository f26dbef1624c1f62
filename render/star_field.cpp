#include "render/star_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"
#include "render/night/star_catalogue.h"
#include "render/night/star_colour.h"

namespace skyig::render {

namespace {

constexpr std::size_t kTransmittanceSteps = 128;
constexpr double kFade_mag = 0.8;

// Steps crowd at the horizon, where the air mass runs away.
double step_of_elevation(double elevation_rad, double horizon_rad) {
    const double share = (elevation_rad - horizon_rad) / (0.5 * std::numbers::pi - horizon_rad);
    return std::sqrt(std::clamp(share, 0.0, 1.0)) * static_cast<double>(kTransmittanceSteps - 1);
}

double elevation_of_step(std::size_t step, double horizon_rad) {
    const double share = static_cast<double>(step) / static_cast<double>(kTransmittanceSteps - 1);
    return horizon_rad + share * share * (0.5 * std::numbers::pi - horizon_rad);
}

}  // namespace

StarField::StarField() {
    sources_.reserve(night::star_catalogue().size());
    for (const night::CatalogueStar& star : night::star_catalogue()) {
        const auto colour = glm::vec3{night::star_colour_of_bv(star.bv)};
        const auto lux = static_cast<float>(night::star_illuminance_lux(star.vmag));
        sources_.push_back({star.direction_gcrs, star.proper_motion_rad_yr, colour * lux, star.vmag});
    }
    std::stable_sort(sources_.begin(), sources_.end(),
                     [](const Source& a, const Source& b) { return a.magnitude < b.magnitude; });
    stars_.resize(sources_.size());
    transmittance_.resize(kTransmittanceSteps);
}

void StarField::tabulate_transmittance(const SkyLight& light, const sky::AirTables& air) {
    for (std::size_t i = 0; i < kTransmittanceSteps; ++i) {
        transmittance_[i] = glm::vec3{
            air.transmittance_rgb(light.eye_height_m, elevation_of_step(i, light.horizon_elevation_rad))};
    }
}

glm::vec3 StarField::transmittance(double elevation_rad, double horizon_rad) const noexcept {
    const double step = step_of_elevation(elevation_rad, horizon_rad);
    const auto low = std::min(static_cast<std::size_t>(step), kTransmittanceSteps - 2);
    return glm::mix(transmittance_[low], transmittance_[low + 1],
                    static_cast<float>(step - static_cast<double>(low)));
}

void StarField::update(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                       const shaders64::ToneParameters& tone, double limit_mag) {
    tabulate_transmittance(light, air);
    const auto tone32 = eye::single_precision(tone);
    const glm::mat3 enu_from_gcrs{scene.stars.enu_from_gcrs};
    const glm::vec3 aberration{scene.stars.earth_velocity_c};
    const auto years = static_cast<float>(scene.stars.years_since_j2000);
    const auto intensity = static_cast<float>(scene.stars.intensity);
    const auto horizon_sine = static_cast<float>(std::sin(light.horizon_elevation_rad));
    const glm::vec3 moon{scene.moon.direction_enu};
    const auto moon_chord = static_cast<float>(2.0 * std::sin(0.5 * scene.moon.angular_radius_rad));

    count_ = 0;
    for (const Source& source : sources_) {
        const auto shown = static_cast<float>(
            smooth_step(limit_mag, limit_mag - kFade_mag, static_cast<double>(source.magnitude)));
        if (shown <= 0.0F) break;
        const glm::vec3 direction = glm::normalize(
            enu_from_gcrs * (source.direction_gcrs + source.motion_rad_per_yr * years + aberration));
        if (direction.z < horizon_sine) continue;
        const glm::vec3 from_moon = direction - moon;
        if (scene.moon.enabled && glm::dot(from_moon, from_moon) < moon_chord * moon_chord) continue;
        const Horizontal horizontal = horizontal_of(glm::dvec3{direction});
        const glm::vec3 behind =
            light.rgb_cd_m2(horizontal.elevation_rad, horizontal.azimuth_rad, Side::kSky);
        stars_[count_++] = {direction,
                            source.illuminance_lux * (intensity * shown) *
                                transmittance(horizontal.elevation_rad, light.horizon_elevation_rad),
                            shaders32::display_linear(behind, tone32)};
    }
}

}  // namespace skyig::render
