#version 450 core
// A streak before the sky.
#include "precipitation/streak.glsl"

layout(location = 0) out vec4 o_colour;

void main() { o_colour = vec4(v_colour, streak_coverage()); }
