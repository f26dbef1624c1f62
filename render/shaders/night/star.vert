#version 450 core
// One star as a small footprint: a Gaussian in angle, so that what it adds to a direction is the same in every channel
// that sees that direction.
layout(location = 0) in vec3 a_direction_enu;
layout(location = 1) in vec3 a_illuminance_lux;    // linear Rec.709 behind the air
layout(location = 2) in vec3 a_background;         // display linear, of the sky behind the star

uniform mat4 u_clip_from_enu;
uniform mat4 u_view_from_enu;
uniform float u_point_gain;      // display linear per cd/m2

flat out vec3 v_direction;
flat out vec3 v_star;
flat out vec3 v_background;

// On the axis the footprint reaches 3.5 px from the star; off the axis the same angle spans more pixels.
const float kFootprintPx = 7.0;

void main() {
    gl_Position = u_clip_from_enu * vec4(a_direction_enu, 0.0);
    v_direction = (u_view_from_enu * vec4(a_direction_enu, 0.0)).xyz;
    v_star = a_illuminance_lux * u_point_gain;
    v_background = a_background;
    float cos_axis = max(gl_Position.w, 0.05);
    gl_PointSize = min(kFootprintPx / (cos_axis * cos_axis), 96.0);
}
