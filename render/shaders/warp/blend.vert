#version 450 core
// The parts of a screen that a mask changes.
layout(location = 0) in vec2 a_place;   // in clip space

void main() { gl_Position = vec4(a_place, 0.0, 1.0); }
