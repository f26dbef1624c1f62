#version 450 core
// The dome of smooth light: vertices are directions, colours are toned already. Perspective-correct interpolation over
// a flat triangle depends on the direction alone, so that neighbouring channels agree wherever they overlap.
layout(location = 0) in vec3 a_direction;
layout(location = 1) in vec3 a_encoded;

uniform mat4 u_clip_from_mesh;

out vec3 v_encoded;

void main() {
    v_encoded = a_encoded;
    gl_Position = u_clip_from_mesh * vec4(a_direction, 0.0);
}
