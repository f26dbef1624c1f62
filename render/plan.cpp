#include "render/plan.h"

#include <algorithm>
#include <cmath>

#include "render/cloud/shadow_map.h"
#include "render/cloud_models.h"
#include "render/dome_bend.h"
#include "render/eye/point_threshold.h"
#include "render/geometry.h"
#include "render/glare.h"
#include "render/night/milky_way_map.h"
#include "render/night/natural_light.h"
#include "render/night/night_sky.h"
#include "render/night/star_colour.h"
#include "render/night/star_scintillation.h"
#include "render/precipitation/exposure.h"
#include "render/precipitation/streak_field.h"
#include "render/sky/sea_surface.h"
#include "render/sky/staleness.h"

namespace skyig::render {

namespace {

constexpr double kDegree = glm::radians(1.0);

constexpr double kBrightestStar_mag = -1.46;
// Planets below this stand under the horizon wherever a cockpit may be; from higher up they only cost a pass.
constexpr double kLowestPlanet_sine = -0.1;
constexpr double kNoStarIsFainter_mag = 99.0;
constexpr double kNothing_mag = 999.0;

double faintest_seen_mag(double background_cd_m2) {
    return faintest_visible_mag(background_cd_m2) - 2.5 * std::log10(kFaintestSeen);
}

// Of the stars and planets that their sky lets through; none: kNothing_mag.
double brightest_seen_mag(const Scene& scene, const PointBackgrounds& background) {
    const auto seen = [](double magnitude, double background_cd_m2) {
        return magnitude <= faintest_seen_mag(background_cd_m2);
    };
    double brightest = seen(kBrightestStar_mag, background.darkest_cd_m2) ? kBrightestStar_mag : kNothing_mag;
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        const Planet& planet = scene.planets[i];
        if (planet.direction_enu.z > kLowestPlanet_sine &&
            seen(planet.magnitude, background.planets_cd_m2[i]))
            brightest = std::min(brightest, planet.magnitude);
    }
    return brightest;
}

// Part of the disc that is left when the corona begins to show and when it shows in full.
constexpr double kCoronaBegins = 0.02;
constexpr double kCoronaWhole = 0.002;

// A size of the direction table, and its largest error in display codes: light_tables_test measures it.
struct TableSize {
    sky::SkyViewSize size;
    double error_codes;
};
constexpr std::array<TableSize, 3> kTables{
    {{{24, 12, 21, 32}, 8.8}, {{40, 20, 33, 48}, 3.1}, {{56, 28, 49, 64}, 1.3}}};

// The table errs smoothly over degrees, where no eye finds an edge: it may err by this many budgets.
constexpr double kTableShare = 8.0;

constexpr std::string_view kThinnedOut = "thinned out for the frame rate";

struct Verdict {
    bool needed;
    std::string_view reason;
};

Verdict plan_sky(bool lights, bool valid, bool same_model, double now_rad, double held_rad,
                 bool height_stale) {
    if (!lights) return {false, "the source is too low to light the air"};
    if (!valid) return {true, "no table of this air yet"};
    if (!same_model) return {true, "the sky's model, its parameters or the sea have changed"};
    if (std::abs(now_rad - held_rad) > sky::source_step_rad(held_rad))
        return {true, "the source has moved on"};
    if (height_stale) return {true, "the eye has changed height"};
    return {false, "the table is fresh"};
}

Verdict plan_disc(bool enabled, double elevation_rad, double radius_rad, double sets_at_rad) {
    if (!enabled) return {false, "switched off"};
    if (elevation_rad + 1.1 * radius_rad < sets_at_rad) return {false, "below the horizon"};
    return {true, "above the horizon"};
}

Verdict plan_precipitation(const Scene& scene) {
    const auto falling = scene.weather.all_precipitations();
    const bool any = std::any_of(falling.begin(), falling.end(),
                                 [](const Precipitation& what) { return what.rate_mm_h > 0.0; });
    if (!any) return {false, "nothing falls"};
    const bool here = std::any_of(falling.begin(), falling.end(), [&](const Precipitation& what) {
        return precipitation::falls_on(what, scene.eye);
    });
    if (!here) return {false, "the eye is above what falls"};
    return {true, "something falls round the eye"};
}

Cost cost_of(Pass pass) {
    switch (pass) {
        case Pass::kAirTables:
            return Cost::kNewAir;
        case Pass::kSunSky:
        case Pass::kMoonSky:
        case Pass::kNightSky:
        case Pass::kVeil:
            return Cost::kNewTable;
        case Pass::kClouds:
        case Pass::kNearClouds:
        case Pass::kCloudShadows:
        case Pass::kExposure:
            return Cost::kFrame;
        case Pass::kDome:
        case Pass::kWaves:
        case Pass::kMilkyWay:
        case Pass::kStars:
        case Pass::kCorona:
        case Pass::kSunDisc:
        case Pass::kMoonDisc:
        case Pass::kCoveredThings:
        case Pass::kWetThings:
        case Pass::kPrecipitation:
        case Pass::kSunGlare:
        case Pass::kMoonGlare:
        case Pass::kWindscreen:
        case Pass::kPattern:
        case Pass::kOverlay:
        case Pass::kWarp:
        case Pass::kResampling:
        case Pass::kBlend:
            break;
    }
    return Cost::kChannel;
}

void put(Plan& plan, Pass pass, const Verdict& verdict) {
    PlannedPass& planned = plan.passes[static_cast<std::size_t>(pass)];
    const bool forced = !verdict.needed && plan.forced[static_cast<std::size_t>(pass)];
    planned.pass = pass;
    planned.needed = verdict.needed || forced;
    planned.reason = forced ? "forced" : verdict.reason;
    planned.cost = cost_of(pass);
}

void plan_skies(Plan& plan, const Scene& scene, const Held& held, double sun_rad, double moon_rad) {
    const double horizon_rad = horizon_elevation_rad(scene.eye.height_m);
    // Sunlit air ends at -21.5 deg (towards the Sun it outshines the night sky's low parts beyond -18),
    // moonlit air at -10 deg of the Moon and where twilight drowns it. From high up sources light air beyond
    // the level horizon.
    plan.sun_share = smooth_step(-21.5 * kDegree, -18.5 * kDegree, sun_rad - horizon_rad);
    plan.moon_share = smooth_step(-10.0 * kDegree, -6.0 * kDegree, moon_rad - horizon_rad) *
                      smooth_step(-3.0 * kDegree, -6.0 * kDegree, sun_rad);
    const auto forced = [&](Pass pass) { return plan.forced[static_cast<std::size_t>(pass)]; };
    if (forced(Pass::kSunSky)) plan.sun_share = 1.0;
    if (forced(Pass::kMoonSky)) plan.moon_share = 1.0;
    // The Moon's table is begun before its light counts.
    const bool moon_lights =
        forced(Pass::kMoonSky) || (moon_rad - horizon_rad > -10.5 * kDegree && sun_rad < -2.0 * kDegree);
    put(plan, Pass::kSunSky,
        plan_sky(plan.sun_share > 0.0, held.sun_sky_valid, held.sun_sky_model, sun_rad,
                 held.sun_sky_elevation_rad,
                 sky::height_is_stale(scene.eye.height_m, held.sun_sky_height_m)));
    put(plan, Pass::kMoonSky,
        plan_sky(moon_lights, held.moon_sky_valid, held.moon_sky_model, moon_rad, held.moon_sky_elevation_rad,
                 sky::height_is_stale(scene.eye.height_m, held.moon_sky_height_m)));
    for (const Pass pass : {Pass::kSunSky, Pass::kMoonSky}) {
        PlannedPass& planned = plan.passes[static_cast<std::size_t>(pass)];
        planned.resolution = {plan.table.sky_rows + plan.table.ground_rows, plan.table.columns};
        planned.error_codes = direction_table_error_codes(plan.table);
    }
}

void plan_night(Plan& plan, double sun_rad) {
    plan.night_share = night::night_share(sun_rad);
    if (plan.forced[static_cast<std::size_t>(Pass::kNightSky)]) plan.night_share = 1.0;
    // As with the Moon's, its table is begun before its light counts.
    const bool near = sun_rad < -2.0 * kDegree;
    put(plan, Pass::kNightSky,
        plan.night_share > 0.0 ? Verdict{true, "the sky is dark enough to show it"}
        : near                 ? Verdict{true, "the sky will soon be dark enough to show it"}
                               : Verdict{false, "below half a code: daylight outshines it"});
    plan.passes[static_cast<std::size_t>(Pass::kNightSky)].resolution = {
        night::NightSky::kSkyRows + night::NightSky::kGroundRows, night::NightSky::kColumns};
    put(plan, Pass::kMilkyWay, {false, "not decided yet"});
}

// What rain and snow do to another renderer's things, and what it is asked for.
void plan_ground(Plan& plan, const Scene& scene) {
    using precipitation::ExposureView;
    const bool land = scene.ground.kind == Ground::Kind::kLand;
    const bool wet = land && scene.ground.wet > 0.0;
    const bool white = land && scene.ground.snow > 0.0;
    put(plan, Pass::kExposure,
        wet || white ? Verdict{true, "another renderer may tell what keeps rain or snow off"}
                     : Verdict{false, "nothing lies on the land"});
    plan.passes[static_cast<std::size_t>(Pass::kExposure)].resolution = {ExposureView::kSize_px,
                                                                         ExposureView::kSize_px};
    put(plan, Pass::kCoveredThings,
        white ? Verdict{true, "snow lies on another renderer's things"}
        : wet ? Verdict{true, "water darkens another renderer's things"}
              : Verdict{false, "the land is dry and bare"});
    const bool film = wet && scene.ground.snow < 1.0;
    put(plan, Pass::kWetThings,
        film  ? Verdict{true, "another renderer's land is wet"}
        : wet ? Verdict{false, "the land lies under snow"}
              : Verdict{false, "the land is dry"});
}

void plan_over_pictures(Plan& plan, const Scene& scene) {
    const auto views = scene.channel_views();
    const bool pane = std::any_of(views.begin(), views.end(),
                                  [](const ChannelView& view) { return view.windscreen_m > 0.0F; });
    const bool rain = scene.weather.precipitation_count > 0;
    put(plan, Pass::kWindscreen,
        !pane  ? Verdict{false, "no channel looks through one"}
        : rain ? Verdict{true, "what falls stands in drops on a channel's pane"}
               : Verdict{true, "drops that are left on a channel's pane dry off; free of cost without any"});
    const bool pattern = std::any_of(views.begin(), views.end(),
                                     [](const ChannelView& view) { return view.pattern != Pattern::kOff; });
    put(plan, Pass::kPattern,
        pattern ? Verdict{true, "a channel shows it in place of the sky"}
                : Verdict{false, "no channel is asked to show one"});
    const bool text =
        std::any_of(views.begin(), views.end(), [](const ChannelView& view) { return view.overlay != 0; });
    put(plan, Pass::kOverlay,
        text ? Verdict{true, "a channel shows lines of text"} : Verdict{false, "no channel shows any text"});
}

}  // namespace

