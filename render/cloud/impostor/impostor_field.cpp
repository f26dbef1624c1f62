#include "render/cloud/impostor/impostor_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skyig::render::cloud::impostor {

namespace {

constexpr int kAzimuths = 128;
constexpr int kElevations = 48;
constexpr std::size_t kBins = static_cast<std::size_t>(kAzimuths) * kElevations;
constexpr std::size_t kEntries = 1U << 18U;
constexpr float kOpaque = 0.998F;
constexpr float kBeside = 1.05F;
constexpr int kMostTaps = 4;
// Of relief: opacity from which a depth is taken for what it says, and the farthest that it moves a look,
// texels.
constexpr float kSure = 0.3F;
constexpr float kMostRelief = 3.0F;
constexpr double kEarthRadius_m = 6371000.0;

// 0..4 once round, rising with the angle from +x to +y.
float diamond(float x, float y) {
    const float sum = std::abs(x) + std::abs(y);
    if (!(sum > 0.0F)) return 0.0F;
    const float part = x / sum;
    return y >= 0.0F ? 1.0F - part : 3.0F + part;
}

int azimuth_bin(float x, float y) {
    return std::min(static_cast<int>(diamond(x, y) * (kAzimuths / 4.0F)), kAzimuths - 1);
}

// Finest at the horizon, where most clouds are.
int elevation_bin(float sine) {
    const float place = std::copysign(std::sqrt(std::min(std::abs(sine), 1.0F)), sine);
    return std::clamp(static_cast<int>((place + 1.0F) * (0.5F * kElevations)), 0, kElevations - 1);
}

struct Bins {
    int first_azimuth = 0;
    int azimuths = kAzimuths;
    int first_elevation = 0;
    int last_elevation = kElevations - 1;
};

// All that a sphere can be seen in.
Bins bins_of(const glm::vec3& middle_m, float distance_m, float bound_m) {
    Bins bins;
    if (distance_m <= bound_m) return bins;
    constexpr float kQuarter = 0.5F * std::numbers::pi_v<float>;
    // A little more, for what single precision does to the edges.
    const float half = std::asin(bound_m / distance_m) + 1e-4F;
    const float elevation = std::atan2(middle_m.z, std::hypot(middle_m.x, middle_m.y));
    const float low = std::max(elevation - half, -kQuarter);
    const float high = std::min(elevation + half, kQuarter);
    bins.first_elevation = elevation_bin(std::sin(low));
    bins.last_elevation = elevation_bin(std::sin(high));
    if (std::abs(elevation) + half >= kQuarter) return bins;
    const float azimuth = std::atan2(middle_m.y, middle_m.x);
    const float across = std::asin(std::min(1.0F, std::sin(half) / std::cos(elevation))) + 1e-4F;
    bins.first_azimuth = azimuth_bin(std::cos(azimuth - across), std::sin(azimuth - across));
    const int last = azimuth_bin(std::cos(azimuth + across), std::sin(azimuth + across));
    bins.azimuths = (last - bins.first_azimuth + kAzimuths) % kAzimuths + 1;
    return bins;
}

template <class Visit>
void visit_bins(const Bins& bins, const Visit& visit) {
    for (int elevation = bins.first_elevation; elevation <= bins.last_elevation; ++elevation) {
        for (int i = 0; i < bins.azimuths; ++i) {
            const int azimuth = (bins.first_azimuth + i) % kAzimuths;
            visit(static_cast<std::size_t>(elevation * kAzimuths + azimuth));
        }
    }
}

float smooth_step(float low, float high, float x) {
    const float s = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return s * s * (3.0F - 2.0F * s);
}

void add_part(const Texel& texel, float part, Texel& sum) {
    for (int c = 0; c < kChannels; ++c)
        sum.v[c] += part * texel.v[c];
}

}  // namespace

ImpostorField::ImpostorField() {
    candidates_.reserve(kMostClouds);
    placed_.resize(kMostClouds);
    shaded_.resize(kMostNear * kMostParticles);
    spheres_.resize(kMostNear);
    starts_.resize(kBins + 1);
    entries_.resize(kEntries);
}

