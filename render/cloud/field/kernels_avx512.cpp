#define SKYIG_CLOUD_ISA avx512
#define SKYIG_CLOUD_ISA_NAME "avx512"

#include "render/cloud/field/kernels.h"
#include "render/cloud/field/march.inc"
