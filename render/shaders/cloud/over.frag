#version 450 core
// Clouds before what is drawn already: to be blended, what is there times alpha.
#include "cloud/fetch.glsl"

in vec3 v_direction;
layout(location = 0) out vec4 o_colour;

void main() { o_colour = clouds_at(v_direction); }
