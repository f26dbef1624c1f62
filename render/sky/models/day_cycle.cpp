#include "render/sky/models/day_cycle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/sky/air_data.h"
#include "render/sky/azimuth.h"
#include "render/sky/phase.h"
#include "render/sky/staleness.h"

namespace skyig::render::sky::models {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kAirMassStep = 1.0;
constexpr double kWidestStepDeg = 4.0;
constexpr double kFarthestEyeM = 1e9;

// Kasten and Young, Appl. Opt. 28 (1989) 4735; below the horizon along the tangent at 0.
double air_mass(double elevation_deg) {
    const auto mass = [](double e) {
        return 1.0 / (std::sin(e * kDegree) + 0.50572 * std::pow(e + 6.07995, -1.6364));
    };
    if (elevation_deg >= 0.0) return mass(elevation_deg);
    constexpr double kStep = 1e-4;
    return mass(0.0) + elevation_deg * (mass(kStep) - mass(0.0)) / kStep;
}

}  // namespace

double day_path_place(double elevation_rad, double dip_rad) noexcept {
    const double elevation_deg = elevation_rad / kDegree;
    return air_mass(elevation_deg - dip_rad / kDegree) / kAirMassStep +
           (90.0 - elevation_deg) / kWidestStepDeg;
}

double day_path_elevation_rad(double place, double dip_rad) noexcept {
    double low = -kHalfPi;
    double high = kHalfPi;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (day_path_place(middle, dip_rad) > place ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

void DayCycle::renew(Place& place, int number, const AirTables& tables) noexcept {
    if (place.made && place.number == number) return;
    const double dip_rad = tables.data().shell.dip_rad(height_m_);
    place.view.begin(tables, height_m_, day_path_elevation_rad(number, dip_rad));
    place.number = number;
    place.made = true;
    ++tables_begun_;
}

void DayCycle::begin(const DayCycleSettings& settings, const AirTables& tables, double eye_height_m,
                     double source_elevation_rad) noexcept {
    const double elevation =
        std::isfinite(source_elevation_rad) ? std::clamp(source_elevation_rad, -kHalfPi, kHalfPi) : -kHalfPi;
    const double height_m = std::isfinite(eye_height_m) ? std::clamp(eye_height_m, 0.0, kFarthestEyeM) : 0.0;
    if (air_ != &tables.data() || height_is_stale(height_m, height_m_)) {
        air_ = &tables.data();
        height_m_ = height_m;
        before_.made = after_.made = false;
    }
    const double place = day_path_place(elevation, tables.data().shell.dip_rad(height_m_));
    const int number = static_cast<int>(std::floor(place));
    if (number == after_.number || number + 1 == before_.number) std::swap(before_, after_);
    renew(before_, number, tables);
    renew(after_, number + 1, tables);
    after_share_ = static_cast<float>(place - number);
    g_ = static_cast<float>(tables.model().aerosol_g);
    source_sine_ = static_cast<float>(std::sin(elevation));
    source_cosine_ = static_cast<float>(std::cos(elevation));
    desaturation_ = static_cast<float>(settings.desaturation);
}

bool DayCycle::build_rows(int max_rows) noexcept {
    SkyView& first = before_.view.complete() ? after_.view : before_.view;
    return first.build_rows(max_rows) && before_.view.complete() && after_.view.complete();
}

glm::vec3 DayCycle::mixed(const SkyParts& before, const SkyParts& after, float elevation_rad,
                          float relative_azimuth_rad) const noexcept {
    const glm::vec3 rest = before.rest + after_share_ * (after.rest - before.rest);
    const glm::vec3 haze = before.haze + after_share_ * (after.haze - before.haze);
    if (rest == glm::vec3(0.0F) && haze == glm::vec3(0.0F)) return glm::vec3(0.0F);
    const float cosine =
        std::sin(elevation_rad) * source_sine_ +
        std::cos(elevation_rad) * source_cosine_ * std::cos(folded_azimuth(relative_azimuth_rad));
    const float phase = cornette_shanks_phase(g_, std::clamp(cosine, -1.0F, 1.0F));
    const glm::vec3 xyz = glm::max(rest + phase * haze, glm::vec3(0.0F));
    const glm::vec3 grey = xyz.y * glm::vec3(0.95047F, 1.0F, 1.08883F);
    return xyz + desaturation_ * (grey - xyz);
}

glm::vec3 DayCycle::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    const float elevation = std::max(elevation_rad, static_cast<float>(horizon_elevation_rad()));
    return mixed(before_.view.parts_above(elevation_rad, relative_azimuth_rad),
                 after_.view.parts_above(elevation_rad, relative_azimuth_rad), elevation,
                 relative_azimuth_rad);
}

glm::vec3 DayCycle::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    const float elevation = std::min(elevation_rad, static_cast<float>(horizon_elevation_rad()));
    return mixed(before_.view.parts_below(elevation_rad, relative_azimuth_rad),
                 after_.view.parts_below(elevation_rad, relative_azimuth_rad), elevation,
                 relative_azimuth_rad);
}

}  // namespace skyig::render::sky::models
