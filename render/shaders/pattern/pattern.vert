#version 450 core
// A grid over the picture. Its vertices carry the directions that they lie in, so that a pattern goes the way of all
// that is drawn.
#include "common/place.glsl"

layout(location = 0) in vec2 a_place;    // across and up the picture, 0..1

uniform vec4 u_plane;                    // image plane at distance 1: left, bottom, width, height
uniform mat3 u_enu_from_view;
uniform mat4 u_clip_from_enu;

out vec3 v_direction;

void main() {
    v_direction = u_enu_from_view * vec3(u_plane.xy + a_place * u_plane.zw, -1.0);
    gl_Position = placed(u_clip_from_enu * vec4(v_direction, 0.0));
}
