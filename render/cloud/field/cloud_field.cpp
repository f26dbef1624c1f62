#include "render/cloud/field/cloud_field.h"

#include <algorithm>
#include <utility>

#include "render/cloud/field/freeze.h"
#include "render/cloud/field/texture.h"

namespace skyig::render::cloud::field {

CloudField::CloudField(std::shared_ptr<const Matrix> matrix, const Kernels& variant)
    : matrix_(std::move(matrix)), kernels_(&variant) {}

void CloudField::freeze(const Scene& scene, const CloudLight& light) noexcept {
    freeze_field(*matrix_, scene, light, field_);
    for (std::size_t i = 0; i < textures_.size(); ++i) {
        const std::optional<CloudLook>& look = scene.weather.clouds[i].look;
        for (std::size_t k = 0; k < textures_[i].size(); ++k) {
            if (i < scene.weather.cloud_count && look)
                textures_[i][k] = look->tiles[k].picture;
            else
                textures_[i][k].reset();
        }
    }
}

void CloudField::march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
                       std::span<CloudSample> out) const noexcept {
    if (field_.deck_count == 0) {
        std::fill(out.begin(), out.end(), CloudSample{});
        return;
    }
    Rays batch{};
    batch.from_m = std::max(range.from_m, 0.0F);
    batch.to_m = range.to_m;
    batch.ray_rad = ray_rad;
    const std::size_t all = std::min(rays.size(), out.size());
    for (std::size_t first = 0; first < all; first += kRays) {
        const std::size_t count = std::min(all - first, static_cast<std::size_t>(kRays));
        for (std::size_t i = 0; i < static_cast<std::size_t>(kRays); ++i) {
            const glm::vec3& direction = rays[first + std::min(i, count - 1)].direction_enu;
            batch.direction[0][i] = direction.x;
            batch.direction[1][i] = direction.y;
            batch.direction[2][i] = direction.z;
        }
        batch.count = static_cast<int>(count);
        kernels_->march(field_, batch);
        for (std::size_t i = 0; i < count; ++i) {
            out[first + i] = {{batch.light[0][i], batch.light[1][i], batch.light[2][i]},
                              batch.transmittance[i],
                              batch.distance_m[i]};
        }
    }
}

void CloudField::shadow(const CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                        std::span<float> passed) const noexcept {
    // A beam along the ground would meet all clouds there are.
    constexpr float kLowest = 0.01F;
    Shade batch{};
    for (int c = 0; c < 3; ++c)
        batch.direction[c] = beam.direction_enu[c];
    batch.direction[2] = std::max(batch.direction[2], kLowest);
    batch.along[0] = beam.direction_enu.x + field_.closing * beam.direction_enu.y;
    batch.along[1] = beam.direction_enu.y;
    batch.grain_m = grain_m;
    batch.spread_rad = beam.spread_rad;
    const std::size_t all = std::min(ground_m.size(), passed.size());
    for (std::size_t first = 0; first < all; first += kRays) {
        const std::size_t count = std::min(all - first, static_cast<std::size_t>(kRays));
        for (std::size_t i = 0; i < static_cast<std::size_t>(kRays); ++i) {
            const glm::vec2& place = ground_m[first + std::min(i, count - 1)];
            batch.east_m[i] = place.x + field_.closing * place.y;
            batch.north_m[i] = place.y;
        }
        batch.count = static_cast<int>(count);
        kernels_->shade(field_, batch);
        std::copy_n(batch.passed, count, &passed[first]);
    }
}

}  // namespace skyig::render::cloud::field
