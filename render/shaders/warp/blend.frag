#version 450 core
// What a projector puts out where others shine too: in linear light, times the mask, raised to the lift. It reads the
// texel that it writes, and no other.
#include "common/scalar.glsl"
#include "common/dither.glsl"
#include "eye/tone.glsl"

layout(binding = 0) uniform sampler2D u_picture;
layout(binding = 1) uniform sampler2D u_weight;
layout(binding = 2) uniform sampler2D u_lift;   // parts of full white; one texel stands for all
uniform float u_encode_power;

layout(location = 0) out vec4 o_colour;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float weight = texelFetch(u_weight, at, 0).r;
    float lift = texelFetch(u_lift, min(at, textureSize(u_lift, 0) - 1), 0).r;
    vec3 light = emitted(texelFetch(u_picture, at, 0).rgb, u_encode_power);
    vec3 sent = light * (weight * (1.0 - lift)) + lift;
    // Another sequence than the picture's own, so that the two roundings are not of one mind.
    o_colour = vec4(dithered(code_of(sent, u_encode_power), dot(gl_FragCoord.yx, kDitherStep)), 1.0);
}
