// What the clouds of one frozen moment look like in the directions of the map that were asked for, in linear
// light, and what is needed to see them from another eye near by.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_source.h"
#include "render/cloud/map_geometry.h"
#include "render/scene.h"

namespace skyig::render::cloud {

/// Light and transmittance of a direction; four floats that are always dealt with together.
struct LightAndPassed {
    using Lanes = float __attribute__((vector_size(16)));
    Lanes v;
};

/// Of a moment, besides what the source knows.
struct Frozen {
    Eye eye;
    /// Of the layer that the eye's displacement is measured against, and its seed.
    glm::dvec2 drift_m{0.0};
    std::uint32_t seed = 0;
    CloudRange range;
    /// Directions are as seen; rays are straight. \see straight_elevation_rad()
    double seen_horizon_rad = 0.0;
    double straight_horizon_rad = 0.0;
};

/// East, north, up of the first eye, metres: of another one near by, along the ground of a sphere and up.
/// Poles are places as any other.
[[nodiscard]] glm::dvec3 eye_offset_m(const Eye& from, const Eye& to) noexcept;
/// By how much east and north of one eye stand turned against those of another one near by: little but near
/// poles.
[[nodiscard]] double axes_turn_rad(const Eye& from, const Eye& to) noexcept;
/// Whether the eye was carried to another place since the frame before: no craft covers so much in one. Or
/// beside a pole, where the directions that maps are fixed to turn under the eye.
[[nodiscard]] bool has_leapt(const Eye& before, const Eye& now) noexcept;

class Snapshot {
  public:
    enum class Tile : std::uint8_t { kUnknown, kClear, kCloud };
    /// Texels from one node of the distances to the next.
    static constexpr int kNodeStep = 8;

    /// Allocates; all is clear and unknown. \param probes  as many as march_probes() will get
    void resize(const MapGeometry& geometry, std::size_t probes);
    /// Another moment: all tiles become unknown.
    void begin(const Frozen& frozen) noexcept;

    /// Fills a tile. One that a few wide rays find empty is clear. Any number of tiles at a time, each by one
    /// thread.
    void march(const CloudSource& source, int tile) noexcept;
    /// Fills a part of a tile of a map that is only asked for seen(): its square of kPart texels.
    void march_part(const CloudSource& source, const MapGeometry::Texel& corner) noexcept;
    static constexpr int kPart = 8;
    /// Follows some directions, near clouds too, for the eye's adaptation.
    void march_probes(const CloudSource& source, std::span<const glm::vec3> seen_enu, float ray_rad);
    /// Works out how far the clouds are, smoothly over directions; to be called when tiles are done.
    void lay_distances() noexcept;

    [[nodiscard]] const MapGeometry& geometry() const noexcept { return geometry_; }
    [[nodiscard]] const Frozen& frozen() const noexcept { return frozen_; }
    [[nodiscard]] Tile tile(int index) const noexcept { return tiles_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] std::span<const CloudSample> probes() const noexcept { return probes_; }
    /// Of all texels: four floats of each; distance times opacity. For the loops of tile_tone.h.
    [[nodiscard]] const float* light_and_passed() const noexcept {
        return reinterpret_cast<const float*>(light_.data());
    }
    [[nodiscard]] const float* reach_m() const noexcept { return reach_m_.data(); }

    /// What another eye sees. \param direction  components whose sizes sum to 1 \param inverse_m  over the
    /// distance, as inverse_distance() has it \param offset_m  of that eye
    struct Seen {
        LightAndPassed::Lanes light;  ///< transmittance last
        float reach_m;                ///< distance times opacity
    };
    [[nodiscard]] Seen seen(const glm::vec3& direction, float inverse_m,
                            const glm::vec3& offset_m) const noexcept {
        const glm::vec3 at = direction + inverse_m * offset_m;
        const glm::vec2 place = shaders32::cloud_map_place(at);
        const auto last = static_cast<float>(geometry_.size() - 1);
        const float x = std::clamp((place.x + 1.0F) * 0.5F * last, 0.0F, last);
        const float y = std::clamp((place.y + 1.0F) * 0.5F * last, 0.0F, last);
        const int column = std::min(static_cast<int>(x), geometry_.size() - 2);
        const int row = std::min(static_cast<int>(y), geometry_.size() - 2);
        const float right = x - static_cast<float>(column);
        const float down = y - static_cast<float>(row);
        const std::size_t first = geometry_.index({column, row, at.z < 0.0F});
        const std::size_t second = first + static_cast<std::size_t>(geometry_.size());
        const auto mixed = [&](auto a, auto b, auto c, auto d) {
            const auto low = a + (b - a) * right;
            return low + (c + (d - c) * right - low) * down;
        };
        return {mixed(light_[first].v, light_[first + 1].v, light_[second].v, light_[second + 1].v),
                mixed(reach_m_[first], reach_m_[first + 1], reach_m_[second], reach_m_[second + 1])};
    }
    /// 1 / m for a direction whose components' sizes sum to 1, in terms of that length: linear over the map
    /// for a level layer. 0 where no cloud is near by. \param column, row  of a node
    [[nodiscard]] float inverse_distance(int column, int row, bool lower) const noexcept {
        return inverse_m_[node_index(column, row, lower)];
    }
    /// 1 / m of the nearest of a tile's nodes.
    [[nodiscard]] float nearest_inverse(int tile) const noexcept;
    /// inverse_distance() between nodes. \param direction  components whose sizes sum to 1
    [[nodiscard]] float inverse_distance(const glm::vec3& direction) const noexcept;

  private:
    [[nodiscard]] int nodes_across() const noexcept { return geometry_.size() / kNodeStep + 1; }
    [[nodiscard]] std::size_t node_index(int column, int row, bool lower) const noexcept {
        return static_cast<std::size_t>(((lower ? nodes_across() : 0) + row) * nodes_across() + column);
    }
    void gather_tile(int tile) noexcept;
    void spread() noexcept;
    void clear(int tile) noexcept;
    [[nodiscard]] float texel_rad(const MapGeometry::Texel& corner) const noexcept;
    void put(const MapGeometry::Texel& at, const CloudSample& sample) noexcept;
    [[nodiscard]] glm::vec3 straight(const glm::vec3& seen) const noexcept;

    MapGeometry geometry_;
    Frozen frozen_;
    std::vector<LightAndPassed> light_;
    std::vector<float> reach_m_;
    std::vector<Tile> tiles_;
    std::vector<std::uint8_t> holds_clear_;
    std::vector<float> inverse_m_;
    std::vector<float> weight_;
    std::vector<float> spread_;
    std::vector<CloudSample> probes_;
};

}  // namespace skyig::render::cloud
