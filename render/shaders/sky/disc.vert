#version 450 core
// A square around a body of the sky: its varyings are gnomonic coordinates about the body's centre, exact at any
// field of view.
uniform mat4 u_clip_from_enu;
uniform vec3 u_centre_enu;
uniform vec3 u_right_enu;
uniform vec3 u_up_enu;
uniform float u_extent;

out vec2 v_offset;
out float v_height;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
    v_offset = corner * u_extent;
    vec3 direction = u_centre_enu + v_offset.x * u_right_enu + v_offset.y * u_up_enu;
    v_height = direction.z;
    gl_Position = u_clip_from_enu * vec4(direction, 0.0);
}
