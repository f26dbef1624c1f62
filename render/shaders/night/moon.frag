#version 450 core
// The Moon as a lit sphere: phase, bright limb and crescent follow from the direction of the Sun, an eclipse from the
// Earth's shadow, maria and rays from the map of its face.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "eye/fovea.glsl"
#include "night/moon.glsl"
#include "common/dither.glsl"
#include "common/disc.glsl"

uniform ToneParameters u_tone;
uniform Fovea u_fovea;
uniform vec3 u_full_cd_m2;       // mean luminance of the lit face divided by its phase function, outside the air
uniform vec3 u_earthshine_cd_m2;
uniform float u_mean_cd_m2;      // of the whole disc, outside the air and the Earth's shadow: what the eye that looks at it adapts to
uniform vec3 u_veil_cd_m2;       // that the bright part lays over the disc in the eye
uniform float u_veil_own_cd_m2;  // of it and the sky, before the eye adapts to them
uniform vec3 u_to_sun_disc;      // in the disc's axes: right, up, towards the eye
uniform vec3 u_shadow_axis_disc; // from the Moon's centre to the axis of the Earth's shadow, in radii of the Moon
uniform vec2 u_shadow_radii;     // of umbra and penumbra
uniform mat3 u_selenographic_from_disc;
uniform float u_map_level;       // where a texel of the map is as large as a pixel, at the disc's middle

layout(binding = 0) uniform sampler2D u_map;

layout(location = 0) out vec4 o_colour;

// Towards the limb a pixel covers more of the ground.
float albedo(vec3 normal) {
    float level = max(u_map_level - 0.5 * log2(max(normal.z, 0.1)), 0.0);
    return textureLod(u_map, moon_map_place(u_selenographic_from_disc * normal), level).x;
}

void main() {
    vec2 xy = v_offset / u_radius;
    float rr = min(dot(xy, xy), 1.0);
    vec3 normal = vec3(xy, sqrt(1.0 - rr));
    vec3 to_axis = u_shadow_axis_disc - normal;
    float from_axis = length(to_axis - u_to_sun_disc * dot(to_axis, u_to_sun_disc));
    SunInShadow sun = sun_in_shadow(from_axis, u_shadow_radii.x, u_shadow_radii.y);
    vec3 sunlight = vec3(sun.direct) + sun.refracted;
    vec3 face = u_earthshine_cd_m2 +
                u_full_cd_m2 * sunlight * lommel_seeliger(dot(normal, u_to_sun_disc), normal.z);
    vec3 light = v_light * face * albedo(normal);
    vec3 sky = sky_behind();
    float own = luminance_709(light);
    if (stores_luminance(u_tone)) {
        o_colour = vec4(shown(sky + light, u_tone), disc_coverage());
        return;
    }
    light *= foveal_factor(u_fovea, foveal_adaptation(u_mean_cd_m2 * luminance_709(v_light * sunlight), own));
    // Who looks at the part in the Earth's shadow keeps the bright rest away from the middle of the eye.
    float veil_own = max(u_veil_own_cd_m2 * sun.direct, 1e-9);
    light = beside_veil(light, u_veil_cd_m2 * sun.direct, own / (own + veil_own));
    float photopic = max(photopic_share(veil_own), foveal_share(own) * own / (own + max(luminance_709(sky), 1e-9)));
    // And sees its copper with cones alone, the little sky before it too.
    ToneParameters tone = u_tone;
    tone.photopic = mix(tone.photopic, max(tone.photopic, photopic), 1.0 - sun.direct);
    vec3 display = encoded(seen_before(light, photopic, sky, tone), tone);
    o_colour = vec4(dithered(display, dot(gl_FragCoord.xy, kDitherStep)), disc_coverage());
}
