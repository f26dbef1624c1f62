// Moments of the cloud field for the cloud map.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/cloud/cloud_maker.h"
#include "render/cloud/field/cloud_field.h"

namespace skyig::render::cloud::field {

class FieldMaker final : public CloudMaker {
  public:
    /// Makes the noise, which takes a while and may throw std::bad_alloc.
    FieldMaker();

    [[nodiscard]] const CloudSource& freeze(std::size_t slot, const CloudMoment& moment) override;

  private:
    std::vector<CloudField> fields_;  // one a slot
    Scene scene_;
};

}  // namespace skyig::render::cloud::field
