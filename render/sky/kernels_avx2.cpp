#define SKYIG_SKY_ISA avx2
#define SKYIG_SKY_ISA_NAME "avx2"

#include "render/sky/kernels.h"
#include "render/sky/kernels_body.inc"
