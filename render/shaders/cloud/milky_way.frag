#version 450 core
// The Milky Way through clouds: as night/milky_way.frag. The map is warped so that codes go nearly straight with it: what
// clouds let through of the light, they let through of the code's power of the warp.
#include "common/dither.glsl"
#include "cloud/fetch.glsl"

uniform sampler2D u_map;

in vec2 v_place;
in vec3 v_direction;
in vec3 v_colour;
in float v_bend;
in float v_above_horizon;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

const float kInverseWarp = 1.0 / 2.2;

void main() {
    float passed = clamp(clouds_at(v_direction).a, 0.0, 1.0);
    float whole = texture(u_map, v_place).x;
    // t = (1 + x)^(1/2.2) - 1 of the dimmed x.
    float x = pow(1.0 + whole, 2.2) - 1.0;
    float t = pow(1.0 + passed * x, kInverseWarp) - 1.0;
    vec3 added = v_colour * (t * (1.0 + t * v_bend) * clamp(v_above_horizon, 0.0, 1.0));
    o_colour = vec4(dithered(added, v_dither_phase_w * gl_FragCoord.w), 0.0);
}
