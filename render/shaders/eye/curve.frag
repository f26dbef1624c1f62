#version 450 core
// The tone curve of greys, one a pixel: what is asked of the display in cd/m2, and the code.
#include "common/scalar.glsl"
#include "eye/tone.glsl"

uniform ToneParameters u_tone;
layout(binding = 0) uniform sampler2D u_luminance;

layout(location = 0) out vec4 o_shown;

void main() {
    vec3 display = display_linear(vec3(texelFetch(u_luminance, ivec2(gl_FragCoord.x, 0), 0).r), u_tone);
    o_shown = vec4(luminance_709(display) / u_tone.inv_display_max, encoded(display, u_tone).g, 0.0, 1.0);
}