std::string_view pass_name(Pass pass) noexcept {
    constexpr std::array<std::string_view, kPassCount> kNames{
        "air tables",    "sun sky",       "moon sky",   "night sky",  "veil",           "clouds",
        "near clouds",   "cloud shadows", "dome",       "waves",      "milky way",      "stars",
        "corona",        "sun disc",      "moon disc",  "exposure",   "covered things", "wet things",
        "precipitation", "sun glare",     "moon glare", "windscreen", "pattern",        "overlay",
        "warp",          "resampling",    "blend"};
    return kNames[static_cast<std::size_t>(pass)];
}

std::string_view thin_name(Thin thin) noexcept {
    constexpr std::array<std::string_view, kThinCount> kNames{
        "cloud-refresh", "", "", "", "precipitation", "waves", "glare", "milky-way", "cloud-tones",
        "cloud-shadows"};
    return kNames[static_cast<std::size_t>(thin)];
}

Thinned thinnable(const Plan& plan) noexcept {
    Thinned would;
    const auto note = [&](Thin thin, bool there) {
        would[static_cast<std::size_t>(thin)] = there && !plan.thins(thin);
    };
    note(Thin::kCloudRefresh, plan.needs(Pass::kClouds));
    note(Thin::kCloudTones, plan.needs(Pass::kClouds));
    note(Thin::kCloudShadows, plan.needs(Pass::kCloudShadows));
    note(Thin::kPrecipitation, plan.needs(Pass::kPrecipitation));
    note(Thin::kWaves, plan.needs(Pass::kWaves));
    note(Thin::kGlare, plan.needs(Pass::kSunGlare) || plan.needs(Pass::kMoonGlare));
    note(Thin::kMilkyWay, plan.needs(Pass::kMilkyWay));
    return would;
}

