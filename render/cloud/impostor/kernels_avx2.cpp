#define SKYIG_IMPOSTOR_ISA avx2
#define SKYIG_IMPOSTOR_ISA_NAME "avx2"

#include "render/cloud/impostor/kernels.h"
#include "render/cloud/impostor/kernels_body.inc"
