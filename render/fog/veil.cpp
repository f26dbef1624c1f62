#include "render/fog/veil.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "render/fog/walk.h"
#include "render/geometry.h"

namespace skyig::render::fog {

namespace {

// Cut depths below the top at which shells are cut, and the same from the ground.
constexpr std::array<double, 4> kFromTop{0.3, 1.0, 3.0, 10.0};
constexpr double kFromGround = 1.0;
static_assert(kFromTop.size() + 1 == Veil::kCuts);

double cut_depth(const Profile::Shell& shell) {
    return shell.kept * 0.5 * (shell.low_per_m + shell.high_per_m) * (shell.high_m - shell.low_m);
}

double extinction_at(const Profile::Shell& shell, double height_m) {
    const double share = (height_m - shell.low_m) / (shell.high_m - shell.low_m);
    return shell.low_per_m + share * (shell.high_per_m - shell.low_per_m);
}

// Height under which the shell's upper part has this cut depth.
double height_of_depth(const Profile::Shell& shell, double depth) {
    const double slope = (shell.high_per_m - shell.low_per_m) / (shell.high_m - shell.low_m);
    const double wanted = depth / shell.kept;
    const double root = std::sqrt(std::max(shell.high_per_m * shell.high_per_m - 2.0 * slope * wanted, 0.0));
    const double below_m = 2.0 * wanted / std::max(shell.high_per_m + root, 1e-300);
    return std::clamp(shell.high_m - below_m, shell.low_m, shell.high_m);
}

}  // namespace

shaders32::VeilSegment single_precision(const Veil::Segment& s) noexcept {
    const auto f = [](double value) { return static_cast<float>(value); };
    return {f(s.low_m),
            f(s.high_m),
            f(s.low_per_m),
            f(s.high_per_m),
            f(s.low_depth),
            f(s.high_depth),
            f(s.kept),
            f(s.g),
            glm::vec3{s.albedo},
            glm::vec3{s.low_even},
            glm::vec3{s.high_even},
            glm::vec3{s.low_slope},
            glm::vec3{s.high_slope}};
}

void Veil::lay(std::span<const Obscurant> obscurants, double eye_height_m) noexcept {
    count_ = 0;
    const double ground_m = std::min(0.0, eye_height_m);
    Profile profile;
    profile.lay(obscurants, ground_m);
    if (profile.empty()) return;
    eye_radius_m_ = kEarthRadius_m + eye_height_m;
    ground_over_m_ = ground_m - eye_height_m;
    top_m_ = profile.shells().back().high_m;
    double whole = 0.0;
    for (const Profile::Shell& shell : profile.shells())
        whole += cut_depth(shell);
    std::array<double, kCuts> cuts{};
    std::copy(kFromTop.begin(), kFromTop.end(), cuts.begin());
    cuts.back() = whole - kFromGround;
    std::sort(cuts.begin(), cuts.end(), std::greater<>{});
    double above = whole;
    for (const Profile::Shell& shell : profile.shells()) {
        above = std::max(above - cut_depth(shell), 0.0);
        add_segments(shell, above, cuts, eye_height_m);
    }
    stack_depths();
}

// One shell, from below, in as many pieces as there are cuts in it. \param cuts  falling
void Veil::add_segments(const Profile::Shell& shell, double depth_above, std::span<const double> cuts,
                        double eye_height_m) noexcept {
    double low_m = shell.low_m;
    const auto end_at = [&](double high_m) {
        Segment& segment = segments_[count_++];
        segment = {};
        segment.low_m = low_m - eye_height_m;
        segment.high_m = high_m - eye_height_m;
        segment.low_per_m = extinction_at(shell, low_m);
        segment.high_per_m = extinction_at(shell, high_m);
        segment.kept = shell.kept;
        segment.g = shell.optics.g;
        segment.albedo = shell.optics.albedo;
        low_m = high_m;
    };
    for (const double cut : cuts) {
        if (!(cut > depth_above)) continue;
        const double height_m = height_of_depth(shell, cut - depth_above);
        if (height_m > low_m + 1e-3 && height_m < shell.high_m - 1e-3) end_at(height_m);
    }
    end_at(shell.high_m);
}

void Veil::stack_depths() noexcept {
    double above = 0.0;
    for (std::size_t i = count_; i-- > 0;) {
        Segment& s = segments_[i];
        s.high_depth = above;
        above += s.kept * 0.5 * (s.low_per_m + s.high_per_m) * (s.high_m - s.low_m);
        s.low_depth = above;
    }
}

// Cut depth along a ray from the ground over the vertical one: finite at the horizon, for the Earth is round.
double Veil::slant(double sine) const noexcept {
    const double radius_m = eye_radius_m_ + ground_over_m_;
    const shaders64::VeilRay ray{std::clamp(sine, 0.0, 1.0), radius_m};
    double along = 0.0;
    double straight = 0.0;
    double from_m = 0.0;
    for (const Segment& s : segments()) {
        const double to_m = shaders64::veil_below_m(s.high_m - ground_over_m_, ray).y;
        const double mean = s.kept * 0.5 * (s.low_per_m + s.high_per_m);
        along += mean * (to_m - from_m);
        straight += mean * (s.high_m - s.low_m);
        from_m = to_m;
    }
    return straight > 0.0 ? std::max(along / straight, 1.0) : 1.0;
}

void Veil::light(const VeilSources& sources) noexcept {
    sources_ = sources;
    sources_.above_cd_m2 = glm::max(sources.above_cd_m2, glm::dvec3{0.0});
    for (std::size_t i = 0; i < sources_.beams.size(); ++i) {
        sources_.beams[i].lux = glm::max(sources.beams[i].lux, glm::dvec3{0.0});
        slants_[i] = slant(sources_.beams[i].direction_enu.z);
    }
    if (empty()) return;
    for (int channel = 0; channel < 3; ++channel)
        light_channel(channel);
}

namespace {

// One segment of the stack in one colour. With I = I0 + I1 mu (mu, depth: downwards) Eddington's equations
// are I0' = -q I1 + b0 exp(-m t), I1' = -3 a I0 + b1 exp(-m t); P exp(-m t) solves them for one beam, and
// what is left of I0 at both ends tells I1 there: I1 = flow at top: conducts * top - passes * bottom.
struct Slab {
    double conducts = 0.0;
    double passes = 0.0;
    double top0 = 0.0, bottom0 = 0.0;  // P0 exp(-m t), summed over the beams
    double top1 = 0.0, bottom1 = 0.0;  // P1 exp(-m t)
    double albedo = 1.0;
    double g = 0.0;
};

Slab slab_of(const Veil::Segment& s, int channel, const VeilSources& sources,
             const std::array<double, 2>& slants) noexcept {
    Slab slab;
    slab.albedo = std::clamp(1.0 - (1.0 - s.albedo[channel]) / s.kept, 0.0, 1.0);
    slab.g = s.g / (1.0 + s.g);
    const double a = 1.0 - slab.albedo;
    const double q = 1.0 - slab.albedo * slab.g;
    const double k = std::sqrt(3.0 * a * q);
    const double depth = std::max(s.low_depth - s.high_depth, 1e-7);
    const double x = std::min(k * depth, 300.0);
    const double coth = x < 1e-3 ? 1.0 + x * x / 3.0 : x / std::tanh(x);
    const double cosech = x < 1e-3 ? 1.0 - x * x / 6.0 : x / std::sinh(x);
    slab.conducts = x < 300.0 ? coth / (q * depth) : k / q;
    slab.passes = x < 300.0 ? cosech / (q * depth) : 0.0;
    for (std::size_t i = 0; i < slants.size(); ++i) {
        const double m = slants[i];
        const double b1 = 3.0 * slab.albedo * sources.beams[i].lux[channel] / (4.0 * std::numbers::pi);
        const double b0 = b1 * slab.g / m;
        // Zero where the beam falls off as the diffuse light does: next to it the sum of both stays right.
        const double gap = m * m - k * k;
        const double determinant = std::abs(gap) < 1e-6 * m * m ? 1e-6 * m * m : gap;
        const double p0 = -(m * b0 + q * b1) / determinant;
        const double p1 = -(3.0 * a * b0 + m * b1) / determinant;
        const double top = std::exp(-m * s.high_depth);
        const double bottom = std::exp(-m * s.low_depth);
        slab.top0 += p0 * top;
        slab.bottom0 += p0 * bottom;
        slab.top1 += p1 * top;
        slab.bottom1 += p1 * bottom;
    }
    return slab;
}

constexpr double kHalfFlux = 2.0 / 3.0;

// On level ground and over the top, of both beams.
struct LevelBeams {
    double top = 0.0;
    double ground = 0.0;
};

// I0 at the ends of all segments, from the ground up: continuous, and so is I1; from above comes the sky,
// from below what the ground sends back (Marshak's conditions). Thomas's algorithm: value[i] = right[i] +
// ratio[i]
// * value[i + 1].
void solve_even(std::span<const Slab> slabs, const LevelBeams& beams, double albedo, double above,
                std::span<double> value) noexcept {
    std::array<double, Veil::kMostSegments + 1> ratio{};
    const double reflects = kHalfFlux * (1.0 + albedo);
    const Slab& first = slabs.front();
    double diagonal = 1.0 - albedo + reflects * first.conducts;
    ratio[0] = reflects * first.passes / diagonal;
    value[0] = (albedo * beams.ground +
                reflects * (first.bottom1 - first.passes * first.top0 + first.conducts * first.bottom0)) /
               diagonal;
    const std::size_t count = slabs.size();
    for (std::size_t i = 1; i < count; ++i) {
        const Slab& under = slabs[i - 1];
        const Slab& over = slabs[i];
        const double right = over.bottom1 - under.top1 - over.passes * over.top0 +
                             over.conducts * over.bottom0 + under.conducts * under.top0 -
                             under.passes * under.bottom0;
        diagonal = over.conducts + under.conducts - under.passes * ratio[i - 1];
        ratio[i] = over.passes / diagonal;
        value[i] = (right + under.passes * value[i - 1]) / diagonal;
    }
    const Slab& last = slabs.back();
    const double right =
        above - kHalfFlux * (last.top1 - last.conducts * last.top0 + last.passes * last.bottom0);
    diagonal = 1.0 + kHalfFlux * (last.conducts - last.passes * ratio[count - 1]);
    value[count] = (right + kHalfFlux * last.passes * value[count - 1]) / diagonal;
    for (std::size_t i = count; i-- > 0;)
        value[i] += ratio[i] * value[i + 1];
}

}  // namespace

void Veil::light_channel(int channel) noexcept {
    std::array<Slab, kMostSegments> slabs;
    for (std::size_t i = 0; i < count_; ++i)
        slabs[i] = slab_of(segments_[i], channel, sources_, slants_);
    LevelBeams beams;
    for (std::size_t i = 0; i < slants_.size(); ++i) {
        const double level = sources_.beams[i].lux[channel] / (std::numbers::pi * slants_[i]);
        beams.top += level;
        beams.ground += level * std::exp(-slants_[i] * segments_[0].low_depth);
    }
    const double albedo = std::clamp(sources_.ground_albedo, 0.0, 1.0);
    const double above = sources_.above_cd_m2[channel];
    std::array<double, kMostSegments + 1> value{};
    solve_even({slabs.data(), count_}, beams, albedo, above, value);

    for (std::size_t i = 0; i < count_; ++i) {
        const Slab& slab = slabs[i];
        Segment& s = segments_[i];
        const double top = value[i + 1] - slab.top0;
        const double bottom = value[i] - slab.bottom0;
        const double high_flow = slab.top1 + slab.conducts * top - slab.passes * bottom;
        const double low_flow = slab.bottom1 + slab.passes * top - slab.conducts * bottom;
        s.high_even[channel] = slab.albedo * value[i + 1];
        s.low_even[channel] = slab.albedo * value[i];
        s.high_slope[channel] = slab.albedo * slab.g * high_flow;
        s.low_slope[channel] = slab.albedo * slab.g * low_flow;
        if (i == 0) {
            const double lit = std::max(value[0] + kHalfFlux * low_flow, 0.0) + beams.ground;
            ground_share_[channel] = above + beams.top > 0.0 ? lit / (above + beams.top) : 1.0;
        }
    }
}

shaders64::VeilBeams Veil::beams(const glm::dvec3& direction_enu) const noexcept {
    const auto cosine = [&](std::size_t i) {
        return std::clamp(glm::dot(direction_enu, sources_.beams[i].direction_enu), -1.0, 1.0);
    };
    return {sources_.beams[0].lux, sources_.beams[1].lux, slants_[0], slants_[1], cosine(0), cosine(1)};
}

shaders64::VeilSum Veil::sum(const glm::dvec3& direction_enu, double end_m) const noexcept {
    // Of what lies behind this nothing is seen.
    constexpr double kOpaque = 60.0;
    shaders64::VeilSum sum = shaders64::veil_none();
    const shaders64::VeilRay ray{direction_enu.z, eye_radius_m_};
    const shaders64::VeilBeams lit = beams(direction_enu);
    if (!std::isfinite(ray.sine) || !(end_m > 0.0)) return sum;
    each_short_piece(segments(), ray, end_m, [&](const Segment& segment, double from_m, double to_m) {
        sum = shaders64::veil_add(sum, segment, from_m, to_m, ray, lit);
        return sum.cut_depth < kOpaque;
    });
    return sum;
}

Veil::Seen Veil::seen(const glm::dvec3& direction_enu, double end_m) const noexcept {
    const shaders64::VeilSum all = sum(direction_enu, end_m);
    return {std::exp(-all.depth), std::exp(-all.cut_depth), all.added_cd_m2, shaders64::veil_distance_m(all)};
}

Veil::Both Veil::along(const glm::dvec3& direction_enu, double distance_m, double end_m) const noexcept {
    const shaders64::VeilRay ray{direction_enu.z, eye_radius_m_};
    const shaders64::VeilBeams lit = beams(direction_enu);
    Both both{shaders64::veil_none(), shaders64::veil_none()};
    if (!std::isfinite(ray.sine) || !(distance_m > 0.0)) return both;
    each_short_piece(segments(), ray, end_m, [&](const Segment& s, double from_m, double to_m) {
        const double at_m = std::clamp(distance_m, from_m, to_m);
        both.whole = shaders64::veil_add(both.whole, s, from_m, at_m, ray, lit);
        if (from_m < distance_m) both.near = both.whole;
        both.whole = shaders64::veil_add(both.whole, s, at_m, to_m, ray, lit);
        return true;
    });
    return both;
}

double Veil::passed(double sine, double end_m) const noexcept {
    return empty() ? 1.0 : std::exp(-optical_depth(sine, end_m));
}

double Veil::optical_depth(double sine, double end_m) const noexcept {
    return depth_along(segments(), shaders64::VeilRay{sine, eye_radius_m_}, end_m);
}

float Veil::optical_depth(float sine, float end_m) const noexcept {
    std::array<shaders32::VeilSegment, kMostSegments> single;
    for (std::size_t i = 0; i < count_; ++i)
        single[i] = single_precision(segments_[i]);
    return depth_along(std::span<const shaders32::VeilSegment>{single.data(), count_},
                       shaders32::VeilRay{sine, static_cast<float>(eye_radius_m_)}, end_m);
}

VeilMark::VeilMark(const Veil& veil) noexcept {
    if (veil.empty()) return;
    ground_share_ = veil.ground_share();
    const glm::dvec3& sun = veil.sources().beams[0].direction_enu;
    const double azimuth_rad = horizontal_of(sun).azimuth_rad;
    constexpr std::array kSines{1e-4, 8e-4, 4e-3, 0.015, 0.04, 0.09, 0.2, 0.4, 0.7, 1.0};
    for (std::size_t i = 0; i < kDirections; ++i) {
        const double sine = i % 2 == 0 ? kSines[i / 2] : -kSines[i / 2];
        // Rays downwards end at the ground, if they meet it.
        const double fall_m = -sine * veil.eye_radius_m();
        const double height_m = veil.eye_radius_m() - kEarthRadius_m;
        const double square = fall_m * fall_m - height_m * (veil.eye_radius_m() + kEarthRadius_m);
        const double end_m = sine < 0.0 && square > 0.0 ? fall_m - std::sqrt(square) : Veil::kEndless_m;
        const auto seen = veil.seen(direction_of({std::asin(sine), azimuth_rad + 0.5}), end_m);
        probes_[i] = {seen.smooth_passed, seen.added_cd_m2};
    }
}

bool VeilMark::differs(const VeilMark& other, double part) const noexcept {
    const auto apart = [part](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::any(glm::greaterThan(glm::abs(a - b), part * glm::max(glm::abs(a), glm::abs(b))));
    };
    for (std::size_t i = 0; i < kDirections; ++i) {
        if (std::abs(probes_[i].passed - other.probes_[i].passed) > part ||
            apart(probes_[i].added_cd_m2, other.probes_[i].added_cd_m2))
            return true;
    }
    return apart(ground_share_, other.ground_share_);
}

}  // namespace skyig::render::fog
