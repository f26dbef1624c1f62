#include "render/sky_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/eye/exposure.h"
#include "render/eye/tone_curve.h"
#include "render/star_field.h"

namespace skyig::render {

namespace {

constexpr double kZenith_rad = 1.5707;

// By how much the dome's vertices may stand off where they were laid out.
constexpr double kHorizonShift_rad = 0.01;

// A shift of adaptation smaller than this moves no pixel by half a display code.
constexpr double kAdaptationStep = 0.004;

// Of the sources' relative azimuth, or of the moonlit share: below it the dome's colours stay.
constexpr float kLightStep = 5e-4F;

// Whether a colour's factor has changed by what could move a display code.
bool scale_moved(const glm::vec3& a, const glm::vec3& b) {
    return glm::any(glm::greaterThan(glm::abs(a - b), kLightStep * glm::max(a, b)));
}

double unit(double share) {
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

// What lightning gives to white ground, or to the air where that is brighter.
float brightest_of_flash(const SkyLight& light) {
    const glm::vec3 ground = light.flash.ground_lux * static_cast<float>(1.0 / std::numbers::pi);
    return shaders32::luminance_709(glm::max(ground, light.flash.sky_cd_m2));
}

// Whether it has changed by what could show; that it is over always does.
bool flash_moved(float now_cd_m2, float shaded_cd_m2, double adaptation_cd_m2) {
    const float step = std::abs(now_cd_m2 - shaded_cd_m2);
    return step > 0.0F && (now_cd_m2 == 0.0F || step > kLightStep * static_cast<float>(adaptation_cd_m2));
}

ClippedLight clipped_light(const std::array<double, eye::kProbeCount>& probes_cd_m2,
                           const shaders64::ToneParameters& tone) {
    ClippedLight clipped;
    for (const double luminance : probes_cd_m2) {
        const double white_parts = shaders64::display_linear(glm::dvec3{luminance}, tone).y - tone.ambient;
        clipped.below_black += white_parts <= 0.0 ? 1.0 : 0.0;
        clipped.above_white += white_parts > 1.0 ? 1.0 : 0.0;
    }
    clipped.below_black /= static_cast<double>(eye::kProbeCount);
    clipped.above_white /= static_cast<double>(eye::kProbeCount);
    return clipped;
}

// By day, the more the brighter the clouds that are probed stand out of the sky behind them. Before a usual
// screen: one adaptation serves all of a rig's.
double adapted_to_clouds(double adaptation_cd_m2, ToneOperator tone,
                         const std::array<double, eye::kProbeCount>& over_sky_cd_m2) {
    DisplaySettings usual;
    usual.tone = tone;
    return eye::adaptation_to_bright(usual, adaptation_cd_m2,
                                     adaptation_cd_m2 + eye::bright_part_cd_m2(over_sky_cd_m2));
}

// What a target of luminance asks of the dome: the finest there is.
constexpr Quality kFinest{.error_codes = 0.0, .forced = {}, .thinned = {}};

// How many times as slowly thinned frames renew the cloud map, and follow what is seen of it.
constexpr int kThinnedRefresh = 3;
constexpr int kThinnedTones = 3;

}  // namespace

SkyFrame::SkyFrame(const DisplaySettings& display, const Quality& quality, std::span<const Screen> screens,
                   Target target)
    : displays_(std::max<std::size_t>(screens.size(), 1), display),
      quality_(quality),
      target_(target),
      tables_(direction_table_size(quality)),
      sun_glares_(displays_.size()),
      moon_glares_(displays_.size()),
      dome_(displays_.size()),
      sea_(displays_.size()),
      clouds_(displays_.size()),
      milky_way_(displays_.size()),
      display_tones_(displays_.size()),
      tones_(displays_.size()),
      clipped_(displays_.size()) {
    for (std::size_t i = 0; i < screens.size(); ++i)
        displays_[i] = before_screen(display, screens[i]);
}

void SkyFrame::prepare(const Scene& scene, double pixel_rad, double smallest_pixel_sr) {
    const sky::RefractionRow refraction = tables_.refraction(scene);
    plan_ = make_plan(scene, tables_.held(scene), refraction, quality_);
    tables_.update(scene, plan_);
    light_ = tables_.light(scene, plan_, refraction);
    veil_.lay(scene, tables_.air(), static_cast<double>(kLightStep), light_);
    plan_veil(plan_, scene, veil_.veil().segments().size());
    take_weather(scene);
    air_between_fresh_ = false;
    if (air_between_) air_between(scene);
    refresh_clouds(scene, pixel_rad);
    adapt(scene);
    tone_screens(scene, smallest_pixel_sr);
    refresh_milky_way(scene);
    dazzle(scene);
    refresh_dome(pixel_rad);
    refresh_sea(scene, pixel_rad);
    tone_clouds();
    tell_dome();
}

const DeferredAir& SkyFrame::air_between(const Scene& scene) {
    if (!air_between_) air_between_.emplace();
    if (!air_between_fresh_) air_between_->update(scene, plan_, tables_, light_);
    air_between_fresh_ = true;
    return *air_between_;
}

void SkyFrame::refresh_clouds(const Scene& scene, double pixel_rad) {
    const int size = quality_.cloud_map_size > 0 ? quality_.cloud_map_size
                                                 : cloud::map_size_for(pixel_rad, scene.channel_views());
    plan_clouds(plan_, scene, size, cloud::NearMap::kSize, false);
    // The last of clouds that go is still shown: by a map from which they go as they came.
    const bool going = clouds_.shown() && !tables_.jumped() && !clouds_.map().is_clear();
    if ((!plan_.needs(Pass::kClouds) && !going) || made_clouds_.maker == nullptr) {
        clouds_.stop();
        ground_shadow_.stop();
        plan_cloud_shadows(plan_, ground_shadow_.map(), false);
        return;
    }
    air_between(scene);
    if (made_clouds_.light != nullptr) made_clouds_.light(scene, plan_, tables_, light_, cloud_light_);
    const int tiles = plan_.thins(Thin::kCloudRefresh)
                          ? std::max(quality_.cloud_tiles_a_frame / kThinnedRefresh, 1)
                          : quality_.cloud_tiles_a_frame;
    clouds_.follow(*made_clouds_.maker, scene, cloud_light_, light_, tables_.jumped(), size, tiles);
    clouds_.tone_every(plan_.thins(Thin::kCloudTones) ? kThinnedTones : 1);
    if (plan_.thins(Thin::kCloudShadows)) {
        ground_shadow_.stop();
    } else {
        ground_shadow_.update(*made_clouds_.maker, {scene, scene.eye, cloud_light_}, tables_.air(), light_,
                              tables_.jumped());
    }
    clouds_.shade_ground(&ground_shadow_);
    plan_cloud_shadows(plan_, ground_shadow_.map(), ground_shadow_.shown());
    plan_clouds(plan_, scene, size, cloud::NearMap::kSize, clouds_.map().near_map() != nullptr);
}

void SkyFrame::serve_things() noexcept {
    clouds_.serve_things();
    tone_clouds();
}

void SkyFrame::tone_clouds() noexcept {
    if (!clouds_.shown()) return;
    clouds_.tone(light_, *air_between_, tones_, light_revision_, vertices_revision_, flashes_);
    const glm::dmat3 mesh_from_enu = glm::transpose(glm::dmat3{enu_from_mesh()});
    dome_.mark([&](const glm::dvec3& axis_mesh, double sine) {
        const glm::dvec3 axis = glm::transpose(mesh_from_enu) * axis_mesh;
        const double reach_rad = std::asin(std::min(sine, 1.0)) + kHorizonShift_rad;
        return std::any_of(clouds_.clouded().begin(), clouds_.clouded().end(), [&](const cloud::Cone& cone) {
            return glm::dot(axis, cone.axis) > std::cos(std::min(reach_rad + std::asin(cone.sine), 3.14));
        });
    });
}

glm::dvec3 SkyFrame::through_clouds(const glm::dvec3& behind_cd_m2,
                                    const glm::dvec3& direction_enu) const noexcept {
    if (!clouds_.shown()) return behind_cd_m2;
    return clouds_.seen_through(*air_between_, behind_cd_m2, direction_enu);
}

void SkyFrame::take_weather(const Scene& scene) noexcept {
    const Air& air = scene.air;
    const double extinction_per_m =
        air.model_enabled ? -std::log(air.visibility_contrast) / std::max(air.visibility_m, 1.0) : 0.0;
    flashes_ = cloud::flashes_at(scene);
    light_.flash = cloud::light_of(flashes_, scene, extinction_per_m);
    light_.near_extinction_per_m = extinction_per_m;
    const Ground& ground = scene.ground;
    // The rest of it soaks in.
    constexpr double kPuddles = 0.5;
    light_.film =
        ground.kind == Ground::Kind::kLand ? kPuddles * unit(ground.wet) * (1.0 - unit(ground.snow)) : 0.0;
}

void SkyFrame::adapt(const Scene& scene) {
    eye::LuminanceMean all;
    std::array<double, eye::kProbeCount> over_sky_cd_m2{};
    for (std::size_t i = 0; i < eye::kProbeCount; ++i) {
        const eye::ProbeDirection& probe = eye::probe_directions()[i];
        const double elevation =
            std::min(light_.horizon_elevation_rad + probe.above_horizon_rad, kZenith_rad);
        const glm::vec3 behind = light_.rgb_cd_m2(elevation, probe.azimuth_rad, Side::kByElevation);
        const auto sky_cd_m2 = static_cast<double>(shaders32::luminance_709(behind));
        probes_cd_m2_[i] =
            clouds_.shown() ? shaders64::luminance_709(clouds_.probed(*air_between_, glm::dvec3{behind}, i))
                            : sky_cd_m2;
        over_sky_cd_m2[i] = std::max(probes_cd_m2_[i] - sky_cd_m2, 0.0);
        all.add(probes_cd_m2_[i]);
    }
    const DisplaySettings& eye = displays_.front();
    if (eye.adapt_to != AdaptationSource::kSky) {
        eye::LuminanceMean seen;
        for (const ChannelView& view : scene.channel_views()) {
            if (!has_area(view.frustum)) continue;
            for (const eye::ViewProbe& probe : eye::view_probes(view)) {
                const Horizontal at = horizontal_of(probe.direction_enu);
                seen.add(clouded_luminance_cd_m2(at.elevation_rad, at.azimuth_rad), probe.solid_angle_sr);
            }
        }
        if (!seen.empty()) all = seen;
    }
    double wanted_cd_m2 =
        eye.adapt_to == AdaptationSource::kViewMean ? all.mean_cd_m2() : all.log_average_cd_m2();
    if (eye.adapt_to == AdaptationSource::kSky && clouds_.shown())
        wanted_cd_m2 = adapted_to_clouds(wanted_cd_m2, eye.tone, over_sky_cd_m2);
    if (eye.fixed_adaptation_cd_m2 > 0.0) wanted_cd_m2 = eye.fixed_adaptation_cd_m2;
    adaptation_.update(wanted_cd_m2, scene.time_s, tables_.jumped(), eye);
}

void SkyFrame::tone_screens(const Scene& scene, double smallest_pixel_sr) {
    double darkest_sky = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < eye::kProbeCount; ++i) {
        if (eye::probe_directions()[i].above_horizon_rad > 0.0)
            darkest_sky = std::min(darkest_sky, probes_cd_m2_[i]);
    }
    milky_way_codes_ = 0.0;
    // The faintest star that any screen shows.
    double faintest_mag = -std::numeric_limits<double>::infinity();
    for (std::size_t screen = 0; screen < display_tones_.size(); ++screen) {
        display_tones_[screen] = eye::tone_parameters(displays_[screen], adaptation_.luminance_cd_m2());
        clipped_[screen] = clipped_light(probes_cd_m2_, display_tones_[screen]);
        milky_way_codes_ =
            std::max(milky_way_codes_, milky_way_most_codes(darkest_sky, display_tones_[screen]));
        faintest_mag =
            std::max(faintest_mag, half_code_mag(darkest_sky, display_tones_[screen], smallest_pixel_sr));
    }
    if (target_ == Target::kDisplay) {
        tones_ = display_tones_;
        PointBackgrounds background{darkest_sky, {}};
        for (std::size_t i = 0; i < kPlanetCount; ++i) {
            const Horizontal at = horizontal_of(scene.planets[i].direction_enu);
            background.planets_cd_m2[i] = luminance_cd_m2(at.elevation_rad, at.azimuth_rad);
        }
        plan_stars(plan_, scene, background, faintest_mag);
        return;
    }
    exposure_exponent_ = eye::exposure_exponent(target_, adaptation_.luminance_cd_m2());
    std::fill(tones_.begin(), tones_.end(), eye::luminance_parameters(exposure_exponent_));
    plan_all_stars(plan_, scene);
}

double SkyFrame::luminance_cd_m2(double elevation_rad, double azimuth_rad) const {
    return static_cast<double>(
        shaders32::luminance_709(light_.rgb_cd_m2(elevation_rad, azimuth_rad, Side::kByElevation)));
}

double SkyFrame::clouded_luminance_cd_m2(double elevation_rad, double azimuth_rad) const {
    const glm::dvec3 behind{light_.rgb_cd_m2(elevation_rad, azimuth_rad, Side::kByElevation)};
    return shaders64::luminance_709(through_clouds(behind, direction_of({elevation_rad, azimuth_rad})));
}

// Adaptation leaves the belt out, so that it may depend on what the eye sees at all.
void SkyFrame::refresh_milky_way(const Scene& scene) {
    plan_milky_way(plan_, scene, milky_way_codes_);
    const bool first = shaded_.tables == 0 || tables_.jumped();
    if (!plan_.needs(Pass::kMilkyWay) || !milky_way_.make_map(scene.night, first)) {
        milky_way_shown_ = false;
        return;
    }
    light_.milky_way = lit_belt(scene, milky_way_.map(), plan_.night_share);
    const bool exposed_anew = exposure_exponent_ != shaded_.exposure_exponent;
    milky_way_.shade(light_, tones_, first || exposed_anew || !milky_way_shown_);
    milky_way_shown_ = true;
}

void SkyFrame::dazzle(const Scene& scene) {
    // Luminance is without an eye.
    const bool wanted = displays_.front().glare && target_ == Target::kDisplay;
    if (wanted) {
        GlareSource sun = render::sun_glare(scene, tables_.air(), light_);
        GlareSource moon = render::moon_glare(scene, tables_.air(), light_);
        sun.rgb_lux *= clouds_.transmittance(CloudFrame::Body::kSun);
        moon.rgb_lux *= clouds_.transmittance(CloudFrame::Body::kMoon);
        veil(sun, sun_glares_, sun_veiled_);
        veil(moon, moon_glares_, moon_veiled_);
    }
    const auto reach_rad = [&](const std::vector<Glare>& glares) {
        double farthest = 0.0;  // as far as any screen shows it
        for (const Glare& glare : glares)
            farthest = std::max(farthest, wanted ? glare.reach_rad() : 0.0);
        return farthest;
    };
    plan_glare(plan_, Pass::kSunGlare, wanted && scene.sun.enabled, reach_rad(sun_glares_));
    plan_glare(plan_, Pass::kMoonGlare, wanted && scene.moon.enabled, reach_rad(moon_glares_));
}

void SkyFrame::veil(const GlareSource& source, std::vector<Glare>& glares, VeilMade& made) {
    const double adaptation = adaptation_.luminance_cd_m2();
    const bool serves =
        made.tables == tables_.revision() && made.fog == light_.veil_revision && !tables_.jumped() &&
        std::abs(adaptation - made.adaptation_cd_m2) <= kAdaptationStep * made.adaptation_cd_m2 &&
        still_serves(made.source, source);
    if (serves) {
        for (Glare& glare : glares)
            glare.follow(source, light_);
        return;
    }
    for (std::size_t screen = 0; screen < glares.size(); ++screen)
        glares[screen].update(source, light_, displays_[screen], tones_[screen]);
    made = {source, tables_.revision(), adaptation, light_.veil_revision};
}

void SkyFrame::refresh_dome(double pixel_rad) {
    const double adaptation = adaptation_.luminance_cd_m2();
    DomeLayout wanted = dome_layout(light_, pixel_rad, adaptation, tables_.air_in_use());
    wanted.veil = veil_.bends_revision();
    const bool at_once = shaded_.tables == 0 || tables_.jumped();
    // A fade that runs is not begun anew for nodes that only could stand better.
    const bool lay = at_once || !still_serves(dome_.layout(), wanted) ||
                     (dome_.share() >= 1.0 && !still_fits(dome_.layout(), wanted));
    const bool replaced = lay || shaded_.tables != tables_.revision();
    const bool turned = std::abs(std::remainder(wanted.second_azimuth_rad - shaded_.moon_from_sun_rad,
                                                2.0 * std::numbers::pi)) > static_cast<double>(kLightStep);
    const float flash_cd_m2 = brightest_of_flash(light_);
    const bool scaled = scale_moved(light_.sun.scale_xyz, shaded_.sun_scale) ||
                        scale_moved(light_.moon.scale_xyz, shaded_.moon_scale) || turned ||
                        std::abs(light_.night_share - shaded_.night_share) > kLightStep ||
                        light_.veil_revision != shaded_.veil ||
                        std::abs(light_.film - shaded_.film) > static_cast<double>(kLightStep) ||
                        flash_moved(flash_cd_m2, shaded_.flash_cd_m2, adaptation);
    const bool toned =
        std::abs(adaptation - shaded_.adaptation_cd_m2) > kAdaptationStep * shaded_.adaptation_cd_m2 ||
        exposure_exponent_ != shaded_.exposure_exponent;
    const bool of_light = target_ != Target::kDisplay;
    const Quality& quality = of_light ? kFinest : quality_;
    mesh_azimuth_rad_ = wanted.azimuth_rad;
    if (lay) {
        bend_.measure(light_, display_tones_, mesh_azimuth_rad_, pixel_rad);
        dome_.lay_out(wanted, bend_, plan_dome(bend_, at_once ? DomeBend::kLeast : dome_.size(), quality));
    }
    if (replaced || scaled) {
        const auto change = at_once || of_light ? Dome::Change::kAtOnce
                            : replaced          ? Dome::Change::kReplaced
                                                : Dome::Change::kScaled;
        dome_.look_up(light_, mesh_azimuth_rad_, change);
        ++light_revision_;
        shaded_.tables = tables_.revision();
        shaded_.sun_scale = light_.sun.scale_xyz;
        shaded_.moon_scale = light_.moon.scale_xyz;
        shaded_.moon_from_sun_rad = wanted.second_azimuth_rad;
        shaded_.night_share = light_.night_share;
        shaded_.veil = light_.veil_revision;
        shaded_.flash_cd_m2 = flash_cd_m2;
        shaded_.film = light_.film;
    }
    if (replaced || scaled || toned) {
        dome_.encode(tones_);
        shaded_.adaptation_cd_m2 = adaptation;
        shaded_.exposure_exponent = exposure_exponent_;
        ++vertices_revision_;
    }
    if (lay) {
        dome_error_codes_ = dome_.triangulate(light_, mesh_azimuth_rad_, tones_.front(), quality.error_codes);
        ++triangles_revision_;
    }
    dome_.step();
}

void SkyFrame::refresh_sea(const Scene& scene, double pixel_rad) {
    const bool lit = light_.sea != nullptr && (light_.sun.sea != nullptr || light_.moon.sea != nullptr);
    waves_ = sky::sea_waves(scene, pixel_rad);
    plan_waves(plan_, scene, waves_, lit);
    const double height_m = sky::height_above_sea_m(scene);
    const int rows = plan_.needs(Pass::kWaves) ? SeaMesh::rows(dome_, waves_, height_m, pixel_rad) : 0;
    const sky::SlopeVariance& variance = waves_.variance;
    sea_shading_ = {height_m,
                    0.5 / (kEarthRadius_m * height_m),
                    pixel_rad,
                    direction_of(light_.glittering().source),
                    {variance.east_east, variance.north_north, variance.east_north}};
    const bool laid = rows > 0 && (rows != sea_rows_ || sea_light_seen_ != light_revision_);
    if (laid) {
        sea_.lay_out(dome_, light_, mesh_azimuth_rad_, rows);
        sea_light_seen_ = light_revision_;
    } else if (rows > 0 && sea_colours_seen_ != vertices_revision_) {
        sea_.colour(dome_);
    }
    if (laid || (rows > 0 && sea_colours_seen_ != vertices_revision_)) ++sea_revision_;
    if (rows > 0) sea_colours_seen_ = vertices_revision_;
    sea_rows_ = rows;
    PlannedPass& planned = plan_.passes[static_cast<std::size_t>(Pass::kWaves)];
    planned.resolution = {rows, rows > 0 ? dome_.size().columns : 0};
}

void SkyFrame::tell_dome() noexcept {
    PlannedPass& planned = plan_.passes[static_cast<std::size_t>(Pass::kDome)];
    planned.resolution = {dome_.size().rows(), dome_.size().columns};
    planned.error_codes = dome_error_codes_;
}

glm::dvec3 SkyFrame::exact_colour(const glm::dvec3& direction_enu, std::size_t screen) const {
    const Horizontal at = horizontal_of(direction_enu);
    const glm::dvec3 behind{light_.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation)};
    const glm::dvec3 rgb = through_clouds(behind, direction_enu);
    const bool sea = sea_rows_ > 0 && at.elevation_rad < light_.horizon_elevation_rad;
    return sea ? waves_colour(direction_enu, rgb, screen) : shaders64::shown(rgb, tones_[screen]);
}

