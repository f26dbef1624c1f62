#include "server/scene_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <GeographicLib/LocalCartesian.hpp>
#include <glm/glm.hpp>

#include "server/ephemeris/time.h"
#include "server/world/conditions.h"

namespace skyig::server {
namespace {

static_assert(config::kMaxChannels <= render::kMaxChannels,
              "every configured channel has a place in the scene");

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;

glm::dmat3 axes_from_parent(double yaw_deg, double pitch_deg, double roll_deg) noexcept {
    return render::body_from_ned(yaw_deg * kRadPerDeg, pitch_deg * kRadPerDeg, roll_deg * kRadPerDeg);
}

glm::dmat3 axes_from_parent(const world::ViewPose& pose) noexcept {
    return axes_from_parent(pose.yaw_deg, pose.pitch_deg, pose.roll_deg);
}

/// Eye point of a view along the ownship's body axes: the group is moved and turned first, then the view in
/// it.
glm::dvec3 eye_offset_m(const world::Views& views, const world::View& view) noexcept {
    const world::ViewPose& group = views.group(view.group_id);
    const glm::dmat3 body_from_group = glm::transpose(axes_from_parent(group));
    return group.offset_m + body_from_group * view.pose.offset_m;
}

glm::dmat3 body_from_enu(const world::Ownship& ownship) noexcept {
    return axes_from_parent(ownship.yaw_deg, ownship.pitch_deg, ownship.roll_deg) * render::ned_from_enu();
}

render::Frustum frustum_of(const world::HalfAngles& angles) noexcept {
    return {angles.left_deg * kRadPerDeg, angles.right_deg * kRadPerDeg, angles.bottom_deg * kRadPerDeg,
            angles.top_deg * kRadPerDeg};
}

/// Mirror mode and pixel replication as CIGI numbers them: bit 0 and bit 1 of the one are across and upright,
/// of the other upright and across.
render::Showing showing_of(const world::View& view) noexcept {
    return {.mirrored_across = (view.mirror_mode & 1U) != 0,
            .mirrored_upright = (view.mirror_mode & 2U) != 0,
            .repeat_across = (view.pixel_replication & 2U) != 0 ? 2 : 1,
            .repeat_upright = (view.pixel_replication & 1U) != 0 ? 2 : 1,
            .parallel = view.orthographic};
}

static_assert(static_cast<int>(config::Pattern::kName) == static_cast<int>(render::Pattern::kName) &&
                  config::kPatternNames == render::kPatternNames,
              "one order of patterns in settings and pictures");

/// Mean Johnson B-V of Mercury, Venus, Mars, Jupiter, Saturn (Allen's Astrophysical Quantities, 4th edition
/// 2000).
constexpr std::array<double, render::kPlanetCount> kPlanetBv{0.93, 0.82, 1.36, 0.83, 1.04};
static_assert(render::kPlanetCount == ephemeris::kPlanetCount, "one order of planets in sky and scene");

void light_moon(const ephemeris::MoonState& state, render::Moon& moon) noexcept {
    moon.direction_enu = state.direction_enu;
    moon.distance_km = state.distance_km;
    moon.angular_radius_rad = state.angular_radius_rad;
    moon.to_sun_enu = state.to_sun_enu;
    moon.phase_angle_rad = state.phase_angle_rad;
    moon.enu_from_selenographic = state.enu_from_selenographic;
    moon.shadow_axis_enu = state.shadow_axis_enu;
    moon.umbra_radius = state.umbra_radius;
    moon.penumbra_radius = state.penumbra_radius;
    moon.sunlit = state.sunlit;
}

void light(const ephemeris::SkyState& sky, const world::CelestialSwitches& switches,
           render::Scene& scene) noexcept {
    scene.sun.enabled = switches.sun;
    scene.sun.direction_enu = sky.sun.direction_enu;
    scene.sun.distance_au = sky.sun.distance_au;
    scene.sun.angular_radius_rad = sky.sun.angular_radius_rad;
    // A Moon that is switched off covers nothing.
    scene.sun.unobscured = switches.moon ? 1.0 - sky.sun.obscured : 1.0;

    scene.moon.enabled = switches.moon;
    light_moon(sky.moon, scene.moon);

    scene.stars.enabled = switches.stars;
    scene.stars.intensity = switches.star_intensity;
    scene.stars.enu_from_gcrs = sky.enu_from_gcrs;
    scene.stars.earth_velocity_c = sky.earth_velocity_c;
    scene.stars.years_since_j2000 = sky.years_since_j2000;
    for (std::size_t i = 0; i < render::kPlanetCount; ++i) {
        scene.planets[i] = {.direction_enu = sky.planets[i].direction_enu,
                            .magnitude = sky.planets[i].magnitude,
                            .bv = kPlanetBv[i]};
    }
}

render::Air air_of(const world::AirState& state) noexcept {
    render::Air air;
    air.model_enabled = state.model_enabled;
    air.visibility_m = state.visibility_m;
    air.visibility_contrast = state.visibility_contrast;
    air.temperature_c = state.temperature_c;
    air.pressure_hpa = state.pressure_hpa;
    air.humidity_pct = state.humidity_pct;
    return air;
}

render::Wave wave_of(const world::WaveAt& at) noexcept {
    const protocol::cigi::WaveControl& told = *at.wave;
    render::Wave wave;
    wave.height_m = static_cast<double>(told.height) * at.weight;
    wave.length_m = static_cast<double>(told.wavelength);
    wave.period_s = static_cast<double>(told.period);
    wave.direction_rad = static_cast<double>(told.direction) * kRadPerDeg;
    wave.phase_rad = static_cast<double>(told.phase_offset) * kRadPerDeg;
    wave.leading_rad = static_cast<double>(told.leading) * kRadPerDeg;
    wave.breaker = static_cast<render::Wave::Breaker>(told.breaker_type);
    return wave;
}

static_assert(world::WavesAt::kMost <= render::kMaxWaves, "every wave at a point has a place in the scene");

world::RegionsAt regions_at(const world::World& world, const render::Eye& eye) noexcept {
    return world.surfaces().is_regional()
               ? world::RegionsAt(world.weather(), world::GroundPoint(eye.latitude_deg, eye.longitude_deg))
               : world::RegionsAt();
}

render::Ground ground_of(const render::Ground& settings, const world::World& world,
                         const world::RegionsAt& regions, const weather::GroundCover& fallen) noexcept {
    const auto told = [&](std::uint16_t condition_id) {
        return world::condition_cover(world.surfaces(), regions, condition_id);
    };
    render::Ground ground = settings;
    ground.snow = told(world::kSnowCondition).value_or(settings.snow + (1.0 - settings.snow) * fallen.snow());
    ground.wet = told(world::kWetCondition).value_or(fallen.wet());
    ground.wind_m_s = world.air().wind_horizontal_m_s;
    ground.wind_from_rad = world.air().wind_from_deg * kRadPerDeg;
    return ground;
}

render::Sea sea_of(const world::World& world, const world::RegionsAt& regions) noexcept {
    const world::SurfaceStore& surfaces = world.surfaces();
    const world::SeaState state = world::sea_at(surfaces, regions);
    render::Sea sea;
    sea.height_m = state.height_m;
    sea.temperature_c = state.temperature_c;
    sea.clarity = state.clarity_pct / 100.0;
    sea.whitecaps = state.whitecaps;
    for (const world::WaveAt& at : world::WavesAt(surfaces, regions))
        sea.waves[sea.wave_count++] = wave_of(at);
    return sea;
}

double elevation_deg(const glm::dvec3& direction) noexcept {
    return std::atan2(direction.z, std::hypot(direction.x, direction.y)) / kRadPerDeg;
}

double azimuth_deg(const glm::dvec3& direction) noexcept {
    const double azimuth = std::atan2(direction.x, direction.y) / kRadPerDeg;
    return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
}

}  // namespace

render::Scene SceneBuilder::build(const world::World& world, std::uint64_t frame_number) {
    render::Scene scene;
    scene.frame_number = frame_number;
    scene.time_s = world.time_s();
    place_eye(world, scene);
    aim_views(world, scene);
    const ephemeris::UtcClockTime& utc = world.clock().utc();
    const ephemeris::KnownOffsets known = offsets_.at(utc);
    instant_ = ephemeris::make_instant(utc, known, orientation_.at(utc, known));
    const ephemeris::Geodetic eye{scene.eye.latitude_deg, scene.eye.longitude_deg, scene.eye.height_m};
    light(clockwork_.state(instant_, eye), world.celestial(), scene);
    scene.air = air_of(world.air());
    scene.sky = sky_;
    scene.night = night_;
    weather_.build(world, scene);
    const world::RegionsAt regions = regions_at(world, scene.eye);
    scene.ground = ground_of(ground_, world, regions, weather_.ground());
    scene.sea = sea_of(world, regions);
    if (sky_.model == render::SkyModel::kWindlight && sky_.windlight.places_sun)
        scene.sun.direction_enu = render::placed_sun_enu(sky_.windlight);
    return scene;
}

void SceneBuilder::place_eye(const world::World& world, render::Scene& scene) {
    const world::Ownship& ownship = world.ownship();
    const auto views = world.views().all();
    glm::dvec3 sum{0.0};
    for (const world::View& view : views)
        sum += eye_offset_m(world.views(), view);
    const glm::dvec3 mean = views.empty() ? sum : sum / static_cast<double>(views.size());
    eye_spread_m_ = 0.0;
    for (const world::View& view : views) {
        eye_spread_m_ = std::max(eye_spread_m_, glm::distance(mean, eye_offset_m(world.views(), view)));
    }
    const ephemeris::Geodetic& place = ownship.position;
    scene.eye = {place.latitude_deg, place.longitude_deg, place.height_m};
    ownship_from_eye_ = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    // Without offsets the host's numbers go through untouched; next to a pole a metre may be many degrees of
    // longitude.
    if (mean == glm::dvec3{0.0}) return;
    const glm::dvec3 offset_enu = glm::transpose(body_from_enu(ownship)) * mean;
    const GeographicLib::LocalCartesian local(place.latitude_deg, place.longitude_deg, place.height_m);
    local.Reverse(offset_enu.x, offset_enu.y, offset_enu.z, scene.eye.latitude_deg, scene.eye.longitude_deg,
                  scene.eye.height_m, ownship_from_eye_);
}

void SceneBuilder::aim_views(const world::World& world, render::Scene& scene) noexcept {
    const std::vector<double>& m = ownship_from_eye_;
    const glm::dmat3 enu_from_eye_enu{glm::dvec3{m[0], m[3], m[6]}, glm::dvec3{m[1], m[4], m[7]},
                                      glm::dvec3{m[2], m[5], m[8]}};
    const glm::dmat3 body_from_eye_enu = body_from_enu(world.ownship()) * enu_from_eye_enu;
    const auto views = world.views().all();
    scene.view_count = std::min(views.size(), render::kMaxChannels);
    for (std::size_t i = 0; i < scene.view_count; ++i) {
        const world::View& view = views[i];
        const glm::dmat3 group_from_body = axes_from_parent(world.views().group(view.group_id));
        scene.views[i].frustum = frustum_of(view.half_angles);
        scene.views[i].showing = showing_of(view);
        scene.views[i].pattern = static_cast<render::Pattern>(view.pattern);
        scene.views[i].view_from_enu =
            render::view_from_body() * axes_from_parent(view.pose) * group_from_body * body_from_eye_enu;
    }
}

SkyAngles sky_angles(const render::Scene& scene) noexcept {
    SkyAngles angles;
    angles.sun_elevation_deg = elevation_deg(scene.sun.direction_enu);
    angles.sun_azimuth_deg = azimuth_deg(scene.sun.direction_enu);
    angles.moon_elevation_deg = elevation_deg(scene.moon.direction_enu);
    angles.moon_azimuth_deg = azimuth_deg(scene.moon.direction_enu);
    angles.moon_lit_fraction = 0.5 * (1.0 + std::cos(scene.moon.phase_angle_rad));
    return angles;
}

}  // namespace skyig::server
