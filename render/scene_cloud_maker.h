// The clouds of a scene's weather for the cloud map, each layer by its model: the field draws sheets and
// volumes, pictures of particles the rest; a ray meets both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "render/cloud/cloud_maker.h"
#include "render/cloud/field/field_maker.h"
#include "render/cloud/impostor/impostor_clouds.h"
#include "render/cloud/impostor/impostor_field.h"
#include "render/cloud_models.h"

namespace skyig::render {

/// What is seen of two sources that stand among each other: on each ray the one whose cloud is nearer in the
/// mean stands before the other.
class JoinedClouds final : public cloud::CloudSource {
  public:
    /// Both must outlive this one's use.
    void join(const cloud::CloudSource& one, const cloud::CloudSource& other) noexcept;

    void march(std::span<const cloud::CloudRay> rays, const cloud::CloudRange& range, float ray_rad,
               std::span<cloud::CloudSample> out) const noexcept override;
    void shadow(const cloud::CloudBeam& beam, float grain_m, std::span<const glm::vec2> ground_m,
                std::span<float> passed) const noexcept override;

  private:
    const cloud::CloudSource* one_ = nullptr;
    const cloud::CloudSource* other_ = nullptr;
};

/// Impostors take memory from the first layer on that asks for them, and keep it.
class SceneCloudMaker final : public cloud::CloudMaker {
  public:
    /// Makes the field's noise, which takes a while. May throw std::bad_alloc, as may follow().
    SceneCloudMaker() = default;

    void follow(const cloud::CloudMoment& moment, float ray_rad, bool jumped) override;
    [[nodiscard]] const cloud::CloudSource& freeze(std::size_t slot,
                                                   const cloud::CloudMoment& moment) override;

  private:
    /// Of one layer at a time, which it knows again by these.
    struct Impostors {
        std::unique_ptr<cloud::impostor::ImpostorClouds> clouds;
        std::uint32_t seed = 0;
        CloudGenus genus = CloudGenus::kCumulus;
        bool used = false;
    };
    struct Slot {
        std::unique_ptr<cloud::impostor::ImpostorField> impostors;
        JoinedClouds joined;
    };
    [[nodiscard]] Impostors& impostors_of(const CloudLayer& layer);

    cloud::field::FieldMaker fields_;
    std::array<Impostors, kMostImpostorLayers> impostors_;
    std::array<Slot, kSlots> slots_;
    Scene scene_;  // for the field, when it draws layers that ask for another model
};

}  // namespace skyig::render
