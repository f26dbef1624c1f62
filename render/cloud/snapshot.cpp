#include "render/cloud/snapshot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/geometry.h"

namespace skyig::render::cloud {

namespace {

constexpr LightAndPassed kClear{{0.0F, 0.0F, 0.0F, 1.0F}};
constexpr CloudSample kNoCloud{};

// Where transmittance steps by more from a texel to its neighbour, one ray meets the cloud or misses it: the
// edge would have the texels' stairs.
constexpr float kEdge = 0.35F;
// Four rays on a turned square in the place of the one in the middle; parts of a texel.
constexpr std::array<glm::dvec2, 4> kBeside{
    {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};

bool on_edge(const std::array<CloudSample, kTileTexels>& samples, int texel) noexcept {
    const float own = samples[static_cast<std::size_t>(texel)].transmittance;
    const auto steps = [&](int to) {
        return std::abs(samples[static_cast<std::size_t>(to)].transmittance - own) > kEdge;
    };
    const int column = texel % kTile;
    const int row = texel / kTile;
    return (column > 0 && steps(texel - 1)) || (column + 1 < kTile && steps(texel + 1)) ||
           (row > 0 && steps(texel - kTile)) || (row + 1 < kTile && steps(texel + kTile));
}

CloudSample mean_of(std::span<const CloudSample> samples) noexcept {
    CloudSample mean;
    const float share = 1.0F / static_cast<float>(samples.size());
    float taken = 0.0F;
    float way_m = 0.0F;
    mean.transmittance = 0.0F;
    for (const CloudSample& sample : samples) {
        mean.light_cd_m2 += share * sample.light_cd_m2;
        mean.transmittance += share * sample.transmittance;
        taken += 1.0F - sample.transmittance;
        way_m += (1.0F - sample.transmittance) * sample.distance_m;
    }
    mean.distance_m = taken > 0.0F ? way_m / taken : 0.0F;
    return mean;
}

// Marches a tile's edges with more rays. \param direction_of  of a place, in texels of the tile
template <class DirectionOf>
void refine_edges(const CloudSource& source, const CloudRange& range, float texel_rad,
                  const DirectionOf& direction_of, std::array<CloudSample, kTileTexels>& samples) noexcept {
    constexpr std::size_t kAtOnce = 16;
    std::array<int, kTileTexels> edges;
    std::size_t count = 0;
    for (int i = 0; i < kTileTexels; ++i)
        if (on_edge(samples, i)) edges[count++] = i;
    std::array<CloudRay, kAtOnce * kBeside.size()> rays;
    std::array<CloudSample, kAtOnce * kBeside.size()> beside;
    for (std::size_t first = 0; first < count; first += kAtOnce) {
        const std::size_t batch = std::min(kAtOnce, count - first);
        for (std::size_t i = 0; i < batch * kBeside.size(); ++i) {
            const int texel = edges[first + i / kBeside.size()];
            const glm::dvec2& aside = kBeside[i % kBeside.size()];
            rays[i].direction_enu = direction_of(texel % kTile + aside.x, texel / kTile + aside.y);
        }
        const std::size_t asked = batch * kBeside.size();
        source.march(std::span{rays}.first(asked), range, texel_rad, std::span{beside}.first(asked));
        for (std::size_t i = 0; i < batch; ++i) {
            samples[static_cast<std::size_t>(edges[first + i])] =
                mean_of(std::span{beside}.subspan(i * kBeside.size(), kBeside.size()));
        }
    }
}

}  // namespace

glm::dvec3 eye_offset_m(const Eye& from, const Eye& to) noexcept {
    const double north_rad = glm::radians(to.latitude_deg - from.latitude_deg);
    const double east_rad = glm::radians(std::remainder(to.longitude_deg - from.longitude_deg, 360.0));
    const double from_rad = glm::radians(from.latitude_deg);
    const double to_rad = glm::radians(to.latitude_deg);
    // Of the unit vector to the other place: nothing cancels where it is near by.
    const double half = std::sin(0.5 * east_rad);
    const double bent = 2.0 * half * half * std::cos(to_rad);
    const double east = std::cos(to_rad) * std::sin(east_rad);
    const double north = std::sin(north_rad) + bent * std::sin(from_rad);
    const double up = std::cos(north_rad) - bent * std::cos(from_rad);
    const double aside = std::hypot(east, north);
    const double scale = aside > 0.0 ? std::atan2(aside, up) / aside : 1.0;
    const double radius_m = kEarthRadius_m + from.height_m;
    return {radius_m * scale * east, radius_m * scale * north, to.height_m - from.height_m};
}

double axes_turn_rad(const Eye& from, const Eye& to) noexcept {
    const double east_rad = glm::radians(std::remainder(to.longitude_deg - from.longitude_deg, 360.0));
    return east_rad * std::sin(glm::radians(0.5 * (from.latitude_deg + to.latitude_deg)));
}

bool has_leapt(const Eye& before, const Eye& now) noexcept {
    constexpr double kMostTurn_rad = 0.1;
    const glm::dvec3 way_m = eye_offset_m(before, now);
    return std::hypot(way_m.x, way_m.y) > 500.0 + 0.02 * std::abs(now.height_m) ||
           std::abs(axes_turn_rad(before, now)) > kMostTurn_rad;
}

void Snapshot::resize(const MapGeometry& geometry, std::size_t probes) {
    probes_.reserve(probes);
    geometry_ = geometry;
    light_.assign(geometry.texel_count(), kClear);
    reach_m_.assign(geometry.texel_count(), 0.0F);
    const auto tiles = static_cast<std::size_t>(geometry.tile_count());
    tiles_.assign(tiles, Tile::kUnknown);
    holds_clear_.assign(tiles, 1);
    const auto nodes = static_cast<std::size_t>(2 * nodes_across() * nodes_across());
    for (auto* each : {&inverse_m_, &weight_, &spread_})
        each->assign(nodes, 0.0F);
}

void Snapshot::begin(const Frozen& frozen) noexcept {
    frozen_ = frozen;
    std::fill(tiles_.begin(), tiles_.end(), Tile::kUnknown);
}

glm::vec3 Snapshot::straight(const glm::vec3& seen) const noexcept {
    const glm::dvec3 unit = glm::normalize(glm::dvec3{seen});
    if (unit.z >= 0.0) return glm::vec3{unit};
    const Horizontal at = horizontal_of(unit);
    return glm::vec3{direction_of(
        {straight_elevation_rad(at.elevation_rad, frozen_.seen_horizon_rad, frozen_.straight_horizon_rad),
         at.azimuth_rad})};
}

void Snapshot::clear(int tile) noexcept {
    tiles_[static_cast<std::size_t>(tile)] = Tile::kClear;
    std::uint8_t& holds_clear = holds_clear_[static_cast<std::size_t>(tile)];
    if (holds_clear != 0) return;
    holds_clear = 1;
    const MapGeometry::Texel corner = geometry_.corner(tile);
    for (int row = 0; row < kTile; ++row) {
        const std::size_t first = geometry_.index({corner.column, corner.row + row, corner.lower});
        std::fill_n(&light_[first], kTile, kClear);
        std::fill_n(&reach_m_[first], kTile, 0.0F);
    }
}

// In the middle of the tile that begins there.
float Snapshot::texel_rad(const MapGeometry::Texel& corner) const noexcept {
    const auto direction = [&](int column, int row) {
        return straight(geometry_.direction(corner.column + column, corner.row + row, corner.lower));
    };
    const glm::vec3 middle = direction(kTile / 2, kTile / 2);
    return std::max(glm::length(direction(kTile / 2 + 1, kTile / 2) - middle),
                    glm::length(direction(kTile / 2, kTile / 2 + 1) - middle));
}

void Snapshot::put(const MapGeometry::Texel& at, const CloudSample& sample) noexcept {
    const std::size_t to = geometry_.index(at);
    light_[to].v = LightAndPassed::Lanes{sample.light_cd_m2.x, sample.light_cd_m2.y, sample.light_cd_m2.z,
                                         sample.transmittance};
    reach_m_[to] = (1.0F - sample.transmittance) * sample.distance_m;
}

void Snapshot::march(const CloudSource& source, int tile) noexcept {
    const MapGeometry::Texel corner = geometry_.corner(tile);
    std::array<CloudRay, kTileTexels> rays;
    std::array<CloudSample, kTileTexels> samples;
    const auto direction_of = [&](double column, double row) {
        return straight(geometry_.direction(corner.column + column, corner.row + row, corner.lower));
    };
    for (int i = 0; i < kTileTexels; ++i)
        rays[static_cast<std::size_t>(i)].direction_enu = direction_of(i % kTile, i / kTile);
    source.march(rays, frozen_.range, texel_rad(corner), samples);
    if (std::all_of(samples.begin(), samples.end(),
                    [](const CloudSample& sample) { return sample == kNoCloud; })) {
        clear(tile);
        return;
    }
    refine_edges(source, frozen_.range, texel_rad(corner), direction_of, samples);
    for (int i = 0; i < kTileTexels; ++i)
        put({corner.column + i % kTile, corner.row + i / kTile, corner.lower},
            samples[static_cast<std::size_t>(i)]);
    tiles_[static_cast<std::size_t>(tile)] = Tile::kCloud;
    holds_clear_[static_cast<std::size_t>(tile)] = 0;
}

void Snapshot::march_part(const CloudSource& source, const MapGeometry::Texel& corner) noexcept {
    std::array<CloudRay, kPart * kPart> rays;
    std::array<CloudSample, kPart * kPart> samples;
    const auto texel = [&](int i) {
        return MapGeometry::Texel{corner.column + i % kPart, corner.row + i / kPart, corner.lower};
    };
    for (int i = 0; i < kPart * kPart; ++i) {
        const MapGeometry::Texel at = texel(i);
        rays[static_cast<std::size_t>(i)].direction_enu =
            straight(geometry_.direction(at.column, at.row, at.lower));
    }
    const MapGeometry::Texel tile{corner.column / kTile * kTile, corner.row / kTile * kTile, corner.lower};
    source.march(rays, frozen_.range, texel_rad(tile), samples);
    for (int i = 0; i < kPart * kPart; ++i)
        put(texel(i), samples[static_cast<std::size_t>(i)]);
}

void Snapshot::march_probes(const CloudSource& source, std::span<const glm::vec3> seen_enu, float ray_rad) {
    probes_.resize(seen_enu.size());
    for (std::size_t i = 0; i < seen_enu.size(); ++i) {
        const CloudRay ray{straight(seen_enu[i])};
        source.march({&ray, 1}, {}, ray_rad, {&probes_[i], 1});
    }
}

// Each node takes what lies nearest to it.
void Snapshot::gather_tile(int tile) noexcept {
    const MapGeometry::Texel corner = geometry_.corner(tile);
    for (int i = 0; i < kTileTexels; ++i) {
        const int column = corner.column + i % kTile;
        const int row = corner.row + i / kTile;
        const std::size_t from = geometry_.index({column, row, corner.lower});
        const float opacity = 1.0F - light_[from].v[3];
        if (!(reach_m_[from] > 0.0F) || opacity < 1e-4F) continue;
        const std::size_t node =
            node_index((column + kNodeStep / 2) / kNodeStep, (row + kNodeStep / 2) / kNodeStep, corner.lower);
        const float length = glm::length(geometry_.direction(column, row, corner.lower));
        inverse_m_[node] += opacity * length * opacity / reach_m_[from];
        weight_[node] += opacity;
    }
}

// Nodes without clouds take what those around them have.
void Snapshot::spread() noexcept {
    const int across = nodes_across();
    spread_ = inverse_m_;
    for (int i = 0; i < 2 * across * across; ++i) {
        if (inverse_m_[static_cast<std::size_t>(i)] > 0.0F) continue;
        const bool lower = i >= across * across;
        const int row = i / across - (lower ? across : 0);
        const int column = i % across;
        float sum = 0.0F;
        float count = 0.0F;
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, across - 1); ++r) {
            for (int c = std::max(column - 1, 0); c <= std::min(column + 1, across - 1); ++c) {
                const float there = inverse_m_[node_index(c, r, lower)];
                sum += there;
                count += there > 0.0F ? 1.0F : 0.0F;
            }
        }
        if (count > 0.0F) spread_[static_cast<std::size_t>(i)] = sum / count;
    }
    std::swap(spread_, inverse_m_);
}