void ImpostorField::gather(std::span<const ImpostorClouds* const> layers, const Eye& eye) noexcept {
    candidates_.clear();
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        const std::span<const Cloud> clouds = layers[layer]->clouds();
        for (std::size_t i = 0; i < clouds.size() && candidates_.size() < kMostClouds; ++i) {
            const Cloud& cloud = clouds[i];
            const bool pictured =
                cloud.pictures[0].id != Atlas::kNone || cloud.pictures[1].id != Atlas::kNone;
            if (!cloud.alive || (!pictured && cloud.particles == 0)) continue;
            const auto distance = static_cast<float>(glm::length(layers[layer]->middle_m(cloud, eye)));
            if (static_cast<double>(distance) >= layers[layer]->range_m()) continue;
            candidates_.push_back(
                {distance, static_cast<std::uint32_t>(layer), static_cast<std::uint32_t>(i)});
        }
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        if (a.distance_m != b.distance_m) return a.distance_m < b.distance_m;
        return a.layer != b.layer ? a.layer < b.layer : a.cloud < b.cloud;
    });
}

void ImpostorField::freeze(std::span<const ImpostorClouds* const> layers, const CloudLight& light,
                           const Eye& eye) noexcept {
    eye_height_m_ = eye.height_m;
    placed_count_ = 0;
    near_used_ = 0;
    gather(layers, eye);
    for (const Candidate& candidate : candidates_) {
        const ImpostorClouds& clouds = *layers[candidate.layer];
        place(clouds, clouds.clouds()[candidate.cloud], light, eye);
    }
    index_bins();
}

ImpostorField::Board ImpostorField::board_of(const ImpostorClouds& clouds, const Picture& picture, float part,
                                             const glm::vec3& middle_m) noexcept {
    Board board;
    const Capture& capture = picture.capture;
    const float ahead = glm::dot(middle_m, capture.away);
    // Seen from behind or from its edge there is nothing on it.
    if (picture.id == Atlas::kNone || part <= 0.0F || ahead <= 0.1F * glm::length(middle_m)) return board;
    board.atlas = &clouds.atlas();
    board.id = picture.id;
    board.part = part;
    board.away = capture.away;
    board.right = capture.right;
    board.up = capture.up;
    board.middle_m = {glm::dot(middle_m, capture.right), glm::dot(middle_m, capture.up), ahead};
    board.drawn_from_m = glm::length(capture.middle_m);
    board.corner_m = capture.corner_m + 0.5F * capture.texel_m;
    board.texels_per_m = 1.0F / capture.texel_m;
    board.size = capture.size;
    board.texel_rad = capture.texel_m / ahead;
    return board;
}

void ImpostorField::place(const ImpostorClouds& clouds, const Cloud& cloud, const CloudLight& light,
                          const Eye& eye) noexcept {
    Placed& placed = placed_[placed_count_++];
    placed = {};
    placed.layer = &clouds;
    placed.cloud = static_cast<std::uint32_t>(&cloud - clouds.clouds().data());
    placed.key = cloud.key;
    placed.middle_m = glm::vec3{clouds.middle_m(cloud, eye)};
    placed.distance_m = glm::length(placed.middle_m);
    // A picture may still show more than there is by now, and a little beside its place.
    placed.bound_m =
        kBeside * std::max({cloud.bound_m, cloud.pictures[0].bound_m, cloud.pictures[1].bound_m});
    const auto range = static_cast<float>(clouds.range_m());
    placed.part = shown_part(placed.distance_m, range);
    const float newest = clouds.newest_part(cloud);
    placed.boards[0] = board_of(clouds, cloud.pictures[0], newest, placed.middle_m);
    placed.boards[1] = board_of(clouds, cloud.pictures[1], 1.0F - newest, placed.middle_m);
    const float boards_part =
        smooth_step(kPictures * cloud.bound_m, kDirect * cloud.bound_m, placed.distance_m);
    if (boards_part < 1.0F && cloud.particles > 0 && near_used_ < kMostNear) {
        placed.boards_part = boards_part;
        placed.near = static_cast<int>(near_used_);
        const std::span<Shaded> out{shaded_.data() + near_used_ * kMostParticles, kMostParticles};
        shade(clouds.particles(cloud), clouds.lit(cloud), clouds.shading(), placed.middle_m, out);
        lay_out(out.first(cloud.particles), spheres_[near_used_]);
        near_counts_[near_used_++] = cloud.particles;
    }
    const double height_m = clouds.moment().layer.base_m + 0.5 * static_cast<double>(cloud.shape.height_m);
    const CloudLight::At at = light.at(height_m);
    placed.sun_lx = at.beam_lx[CloudLight::kSun];
    placed.moon_lx = at.beam_lx[CloudLight::kMoon];
    placed.above_cd_m2 = at.above_cd_m2;
    placed.below_cd_m2 = at.below_cd_m2;
}

