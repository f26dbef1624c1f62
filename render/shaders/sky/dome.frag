#version 450 core
#include "common/dither.glsl"

in vec3 v_encoded;
layout(location = 0) out vec4 o_colour;

void main() {
    o_colour = vec4(dithered(v_encoded), 1.0);
}
