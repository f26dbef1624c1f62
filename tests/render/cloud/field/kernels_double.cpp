#include "tests/render/cloud/field/kernels_double.h"

#define SKYIG_CLOUD_ISA doubles
#define SKYIG_CLOUD_ISA_NAME "double"
#define SKYIG_CLOUD_LANES "tests/render/cloud/field/lanes_double.inc"

#include "render/cloud/field/march.inc"

namespace skyig::render::cloud::field::doubles {

Shell shell(double eye_m, double low_m, double high_m, double sine, bool rising) noexcept {
    const Ray ray{F{}, F{}, all(sine), eye_m, 0.0, (kEarth_m + eye_m) * all(sine), all(1e9)};
    const Part part = between(ray, low_m, high_m, rising);
    return {part.from[0], part.to[0]};
}

}  // namespace skyig::render::cloud::field::doubles
