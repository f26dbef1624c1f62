#include "render/star_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/eye/point_threshold.h"
#include "render/night/star_catalogue.h"
#include "render/night/star_colour.h"
#include "render/night/star_scintillation.h"
#include "render/sky/staleness.h"

namespace skyig::render {

namespace {

constexpr std::size_t kAirSteps = 192;

// Directions that are off by less are as good as new.
constexpr double kStep_px = 0.1;

// Over the sine of the airless elevation; steps crowd at the horizon, where air mass and refraction run away.
float step_of_sine(float sine, float lowest_sine) {
    const float share = (sine - lowest_sine) / (1.0F - lowest_sine);
    return std::sqrt(std::clamp(share, 0.0F, 1.0F)) * static_cast<float>(kAirSteps - 1);
}

double elevation_of_step(std::size_t step, double lowest_sine) {
    const double share = static_cast<double>(step) / static_cast<double>(kAirSteps - 1);
    return std::asin(std::min(1.0, lowest_sine + share * share * (1.0 - lowest_sine)));
}

// A direction turned towards the zenith by `lift` times the cosine of its elevation; the zenith stays.
glm::vec3 lifted(const glm::vec3& d, float lift) {
    const float level = std::sqrt(d.x * d.x + d.y * d.y);
    const float angle_rad = lift * level;
    const float cosine = std::cos(angle_rad);
    const float sine_over_level = level > 1e-6F ? std::sin(angle_rad) / level : lift;
    const float shrink = cosine - sine_over_level * d.z;
    return {d.x * shrink, d.y * shrink, d.z * cosine + level * level * sine_over_level};
}

bool moved(const glm::vec3& now, const glm::vec3& held) {
    constexpr float kStep = 5e-3F;
    return glm::any(glm::greaterThan(glm::abs(now - held), kStep * glm::max(now, held)));
}

bool apart(const glm::dvec3& a, const glm::dvec3& b, double angle_rad) {
    return glm::dot(a - b, a - b) > angle_rad * angle_rad;
}

bool turned(const glm::dmat3& now, const glm::dmat3& held, double angle_rad) {
    return apart(now[0], held[0], angle_rad) || apart(now[1], held[1], angle_rad) ||
           apart(now[2], held[2], angle_rad);
}

bool differs(const StarPlan& a, const StarPlan& b) {
    constexpr double kStep_mag = 0.02;
    return std::abs(a.limit_mag - b.limit_mag) > kStep_mag || a.seen_only != b.seen_only ||
           a.twinkle != b.twinkle || std::abs(a.twinkle_limit_mag - b.twinkle_limit_mag) > kStep_mag;
}

}  // namespace

double half_code_mag(double background_cd_m2, const shaders64::ToneParameters& tone,
                     double pixel_sr) noexcept {
    const glm::dvec3 behind = shaders64::display_linear(glm::dvec3{background_cd_m2}, tone);
    const auto code = [&](double log2_added) {
        return 255.0 * shaders64::encoded(behind + glm::dvec3{std::exp2(log2_added)}, tone).y;
    };
    const double wanted = 255.0 * shaders64::encoded(behind, tone).y + 0.5;
    double low = -40.0;
    double high = 20.0;
    if (code(high) < wanted) return -std::numeric_limits<double>::infinity();
    while (high - low > 1e-3) {
        const double middle = 0.5 * (low + high);
        (code(middle) < wanted ? low : high) = middle;
    }
    const double lux = std::exp2(high) * 2.0 * std::numbers::pi * kStarSigma_px * kStarSigma_px * pixel_sr /
                       (tone.point_gain * tone.inv_display_max);
    return -2.5 * std::log10(lux / night::star_illuminance_lux(0.0));
}

float seen_share(float illuminance_lux, float background_cd_m2) noexcept {
    const auto threshold = static_cast<float>(eye::threshold_lux(static_cast<double>(background_cd_m2)));
    constexpr auto kFrom = static_cast<float>(kFaintestSeen);
    const float t = std::clamp((illuminance_lux / threshold - kFrom) / (2.0F * (1.0F - kFrom)), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
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
    twinkles_.resize(stars_.size());
    backgrounds_.resize(stars_.size());
    air_.resize(kAirSteps);
}

struct StarField::Frame {
    const SkyLight& light;
    float lowest_sine;  // airless, of what is seen on the horizon
    float intensity;
    float least_lux;  // of the faintest that is seen before the darkest sky
    bool seen_only;
    glm::vec3 moon_enu;
    float moon_chord;  // 0: the Moon covers nothing
};

StarField::Made StarField::made_of(const Scene& scene, const SkyFrame& frame) noexcept {
    const SkyLight& light = frame.light();
    const glm::dmat3 gcrs_from_enu = glm::transpose(scene.stars.enu_from_gcrs);
    Made made{.valid = true,
              .tables = frame.tables().revision(),
              .air_in_use = frame.tables().air_in_use(),
              .veil = light.veil_revision,
              .sun_scale = light.sun.scale_xyz,
              .moon_scale = light.moon.scale_xyz,
              .height_m = scene.eye.height_m,
              .horizon_lift_rad =
                  light.refraction.horizon_elevation_rad() - light.refraction.setting_elevation_rad(),
              .stars = scene.stars,
              .plan = frame.plan().stars,
              .planets = scene.planets,
              .planets_gcrs = {},
              .moon_gcrs = gcrs_from_enu * scene.moon.direction_enu,
              .moon_radius_rad = scene.moon.enabled ? scene.moon.angular_radius_rad : 0.0};
    for (std::size_t i = 0; i < kPlanetCount; ++i)
        made.planets_gcrs[i] = gcrs_from_enu * scene.planets[i].direction_enu;
    return made;
}

bool StarField::light_is_stale(const Made& now, double pixel_rad) const noexcept {
    const Made& held = made_;
    return !held.valid || now.tables != held.tables || now.air_in_use != held.air_in_use ||
           now.veil != held.veil || moved(now.sun_scale, held.sun_scale) ||
           moved(now.moon_scale, held.moon_scale) || sky::height_is_stale(now.height_m, held.height_m) ||
           std::abs(now.horizon_lift_rad - held.horizon_lift_rad) > kStep_px * pixel_rad;
}

bool StarField::is_stale(const Made& now, double pixel_rad) const noexcept {
    const Made& held = made_;
    const double step_rad = kStep_px * pixel_rad;
    if (light_is_stale(now, pixel_rad) || differs(now.plan, held.plan) ||
        turned(now.stars.enu_from_gcrs, held.stars.enu_from_gcrs, step_rad))
        return true;
    constexpr double kYears = 0.01;
    if (now.stars.intensity != held.stars.intensity ||
        apart(now.stars.earth_velocity_c, held.stars.earth_velocity_c, step_rad) ||
        std::abs(now.stars.years_since_j2000 - held.stars.years_since_j2000) > kYears ||
        apart(now.moon_gcrs, held.moon_gcrs, step_rad) || now.moon_radius_rad != held.moon_radius_rad)
        return true;
    constexpr double kMagnitude = 0.01;
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        if (apart(now.planets_gcrs[i], held.planets_gcrs[i], step_rad) ||
            std::abs(now.planets[i].magnitude - held.planets[i].magnitude) > kMagnitude)
            return true;
    }
    return false;
}

void StarField::tabulate_air(const SkyFrame& frame, double eye_height_m) {
    const SkyLight& light = frame.light();
    const double lowest_sine = std::sin(light.refraction.setting_elevation_rad());
    for (std::size_t i = 0; i < kAirSteps; ++i) {
        const double elevation_rad = elevation_of_step(i, lowest_sine);
        const double seen_rad = light.refraction.apparent_from_true(elevation_rad);
        const double level = std::max(std::cos(elevation_rad), 1e-4);
        const double rms = night::scintillation_rms(night::air_mass(seen_rad), eye_height_m);
        const double straight_rad = light.straight_elevation_rad(seen_rad);
        air_[i] = {glm::vec3{light.veil_passes(straight_rad) *
                             frame.air().transmittance_rgb(light.eye_height_m, straight_rad)},
                   static_cast<float>((seen_rad - elevation_rad) / level), static_cast<float>(rms)};
    }
}

StarField::Air StarField::air_at(float sine, float lowest_sine) const noexcept {
    const float step = step_of_sine(sine, lowest_sine);
    const auto low = std::min(static_cast<std::size_t>(step), kAirSteps - 2);
    const float share = step - static_cast<float>(low);
    const Air& a = air_[low];
    const Air& b = air_[low + 1];
    return {glm::mix(a.transmittance, b.transmittance, share), glm::mix(a.lift, b.lift, share),
            glm::mix(a.twinkle_rms, b.twinkle_rms, share)};
}

const glm::vec3& StarField::background(const glm::vec3& seen_enu, std::uint32_t source,
                                       const Frame& frame) noexcept {
    Background& background = backgrounds_[source];
    if (background.made != backgrounds_due_) {
        const Horizontal at = horizontal_of(glm::dvec3{seen_enu});
        background = {frame.light.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kSky), backgrounds_due_};
    }
    return background.cd_m2;
}

