#version 450 core
// One triangle over the whole picture; the vector to the far plane is linear over it.
uniform vec3 u_far_centre;  // middle of the far plane from the eye, east-north-up, metres,
uniform vec3 u_far_right;   // and half its sides
uniform vec3 u_far_up;

out vec3 v_far_enu;

void main() {
    vec2 at = vec2(float((gl_VertexID & 1) * 4 - 1), float((gl_VertexID & 2) * 2 - 1));
    v_far_enu = u_far_centre + at.x * u_far_right + at.y * u_far_up;
    gl_Position = vec4(at, 0.0, 1.0);
}
