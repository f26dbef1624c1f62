// The kernels of the cloud field in doubles: the same text as the drawn ones, on the same inputs.
#pragma once

#include "render/cloud/field/kernels.h"

namespace skyig::render::cloud::field::doubles {

/// Answers are rounded to float at the end alone.
[[nodiscard]] const Kernels& kernels() noexcept;

struct Shell {
    double from_m = 0.0;
    double to_m = 0.0;
};
/// Kernels::parts of one ray, not rounded.
[[nodiscard]] Shell shell(double eye_m, double low_m, double high_m, double sine, bool rising) noexcept;

}  // namespace skyig::render::cloud::field::doubles
