#version 450 core
// Luminance = illuminance * Gaussian density in angle (1/sr), sigma 0.7 px of the axis: its sum over the pixels times their
// solid angles is the star's illuminance within 3e-4 at every sub-pixel offset. Adds what the star brightens the display
// over its background.
#include "common/scalar.glsl"
#include "eye/tone.glsl"

uniform ToneParameters u_tone;
uniform vec2 u_plane_origin;     // image plane at distance 1: where window coordinate 0 lies,
uniform vec2 u_plane_step;       // and the size of a pixel
uniform float u_sigma_rad;

flat in vec3 v_direction;
flat in vec3 v_star;
flat in vec3 v_background;

layout(location = 0) out vec4 o_colour;

void main() {
    vec3 here = normalize(vec3(u_plane_origin + u_plane_step * gl_FragCoord.xy, -1.0));
    vec3 chord = (here - v_direction) / u_sigma_rad;
    float density = exp(-0.5 * dot(chord, chord)) / (6.283185307 * u_sigma_rad * u_sigma_rad);
    o_colour = vec4(encoded(v_background + v_star * density, u_tone) - encoded(v_background, u_tone), 0.0);
}
