#version 450 core
// Another renderer's picture under our air: colour * passed + added, then the tone curve. Where it has drawn nothing, what
// is there stays.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/dither.glsl"
#include "sky/aerial.glsl"

uniform ToneParameters u_tone;
uniform AerialMap u_map;
uniform vec3 u_table_size;       // columns, rows, slices
uniform float u_depths;
uniform float u_haze_g;
uniform vec3 u_source_enu[2];
uniform mat4 u_source_rgb[2];    // what becomes of the light of the table
uniform float u_source_count;
uniform vec3 u_night_cd_m2;      // of endless air

layout(binding = 0) uniform sampler2D u_colour;
layout(binding = 1) uniform sampler2D u_depth;
layout(binding = 2) uniform sampler2D u_extinction;
layout(binding = 3) uniform sampler3D u_rest_0;
layout(binding = 4) uniform sampler3D u_haze_0;
layout(binding = 5) uniform sampler3D u_rest_1;
layout(binding = 6) uniform sampler3D u_haze_1;

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

vec3 under_air(vec3 colour, vec3 view, float distance_m) {
    AerialPlace place = aerial_place(view.z, u_map);
    float inside_m = distance_m - place.near_m;
    if (!place.meets_air || !(inside_m > 0.0)) return colour;
    float far_m = aerial_far_m(place.sine, u_map);
    inside_m = min(inside_m, far_m);
    float slice = aerial_slice(inside_m, far_m);
    float row = centred(aerial_row(place.sine, u_map), u_table_size.y);
    vec3 passed = exp(-inside_m * texture(u_extinction, vec2(centred(slice, u_depths), row)).rgb);
    vec3 at = vec3(0.0, row, centred(slice, u_table_size.z));
    vec3 away = vec3(1.0) - passed;
    vec3 added = u_night_cd_m2 * away;
    if (u_source_count > 0.5)
        added += mat3(u_source_rgb[0]) * (away * light(u_rest_0, u_haze_0, u_source_enu[0], view, at));
    if (u_source_count > 1.5)
        added += mat3(u_source_rgb[1]) * (away * light(u_rest_1, u_haze_1, u_source_enu[1], view, at));
    return colour * passed + added;
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
    colour = under_air(colour, v_far_enu / far_m, max(depth, 0.0) * far_m);
    o_colour = vec4(dithered(shown(colour, u_tone), dot(gl_FragCoord.xy, kDitherStep)), 1.0);
}
