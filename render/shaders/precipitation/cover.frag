#version 450 core
// The light of another renderer's things where rain has soaked or snow covers them, before the air is put over it.
#include "common/scalar.glsl"
#include "common/fresnel.glsl"
#include "precipitation/things.glsl"

uniform vec3 u_white_cd_m2;      // of level ground that sends back all light
uniform vec3 u_snow_albedo;
uniform float u_snow;            // part of what is open that it covers
uniform float u_wet;

layout(binding = 1) uniform sampler2D u_colour;

layout(location = 0) out vec4 o_colour;

float soaked(float light, float white) {
    float dry = clamp(light / max(white, 1e-12), 1e-6, 1.0);
    return light * mix(1.0, wet_albedo(dry) / dry, u_wet);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(u_depth, pixel, 0).r;
    vec3 colour = texelFetch(u_colour, pixel, 0).rgb;
    o_colour = vec4(colour, 1.0);
    if (!(depth > 0.0 && depth < 1.0)) return;
    float up = facing_up(pixel, depth);
    float open = exposed(v_far_enu * depth);
    vec3 wet = vec3(soaked(colour.r, u_white_cd_m2.r), soaked(colour.g, u_white_cd_m2.g), soaked(colour.b, u_white_cd_m2.b));
    colour = mix(colour, wet, open * level_share(up));
    // It slides off steep roofs.
    float lies = clamp((up - 0.6) / 0.2, 0.0, 1.0);
    o_colour.rgb = mix(colour, u_snow_albedo * u_white_cd_m2, u_snow * open * lies);
}
