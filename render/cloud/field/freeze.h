// One frame's weather as the march takes it.
#pragma once

#include "render/cloud/field/cloud_field.h"

namespace skyig::render::cloud::field {

void freeze_field(const Matrix& matrix, const Scene& scene, const CloudLight& light, Field& field) noexcept;

}  // namespace skyig::render::cloud::field
