// Another renderer's things as what falls finds them: how level they are, by their depths, and whether anything stands
// over them. For fragment shaders behind sky/deferred.vert.
uniform vec3 u_far_right;        // as in sky/deferred.vert
uniform vec3 u_far_up;
uniform vec2 u_size_px;
uniform mat4 u_exposure_from_enu_m;  // 0..1 in the map from above
uniform float u_exposure_px;         // on its side; 0: there is none
uniform float u_exposure_bias;       // of its depths

layout(binding = 0) uniform sampler2D u_depth;
layout(binding = 3) uniform sampler2D u_exposure;

in vec3 v_far_enu;

float depth_at(ivec2 pixel) { return texelFetch(u_depth, clamp(pixel, ivec2(0), ivec2(u_size_px) - 1), 0).r; }

// From a thing to its neighbour of two that lies less far before or behind it: edges have no part in it.
vec3 beside(ivec2 pixel, ivec2 step_px, vec3 far_step, vec3 place, float depth) {
    float ahead = depth_at(pixel + step_px);
    float behind = depth_at(pixel - step_px);
    bool take_ahead = abs(ahead - depth) <= abs(behind - depth);
    vec3 other = take_ahead ? (v_far_enu + far_step) * ahead : (v_far_enu - far_step) * behind;
    return take_ahead ? other - place : place - other;
}

// Sine of the slope's normal: 1 level, 0 upright. Things seen from below do not face up.
float facing_up(ivec2 pixel, float depth) {
    vec3 place = v_far_enu * depth;
    vec3 normal = cross(beside(pixel, ivec2(1, 0), u_far_right * (2.0 / u_size_px.x), place, depth),
                        beside(pixel, ivec2(0, 1), u_far_up * (2.0 / u_size_px.y), place, depth));
    normal *= inversesqrt(max(dot(normal, normal), 1e-30));
    return dot(normal, place) < 0.0 ? normal.z : -normal.z;
}

float level_share(float up) { return clamp((up - 0.85) / 0.1, 0.0, 1.0); }

float open_at(ivec2 texel, float depth) {
    ivec2 last = ivec2(int(u_exposure_px) - 1);
    return texelFetch(u_exposure, clamp(texel, ivec2(0), last), 0).r < depth - u_exposure_bias ? 0.0 : 1.0;
}

// Whether what falls comes here, 0..1, softened over a texel. Outside the map everything lies open.
float exposed(vec3 place_m) {
    if (u_exposure_px < 0.5) return 1.0;
    vec3 at = (u_exposure_from_enu_m * vec4(place_m, 1.0)).xyz;
    vec2 texel = at.xy * u_exposure_px - 0.5;
    ivec2 low = ivec2(floor(texel));
    vec2 part = texel - floor(texel);
    float south = mix(open_at(low, at.z), open_at(low + ivec2(1, 0), at.z), part.x);
    float north = mix(open_at(low + ivec2(0, 1), at.z), open_at(low + ivec2(1, 1), at.z), part.x);
    vec2 off = abs(at.xy - 0.5);
    float inside = clamp((0.5 - max(off.x, off.y)) * 20.0, 0.0, 1.0);
    return mix(1.0, mix(south, north, part.y), at.z < 1.0 ? inside : 0.0);
}
