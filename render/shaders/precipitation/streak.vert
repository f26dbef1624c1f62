#version 450 core
// A straight rod in space, round in cross section, seen from the origin: what a drop makes of an exposure. All that the
// fragments need is linear in the view ray before it is brought to length 1, so that a direction has the same answer in
// every channel: the pixel that softens edges is the finest of the rig.
#include "common/scalar.glsl"
#include "common/place.glsl"
#include "eye/tone.glsl"

layout(location = 0) in vec3 a_head_enu_m;
layout(location = 1) in vec3 a_tail_enu_m;
layout(location = 2) in vec2 a_shape;          // half width in metres, opacity

uniform ToneParameters u_tone;
uniform mat3 u_view_from_enu;
uniform vec2 u_plane_origin;     // image plane at distance 1: where window coordinate 0 lies,
uniform vec2 u_plane_size;       // and how large the picture is
uniform float u_pixel_rad;
uniform vec3 u_mean_cd_m2;       // light that it shows: mean + gradient * direction
uniform mat3 u_gradient_cd_m2;

out vec4 v_lines;                // sines of angles, times the ray's length: off the rod's plane, before the head, beyond the
                                 // tail; and half of the angle that its width has there
out vec3 v_ray;                  // x, y on the image plane; distance along the view axis of the plane through the rod, inverse
flat out float v_opacity;
flat out vec3 v_colour;          // as it is shown

const float kNear = 0.05;

vec3 any_across(vec3 a) {
    return normalize(abs(a.z) < 0.7 ? cross(a, vec3(0.0, 0.0, 1.0)) : cross(a, vec3(1.0, 0.0, 0.0)));
}

// The part of the rod that lies before the eye.
vec3 clipped(vec3 end, vec3 other) {
    float ahead = -end.z;
    if (ahead >= kNear) return end;
    return mix(other, end, clamp((-other.z - kNear) / max(-other.z - ahead, 1e-6), 0.0, 1.0));
}

void main() {
    vec3 head = u_view_from_enu * a_head_enu_m;
    vec3 tail = u_view_from_enu * a_tail_enu_m;
    float half_width = a_shape.x;
    float head_m = max(length(head), 1e-3);
    float tail_m = max(length(tail), 1e-3);
    vec3 a = head / head_m;
    vec3 b = tail / tail_m;
    vec3 turned = cross(a, b);
    float sine = length(turned);
    bool dot_like = sine < 1e-5;
    vec3 across = dot_like ? any_across(a) : turned / sine;
    vec3 from_head = cross(across, a);
    vec3 from_tail = cross(across, b);
    // One on every point of the rod: over the length of a ray it is the inverse distance of the rod there.
    vec3 nearness = a / head_m;
    if (!dot_like) nearness += from_head * ((1.0 / tail_m - dot(a, b) / head_m) / sine);

    // A corner of what its image can cover.
    bool at_head = gl_VertexID % 4 < 2;
    float side = gl_VertexID % 2 == 0 ? -1.0 : 1.0;
    vec3 near_head = clipped(head, tail);
    vec3 near_tail = clipped(tail, head);
    vec2 plane_head = near_head.xy / max(-near_head.z, kNear);
    vec2 plane_tail = near_tail.xy / max(-near_tail.z, kNear);
    vec2 along = plane_head - plane_tail;
    float along_length = length(along);
    along = along_length > 1e-7 ? along / along_length : vec2(1.0, 0.0);
    vec2 end = at_head ? plane_head : plane_tail;
    float end_m = length(at_head ? near_head : near_tail);
    float margin = (half_width / max(end_m, 1e-3) + 0.5 * u_pixel_rad) * (1.0 + dot(end, end)) * 1.1;
    vec2 plane = end + margin * ((at_head ? along : -along) + side * vec2(-along.y, along.x));
    gl_Position = placed(vec4(2.0 * (plane - u_plane_origin) / u_plane_size - 1.0, 0.0, 1.0));

    vec3 ray = vec3(plane, -1.0);
    v_lines = vec4(dot(ray, across), -dot(ray, from_head), dot(ray, from_tail), half_width * dot(ray, nearness));
    v_ray = vec3(plane, dot(ray, nearness));

    // A rod that is thinner than a pixel has its round ends drawn too large.
    vec3 middle = 0.5 * (head + tail);
    float width_rad = 2.0 * half_width / max(length(middle), 1e-3);
    float length_rad = atan(sine, dot(a, b));
    float whole = length_rad + 0.7854 * width_rad;
    v_opacity = a_shape.y * whole / (length_rad + 0.7854 * max(width_rad, u_pixel_rad));
    vec3 direction = normalize(0.5 * (a_head_enu_m + a_tail_enu_m));
    v_colour = shown(max(u_mean_cd_m2 + u_gradient_cd_m2 * direction, vec3(0.0)), u_tone);
}
