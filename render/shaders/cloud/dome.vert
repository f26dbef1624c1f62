#version 450 core
// The dome as sky/dome.vert has it, one octant of directions at a time: in it a direction's place on the cloud map is a
// quotient of two sums that are linear over a triangle. What lies in other octants is clipped.
#include "common/dither.glsl"
#include "common/place.glsl"

layout(location = 0) in vec3 a_direction;
layout(location = 1) in vec3 a_from;
layout(location = 2) in vec3 a_to;

uniform mat4 u_clip_from_mesh;
uniform mat4 u_enu_from_mesh;
uniform float u_share;
uniform vec2 u_half_size_px;
uniform vec4 u_cloud_place;      // as cloud/fetch.glsl has it, the octant's square told by the last one
uniform vec3 u_octant;           // signs of the components of its directions

out vec3 v_encoded;
out vec3 v_place;                // homogeneous, of the texture
out float v_dither_phase_w;

// Neighbouring octants overlap by this, less than a hundredth of a texel, so that no pixel between them is left out.
const float kOverlap = 2e-5;

void main() {
    v_encoded = mix(a_from, a_to, u_share);
    vec3 direction = (u_enu_from_mesh * vec4(a_direction, 1.0)).xyz;
    vec3 sizes = direction * u_octant;
    float size = sizes.x + sizes.y + sizes.z;
    vec2 place = vec2(direction.x + direction.y, direction.x - direction.y);
    v_place = vec3(place * u_cloud_place.xz + size * u_cloud_place.yw, size);
    gl_ClipDistance[0] = sizes.x + kOverlap;
    gl_ClipDistance[1] = sizes.y + kOverlap;
    gl_ClipDistance[2] = sizes.z + kOverlap;
    gl_Position = placed(u_clip_from_mesh * vec4(a_direction, 1.0));
    v_dither_phase_w = dot((gl_Position.xy + gl_Position.w) * u_half_size_px, kDitherStep);
}
