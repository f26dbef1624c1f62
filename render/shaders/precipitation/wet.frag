#version 450 core
// What a film of water mirrors of the sky, on things of another renderer that face up: normals from depth, tilted by the
// rings of drops near the eye. Before it has been drawn the things themselves under their air.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/fresnel.glsl"

uniform ToneParameters u_tone;
uniform vec3 u_far_centre;       // as in sky/deferred.vert
uniform vec3 u_far_right;
uniform vec3 u_far_up;
uniform vec2 u_size_px;
uniform float u_film;            // part of the ground under it
uniform float u_extinction_per_m;
uniform vec2 u_tile_at_eye;      // where the eye stands in the tile of rings, 0..1 east and north
uniform float u_tile_m;
uniform float u_tile_texels;
uniform vec2 u_sky_size;
uniform float u_pixel_rad;

layout(binding = 0) uniform sampler2D u_depth;
layout(binding = 1) uniform sampler2D u_sky;
layout(binding = 2) uniform sampler2D u_slopes;

in vec3 v_far_enu;
layout(location = 0) out vec4 o_colour;

const float kTurn = 6.2831853;

float depth_at(ivec2 pixel) { return texelFetch(u_depth, clamp(pixel, ivec2(0), ivec2(u_size_px) - 1), 0).r; }

// From a thing to its neighbour of two that lies less far before or behind it: edges have no part in it.
vec3 beside(ivec2 pixel, ivec2 step_px, vec3 far_step, vec3 place, float depth) {
    float ahead = depth_at(pixel + step_px);
    float behind = depth_at(pixel - step_px);
    bool take_ahead = abs(ahead - depth) <= abs(behind - depth);
    vec3 other = take_ahead ? (v_far_enu + far_step) * ahead : (v_far_enu - far_step) * behind;
    return take_ahead ? other - place : place - other;
}

vec3 sky_at(vec3 direction) {
    float azimuth = atan(direction.x, direction.y) / kTurn;
    vec2 at = vec2(fract(azimuth), clamp(direction.z, 0.0, 1.0));
    return texture(u_sky, (at * (u_sky_size - 1.0) + 0.5) / u_sky_size).rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel);
    if (!(depth > 0.0 && depth < 1.0)) discard;
    vec3 place = v_far_enu * depth;
    vec3 normal = cross(beside(pixel, ivec2(1, 0), u_far_right * (2.0 / u_size_px.x), place, depth),
                        beside(pixel, ivec2(0, 1), u_far_up * (2.0 / u_size_px.y), place, depth));
    normal *= inversesqrt(max(dot(normal, normal), 1e-30));
    float level = clamp((abs(normal.z) - 0.85) / 0.1, 0.0, 1.0);
    float distance_m = length(place);
    vec3 view = place / distance_m;
    // Rings as far as a pixel is no wider than some of their cells.
    float footprint_m = distance_m * u_pixel_rad / max(-view.z, 0.02);
    float resolved = clamp(2.0 - 20.0 * footprint_m / u_tile_m, 0.0, 1.0);
    vec2 tile = fract(u_tile_at_eye + place.xy / u_tile_m);
    vec2 slope = resolved * texture(u_slopes, (tile * (u_tile_texels - 1.0) + 0.5) / u_tile_texels).xy;
    vec3 water = normalize(vec3(-slope, 1.0));
    vec3 mirrored = reflect(view, water);
    mirrored.z = sqrt(max(mirrored.z, 0.0) * max(mirrored.z, 0.0) + film_slope_variance());
    float reflectance = film_reflectance(max(-dot(view, water), 0.0));
    float passed = exp(-u_extinction_per_m * distance_m);
    // Things seen from below are dry.
    float share = view.z < 0.0 ? level : 0.0;
    o_colour = vec4(shown(sky_at(normalize(mirrored)), u_tone), share * u_film * reflectance * passed);
}
