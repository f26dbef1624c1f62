#version 450 core
// The dome's triangles where waves are seen one by one (sky/dome.vert), with what their slopes change of the light.
#include "common/dither.glsl"
#include "common/place.glsl"

layout(location = 0) in vec3 a_direction;
layout(location = 1) in vec3 a_from;
layout(location = 2) in vec3 a_to;
layout(location = 3) in vec3 a_smooth_from;
layout(location = 4) in vec3 a_smooth_to;
layout(location = 5) in vec3 a_east;
layout(location = 6) in vec3 a_north;
layout(location = 7) in vec3 a_bend;
layout(location = 8) in vec3 a_glitter;

uniform mat4 u_clip_from_mesh;
uniform mat4 u_enu_from_mesh;
uniform float u_share;
uniform vec2 u_half_size_px;

out vec3 v_encoded;
out vec3 v_ray;
out vec3 v_smooth;
out vec3 v_east;
out vec3 v_north;
out vec3 v_bend;
out vec3 v_glitter;
out float v_dither_phase_w;

void main() {
    v_encoded = mix(a_from, a_to, u_share);
    v_ray = (u_enu_from_mesh * vec4(a_direction, 1.0)).xyz;
    v_smooth = mix(a_smooth_from, a_smooth_to, u_share);
    v_east = a_east;
    v_north = a_north;
    v_bend = a_bend;
    v_glitter = a_glitter;
    gl_Position = placed(u_clip_from_mesh * vec4(a_direction, 1.0));
    v_dither_phase_w = dot((gl_Position.xy + gl_Position.w) * u_half_size_px, kDitherStep);
}
