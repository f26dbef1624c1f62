#version 450 core
// Gaussian footprint of sigma 0.7 px evaluated at pixel centres about the exact position: its weights sum to 1 within 3e-4
// at every sub-pixel offset. Adds what the star brightens the display over its background.
#include "common/scalar.glsl"
#include "eye/tone.glsl"

uniform ToneParameters u_tone;

flat in vec2 v_centre_px;
flat in vec3 v_star;
flat in vec3 v_background;

layout(location = 0) out vec4 o_colour;

void main() {
    vec2 offset = gl_FragCoord.xy - v_centre_px;
    const float variance = 0.49;
    float weight = exp(-dot(offset, offset) / (2.0 * variance)) / (6.283185307 * variance);
    // A shoulder instead of a clip keeps the colour and the order of bright stars.
    vec3 star = vec3(1.0) - exp(-v_star * weight);
    o_colour = vec4(encoded(v_background + star, u_tone) - encoded(v_background, u_tone), 0.0);
}
