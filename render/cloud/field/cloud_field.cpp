#include "render/cloud/field/cloud_field.h"

#include <algorithm>
#include <utility>

#include "render/cloud/field/freeze.h"

namespace skyig::render::cloud::field {

CloudField::CloudField(std::shared_ptr<const Matrix> matrix, const Kernels& variant)
    : matrix_(std::move(matrix)), kernels_(&variant) {}

void CloudField::freeze(const Scene& scene, const CloudLight& light) noexcept {
    freeze_field(*matrix_, scene, light, field_);
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

}  // namespace skyig::render::cloud::field
