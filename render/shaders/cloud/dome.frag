#version 450 core
#include "common/dither.glsl"

layout(binding = 7) uniform sampler2D u_clouds;

in vec3 v_encoded;
in vec3 v_place;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

void main() {
    vec4 clouds = textureProj(u_clouds, v_place);
    o_colour = vec4(dithered(v_encoded * clouds.a + clouds.rgb, v_dither_phase_w * gl_FragCoord.w), 1.0);
}
