#version 450 core
// A warped screen as a mesh over a finished flat picture.
layout(location = 0) in vec2 a_screen;    // in clip space
layout(location = 1) in vec2 a_picture;   // 0..1

out vec2 v_picture;

void main() {
    v_picture = a_picture;
    gl_Position = vec4(a_screen, 0.0, 1.0);
}