glm::dvec3 SkyFrame::waves_colour(const glm::dvec3& direction_enu, const glm::dvec3& mean_cd_m2,
                                  std::size_t screen) const {
    const SeaShading& sea = sea_shading_;
    const glm::dvec2 at_m = shaders64::sea_point_m(direction_enu, sea.height_m, sea.curvature_m2);
    const double footprint_m = shaders64::footprint_m(at_m, sea.height_m, sea.pixel_rad);
    shaders64::ResolvedSlope slope{};
    for (const shaders64::WaveTrain& train : waves_.all())
        slope = shaders64::with_train(slope, train, at_m, footprint_m);
    const Horizontal at = horizontal_of(direction_enu);
    const SlopeLight slopes = light_.of_slopes(at.elevation_rad, at.azimuth_rad);
    const glm::dvec3 smooth{slopes.without_glitter(glm::vec3{mean_cd_m2})};
    const glm::dvec3 bend = glm::dvec3{slopes.bend_cd_m2} / std::max(shaders64::luminance_709(smooth), 1e-12);
    const glm::dvec3 to_eye = glm::normalize(glm::dvec3{-at_m, sea.height_m});
    const glm::dvec3 lit =
        shaders64::wave_lit({smooth, slopes.east, slopes.north, bend, slopes.glitter}, slope,
                            shaders64::mirroring_slope(to_eye, sea.source_enu), sea.variance);
    return glm::mix(shaders64::shown(mean_cd_m2, tones_[screen]), shaders64::shown(lit, tones_[screen]),
                    shaders64::shaded_share(waves_.trains.front().number_rad_m, footprint_m));
}

glm::dvec3 SkyFrame::exact_dome_colour(const glm::dvec3& direction_enu, std::size_t screen) const {
    const Horizontal at = horizontal_of(direction_enu);
    const glm::vec3 rgb = light_.smooth_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation);
    return shaders64::shown(glm::dvec3{rgb}, tones_[screen]);
}

}  // namespace skyig::render
