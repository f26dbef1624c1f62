#define SKYIG_CLOUD_ISA avx512
#define SKYIG_CLOUD_ISA_NAME "avx512"

#include "render/cloud/tile_tone.h"
#include "render/cloud/tile_tone_body.inc"
