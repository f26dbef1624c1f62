#version 450 core
// Waves that a pixel resolves; where the longest ends to be one, the dome's own colour.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/dither.glsl"
#include "sky/sea.glsl"

const int kMaxWaves = 16;

uniform ToneParameters u_tone;
uniform float u_height_m;
uniform float u_curvature_m2;
uniform float u_pixel_rad;
uniform vec3 u_source_enu;
uniform vec3 u_variance;
uniform float u_wave_count;
uniform vec3 u_wave_phase[kMaxWaves];  // WaveTrain: number, phase
uniform vec2 u_wave_shape[kMaxWaves];  // slope, skew

in vec3 v_encoded;
in vec3 v_ray;
in vec3 v_smooth;
in vec3 v_east;
in vec3 v_north;
in vec3 v_bend;
in vec3 v_glitter;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

void main() {
    vec2 at_m = sea_point_m(v_ray, u_height_m, u_curvature_m2);
    float footprint = footprint_m(at_m, u_height_m, u_pixel_rad);
    ResolvedSlope waves = ResolvedSlope(vec2(0.0), vec3(0.0));
    for (int i = 0; i < int(u_wave_count); ++i) {
        WaveTrain train =
            WaveTrain(u_wave_phase[i].xy, u_wave_phase[i].z, u_wave_shape[i].x, u_wave_shape[i].y);
        waves = with_train(waves, train, at_m, footprint);
    }
    vec2 mirroring = mirroring_slope(normalize(vec3(-at_m, u_height_m)), u_source_enu);
    WaveLight light = WaveLight(v_smooth, v_east, v_north, v_bend, v_glitter);
    vec3 lit = shown(wave_lit(light, waves, mirroring, u_variance), u_tone);
    float share = shaded_share(length(u_wave_phase[0].xy) * footprint);
    o_colour = vec4(dithered(mix(v_encoded, lit, share), v_dither_phase_w * gl_FragCoord.w), 1.0);
}
