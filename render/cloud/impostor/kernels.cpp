#include "render/cloud/impostor/kernels.h"

namespace skyig::render::cloud::impostor {

const Kernels& kernels() noexcept {
#ifdef SKYIG_IMPOSTOR_X86_64
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::kernels();
#endif
    return portable::kernels();
}

}  // namespace skyig::render::cloud::impostor
