#version 450 core
// A literal colour: the unit of every cost in the documentation.
layout(location = 0) out vec4 o_colour;

void main() {
    o_colour = vec4(0.2, 0.4, 0.6, 1.0);
}