std::string_view cost_name(Cost cost) noexcept {
    constexpr std::array<std::string_view, 4> kNames{"per air", "per table", "per frame", "per channel"};
    return kNames[static_cast<std::size_t>(cost)];
}

double faintest_visible_mag(double background_cd_m2) noexcept {
    return -2.5 * std::log10(eye::threshold_lux(background_cd_m2) / night::star_illuminance_lux(0.0));
}

sky::SkyViewSize direction_table_size(const Quality& quality) noexcept {
    for (const TableSize& table : kTables) {
        if (table.error_codes <= kTableShare * quality.error_codes) return table.size;
    }
    return kTables.back().size;
}

double direction_table_error_codes(const sky::SkyViewSize& size) noexcept {
    for (const TableSize& table : kTables) {
        if (table.size == size) return table.error_codes;
    }
    return kTables.front().error_codes;
}

Plan make_plan(const Scene& scene, const Held& held, const sky::RefractionRow& refraction,
               const Quality& quality) noexcept {
    const double sets_at_rad = refraction.setting_elevation_rad();
    const double sun_rad = horizontal_of(scene.sun.direction_enu).elevation_rad;
    const double moon_rad = horizontal_of(scene.moon.direction_enu).elevation_rad;
    Plan plan;
    plan.forced = quality.forced;
    plan.thinned = quality.thinned;
    plan.sky_model = scene.sky.model;
    plan.table = direction_table_size(quality);
    const bool air_stale = !held.air_valid || !held.air_fresh;
    put(plan, Pass::kAirTables, {air_stale, air_stale ? "the air is new" : "the air has not changed"});
    plan_skies(plan, scene, held, sun_rad, moon_rad);
    plan_night(plan, sun_rad);
    put(plan, Pass::kVeil, {false, "not decided yet"});
    put(plan, Pass::kClouds, {false, "not decided yet"});
    put(plan, Pass::kNearClouds, {false, "not decided yet"});
    put(plan, Pass::kCloudShadows, {false, "not decided yet"});
    put(plan, Pass::kDome, {true, "smooth light of all directions"});
    put(plan, Pass::kWaves, {false, "not decided yet"});
    put(plan, Pass::kStars, {false, "not decided yet"});
    plan.corona_share = smooth_step(kCoronaBegins, kCoronaWhole, scene.sun.unobscured);
    const double sun_radius_rad = scene.sun.angular_radius_rad;
    put(plan, Pass::kCorona,
        plan.corona_share > 0.0 ? plan_disc(scene.sun.enabled, sun_rad, 8.0 * sun_radius_rad, sets_at_rad)
                                : Verdict{false, "the Sun outshines it"});
    put(plan, Pass::kSunDisc, plan_disc(scene.sun.enabled, sun_rad, sun_radius_rad, sets_at_rad));
    put(plan, Pass::kMoonDisc,
        plan_disc(scene.moon.enabled, moon_rad, scene.moon.angular_radius_rad, sets_at_rad));
    plan_ground(plan, scene);
    Verdict falls = plan_precipitation(scene);
    if (falls.needed && plan.thins(Thin::kPrecipitation))
        falls.reason = "something falls round the eye: half the streaks, thinned out";
    put(plan, Pass::kPrecipitation, falls);
    for (const Pass pass : {Pass::kSunGlare, Pass::kMoonGlare})
        put(plan, pass, {false, "not decided yet"});
    plan_over_pictures(plan, scene);
    plan_screens(plan, {});
    return plan;
}

