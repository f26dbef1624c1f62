#define SKYIG_IMPOSTOR_ISA portable
#define SKYIG_IMPOSTOR_ISA_NAME "portable"

#include "render/cloud/impostor/kernels.h"
#include "render/cloud/impostor/kernels_body.inc"
