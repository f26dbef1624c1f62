#version 450 core
// The dome of smooth light: vertices are directions, colours are toned already and fade from one state to another.
// Perspective-correct interpolation over a flat triangle depends on the direction alone, so that neighbouring channels
// agree wherever they overlap.
#include "common/dither.glsl"
#include "common/place.glsl"

layout(location = 0) in vec3 a_direction;
layout(location = 1) in vec3 a_from;
layout(location = 2) in vec3 a_to;

uniform mat4 u_clip_from_mesh;
uniform mat4 u_enu_from_mesh;    // this one and what follows from it where clouds are laid over waves alone
uniform float u_share;
uniform vec2 u_half_size_px;

out vec3 v_encoded;
out vec3 v_direction;
// Phase times w rides on the triangles, and the rasteriser has 1 / w at hand: cheaper than gl_FragCoord.xy. (As a
// noperspective varying it would be cheaper still, but llvmpipe loses clipped triangles that carry one.)
out float v_dither_phase_w;

void main() {
    v_encoded = mix(a_from, a_to, u_share);
    v_direction = (u_enu_from_mesh * vec4(a_direction, 1.0)).xyz;
    gl_Position = placed(u_clip_from_mesh * vec4(a_direction, 1.0));
    v_dither_phase_w = dot((gl_Position.xy + gl_Position.w) * u_half_size_px, kDitherStep);
}