void plan_screens(Plan& plan, std::span<const Channel> channels) noexcept {
    const auto any = [channels](const auto& wanted) {
        return std::any_of(channels.begin(), channels.end(), wanted);
    };
    const bool direct = any([](const Channel& c) { return c.warp && c.drawing == WarpDrawing::kDirect; });
    const bool resampled =
        any([](const Channel& c) { return c.warp && c.drawing == WarpDrawing::kResampled; });
    const bool blended = any([](const Channel& c) { return c.blend != nullptr; });
    put(plan, Pass::kWarp,
        {direct, direct ? "a channel's screen is warped: all that is drawn is placed by it"
                        : "no channel is drawn through a warp"});
    put(plan, Pass::kResampling,
        {resampled, resampled ? "the settings want a warped channel drawn flat and resampled"
                              : "no warped channel is drawn flat"});
    put(plan, Pass::kBlend,
        {blended, blended ? "other projectors shine on a channel's screen" : "no channel has a mask"});
}

DomeSize plan_dome(const DomeBend& bend, const DomeSize& held, const Quality& quality) noexcept {
    constexpr double kClearlyTooFine = 0.6;
    const DomeSize least = bend.size_for(quality.error_codes);
    const DomeSize ample = bend.size_for(kClearlyTooFine * quality.error_codes);
    return {std::clamp(held.columns, least.columns, ample.columns),
            std::clamp(held.sky_rows, least.sky_rows, ample.sky_rows),
            std::clamp(held.ground_rows, least.ground_rows, ample.ground_rows)};
}

