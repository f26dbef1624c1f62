#version 450 core
#include "common/dither.glsl"
#include "cloud/fetch.glsl"

in vec3 v_encoded;
in vec3 v_direction;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

void main() {
    vec4 clouds = clouds_at(v_direction);
    o_colour = vec4(dithered(v_encoded * clouds.a + clouds.rgb, v_dither_phase_w * gl_FragCoord.w), 1.0);
}
