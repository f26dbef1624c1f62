#version 450 core
// The Sun's disc with linear limb darkening, I/I0 = 1 - u (1 - cos): u about 0.6 at 550 nm, more in the blue.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/dither.glsl"
#include "common/disc.glsl"

uniform ToneParameters u_tone;
uniform vec3 u_limb;

layout(location = 0) out vec4 o_colour;

void main() {
    float rho = min(length(v_offset) / u_radius, 1.0);
    float cos_emission = sqrt(1.0 - rho * rho);
    vec3 profile = (vec3(1.0) - u_limb * (1.0 - cos_emission)) / (vec3(1.0) - u_limb / 3.0);
    vec3 light = sky_behind() + v_light * profile;
    o_colour = vec4(dithered(shown(light, u_tone), dot(gl_FragCoord.xy, kDitherStep)), disc_coverage());
}
