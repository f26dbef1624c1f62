#version 450 core
// Waves that a pixel resolves; where the longest ends to be one, the dome's own colour.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/dither.glsl"
#include "sky/sea.glsl"

const int kTrains = 4;

uniform ToneParameters u_tone;
uniform float u_height_m;
uniform float u_curvature_m2;
uniform float u_pixel_rad;
uniform vec3 u_source_enu;
uniform vec3 u_variance;
uniform vec3 u_wave_phase[kTrains];  // WaveTrain: number, phase
uniform vec3 u_wave_shape[kTrains];  // rise, skew

in vec3 v_encoded;
in vec3 v_ray;
in vec3 v_smooth;
in vec3 v_east;
in vec3 v_north;
in vec3 v_bend;
in vec3 v_glitter;
in float v_dither_phase_w;
layout(location = 0) out vec4 o_colour;

WaveTrain train_at(int i) {
    return WaveTrain(u_wave_phase[i].xy, u_wave_phase[i].z, u_wave_shape[i].xy, u_wave_shape[i].z);
}

void main() {
    vec2 at_m = sea_point_m(v_ray, u_height_m, u_curvature_m2);
    float footprint = footprint_m(at_m, u_height_m, u_pixel_rad);
    ResolvedSlope waves = ResolvedSlope(vec2(0.0), vec3(0.0));
    // To be unrolled: a loop of unknown length costs software GL as much as all the rest.
    for (int i = 0; i < kTrains; ++i)
        waves = with_train(waves, train_at(i), at_m, footprint);
    vec2 mirroring = mirroring_slope(normalize(vec3(-at_m, u_height_m)), u_source_enu);
    WaveLight light = WaveLight(v_smooth, v_east, v_north, v_bend, v_glitter);
    vec3 lit = shown(wave_lit(light, waves, mirroring, u_variance), u_tone);
    float share = shaded_share(u_wave_phase[0].xy, footprint);
    o_colour = vec4(dithered(mix(v_encoded, lit, share), v_dither_phase_w * gl_FragCoord.w), 1.0);
}