void StarField::add(const glm::vec3& direction_enu, const Light& source, const Frame& frame) noexcept {
    const glm::vec3 from_moon = direction_enu - frame.moon_enu;
    if (glm::dot(from_moon, from_moon) < frame.moon_chord * frame.moon_chord) return;
    const Air air = air_at(direction_enu.z, frame.lowest_sine);
    const glm::vec3 seen_enu = lifted(direction_enu, air.lift);
    glm::vec3 lux = source.illuminance_lux * air.transmittance * frame.intensity;
    if (shaders32::luminance_709(lux) < frame.least_lux) return;
    const glm::vec3& behind = background(seen_enu, source.source, frame);
    if (frame.seen_only) {
        const float share = seen_share(shaders32::luminance_709(lux), shaders32::luminance_709(behind));
        if (!(share > 0.0F)) return;
        lux *= share;
    }
    stars_[count_] = {seen_enu, lux, behind};
    twinkles_[count_++] = {lux, air.twinkle_rms * source.twinkle, source.source};
}

void StarField::rebuild(const Scene& scene, const SkyFrame& frame) {
    const StarPlan& plan = frame.plan().stars;
    const double moon_chord = scene.moon.enabled ? 2.0 * std::sin(0.5 * scene.moon.angular_radius_rad) : 0.0;
    const double lowest_sine = std::sin(frame.light().refraction.setting_elevation_rad());
    const Frame now{.light = frame.light(),
                    .lowest_sine = static_cast<float>(lowest_sine),
                    .intensity = static_cast<float>(scene.stars.intensity),
                    .least_lux = static_cast<float>(night::star_illuminance_lux(plan.limit_mag)),
                    .seen_only = plan.seen_only,
                    .moon_enu = glm::vec3{scene.moon.direction_enu},
                    .moon_chord = static_cast<float>(moon_chord)};
    const auto twinkle = [&](double magnitude, double factor) {
        return plan.twinkle && magnitude < plan.twinkle_limit_mag ? static_cast<float>(factor) : 0.0F;
    };

    count_ = 0;
    for (std::size_t i = 0; i < kPlanetCount; ++i) {
        const Planet& planet = scene.planets[i];
        if (planet.direction_enu.z < lowest_sine || planet.magnitude > plan.limit_mag) continue;
        const glm::dvec3 lux =
            night::star_colour_of_bv(planet.bv) * night::star_illuminance_lux(planet.magnitude);
        add(glm::vec3{planet.direction_enu},
            {glm::vec3{lux}, twinkle(planet.magnitude, night::kPlanetScintillation),
             static_cast<std::uint32_t>(sources_.size() + i)},
            now);
    }
    const glm::mat3 enu_from_gcrs{scene.stars.enu_from_gcrs};
    const glm::vec3 aberration{scene.stars.earth_velocity_c};
    const auto years = static_cast<float>(scene.stars.years_since_j2000);
    twinkling_ = count_;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const Source& source = sources_[i];
        if (static_cast<double>(source.magnitude) > plan.limit_mag) break;
        const glm::vec3 direction = glm::normalize(
            enu_from_gcrs * (source.direction_gcrs + source.motion_rad_per_yr * years + aberration));
        if (direction.z < now.lowest_sine) continue;
        const float factor = twinkle(static_cast<double>(source.magnitude), 1.0);
        add(direction, {source.illuminance_lux, factor, static_cast<std::uint32_t>(i)}, now);
        if (factor > 0.0F) twinkling_ = count_;
    }
}

