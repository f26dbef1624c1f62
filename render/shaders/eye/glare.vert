#version 450 core
// The veil round a source of glare: rings of vertices in gnomonic coordinates about it, the same for every channel.
#include "common/place.glsl"

layout(location = 0) in vec2 a_offset;
layout(location = 1) in vec3 a_over_sky;
layout(location = 2) in vec3 a_over_ground;

uniform mat4 u_clip_from_enu;
uniform mat3 u_enu_from_source;

out vec2 v_offset;
out float v_height;
out vec3 v_over_sky;
out vec3 v_over_ground;

void main() {
    v_offset = a_offset;
    v_over_sky = a_over_sky;
    v_over_ground = a_over_ground;
    vec3 direction = u_enu_from_source * vec3(a_offset, 1.0);
    v_height = direction.z;
    gl_Position = placed(u_clip_from_enu * vec4(direction, 0.0));
}
