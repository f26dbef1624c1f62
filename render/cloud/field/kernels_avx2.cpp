#define SKYIG_CLOUD_ISA avx2
#define SKYIG_CLOUD_ISA_NAME "avx2"

#include "render/cloud/field/kernels.h"
#include "render/cloud/field/march.inc"