void ImpostorField::index_bins() noexcept {
    std::fill(starts_.begin(), starts_.end(), 0U);
    std::size_t total = 0;
    std::size_t kept = 0;
    for (; kept < placed_count_; ++kept) {
        const Placed& cloud = placed_[kept];
        const Bins bins = bins_of(cloud.middle_m, cloud.distance_m, cloud.bound_m);
        total += static_cast<std::size_t>(bins.azimuths) *
                 static_cast<std::size_t>(bins.last_elevation - bins.first_elevation + 1);
        if (total > kEntries) break;
        visit_bins(bins, [this](std::size_t bin) { ++starts_[bin + 1]; });
    }
    placed_count_ = kept;
    for (std::size_t bin = 1; bin <= kBins; ++bin)
        starts_[bin] += starts_[bin - 1];
    const std::uint32_t entries = starts_.back();
    // From the farthest on and from the end of each bin: the nearest come to stand first, starts_ in place.
    for (std::size_t i = placed_count_; i-- > 0;) {
        const Placed& cloud = placed_[i];
        visit_bins(bins_of(cloud.middle_m, cloud.distance_m, cloud.bound_m), [this, i](std::size_t bin) {
            entries_[--starts_[bin + 1]] = static_cast<std::uint16_t>(i);
        });
    }
    // Each end has become its bin's beginning.
    std::copy(starts_.begin() + 1, starts_.end(), starts_.begin());
    starts_.back() = entries;
}

void ImpostorField::fetch(const Board& board, const glm::vec2& place, float weight, Texel& sum) noexcept {
    const glm::vec2 last = glm::vec2{board.size} - 1.0F;
    if (!(place.x >= 0.0F && place.y >= 0.0F && place.x < last.x && place.y < last.y)) return;
    const glm::ivec2 low{place};
    int stride = 0;
    const Texel* corner = board.atlas->corner(board.id, low, stride);
    kernels().add(corner, stride, place.x - static_cast<float>(low.x), place.y - static_cast<float>(low.y),
                  weight, sum);
}

Texel ImpostorField::look(const Board& board, const glm::vec3& ray, float ray_rad) noexcept {
    Texel sum{};
    const float forward = glm::dot(ray, board.away);
    if (!(forward > 1e-6F)) return sum;
    const glm::vec2 sideways{glm::dot(ray, board.right), glm::dot(ray, board.up)};
    const glm::vec2 middle{board.middle_m.x, board.middle_m.y};
    // Where the ray passes `depth_m` behind the plane, as it was seen from where the picture was drawn.
    const auto place_at = [&](float depth_m) {
        const glm::vec2 point = sideways * ((board.middle_m.z + depth_m) / forward) - middle;
        const float shrunk = board.drawn_from_m / (board.drawn_from_m + depth_m);
        return (point * shrunk - board.corner_m) * board.texels_per_m;
    };
    // Seen from elsewhere the plane shows what stands before or behind it in a wrong place: one look tells
    // how far off it is, the next one finds it (relief mapping, Oliveira et al., SIGGRAPH 2000, in one step).
    const glm::vec2 flat = place_at(0.0F);
    Texel first{};
    fetch(board, flat, 1.0F, first);
    // Where there is little to see the depth is uncertain: it goes to nothing with the opacity.
    glm::vec2 shift = place_at(first.v[kDepth_m] / std::max(first.v[kOpacity], kSure)) - flat;
    const float far = glm::length(shift);
    if (far > kMostRelief) shift *= kMostRelief / far;
    const glm::vec2 place = flat + shift;
    // A ray that stands for more than two texels looks at several places.
    const float span = ray_rad / board.texel_rad;
    const int taps = std::clamp(static_cast<int>(0.5F * span + 0.5F), 1, kMostTaps);
    const float step = span / static_cast<float>(taps);
    const float weight = 1.0F / static_cast<float>(taps * taps);
    for (int i = 0; i < taps * taps; ++i) {
        const glm::vec2 tap{static_cast<float>(i % taps), static_cast<float>(i / taps)};
        fetch(board, place + (tap - 0.5F * static_cast<float>(taps - 1)) * step, weight, sum);
    }
    // From depth behind the plane to distance from the eye.
    sum.v[kDepth_m] = (sum.v[kDepth_m] + board.middle_m.z * sum.v[kOpacity]) / forward;
    return sum;
}

