#include "render/sky_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/eye/tone_curve.h"
#include "render/star_field.h"

namespace skyig::render {

namespace {

constexpr double kZenith_rad = 1.5707;

// A shift of adaptation smaller than this moves no pixel by half a display code.
constexpr double kAdaptationStep = 0.004;

// Of the sources' relative azimuth, or of the moonlit share: below it the dome's colours stay.
constexpr float kLightStep = 5e-4F;

// Whether a colour's factor has changed by what could move a display code.
bool scale_moved(const glm::vec3& a, const glm::vec3& b) {
    return glm::any(glm::greaterThan(glm::abs(a - b), kLightStep * glm::max(a, b)));
}

}  // namespace

SkyFrame::SkyFrame(const DisplaySettings& display, const Quality& quality)
    : display_(display), quality_(quality), tables_(direction_table_size(quality)) {}

void SkyFrame::prepare(const Scene& scene, double pixel_rad) {
    const sky::RefractionRow refraction = tables_.refraction(scene);
    plan_ = make_plan(scene, tables_.held(scene), refraction, quality_);
    tables_.update(scene, plan_);
    light_ = tables_.light(scene, plan_, refraction);
    adapt(scene, pixel_rad);
    dazzle(scene);
    refresh_dome(pixel_rad);
    tell_dome();
}

void SkyFrame::adapt(const Scene& scene, double pixel_rad) {
    std::array<double, eye::kProbeCount> luminance{};
    double darkest_sky = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < eye::kProbeCount; ++i) {
        const eye::ProbeDirection& probe = eye::probe_directions()[i];
        const double elevation =
            std::min(light_.horizon_elevation_rad + probe.above_horizon_rad, kZenith_rad);
        luminance[i] = static_cast<double>(
            shaders32::luminance_709(light_.rgb_cd_m2(elevation, probe.azimuth_rad, Side::kByElevation)));
        if (probe.above_horizon_rad > 0.0) darkest_sky = std::min(darkest_sky, luminance[i]);
    }
    const double now_cd_m2 =
        adaptation_.update(eye::adaptation_target_cd_m2(luminance), scene.time_s, tables_.jumped(), display_);
    tone_ = eye::tone_parameters(display_, now_cd_m2);
    plan_stars(plan_, scene, darkest_sky, half_code_mag(darkest_sky, tone_, pixel_rad));
}

void SkyFrame::dazzle(const Scene& scene) {
    sun_glare_.update(render::sun_glare(scene, tables_.air(), light_), light_, display_, tone_);
    moon_glare_.update(render::moon_glare(scene, tables_.air(), light_), light_, display_, tone_);
    plan_glare(plan_, Pass::kSunGlare, display_.glare && scene.sun.enabled, sun_glare_.reach_rad());
    plan_glare(plan_, Pass::kMoonGlare, display_.glare && scene.moon.enabled, moon_glare_.reach_rad());
}

void SkyFrame::refresh_dome(double pixel_rad) {
    const double adaptation = adaptation_.luminance_cd_m2();
    const DomeLayout wanted = dome_layout(light_, pixel_rad, adaptation, tables_.air_in_use());
    const bool at_once = shaded_.tables == 0 || tables_.jumped();
    // A fade that runs is not begun anew for nodes that only could stand better.
    const bool lay = at_once || !still_serves(dome_.layout(), wanted) ||
                     (dome_.share() >= 1.0 && !still_fits(dome_.layout(), wanted));
    const bool replaced = lay || shaded_.tables != tables_.revision();
    const bool turned = std::abs(std::remainder(wanted.second_azimuth_rad - shaded_.moon_from_sun_rad,
                                                2.0 * std::numbers::pi)) > static_cast<double>(kLightStep);
    const bool scaled = scale_moved(light_.sun.scale_xyz, shaded_.sun_scale) ||
                        scale_moved(light_.moon.scale_xyz, shaded_.moon_scale) || turned;
    const bool toned =
        std::abs(adaptation - shaded_.adaptation_cd_m2) > kAdaptationStep * shaded_.adaptation_cd_m2;
    mesh_azimuth_rad_ = wanted.azimuth_rad;
    if (lay) {
        bend_.measure(light_, tone_, mesh_azimuth_rad_, pixel_rad);
        dome_.lay_out(wanted, bend_, plan_dome(bend_, at_once ? DomeBend::kLeast : dome_.size(), quality_));
    }
    if (replaced || scaled) {
        const auto change = at_once    ? Dome::Change::kAtOnce
                            : replaced ? Dome::Change::kReplaced
                                       : Dome::Change::kScaled;
        dome_.look_up(light_, mesh_azimuth_rad_, change);
        shaded_.tables = tables_.revision();
        shaded_.sun_scale = light_.sun.scale_xyz;
        shaded_.moon_scale = light_.moon.scale_xyz;
        shaded_.moon_from_sun_rad = wanted.second_azimuth_rad;
    }
    if (replaced || scaled || toned) {
        dome_.encode(tone_);
        shaded_.adaptation_cd_m2 = adaptation;
        ++vertices_revision_;
    }
    if (lay) {
        dome_error_codes_ = dome_.split_quads(light_, mesh_azimuth_rad_, tone_);
        ++triangles_revision_;
    }
    dome_.step();
}

void SkyFrame::tell_dome() noexcept {
    PlannedPass& planned = plan_.passes[static_cast<std::size_t>(Pass::kDome)];
    planned.resolution = {dome_.size().rows(), dome_.size().columns};
    planned.error_codes = dome_error_codes_;
}

glm::dvec3 SkyFrame::exact_colour(const glm::dvec3& direction_enu) const {
    const Horizontal at = horizontal_of(direction_enu);
    const glm::vec3 rgb = light_.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation);
    return shaders64::shown(glm::dvec3{rgb}, tone_);
}

}  // namespace skyig::render
