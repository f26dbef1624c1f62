#version 450 core
// A strip of level lines across a body of the sky. Its varyings are gnomonic coordinates about the body's centre, exact
// at any field of view: as the disc is seen, and as it would be without refraction.
#include "common/place.glsl"

layout(location = 0) in vec2 a_seen;
layout(location = 1) in vec2 a_true_up_stretch;
layout(location = 2) in vec3 a_light;

uniform mat4 u_clip_from_enu;
uniform vec3 u_centre_enu;
uniform vec3 u_right_enu;
uniform vec3 u_up_enu;

out vec2 v_seen;
out vec2 v_offset;
out float v_stretch;
out float v_height;
out vec3 v_light;

void main() {
    v_seen = a_seen;
    v_offset = vec2(a_seen.x, a_true_up_stretch.x);
    v_stretch = a_true_up_stretch.y;
    v_light = a_light;
    vec3 direction = u_centre_enu + a_seen.x * u_right_enu + a_seen.y * u_up_enu;
    v_height = direction.z;
    gl_Position = placed(u_clip_from_enu * vec4(direction, 0.0));
}
