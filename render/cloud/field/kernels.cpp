#include "render/cloud/field/kernels.h"

namespace skyig::render::cloud::field {

const Kernels& kernels() noexcept {
#ifdef SKYIG_CLOUD_X86_64
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        return avx512::kernels();
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::kernels();
#endif
    return portable::kernels();
}

}  // namespace skyig::render::cloud::field
