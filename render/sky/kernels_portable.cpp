#define SKYIG_SKY_ISA portable
#define SKYIG_SKY_ISA_NAME "portable"

#include "render/sky/kernels.h"
#include "render/sky/kernels_body.inc"