void StarField::flicker(double time_s) noexcept {
    for (std::size_t i = 0; i < twinkling_; ++i) {
        const Twinkle& star = twinkles_[i];
        stars_[i].illuminance_lux =
            star.illuminance_lux * night::scintillation(star.source, time_s, star.rms);
    }
}

std::size_t StarField::update(const Scene& scene, const SkyFrame& frame, double pixel_rad) {
    const Made now = made_of(scene, frame);
    const bool stale = is_stale(now, pixel_rad);
    if (stale) {
        constexpr double kHalfDegree = 0.0087;
        const bool new_light = light_is_stale(now, pixel_rad);
        if (new_light) tabulate_air(frame, scene.eye.height_m);
        if (new_light || turned(now.stars.enu_from_gcrs, backgrounds_turn_, kHalfDegree)) {
            ++backgrounds_due_;
            backgrounds_turn_ = now.stars.enu_from_gcrs;
        }
        rebuild(scene, frame);
        made_ = now;
    }
    enu_from_update_ = scene.stars.enu_from_gcrs * glm::transpose(made_.stars.enu_from_gcrs);
    const bool flickers = frame.plan().stars.twinkle && twinkling_ > 0;
    if (flickers) flicker(scene.time_s);
    if (stale) return count_;
    return flickers ? twinkling_ : 0;
}

}  // namespace skyig::render
