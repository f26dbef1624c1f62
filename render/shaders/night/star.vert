#version 450 core
// One star as a small footprint of pixels: its light is spread over them, whatever the field of view.
layout(location = 0) in vec3 a_direction_enu;
layout(location = 1) in vec3 a_illuminance_lux;    // linear Rec.709 behind the air
layout(location = 2) in vec3 a_background;         // display linear, of the sky behind the star

uniform mat4 u_clip_from_enu;
uniform vec2 u_viewport_px;
uniform float u_guard_px;
uniform float u_pixel_area;      // area of a pixel on the image plane at distance 1
uniform float u_point_gain;      // display linear per cd/m2

flat out vec2 v_centre_px;
flat out vec3 v_star;
flat out vec3 v_background;

const float kFootprintPx = 7.0;

void main() {
    gl_Position = u_clip_from_enu * vec4(a_direction_enu, 0.0);
    // Solid angle of the pixel on which the star falls: area * cos^3 of the angle off the axis.
    float cos_axis = max(gl_Position.w, 0.0);
    float solid_angle = u_pixel_area * cos_axis * cos_axis * cos_axis;
    v_star = a_illuminance_lux * (u_point_gain / max(solid_angle, 1e-20));
    v_background = a_background;
    vec2 ndc = gl_Position.xy / max(gl_Position.w, 1e-6);
    v_centre_px = (ndc * 0.5 + 0.5) * u_viewport_px - u_guard_px;
    gl_PointSize = kFootprintPx;
}
