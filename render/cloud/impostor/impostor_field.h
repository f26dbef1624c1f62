// Clouds of model `impostor` for the shared map: a ray meets the pictures of all clouds in its way. The seed
// draws its billboards once per channel; here the map is where they are drawn, once for all channels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_light.h"
#include "render/cloud/cloud_source.h"
#include "render/cloud/impostor/impostor_clouds.h"

namespace skyig::render::cloud::impostor {

class ImpostorField final : public CloudSource {
  public:
    /// Of all layers together; farther ones are left out.
    static constexpr std::size_t kMostClouds = 4096;
    /// Clouds so near that rays meet their particles; of any farther one the picture has to do.
    static constexpr std::size_t kMostNear = 20;

    ImpostorField();

    /// Allocates nothing. \param layers  read in place until the next freeze(): their update() has to wait
    /// for the marches \param eye  near the one that they were last updated for
    void freeze(std::span<const ImpostorClouds* const> layers, const CloudLight& light,
                const Eye& eye) noexcept;

    void march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
               std::span<CloudSample> out) const noexcept override;

    /// By particles, as they are when it is asked.
    void shadow(const CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                std::span<float> passed) const noexcept override;

    /// Clouds that stand in the way of some ray.
    [[nodiscard]] std::size_t cloud_count() const noexcept { return placed_count_; }

  private:
    /// A picture on its plane.
    struct Board {
        const Atlas* atlas = nullptr;
        Atlas::Id id = Atlas::kNone;
        float part = 0.0F;
        glm::vec3 away{0.0F};
        glm::vec3 right{0.0F};
        glm::vec3 up{0.0F};
        /// The cloud's middle along these three.
        glm::vec3 middle_m{0.0F};
        /// From where it was drawn.
        float drawn_from_m = 1.0F;
        /// Of the first texel's middle, from the cloud's.
        glm::vec2 corner_m{0.0F};
        float texels_per_m = 0.0F;
        glm::ivec2 size{0};
        float texel_rad = 1.0F;
    };
    struct Placed {
        glm::vec3 middle_m{0.0F};
        float distance_m = 0.0F;
        float bound_m = 0.0F;
        std::array<Board, 2> boards{};
        float boards_part = 1.0F;
        /// Where its particles are, while its cell has the same cloud.
        const ImpostorClouds* layer = nullptr;
        std::uint32_t cloud = 0;
        std::uint32_t key = 0;
        /// Index into near_; < 0: none.
        int near = -1;
        /// Of it all: clouds fade at the end of their layer's range.
        float part = 1.0F;
        glm::vec3 sun_lx{0.0F};
        glm::vec3 moon_lx{0.0F};
        glm::vec3 above_cd_m2{0.0F};
        glm::vec3 below_cd_m2{0.0F};
    };
    struct Candidate {
        float distance_m;
        std::uint32_t layer;
        std::uint32_t cloud;
    };

    void gather(std::span<const ImpostorClouds* const> layers, const Eye& eye) noexcept;
    void place(const ImpostorClouds& clouds, const Cloud& cloud, const CloudLight& light,
               const Eye& eye) noexcept;
    [[nodiscard]] static Board board_of(const ImpostorClouds& clouds, const Picture& picture, float part,
                                        const glm::vec3& middle_m) noexcept;
    void index_bins() noexcept;
    [[nodiscard]] static Texel look(const Board& board, const glm::vec3& ray, float ray_rad) noexcept;
    static void fetch(const Board& board, const glm::vec2& place, float weight, Texel& sum) noexcept;
    [[nodiscard]] Texel look(const Placed& cloud, const glm::vec3& ray, const CloudRange& range,
                             float ray_rad) const noexcept;
    [[nodiscard]] CloudSample follow(const glm::vec3& ray, const CloudRange& range,
                                     float ray_rad) const noexcept;
    [[nodiscard]] float ground_m(const glm::vec3& ray) const noexcept;
    struct Shade;
    void add_shade(const Placed& cloud, Shade& shade) const noexcept;

    std::vector<Candidate> candidates_;
    std::vector<Placed> placed_;
    std::size_t placed_count_ = 0;
    std::vector<Shaded> shaded_;
    std::vector<Spheres> spheres_;
    std::array<std::size_t, kMostNear> near_counts_{};
    std::size_t near_used_ = 0;
    /// Clouds by direction, the nearest first: entries_[starts_[bin]] .. entries_[starts_[bin + 1]].
    std::vector<std::uint32_t> starts_;
    std::vector<std::uint16_t> entries_;
    double eye_height_m_ = 0.0;
};

}  // namespace skyig::render::cloud::impostor
