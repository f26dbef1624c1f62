#define SKYIG_CLOUD_ISA portable
#define SKYIG_CLOUD_ISA_NAME "portable"

#include "render/cloud/tile_tone.h"
#include "render/cloud/tile_tone_body.inc"
