#version 450 core
// Another renderer's picture under our air: colour * passed + added, behind the clouds before it, then the tone curve. Where it has drawn nothing, what
// is there stays.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/dither.glsl"
#include "sky/aerial.glsl"
#include "fog/veil.glsl"
#include "fog/patches.glsl"
#include "cloud/things.glsl"

uniform ToneParameters u_tone;
uniform AerialMap u_map;
uniform vec3 u_table_size;       // columns, rows, slices
uniform float u_depths;
uniform float u_haze_g;
uniform vec3 u_source_enu[2];
uniform mat4 u_source_rgb[2];    // what becomes of the light of the table
uniform float u_source_count;
uniform vec3 u_even_cd_m2;      // of endless air
uniform float u_veil_count;      // segments, 0 without fog
uniform float u_veil_radius_m;   // of the eye's place, from the Earth's centre
uniform vec3 u_veil_lux[2];
uniform vec3 u_veil_enu[2];      // towards the sources of that light
uniform vec2 u_veil_slants;
uniform vec3 u_veil_beyond[2];   // light from past it: sky, ground
uniform float u_veil_above_m;
uniform vec4 u_veil_molecules;   // VeilAir: per metre at the eye, scale height
uniform vec4 u_veil_aerosol;

layout(binding = 0) uniform sampler2D u_colour;
layout(binding = 1) uniform sampler2D u_depth;
layout(binding = 2) uniform sampler2D u_extinction;
layout(binding = 3) uniform sampler3D u_rest_0;
layout(binding = 4) uniform sampler3D u_haze_0;
layout(binding = 5) uniform sampler3D u_rest_1;
layout(binding = 6) uniform sampler3D u_haze_1;
layout(binding = 7) uniform sampler2D u_veil;

in vec3 v_far_enu;
layout(location = 0) out vec4 o_colour;

// Coordinate 0..1 from the first texel's centre to the last one's.
float centred(float at, float texels) { return (at * (texels - 1.0) + 0.5) / texels; }

vec3 light(sampler3D rest, sampler3D haze, vec3 source, vec3 view, vec3 at) {
    float level = sqrt(max(dot(view.xy, view.xy) * dot(source.xy, source.xy), 1e-12));
    float column = aerial_column(dot(view.xy, source.xy) / level);
    vec3 place = vec3(centred(column, u_table_size.x), at.y, at.z);
    float phase = aerial_haze_phase(u_haze_g, clamp(dot(view, source), -1.0, 1.0));
    return texture(rest, place).rgb + phase * texture(haze, place).rgb;
}

// Light of air without an end: what the table has so far along the ray.
vec3 endless(vec3 view, vec3 at) {
    vec3 sum = u_even_cd_m2;
    if (u_source_count > 0.5)
        sum += mat3(u_source_rgb[0]) * light(u_rest_0, u_haze_0, u_source_enu[0], view, at);
    if (u_source_count > 1.5)
        sum += mat3(u_source_rgb[1]) * light(u_rest_1, u_haze_1, u_source_enu[1], view, at);
    return sum;
}

VeilSegment veil_segment(int i) {
    vec4 ends = texelFetch(u_veil, ivec2(i, 0), 0);
    vec4 depths = texelFetch(u_veil, ivec2(i, 1), 0);
    vec4 low = texelFetch(u_veil, ivec2(i, 2), 0);
    vec4 high = texelFetch(u_veil, ivec2(i, 3), 0);
    vec4 low_slope = texelFetch(u_veil, ivec2(i, 4), 0);
    vec4 high_slope = texelFetch(u_veil, ivec2(i, 5), 0);
    return VeilSegment(ends.x, ends.y, ends.z, ends.w, depths.x, depths.y, depths.z, depths.w,
                       vec3(low.w, high.w, low_slope.w), low.rgb, high.rgb, low_slope.rgb, high_slope.rgb);
}

