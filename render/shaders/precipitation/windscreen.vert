#version 450 core
// A drop on the pane: a square about its base.
layout(location = 0) in vec2 a_clip;
layout(location = 1) in vec2 a_across;  // of the base's radius, right and up
layout(location = 2) in vec2 a_radius_px_there;

out vec2 v_across;
out vec2 v_radius_px_there;

void main() {
    v_across = a_across;
    v_radius_px_there = a_radius_px_there;
    gl_Position = vec4(a_clip, 0.0, 1.0);
}
