#version 450 core
#include "common/dither.glsl"

in vec3 v_encoded;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

void main() {
    o_colour = vec4(dithered(v_encoded, v_dither_phase_w * gl_FragCoord.w), 1.0);
}
