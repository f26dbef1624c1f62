#define SKYIG_CLOUD_ISA avx2
#define SKYIG_CLOUD_ISA_NAME "avx2"

#include "render/cloud/tile_tone.h"
#include "render/cloud/tile_tone_body.inc"