void plan_veil(Plan& plan, const Scene& scene, std::size_t segments) noexcept {
    if (scene.weather.obscurant_count == 0) {
        put(plan, Pass::kVeil, {false, "there is no fog, haze, dust or the like"});
    } else if (segments == 0) {
        put(plan, Pass::kVeil, {false, "what there is, is nothing where the eye is"});
    } else {
        put(plan, Pass::kVeil, {true, "it rides on the dome's vertices, free of cost by pixel"});
    }
    plan.passes[static_cast<std::size_t>(Pass::kVeil)].resolution = {static_cast<int>(segments), 0};
}

void plan_clouds(Plan& plan, const Scene& scene, int map_size, int near_size, bool near_shown) noexcept {
    const auto layers = scene.weather.all_clouds();
    const bool any = std::any_of(layers.begin(), layers.end(),
                                 [](const CloudLayer& layer) { return layer.coverage > 0.0; });
    const bool slower = any && (plan.thins(Thin::kCloudRefresh) || plan.thins(Thin::kCloudTones));
    put(plan, Pass::kClouds,
        {any, slower ? "followed more slowly: thinned out" : drawn_models(scene.weather)});
    put(plan, Pass::kNearClouds,
        !any         ? Verdict{false, "no layer has any"}
        : near_shown ? Verdict{true, "the eye is in a layer or soon may be"}
                     : Verdict{false, "no layer is near the eye's height"});
    plan.passes[static_cast<std::size_t>(Pass::kClouds)].resolution = {2 * map_size, map_size};
    plan.passes[static_cast<std::size_t>(Pass::kNearClouds)].resolution = {2 * near_size, near_size};
}

void plan_cloud_shadows(Plan& plan, const cloud::ShadowMap& map, bool told) noexcept {
    put(plan, Pass::kCloudShadows,
        !plan.needs(Pass::kClouds)        ? Verdict{false, "no layer has any clouds"}
        : plan.thins(Thin::kCloudShadows) ? Verdict{false, kThinnedOut}
        : !map.shown() ? Verdict{false, "neither Sun nor Moon stands high enough to cast any"}
        : !told        ? Verdict{false, "the ground lies in even light: no gaps, or nothing but gaps"}
                       : Verdict{true, "single clouds cast shadows; they ride on the cloud map"});
    plan.passes[static_cast<std::size_t>(Pass::kCloudShadows)].resolution = {
        cloud::ShadowMap::kLevels * cloud::ShadowMap::kCells, cloud::ShadowMap::kCells};
}

void plan_waves(Plan& plan, const Scene& scene, const sky::SeaWaves& waves, bool lit) noexcept {
    const auto told = scene.sea.all_waves();
    const bool any =
        std::any_of(told.begin(), told.end(), [](const Wave& wave) { return sky::wave_slope(wave) > 0.0; });
    if (scene.ground.kind != Ground::Kind::kSea) {
        put(plan, Pass::kWaves, {false, "there is no sea"});
    } else if (!any) {
        put(plan, Pass::kWaves, {false, "no waves are told: wind alone roughens the sea"});
    } else if (waves.count == 0) {
        put(plan, Pass::kWaves, {false, "no wave is two pixels long, seen from here"});
    } else if (!lit) {
        put(plan, Pass::kWaves, {false, "neither Sun nor Moon lights them"});
    } else if (plan.thins(Thin::kWaves)) {
        put(plan, Pass::kWaves, {false, kThinnedOut});
    } else {
        put(plan, Pass::kWaves, {true, "pixels resolve waves near the eye"});
    }
}

