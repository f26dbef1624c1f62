// Clouds and things of another renderer: the shadows on them, and what stands before them.
#include "cloud/map.glsl"
#include "cloud/before.glsl"

uniform float u_clouds_shown;
uniform vec4 u_cloud_place;       // as in cloud/fetch.glsl
uniform float u_near_range_m;
uniform float u_shaded;
uniform float u_eye_height_m;
uniform vec3 u_shadow_source;     // towards it
uniform vec3 u_beam_over_mean;
uniform vec2 u_shadow_heights_m;  // where shadows begin: lowest, highest
uniform float u_shadow_mean;
uniform vec2 u_shadow_corner_m[3];
uniform vec3 u_shadow_cell_m;
uniform float u_shadow_cells;

uniform vec4 u_patch_heights_m;   // PatchHeights
uniform vec3 u_patch_fog;         // extinction, 0 without patches; mean beyond the rings; the eye's radius
uniform vec2 u_patch_size;        // directions, rings

layout(binding = 8) uniform sampler2D u_cloud_light;     // with the air between; transmittance of all
layout(binding = 9) uniform sampler2D u_cloud_distance;  // 1 over it
layout(binding = 10) uniform sampler2D u_cloud_near;     // transmittance of near ones
layout(binding = 11) uniform sampler2D u_shadow;
layout(binding = 12) uniform sampler2D u_patches;

// As ShadowMap::at(): each square fades into the next one at its rim.
float beam_at(vec2 ground_m) {
    float sum = 0.0;
    float left = 1.0;
    float last = u_shadow_cells - 1.0;
    for (int k = 0; k < 3 && left > 0.0; ++k) {
        vec2 place = (ground_m - u_shadow_corner_m[k]) / u_shadow_cell_m[k] - 0.5;
        vec2 rim = min(place, last - place);
        float inside = min(rim.x, rim.y) * u_shadow_cells / (8.0 * last);
        if (!(inside > 0.0)) continue;
        float share = left * min(inside, 1.0);
        vec2 texel = (place + 0.5) / u_shadow_cells;
        sum += share * texture(u_shadow, vec2(texel.x, (texel.y + float(k)) / 3.0)).r;
        left -= share;
    }
    return sum + left * u_shadow_mean;
}

vec3 in_cloud_shadow(vec3 colour, vec3 view, float distance_m) {
    if (u_shaded < 0.5) return colour;
    vec3 at_m = view * distance_m;
    float height_m = height_over_ground(at_m, u_eye_height_m);
    float strength = shadow_strength(height_m, u_shadow_heights_m.x, u_shadow_heights_m.y);
    if (!(strength > 0.0)) return colour;
    float change = strength * (beam_at(shadow_place(at_m, height_m, u_shadow_source)) - u_shadow_mean);
    return colour * max(vec3(1.0) + u_beam_over_mean * change, vec3(0.0));
}

// Metres of full density on the ground from below the eye.
float patch_sum(float turns, float ground_m) {
    float inside_m = min(ground_m, patch_ring_m(u_patch_size.y));
    vec2 place = vec2(turns * u_patch_size.x, patch_ring(inside_m)) + 0.5;
    return texture(u_patches, place / (u_patch_size + 1.0)).r + u_patch_fog.y * (ground_m - inside_m);
}

// Metres of full density, over the ground, of a piece of ray.
float patch_way_m(float from_m, float to_m, PatchBand band, VeilRay ray, float level, float turns) {
    int parts = patch_parts(band);
    float sum = patch_sum(turns, from_m * level);
    float density = patch_density(from_m, band, ray);
    float way_m = 0.0;
    for (int k = 1; k <= parts; ++k) {
        float at_m = mix(from_m, to_m, float(k) / float(parts));
        float next_sum = patch_sum(turns, at_m * level);
        float next_density = patch_density(at_m, band, ray);
        way_m += 0.5 * (density + next_density) * (next_sum - sum);
        sum = next_sum;
        density = next_density;
    }
    return way_m;
}

// Optical depth of fog's patches up to the thing, up to the end of near clouds and of all.
vec3 patch_depths(vec3 view, float distance_m) {
    VeilRay ray = VeilRay(view.z, u_patch_fog.z);
    PatchHeights heights = PatchHeights(u_patch_heights_m.x, u_patch_heights_m.y, u_patch_heights_m.z, u_patch_heights_m.w);
    float level = max(length(view.xy), 1e-4);
    float turns = atan(view.x, view.y) / 6.2831853 + 0.5;
    vec3 ways_m = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        PatchBand band = patch_band(i, heights);
        vec2 piece_m = patch_piece_m(band, ray);
        if (!(piece_m.y > piece_m.x)) continue;
        vec3 ends_m = clamp(vec3(distance_m, u_near_range_m, piece_m.y), piece_m.x, piece_m.y);
        for (int k = 0; k < 3; ++k)
            ways_m[k] += patch_way_m(piece_m.x, ends_m[k], band, ray, level, turns);
    }
    return u_patch_fog.x / level * ways_m;
}

// The thing has its air before it already.
vec3 behind_clouds(vec3 colour, vec3 view, float distance_m) {
    if (u_clouds_shown < 0.5) return colour;
    vec2 at = cloud_map_place(view);
    float shift = view.z < 0.0 ? u_cloud_place.w + 0.5 : u_cloud_place.w;
    vec2 place = vec2(at.x * u_cloud_place.x + u_cloud_place.y, at.y * u_cloud_place.z + shift);
    vec4 clouds = texture(u_cloud_light, place);
    if (!(clouds.a < 0.9999)) return colour;
    float near = texture(u_cloud_near, place).r;
    float all = clouds.a;
    float before = 1.0;
    if (u_patch_fog.x > 0.0) {
        vec3 passed = exp(-patch_depths(view, distance_m));
        before = passed.x;
        near = patch_others(near, passed.y);
        all = patch_others(all, passed.z);
    }
    before *= passed_before(all, near, distance_m, u_near_range_m, texture(u_cloud_distance, place).r);
    return before * colour + light_before(clouds.a, before) * clouds.rgb;
}