// As fog/walk.h: the near sum ends at the thing, the whole one where the ray does.
void walk(vec3 view, float distance_m, inout VeilSum near, inout VeilSum whole) {
    VeilRay ray = VeilRay(view.z, u_veil_radius_m);
    VeilBeams beams = VeilBeams(u_veil_lux[0], u_veil_lux[1], u_veil_slants.x, u_veil_slants.y,
                                clamp(dot(view, u_veil_enu[0]), -1.0, 1.0), clamp(dot(view, u_veil_enu[1]), -1.0, 1.0));
    int count = int(u_veil_count);
    VeilSegment lowest = veil_segment(0);
    vec2 ground_m = veil_below_m(lowest.low_m, ray);
    bool meets_ground = view.z < 0.0 && ground_m.y > ground_m.x;
    float from_m = view.z < 0.0 ? max(veil_below_m(veil_segment(count - 1).high_m, ray).x, 0.0) : max(ground_m.y, 0.0);
    for (int k = view.z < 0.0 ? -count : 0; k < (meets_ground ? 0 : count); ++k) {
        VeilSegment at = veil_segment(k < 0 ? -1 - k : k);
        vec2 end_m = veil_below_m(k < 0 ? at.low_m : at.high_m, ray);
        float to_m = max(k < 0 ? end_m.x : end_m.y, 0.0);
        to_m = max(to_m, from_m);
        float cut = at.kept * veil_depth(at, from_m, to_m, ray);
        float part_m = (to_m - from_m) / max(cut, 1e-30);
        for (int piece = 0; piece < 3; ++piece) {
            bool last = piece == 2 || !(cut > (piece == 0 ? 1.0 : 3.0));
            float until_m = last ? to_m : min(from_m + (piece == 0 ? 1.0 : 2.0) * part_m, to_m);
            float at_m = clamp(distance_m, from_m, until_m);
            whole = veil_add(whole, at, from_m, at_m, ray, beams);
            if (from_m < distance_m) near = whole;
            whole = veil_add(whole, at, at_m, until_m, ray, beams);
            from_m = until_m;
            if (last) break;
        }
    }
}

// A thing under clear air shows colour * passed + added; that air is `far_cd_m2` where it has no end.
vec3 under_veil(vec3 colour, vec3 passed, vec3 added, vec3 far_cd_m2, vec3 view, float distance_m) {
    VeilSum near = veil_none();
    VeilSum whole = near;
    walk(view, distance_m, near, whole);
    VeilRay ray = VeilRay(view.z, u_veil_radius_m);
    VeilAir air = VeilAir(u_veil_molecules.xyz, u_veil_aerosol.xyz, u_veil_molecules.w, u_veil_aerosol.w, u_veil_above_m);
    vec3 before = veil_in_air(near, veil_air_passes_before(near, ray, air), far_cd_m2,
                              veil_own_air(added, passed, far_cd_m2, near));
    vec3 without = veil_in_air(whole, veil_air_passes_before(whole, ray, air), far_cd_m2,
                               u_veil_beyond[view.z < 0.0 ? 1 : 0]);
    return colour * passed * exp(-near.depth) + veil_before(before, without, near);
}

vec3 under_air(vec3 colour, vec3 view, float distance_m) {
    vec3 passed = vec3(1.0);
    vec3 added = vec3(0.0);
    vec3 far_cd_m2 = vec3(0.0);
    bool veiled = u_veil_count > 0.5 && distance_m > 0.0;
    AerialPlace place = aerial_place(view.z, u_map);
    float inside_m = distance_m - place.near_m;
    if (place.meets_air && inside_m > 0.0) {
        float far_m = aerial_far_m(place.sine, u_map);
        inside_m = min(inside_m, far_m);
        float slice = aerial_slice(inside_m, far_m);
        float row = centred(aerial_row(place.sine, u_map), u_table_size.y);
        passed = exp(-inside_m * texture(u_extinction, vec2(centred(slice, u_depths), row)).rgb);
        added = (vec3(1.0) - passed) * endless(view, vec3(0.0, row, centred(slice, u_table_size.z)));
        if (veiled) far_cd_m2 = endless(view, vec3(0.0, row, centred(1.0, u_table_size.z)));
    }
    if (!veiled) return colour * passed + added;
    return under_veil(colour, passed, added, far_cd_m2, view, distance_m);
}

// What is not a number is dark, what is endless very bright.
float clean(float value) { return value > 0.0 ? min(value, 1e9) : 0.0; }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(u_depth, pixel, 0).r;
    if (!(depth < 1.0)) discard;
    vec3 colour = texelFetch(u_colour, pixel, 0).rgb;
    colour = vec3(clean(colour.r), clean(colour.g), clean(colour.b));
    float far_m = length(v_far_enu);
    vec3 view = v_far_enu / far_m;
    float distance_m = max(depth, 0.0) * far_m;
    colour = under_air(in_cloud_shadow(colour, view, distance_m), view, distance_m);
    colour = behind_clouds(colour, view, distance_m);
    o_colour = vec4(dithered(shown(colour, u_tone), dot(gl_FragCoord.xy, kDitherStep)), 1.0);
}