Texel ImpostorField::look(const Placed& cloud, const glm::vec3& ray, const CloudRange& range,
                          float ray_rad) const noexcept {
    Texel seen{};
    if (cloud.boards_part > 0.0F) {
        for (const Board& board : cloud.boards) {
            if (board.part > 0.0F) add_part(look(board, ray, ray_rad), board.part * cloud.boards_part, seen);
        }
        const float distance_m = seen.v[kOpacity] > 0.0F ? seen.v[kDepth_m] / seen.v[kOpacity] : 0.0F;
        if (distance_m < range.from_m || distance_m >= range.to_m) seen = {};
    }
    if (cloud.near >= 0) {
        const auto near = static_cast<std::size_t>(cloud.near);
        const std::span<const Shaded> particles{shaded_.data() + near * kMostParticles, near_counts_[near]};
        add_part(meet(particles, spheres_[near], ray, range), 1.0F - cloud.boards_part, seen);
    }
    return seen;
}

float ImpostorField::ground_m(const glm::vec3& ray) const noexcept {
    constexpr float kFar_m = std::numeric_limits<float>::max();
    if (ray.z >= 0.0F || eye_height_m_ <= 0.0) return kFar_m;
    const double b = (kEarthRadius_m + eye_height_m_) * static_cast<double>(ray.z);
    const double c = eye_height_m_ * (2.0 * kEarthRadius_m + eye_height_m_);
    const double d = b * b - c;
    return d < 0.0 ? kFar_m : static_cast<float>(c / (std::sqrt(d) - b));
}

CloudSample ImpostorField::follow(const glm::vec3& ray, const CloudRange& range,
                                  float ray_rad) const noexcept {
    CloudSample sample;
    const auto bin = static_cast<std::size_t>(elevation_bin(ray.z) * kAzimuths + azimuth_bin(ray.x, ray.y));
    const CloudRange visible{range.from_m, std::min(range.to_m, ground_m(ray))};
    float weighed_m = 0.0F;
    float seen = 1.0F;
    for (std::uint32_t i = starts_[bin]; i < starts_[bin + 1] && seen > 1.0F - kOpaque; ++i) {
        const Placed& cloud = placed_[entries_[i]];
        const float along = glm::dot(ray, cloud.middle_m);
        if (cloud.distance_m * cloud.distance_m - along * along > cloud.bound_m * cloud.bound_m) continue;
        const Texel texel = look(cloud, ray, visible, ray_rad);
        if (!(texel.v[kOpacity] > 0.0F)) continue;
        const float part = seen * cloud.part;
        sample.light_cd_m2 +=
            part * (texel.v[kSunlight] * cloud.sun_lx + texel.v[kMoonlight] * cloud.moon_lx +
                    texel.v[kFromAbove] * cloud.above_cd_m2 + texel.v[kFromBelow] * cloud.below_cd_m2);
        weighed_m += part * texel.v[kDepth_m];
        seen *= 1.0F - std::min(1.0F, cloud.part * texel.v[kOpacity]);
    }
    sample.transmittance = seen;
    if (seen < 1.0F) sample.distance_m = std::max(0.0F, weighed_m / (1.0F - seen));
    return sample;
}

void ImpostorField::march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
                          std::span<CloudSample> out) const noexcept {
    for (std::size_t i = 0; i < rays.size(); ++i)
        out[i] = follow(rays[i].direction_enu, range, ray_rad);
}

}  // namespace skyig::render::cloud::impostor
