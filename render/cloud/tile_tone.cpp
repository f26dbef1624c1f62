#include "render/cloud/tile_tone.h"

namespace skyig::render::cloud {

const ToneKernel& tone_kernel() noexcept {
#ifdef SKYIG_CLOUD_X86_64
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        return avx512::tone_kernel();
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::tone_kernel();
#endif
    return portable::tone_kernel();
}

}  // namespace skyig::render::cloud
