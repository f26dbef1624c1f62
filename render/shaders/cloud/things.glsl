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

layout(binding = 8) uniform sampler2D u_cloud_light;     // with the air between; transmittance of all
layout(binding = 9) uniform sampler2D u_cloud_distance;  // 1 over it
layout(binding = 10) uniform sampler2D u_cloud_near;     // transmittance of near ones
layout(binding = 11) uniform sampler2D u_shadow;

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

// The thing has its air before it already.
vec3 behind_clouds(vec3 colour, vec3 view, float distance_m) {
    if (u_clouds_shown < 0.5) return colour;
    vec2 at = cloud_map_place(view);
    float shift = view.z < 0.0 ? u_cloud_place.w + 0.5 : u_cloud_place.w;
    vec2 place = vec2(at.x * u_cloud_place.x + u_cloud_place.y, at.y * u_cloud_place.z + shift);
    vec4 clouds = texture(u_cloud_light, place);
    if (!(clouds.a < 0.9999)) return colour;
    float before = passed_before(clouds.a, texture(u_cloud_near, place).r, distance_m, u_near_range_m,
                                 texture(u_cloud_distance, place).r);
    return before * colour + light_before(clouds.a, before) * clouds.rgb;
}
