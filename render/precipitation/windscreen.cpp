#include "render/precipitation/windscreen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/mixed_bits.h"
#include "render/precipitation/fall.h"
#include "render/precipitation/streak_field.h"

namespace skyig::render::precipitation {

namespace {

constexpr int kMostSteps = 16;
constexpr int kMostHits = 8;
constexpr double kWater_kg_m3 = 1000.0;
constexpr double kAir_kg_m3 = 1.225;

// Shares of a^3 and a^2 of the cap over a base of radius a.
double cap_volume() noexcept {
    static const double cosine = std::cos(kContact_rad);
    static const double sine = std::sin(kContact_rad);
    return std::numbers::pi / 3.0 * (2.0 - 3.0 * cosine + cosine * cosine * cosine) / (sine * sine * sine);
}

double cap_front() noexcept {
    static const double sine = std::sin(kContact_rad);
    return (kContact_rad - sine * std::cos(kContact_rad)) / (sine * sine);
}

double base_radius_m(double diameter_mm) noexcept {
    const double diameter_m = 1e-3 * diameter_mm;
    return std::cbrt(std::numbers::pi / 6.0 * diameter_m * diameter_m * diameter_m / cap_volume());
}

double joined_m(double a_m, double b_m) noexcept {
    return std::cbrt(a_m * a_m * a_m + b_m * b_m * b_m);
}

double rain_mm_h(const Scene& scene) noexcept {
    double rate_mm_h = 0.0;
    for (const Precipitation& falling : scene.weather.all_precipitations()) {
        if (!falls_on(falling, scene.eye)) continue;
        if (falling.kind == Precipitation::Kind::kRain) rate_mm_h += falling.rate_mm_h;
        if (falling.kind == Precipitation::Kind::kSleet) rate_mm_h += 0.5 * falling.rate_mm_h;
    }
    return rate_mm_h;
}

}  // namespace

double Windscreen::hits_per_m2_s(double rate_mm_h, double towards_m_s) noexcept {
    if (!(rate_mm_h > 0.0)) return 0.0;
    constexpr double kPerM3_mm = 8000.0;
    const double slope_per_mm = rain_slope_per_mm(rate_mm_h);
    return kPerM3_mm / slope_per_mm * std::exp(-slope_per_mm * kLeast_mm) * std::max(towards_m_s, 0.0);
}

Windscreen::Conditions Windscreen::conditions(const Scene& scene, const ChannelView& view) noexcept {
    // The pane's outward normal and the way up along it, in the view's axes.
    constexpr double kHalf = std::numbers::sqrt2 / 2.0;
    constexpr glm::dvec3 kOut{0.0, kHalf, -kHalf};
    constexpr glm::dvec3 kUp{0.0, kHalf, kHalf};
    Conditions now;
    const ImagePlane plane = image_plane(view.frustum);
    const auto away_m = static_cast<double>(view.windscreen_m);
    now.pane_m = {away_m * plane.left, away_m * plane.right, away_m * plane.bottom, away_m * plane.top};
    const auto along = [&](const glm::dvec3& enu) {
        const glm::dvec3 own = view.view_from_enu * enu;
        return glm::dvec2{own.x, glm::dot(own, kUp)};
    };
    now.gravity_m_s2 = along({0.0, 0.0, -9.81});
    now.air_m_s = along(relative_wind_m_s(scene.weather, 0.0));
    const double rate_mm_h = rain_mm_h(scene);
    now.rains = rate_mm_h > 0.0;
    if (!now.rains) return now;
    now.slope_per_mm = rain_slope_per_mm(rate_mm_h);
    const double fall_m_s = fall_speed_m_s(Precipitation::Kind::kRain, rate_mm_h, scene.eye.height_m);
    const double towards_m_s =
        -glm::dot(view.view_from_enu * relative_wind_m_s(scene.weather, fall_m_s), kOut);
    const double area_m2 = (now.pane_m.right - now.pane_m.left) * (now.pane_m.top - now.pane_m.bottom);
    now.hits = std::min(hits_per_m2_s(rate_mm_h, towards_m_s) * area_m2 * kStep_s, double{kMostHits});
    return now;
}

void Windscreen::advance(const Scene& scene, const ChannelView& view) noexcept {
    const double due = std::floor((scene.time_s - time_s_) / kStep_s + 1e-6);
    if (!started_ || !(due >= 0.0) || due > kMostSteps) {
        time_s_ = scene.time_s;
        started_ = true;
        return;
    }
    const Conditions now = conditions(scene, view);
    for (int i = 0; i < static_cast<int>(due); ++i)
        step(now);
    time_s_ += due * kStep_s;
}

void Windscreen::step(const Conditions& now) noexcept {
    // Half as large after five minutes.
    constexpr double kDries = 1.0 - 0.0023 * kStep_s;
    constexpr double kDry_m = 0.4e-3;
    const std::uint64_t bits = mixed(mixed(seed_) + steps_++);
    const int hits = static_cast<int>(now.hits + unit_of(bits));
    for (int i = 0; i < hits; ++i)
        hit(now, mixed(bits + 1 + static_cast<std::uint64_t>(i)));
    shown_ = 0;
    for (Drop& drop : drops_) {
        if (!(drop.there > 0.0)) continue;
        drop.there = std::clamp(drop.there + (drop.goes ? -1.0 : 1.0) * kStep_s / kFade_s, 0.0, 1.0);
        if (!now.rains) drop.radius_m *= kDries;
        run(drop, now);
        const glm::dvec2 past_m = glm::max(glm::dvec2{now.pane_m.left, now.pane_m.bottom} - drop.at_m,
                                           drop.at_m - glm::dvec2{now.pane_m.right, now.pane_m.top});
        if (std::max(past_m.x, past_m.y) > 0.0 || drop.radius_m < kDry_m) drop.goes = true;
        shown_ += drop.there > 0.0;
    }
}

// On a drop that is there it joins it; where there is no place left, on any.
void Windscreen::hit(const Conditions& now, std::uint64_t bits) noexcept {
    const double size = 1.0 - unit_of(mixed(bits));
    const double diameter_mm = std::min(kLeast_mm - std::log(size) / now.slope_per_mm, 6.0);
    Drop made;
    made.radius_m = base_radius_m(diameter_mm);
    const glm::dvec2 share{unit_of(mixed(bits + 1)), unit_of(mixed(bits + 2))};
    made.at_m = glm::mix(glm::dvec2{now.pane_m.left, now.pane_m.bottom},
                         glm::dvec2{now.pane_m.right, now.pane_m.top}, share);
    Drop* free = nullptr;
    for (Drop& drop : drops_) {
        if (!(drop.there > 0.0)) {
            if (free == nullptr) free = &drop;
        } else if (!drop.goes && glm::distance(drop.at_m, made.at_m) < drop.radius_m) {
            drop.radius_m = joined_m(drop.radius_m, made.radius_m);
            return;
        }
    }
    if (free == nullptr) {
        Drop& met = drops_[mixed(bits + 3) % kMost];
        if (!met.goes) met.radius_m = joined_m(met.radius_m, made.radius_m);
        return;
    }
    made.there = 1e-6;
    *free = made;
}

void Windscreen::run(Drop& drop, const Conditions& now) noexcept {
    // Difference of the cosines of receding and advancing angle; water's surface tension and viscosity; the
    // share of the speed of the free air that blows about a drop, and its drag; the wedge's share of viscous
    // pull.
    constexpr double kHysteresis = 0.3;
    constexpr double kTension_n_m = 0.0728;
    constexpr double kViscosity_pa_s = 1.0e-3;
    constexpr double kAirShare = 0.5;
    constexpr double kDrag = 0.5;
    constexpr double kWedge = 150.0;
    const double a = drop.radius_m;
    const double air_m_s = kAirShare * glm::length(now.air_m_s);
    const glm::dvec2 pull_n =
        kWater_kg_m3 * cap_volume() * a * a * a * now.gravity_m_s2 +
        0.5 * kAir_kg_m3 * kDrag * cap_front() * a * a * air_m_s * kAirShare * now.air_m_s;
    const double pull = glm::length(pull_n);
    const double over_n = pull - kTension_n_m * 2.0 * a * kHysteresis;
    drop.speed_m_s = std::clamp(over_n / (kWedge * kViscosity_pa_s * a), 0.0, kFastest_m_s);
    if (!(drop.speed_m_s > 0.0)) return;
    drop.at_m += kStep_s * drop.speed_m_s / pull * pull_n;
    if (!drop.goes) take_up(drop);
}

void Windscreen::take_up(Drop& runner) noexcept {
    for (Drop& other : drops_) {
        if (&other == &runner || other.goes || !(other.there > 0.0)) continue;
        if (glm::distance(other.at_m, runner.at_m) >= runner.radius_m || other.radius_m > runner.radius_m)
            continue;
        runner.radius_m = joined_m(runner.radius_m, other.radius_m);
        other.goes = true;
    }
}

}  // namespace skyig::render::precipitation
