// Clouds as a field of density over the Earth: the models `volume` (marched through solid noise, after
// Schneider & Vos 2015) and `layer` (one look at flat noise) behind CloudSource. Where there is cloud depends
// on place, drift, age and seed alone, so that all who draw one weather draw the same clouds.
#pragma once

#include <array>
#include <memory>

#include "render/cloud/cloud_light.h"
#include "render/cloud/cloud_source.h"
#include "render/cloud/field/coverage.h"
#include "render/cloud/field/inside_light.h"
#include "render/cloud/field/kernels.h"
#include "render/cloud/field/noise.h"
#include "render/scene.h"

namespace skyig::render::cloud::field {

/// What does not change from frame to frame: noise, the coverage measured on it, light
/// inside. Made once, shared.
struct Matrix {
    Noise noise;
    Coverage coverage{noise};
    InsideLight water{kWaterG};
    InsideLight ice{kIceG};
};

class CloudField final : public CloudSource {
  public:
    /// \param variant  of the instruction set
    explicit CloudField(std::shared_ptr<const Matrix> matrix, const Kernels& variant = kernels());

    /// Takes the eye, the layers and the light of one frame; nothing of them is kept. Layers without
    /// thickness, coverage or finite numbers are left out, and so are those of kImpostor. kAuto is kVolume,
    /// but ice clouds, which are thin, and those that have a look are sheets then, in the volume's light.
    /// Allocates nothing.
    void freeze(const Scene& scene, const CloudLight& light) noexcept;

    void march(std::span<const CloudRay> rays, const CloudRange& range, float ray_rad,
               std::span<CloudSample> out) const noexcept override;

    void shadow(const CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                std::span<float> passed) const noexcept override;

    /// What is frozen, lowest deck first.
    [[nodiscard]] const Field& field() const noexcept { return field_; }

  private:
    std::shared_ptr<const Matrix> matrix_;
    const Kernels* kernels_;
    Field field_{};
    /// That field_ looks into.
    std::array<std::array<std::shared_ptr<const Texture>, 3>, Weather::kMaxClouds> textures_;
};

}  // namespace skyig::render::cloud::field
