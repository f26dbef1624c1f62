#define SKYIG_CLOUD_ISA portable
#define SKYIG_CLOUD_ISA_NAME "portable"

#include "render/cloud/field/kernels.h"
#include "render/cloud/field/march.inc"
