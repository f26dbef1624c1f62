#include "render/precipitation/streak_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "render/geometry.h"
#include "render/mixed_bits.h"
#include "render/precipitation/extinction.h"
#include "render/precipitation/fall.h"
#include "render/sky/sea_waves.h"

namespace skyig::render::precipitation {

namespace {

using Kind = Precipitation::Kind;

struct Look {
    double exposure_s;
    /// Seen from the middle of its shell: near the eye a drop's own size, farther out a bundle's.
    double width_rad;
    double most_opacity;
    /// Share of the tile's places that are filled when much of it falls.
    double share;
    /// Radius of the circles that it whirls in, metres.
    float whirl_m;
};

const Look& look_of(Kind kind) {
    static constexpr std::array<Look, StreakField::kKinds> kLooks{{
        {1.0 / 30.0, 7e-4, 0.55, 0.9, 0.0F},     // rain
        {1.0 / 30.0, 4.5e-4, 0.45, 0.4, 0.0F},   // drizzle
        {1.0 / 100.0, 1.8e-3, 0.95, 1.0, 0.1F},  // snow
        {1.0 / 50.0, 1.3e-3, 0.75, 0.7, 0.03F},  // sleet
        {1.0 / 50.0, 2.4e-3, 0.9, 0.1, 0.0F},    // hail
    }};
    return kLooks[static_cast<std::size_t>(kind)];
}

// Places of the tile that the first shell may fill; each shell beyond has twice as many.
constexpr std::size_t kFirstShellPlaces = 4000;
constexpr std::size_t kTilePlaces = kFirstShellPlaces << (StreakField::kShells - 1);
constexpr double kLargestBox_m = 2.0 * StreakField::kFarthest_m;
// Of a box's places those that lie in its shell: a ball without the ball of half its size, over a cube.
constexpr double kInShell = std::numbers::pi / 6.0 * 0.875;

// Mean over a shell of (its middle's distance / distance)^2.
constexpr double kNearer = 1.5 * 1.5 * 3.0 / 7.0;

// From here on all places are filled.
constexpr double kDense_per_m = 2e-3;
// Longer streaks are fewer, so that they cover little more of the view.
constexpr double kShort_m = 0.25;

// What comes no nearer is drawn whole.
constexpr float kUntouched_m = 1.2F;

// A step of the clock beyond this is a jump.
constexpr double kJump_s = 5.0;

glm::dvec3 wrapped(const glm::dvec3& m) {
    return m - kLargestBox_m * glm::floor(m / kLargestBox_m);
}

float rising(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

// A sine of turns, as near as flakes need: from a parabola each half turn.
float swing(float turns) {
    const float t = turns - std::floor(turns) - 0.5F;
    return -16.0F * t * (0.5F - std::abs(t));
}

// Squared distance of the origin from a segment.
float nearest2(const glm::vec3& head, const glm::vec3& tail) {
    const glm::vec3 along = tail - head;
    const float length2 = glm::dot(along, along);
    const float part = length2 > 0.0F ? std::clamp(-glm::dot(head, along) / length2, 0.0F, 1.0F) : 0.0F;
    const glm::vec3 nearest = head + part * along;
    return glm::dot(nearest, nearest);
}

}  // namespace

struct StreakField::Fall {
    Kind kind;
    glm::dvec3 offset_m;   // of the tile, from the eye
    glm::vec3 half_way_m;  // from the middle of a streak to its head
    double length_m;
    double extinction_per_m;
    float lowest_m;
    float highest_m;
};

struct StreakField::Shell {
    std::size_t index;
    double from_m;
};

bool falls_on(const Precipitation& falling, const Eye& eye) noexcept {
    return falling.rate_mm_h > 0.0 && eye.height_m < falling.top_m;
}

double StreakField::exposure_s(Kind kind) noexcept {
    return look_of(kind).exposure_s;
}

StreakField::StreakField() : tile_(kTilePlaces), streaks_(kKinds * kTilePlaces) {
    for (std::size_t i = 0; i < kTilePlaces; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double unit = unit_of(mixed(3 * i + static_cast<std::size_t>(k)));
            tile_[i][k] = std::min(static_cast<float>(unit), 1.0F - 0x1p-24F);
        }
    }
}

void StreakField::carry(const Scene& scene) noexcept {
    const double step_s = scene.time_s - time_s_;
    time_s_ = scene.time_s;
    const bool jumped = !started_ || step_s < 0.0 || step_s > kJump_s;
    started_ = true;
    if (jumped) return;
    constexpr double kTurns_per_s = 0.4;
    whirl_ = std::fmod(whirl_ + kTurns_per_s * step_s, 1.0);
    for (const Precipitation& falling : scene.weather.all_precipitations()) {
        if (!falls_on(falling, scene.eye)) continue;
        glm::dvec3& carried_m = carried_m_[static_cast<std::size_t>(falling.kind)];
        const double fall_m_s = fall_speed_m_s(falling.kind, falling.rate_mm_h, scene.eye.height_m);
        carried_m = wrapped(carried_m + step_s * (scene.weather.wind_m_s - glm::dvec3{0.0, 0.0, fall_m_s}));
    }
}

void StreakField::update(const Scene& scene, double density) noexcept {
    density_ = density;
    carry(scene);
    group_count_ = 0;
    count_ = 0;
    for (const Precipitation& falling : scene.weather.all_precipitations()) {
        const bool told = std::any_of(groups_.begin(), groups_.begin() + group_count_,
                                      [&](const Group& group) { return group.kind == falling.kind; });
        if (falls_on(falling, scene.eye) && !told) fill(scene, falling);
    }
}

void StreakField::fill(const Scene& scene, const Precipitation& falling) noexcept {
    const Kind kind = falling.kind;
    const glm::dvec3 wind_m_s =
        relative_wind_m_s(scene.weather, fall_speed_m_s(kind, falling.rate_mm_h, scene.eye.height_m));
    const glm::dvec3 way_m = exposure_s(kind) * wind_m_s;
    const glm::dvec3 eye_m{sky::sea_anchor(scene.eye).eye_m, scene.eye.height_m};
    const double ground_m = scene.ground.kind == Ground::Kind::kSea ? scene.sea.height_m : 0.0;
    const Fall fall{
        kind,
        wrapped(carried_m_[static_cast<std::size_t>(kind)] - eye_m),
        glm::vec3{0.5 * way_m},
        glm::length(way_m),
        extinction_per_m(kind, falling.rate_mm_h, scene.air.temperature_c),
        // An eye on the ground, or below, has it at its feet.
        static_cast<float>(std::min(ground_m - scene.eye.height_m, 0.0)),
        static_cast<float>(falling.top_m - scene.eye.height_m),
    };
    const std::size_t first = count_;
    for (std::size_t i = 0; i < kShells; ++i)
        fill_shell(fall, {i, kNearest_m * static_cast<double>(1U << i)});
    groups_[group_count_++] = {kind, {streaks_.data() + first, count_ - first}};
}

void StreakField::fill_shell(const Fall& fall, const Shell& shell) noexcept {
    const Look& look = look_of(fall.kind);
    const double middle_m = 1.5 * shell.from_m;
    const double box_m = 4.0 * shell.from_m;
    const double places = density_ * static_cast<double>(kFirstShellPlaces << shell.index) * look.share *
                          std::min(1.0, std::sqrt(fall.extinction_per_m / kDense_per_m)) *
                          std::min(1.0, std::pow(kShort_m / fall.length_m, 0.8));
    // What the shell's drops dim, spread over what its rods cover of all directions: the mean over the shell
    // of a rod that points anywhere and is round at its ends.
    const double covered_sr = places * kInShell * kNearer * 0.25 * std::numbers::pi * look.width_rad *
                              (fall.length_m / middle_m + look.width_rad);
    const double dimmed_sr = 4.0 * std::numbers::pi * fall.extinction_per_m * shell.from_m;
    const auto opacity =
        static_cast<float>(std::min(look.most_opacity, dimmed_sr / std::max(covered_sr, 1e-12)));
    const auto half_width_m = static_cast<float>(0.5 * look.width_rad * middle_m);
    const auto box = static_cast<float>(box_m);
    const auto from_m = static_cast<float>(shell.from_m);
    const glm::vec3 offset{fall.offset_m / box_m - glm::floor(fall.offset_m / box_m)};
    const float clear_m = kUntouched_m + static_cast<float>(0.5 * fall.length_m);
    const auto whole = static_cast<std::size_t>(std::ceil(places));
    const float last = static_cast<float>(places - std::floor(places));
    for (std::size_t i = 0; i < std::min(whole, kTilePlaces); ++i) {
        glm::vec3 place = tile_[i] + offset;
        place -= glm::vec3{place.x >= 1.0F ? 1.0F : 0.0F, place.y >= 1.0F ? 1.0F : 0.0F,
                           place.z >= 1.0F ? 1.0F : 0.0F};
        glm::vec3 middle = box * (place - 0.5F);
        const float far2 = glm::dot(middle, middle);
        if (far2 < from_m * from_m || far2 > 4.0F * from_m * from_m) continue;
        if (middle.z < fall.lowest_m || middle.z > fall.highest_m) continue;
        if (look.whirl_m > 0.0F) {
            const float turns = static_cast<float>(whirl_) * static_cast<float>(1 + i % 2) +
                                tile_[(i * 7 + 1) % kTilePlaces].x;
            middle += look.whirl_m * glm::vec3{swing(turns), swing(turns + 0.25F), 0.0F};
        }
        const float far = std::sqrt(far2);
        const glm::vec3 head = middle + fall.half_way_m;
        const glm::vec3 tail = middle - fall.half_way_m;
        // It fades in and out at the shell's ends, and before it could touch the eye.
        const bool clear = far > clear_m;
        const float shown = opacity * (i + 1 == whole && last > 0.0F ? last : 1.0F) *
                            rising(from_m, 1.3F * from_m, far) *
                            (1.0F - rising(1.7F * from_m, 2.0F * from_m, far)) *
                            (clear ? 1.0F : rising(0.4F, kUntouched_m, std::sqrt(nearest2(head, tail))));
        if (shown <= 0.0F) continue;
        streaks_[count_++] = {head, tail, half_width_m, shown};
    }
}

}  // namespace skyig::render::precipitation
