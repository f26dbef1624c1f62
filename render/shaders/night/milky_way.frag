#version 450 core
#include "common/dither.glsl"

uniform sampler2D u_map;

in vec2 v_place;
in vec3 v_colour;
in float v_bend;
in float v_above_horizon;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

void main() {
    float t = texture(u_map, v_place).x;
    vec3 added = v_colour * (t * (1.0 + t * v_bend) * clamp(v_above_horizon, 0.0, 1.0));
    o_colour = vec4(dithered(added, v_dither_phase_w * gl_FragCoord.w), 0.0);
}