void plan_glare(Plan& plan, Pass pass, bool enabled, double reach_rad) noexcept {
    if (!enabled) {
        put(plan, pass, {false, "switched off"});
    } else if (reach_rad <= 0.0) {
        put(plan, pass, {false, "adds less than half a code to the sky"});
    } else if (plan.thins(Thin::kGlare)) {
        put(plan, pass, {false, kThinnedOut});
    } else {
        put(plan, pass, {true, "the eye spreads the disc's light"});
    }
    plan.passes[static_cast<std::size_t>(pass)].resolution = {static_cast<int>(Glare::kRings),
                                                              static_cast<int>(Glare::kSectors)};
}

PointBackgrounds PointBackgrounds::even(double luminance_cd_m2) noexcept {
    PointBackgrounds background;
    background.darkest_cd_m2 = luminance_cd_m2;
    background.planets_cd_m2.fill(luminance_cd_m2);
    return background;
}

void plan_stars(Plan& plan, const Scene& scene, const PointBackgrounds& background,
                double half_code_mag) noexcept {
    const double brightest_mag = brightest_seen_mag(scene, background);
    const double limit_mag = faintest_seen_mag(background.darkest_cd_m2);
    const bool forced = plan.forced[static_cast<std::size_t>(Pass::kStars)];
    const bool outshone = half_code_mag < brightest_mag;
    const double flicker = night::strongest_flicker(scene.eye.height_m);
    plan.stars.limit_mag = forced ? kNoStarIsFainter_mag : limit_mag;
    plan.stars.seen_only = !forced;
    plan.stars.twinkle_limit_mag = half_code_mag + 2.5 * std::log10(std::max(flicker, 1e-9));
    plan.stars.twinkle = scene.sky.star_scintillation && brightest_mag < plan.stars.twinkle_limit_mag;
    if (!scene.stars.enabled || scene.stars.intensity <= 0.0) {
        put(plan, Pass::kStars, {false, "switched off"});
    } else if (outshone) {
        put(plan, Pass::kStars, {false, "the sky outshines every star and planet"});
    } else if (plan.stars.twinkle) {
        put(plan, Pass::kStars, {true, "some stars outshine the sky, and twinkle"});
    } else {
        put(plan, Pass::kStars, {true, "some stars outshine the sky"});
    }
}

void plan_milky_way(Plan& plan, const Scene& scene, double most_codes) noexcept {
    constexpr double kLeast_codes = 0.5;
    if (plan.night_share <= 0.0) {
        put(plan, Pass::kMilkyWay, {false, "below half a code: daylight outshines it"});
    } else if (scene.night.model != NightModel::kSources) {
        put(plan, Pass::kMilkyWay, {false, "the night sky's model has none"});
    } else if (night::starlight_share(scene.night) <= 0.0) {
        put(plan, Pass::kMilkyWay, {false, "switched off"});
    } else if (most_codes < kLeast_codes) {
        put(plan, Pass::kMilkyWay, {false, "below half a code before this sky"});
    } else if (plan.thins(Thin::kMilkyWay)) {
        put(plan, Pass::kMilkyWay, {false, kThinnedOut});
    } else {
        put(plan, Pass::kMilkyWay, {true, "it shows before this sky"});
    }
    plan.passes[static_cast<std::size_t>(Pass::kMilkyWay)].resolution = {night::MilkyWayMap::kHeight,
                                                                         night::MilkyWayMap::kWidth};
}

void plan_all_stars(Plan& plan, const Scene& scene) noexcept {
    const bool on = scene.stars.enabled && scene.stars.intensity > 0.0;
    plan.stars = {.limit_mag = kNoStarIsFainter_mag,
                  .seen_only = false,
                  .twinkle = scene.sky.star_scintillation,
                  .twinkle_limit_mag = kNoStarIsFainter_mag};
    put(plan, Pass::kStars, {on, on ? "every star is light" : "switched off"});
}

}  // namespace skyig::render
