#version 450 core
// Adds the veil, already encoded for the display, over the sky or over the ground.
#include "common/dither.glsl"

uniform float u_horizon_sin;
uniform float u_inv_softness;    // 1 over the sine's rise in one pixel's angle at the horizon

in vec2 v_offset;
in float v_height;
in vec3 v_over_sky;
in vec3 v_over_ground;

layout(location = 0) out vec4 o_colour;

void main() {
    float elevation_sin = v_height * inversesqrt(1.0 + dot(v_offset, v_offset));
    float above = clamp((elevation_sin - u_horizon_sin) * u_inv_softness + 0.5, 0.0, 1.0);
    o_colour = vec4(dithered(mix(v_over_ground, v_over_sky, above), dot(gl_FragCoord.yx, kDitherStep)), 0.0);
}