void Snapshot::lay_distances() noexcept {
    std::fill(inverse_m_.begin(), inverse_m_.end(), 0.0F);
    std::fill(weight_.begin(), weight_.end(), 0.0F);
    for (int i = 0; i < geometry_.tile_count(); ++i) {
        if (tile(i) == Tile::kCloud) gather_tile(i);
    }
    for (std::size_t i = 0; i < inverse_m_.size(); ++i)
        inverse_m_[i] = weight_[i] > 0.0F ? inverse_m_[i] / weight_[i] : 0.0F;
    constexpr int kReach = 3;
    for (int i = 0; i < kReach; ++i)
        spread();
}

float Snapshot::nearest_inverse(int tile) const noexcept {
    const MapGeometry::Texel corner = geometry_.corner(tile);
    float most = 0.0F;
    for (int row = 0; row <= kTile / kNodeStep; ++row) {
        for (int column = 0; column <= kTile / kNodeStep; ++column) {
            most = std::max(most, inverse_distance(corner.column / kNodeStep + column,
                                                   corner.row / kNodeStep + row, corner.lower));
        }
    }
    // Lengths of directions whose components' sizes sum to 1 are 0.577 at least.
    return most * 1.7320508F;
}

float Snapshot::inverse_distance(const glm::vec3& direction) const noexcept {
    const glm::vec2 place = shaders32::cloud_map_place(direction);
    const auto step = static_cast<float>(geometry_.size() - 1) / (2.0F * kNodeStep);
    const auto most = static_cast<float>(nodes_across() - 2);
    const float x = std::clamp((place.x + 1.0F) * step, 0.0F, most);
    const float y = std::clamp((place.y + 1.0F) * step, 0.0F, most);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float right = x - static_cast<float>(column);
    const float down = y - static_cast<float>(row);
    const bool lower = direction.z < 0.0F;
    const auto along = [&](int r) {
        return glm::mix(inverse_distance(column, r, lower), inverse_distance(column + 1, r, lower), right);
    };
    return glm::mix(along(row), along(row + 1), down);
}

}  // namespace skyig::render::cloud
