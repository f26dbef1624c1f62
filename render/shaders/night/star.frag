#version 450 core
// Adds what the star brightens the display over its background.
#include "common/scalar.glsl"
#include "eye/tone.glsl"

uniform ToneParameters u_tone;

flat in vec2 v_place_px;
flat in vec3 v_peak;
flat in vec3 v_background;
flat in vec3 v_background_code;

layout(location = 0) out vec4 o_colour;

const float kFall = 1.4722398;   // log2(e) / (2 * 0.7^2)

void main() {
    vec2 apart_px = gl_FragCoord.xy - v_place_px;
    float weight = exp2(-kFall * dot(apart_px, apart_px));
    o_colour = vec4(encoded(v_background + v_peak * weight, u_tone) - v_background_code, 0.0);
}
