#version 450 core
// The Moon as a lit sphere: phase, bright limb and crescent follow from the direction of the Sun.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "night/moon.glsl"
#include "common/dither.glsl"
#include "common/disc.glsl"

uniform ToneParameters u_tone;
uniform vec3 u_full_cd_m2;       // mean luminance of the lit face divided by its phase function, behind the air
uniform vec3 u_earthshine_cd_m2;
uniform vec3 u_to_sun_disc;      // in the disc's axes: right, up, towards the eye

layout(location = 0) out vec4 o_colour;

void main() {
    vec2 xy = v_offset / u_radius;
    float rr = min(dot(xy, xy), 1.0);
    vec3 normal = vec3(xy, sqrt(1.0 - rr));
    vec3 light = sky_behind() + u_earthshine_cd_m2 +
                 u_full_cd_m2 * lommel_seeliger(dot(normal, u_to_sun_disc), normal.z);
    o_colour = vec4(dithered(shown(light, u_tone)), disc_coverage());
}
