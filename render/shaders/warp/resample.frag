#version 450 core
// A flat picture, seen through a warp; black beyond its edge.
layout(binding = 0) uniform sampler2D u_picture;

in vec2 v_picture;
layout(location = 0) out vec4 o_colour;

void main() {
    vec2 inside = step(abs(v_picture - 0.5), vec2(0.5));
    o_colour = vec4(texture(u_picture, v_picture).rgb * (inside.x * inside.y), 1.0);
}
