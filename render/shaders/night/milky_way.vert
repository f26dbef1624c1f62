#version 450 core
// The Milky Way's belt: a strip of directions with what a texel of the map adds to the display there. What depends on
// direction alone is interpolated over flat triangles, as in the dome: channels agree wherever they overlap.
#include "common/dither.glsl"
#include "common/place.glsl"

layout(location = 0) in vec3 a_direction;
layout(location = 1) in vec2 a_place;
layout(location = 2) in vec3 a_colour;
layout(location = 3) in float a_bend;

uniform mat4 u_clip_from_galactic;
uniform mat3 u_enu_from_galactic; // this one and what follows from it where clouds are drawn alone
uniform vec2 u_half_size_px;
uniform vec3 u_up_galactic;      // both over the width of the horizon's edge
uniform float u_horizon_sine;
uniform vec2 u_place_scale;      // from edge to edge of the map to its texels
uniform vec2 u_place_shift;

out vec2 v_place;
out vec3 v_direction;
out vec3 v_colour;
out float v_bend;
out float v_above_horizon;
out float v_dither_phase_w;

void main() {
    gl_Position = placed(u_clip_from_galactic * vec4(a_direction, 1.0));
    v_direction = u_enu_from_galactic * a_direction;
    v_place = a_place * u_place_scale + u_place_shift;
    v_colour = a_colour;
    v_bend = a_bend;
    v_above_horizon = dot(a_direction, u_up_galactic) - u_horizon_sine;
    // Another sequence than the dome's, so that the two roundings are not of one mind.
    v_dither_phase_w = 3.0 * dot((gl_Position.xy + gl_Position.w) * u_half_size_px, kDitherStep);
}
