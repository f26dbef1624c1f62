#version 450 core
// A streak before or behind the things of another renderer.
#include "precipitation/streak.glsl"

layout(binding = 0) uniform sampler2D u_depth;   // along the view axis, over the far plane's distance
uniform float u_far_m;

layout(location = 0) out vec4 o_colour;

void main() {
    float depth = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).r;
    // What is not a number is no thing.
    bool hidden = depth < 1.0 && max(depth, 0.0) * u_far_m * v_ray.z < 1.0;
    o_colour = vec4(v_colour, hidden ? 0.0 : streak_coverage());
}
