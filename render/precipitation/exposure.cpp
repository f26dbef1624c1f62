#include "render/precipitation/exposure.h"

#include <algorithm>
#include <cmath>

#include "render/precipitation/fall.h"
#include "render/precipitation/streak_field.h"
#include "render/sky/sea_waves.h"

namespace skyig::render::precipitation {

namespace {

glm::dvec3 fall_of(const Scene& scene) noexcept {
    constexpr double kWhole_mm_h = 0.1;
    double rate_mm_h = 0.0;
    double speed_m_s = 0.0;
    for (const Precipitation& falling : scene.weather.all_precipitations()) {
        if (!falls_on(falling, scene.eye)) continue;
        rate_mm_h += falling.rate_mm_h;
        // At the ground: a way that changed with the eye's height would move the texels.
        speed_m_s += falling.rate_mm_h * fall_speed_m_s(falling.kind, falling.rate_mm_h, 0.0);
    }
    if (!(rate_mm_h > 0.0)) return {0.0, 0.0, -1.0};
    const glm::dvec2 wind = std::min(rate_mm_h / kWhole_mm_h, 1.0) * glm::dvec2{scene.weather.wind_m_s};
    return glm::normalize(glm::dvec3{wind, -std::max(speed_m_s / rate_mm_h, 0.2)});
}

// From the eye back to where the texel begins in which it stands, along an axis.
double into_texel_m(double along_m) noexcept {
    return std::floor(along_m / ExposureView::kTexel_m) * ExposureView::kTexel_m - along_m;
}

}  // namespace

ExposureView exposure_view(const Scene& scene) noexcept {
    ExposureView view;
    view.fall_enu = fall_of(scene);
    const glm::dvec3 right = glm::normalize(glm::cross(view.fall_enu, glm::dvec3{0.0, 1.0, 0.0}));
    const glm::dvec3 up = glm::cross(right, view.fall_enu);
    const glm::dvec3 eye_m{sky::sea_anchor(scene.eye).eye_m, scene.eye.height_m};
    constexpr double kAcross = 2.0 / ExposureView::kSide_m;
    constexpr double kAlong = 2.0 / ExposureView::kDepth_m;
    const glm::dmat3 rows{kAcross * right, kAcross * up, kAlong * view.fall_enu};
    view.clip_from_enu_m = glm::dmat4{glm::transpose(rows)};
    view.clip_from_enu_m[3] = {-kAcross * into_texel_m(glm::dot(eye_m, right)),
                               -kAcross * into_texel_m(glm::dot(eye_m, up)), 0.0, 1.0};
    const double aslant = std::hypot(view.fall_enu.x, view.fall_enu.y) / -view.fall_enu.z;
    view.bias_m = 0.25 + 1.5 * aslant * ExposureView::kTexel_m;
    return view;
}

}  // namespace skyig::render::precipitation
