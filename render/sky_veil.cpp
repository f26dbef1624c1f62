#include "render/sky_veil.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/cloud_shade.h"
#include "render/colour.h"

namespace skyig::render {

glm::dvec3 rgb_of(const sky::Spectrum& spectrum) noexcept {
    constexpr std::array<std::size_t, 3> kRgbWavelengths{11, 8, 4};
    return {spectrum[kRgbWavelengths[0]], spectrum[kRgbWavelengths[1]], spectrum[kRgbWavelengths[2]]};
}

namespace {

// Mean of the sky seen from the eye, weighed by the sine of the elevation.
glm::dvec3 mean_sky_cd_m2(const LitAir& lit) {
    constexpr int kRings = 6;
    constexpr int kAround = 8;
    glm::vec3 xyz{0.0F};
    for (int ring = 0; ring < kRings; ++ring) {
        const auto elevation_rad = static_cast<float>(std::asin(std::sqrt((ring + 0.5) / kRings)));
        for (int i = 0; i < kAround; ++i)
            xyz += lit.view->xyz_above(elevation_rad,
                                       static_cast<float>(2.0 * std::numbers::pi * (i + 0.5) / kAround));
    }
    return glm::dvec3{rec709_from_xyz(lit.scale_xyz * xyz)} / double{kRings * kAround};
}

void shine(const LitAir& lit, const glm::dvec3& direction_enu, const sky::AirTables& air,
           const SkyLight& light, const CloudShade& clouds, double top_m, fog::VeilSources& sources,
           fog::VeilSources::Beam& beam) noexcept {
    beam.direction_enu = direction_enu;
    if (lit.view == nullptr) return;
    const glm::dvec3 scale{lit.scale_xyz};
    const double elevation_rad = horizontal_of(direction_enu).elevation_rad;
    const double seen_rad = light.straight_elevation_rad(light.refraction.apparent_from_true(elevation_rad));
    const glm::dvec3 beam_lux = kRec709FromXyz * (scale * air.direct_sun_xyz(std::max(top_m, 0.0), seen_rad));
    const glm::dvec3 sky_xyz_lux = air.ground_diffuse_xyz(elevation_rad);
    const glm::dvec3 sky_cd_m2 =
        sky_xyz_lux.y > 0.0 ? kRec709FromXyz * (scale * sky_xyz_lux) / std::numbers::pi : mean_sky_cd_m2(lit);
    // Clouds above the veil let a part of the beam through and make even light of another.
    const double mu0 = std::sin(elevation_rad);
    const CloudShare share = clouds.at(top_m, mu0);
    beam.lux = static_cast<double>(share.direct) * beam_lux;
    const double scattered = std::max(mu0, 0.0) * static_cast<double>(share.beam - share.direct);
    sources.above_cd_m2 +=
        static_cast<double>(share.sky) * sky_cd_m2 + scattered * beam_lux / std::numbers::pi;
}

}  // namespace

fog::VeilSources veil_sources(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                              double top_m) noexcept {
    fog::VeilSources sources;
    sources.ground_albedo = light.ground_albedo;
    const CloudShade clouds(scene.weather, light.ground_albedo);
    shine(light.sun, scene.sun.direction_enu, air, light, clouds, top_m, sources, sources.beams[0]);
    shine(light.moon, scene.moon.direction_enu, air, light, clouds, top_m, sources, sources.beams[1]);
    if (light.night != nullptr) {
        const double share =
            static_cast<double>(light.night_share * clouds.at(top_m, 0.0).sky) / std::numbers::pi;
        sources.above_cd_m2 += share * glm::dvec3{light.night->ground_rgb_lux()};
    }
    return sources;
}

glm::dvec3 white_ground_cd_m2(const Scene& scene, const sky::AirTables& air, const SkyLight& light) noexcept {
    const fog::VeilSources sources = veil_sources(scene, air, light, 0.0);
    glm::dvec3 level_cd_m2 = sources.above_cd_m2;
    for (const fog::VeilSources::Beam& beam : sources.beams)
        level_cd_m2 += beam.lux * (std::max(beam.direction_enu.z, 0.0) / std::numbers::pi);
    level_cd_m2 += glm::dvec3{light.flash.ground_lux} / std::numbers::pi;
    return light.veil != nullptr ? level_cd_m2 * light.veil->ground_share() : level_cd_m2;
}

shaders64::VeilAir front_air(const sky::AirModel& model, double eye_height_m) noexcept {
    // Beyond it no number would hold both the air there and that at the ground.
    constexpr double kNoAir_m = 60e3;
    const double height_m = std::clamp(eye_height_m, 0.0, kNoAir_m);
    const double molecules_m = sky::column_above_m(model.molecules, 0.0);
    const double thinned = sky::column_above_m(model.molecules, height_m) / molecules_m;
    return {thinned * rgb_of(model.rayleigh_per_m),
            std::exp(-height_m / model.aerosol_scale_height_m) * rgb_of(model.aerosol_extinction_per_m),
            molecules_m, model.aerosol_scale_height_m, std::max(eye_height_m - kNoAir_m, 0.0)};
}

void SkyVeil::lay(const Scene& scene, const sky::AirTables& air, double smallest, SkyLight& light) noexcept {
    // Nodes stand where they should while what they show has not changed by more.
    constexpr double kBent = 0.08;
    veil_.lay(scene.weather.all_obscurants(), scene.eye.height_m);
    fog::VeilMark now;
    if (!veil_.empty()) {
        veil_.light(veil_sources(scene, air, light, veil_.top_m()));
        light.veil = &veil_;
        now = fog::VeilMark(veil_);
    }
    if (now.differs(shown_, smallest)) {
        shown_ = now;
        ++revision_;
    }
    if (now.differs(bent_, kBent)) {
        bent_ = now;
        ++bends_revision_;
    }
    light.veil_revision = revision_;
}

}  // namespace skyig::render
