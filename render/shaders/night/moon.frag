#version 450 core
// The Moon as a lit sphere: phase, bright limb and crescent follow from the direction of the Sun, an eclipse from the
// Earth's shadow.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "night/moon.glsl"
#include "common/dither.glsl"
#include "common/disc.glsl"

uniform ToneParameters u_tone;
uniform vec3 u_full_cd_m2;       // mean luminance of the lit face divided by its phase function, outside the air
uniform vec3 u_earthshine_cd_m2;
uniform vec3 u_to_sun_disc;      // in the disc's axes: right, up, towards the eye
uniform vec3 u_shadow_axis_disc; // from the Moon's centre to the axis of the Earth's shadow, in radii of the Moon
uniform vec2 u_shadow_radii;     // of umbra and penumbra

layout(location = 0) out vec4 o_colour;

void main() {
    vec2 xy = v_offset / u_radius;
    float rr = min(dot(xy, xy), 1.0);
    vec3 normal = vec3(xy, sqrt(1.0 - rr));
    vec3 to_axis = u_shadow_axis_disc - normal;
    float from_axis = length(to_axis - u_to_sun_disc * dot(to_axis, u_to_sun_disc));
    SunInShadow sun = sun_in_shadow(from_axis, u_shadow_radii.x, u_shadow_radii.y);
    vec3 face = u_earthshine_cd_m2 + u_full_cd_m2 * (vec3(sun.direct) + sun.refracted) *
                                         lommel_seeliger(dot(normal, u_to_sun_disc), normal.z);
    vec3 sky = sky_behind();
    vec3 light = v_light * face;
    // An eclipsed Moon is looked at with the middle of the eye, which has no rods and adapts to it: in the shadow its
    // colours stay down to where cones end, and what would overdrive the display keeps its hue.
    float shadow = stores_luminance(u_tone) ? 0.0 : 1.0 - sun.direct;
    float luminance = luminance_709(light);
    float cones = smoothstep(-3.0, -2.0, log2(max(luminance, 1e-9)) * 0.30103);
    ToneParameters tone = u_tone;
    tone.photopic = max(tone.photopic, shadow * cones * luminance / (luminance + max(luminance_709(sky), 1e-9)));
    vec3 display = display_linear(sky + light, tone);
    float largest = max(display.x, max(display.y, display.z));
    display *= mix(1.0, 0.85 / (3.0 + largest), shadow * cones * smoothstep(0.0, 1.0, largest));
    o_colour = vec4(dithered(encoded(display, tone), dot(gl_FragCoord.xy, kDitherStep)), disc_coverage());
}
