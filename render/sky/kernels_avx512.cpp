#define SKYIG_SKY_ISA avx512
#define SKYIG_SKY_ISA_NAME "avx512"

#include "render/sky/kernels.h"
#include "render/sky/kernels_body.inc"
