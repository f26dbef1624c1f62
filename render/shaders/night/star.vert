#version 450 core
// One star as a small footprint, a round Gaussian of pixels: the same at any field of view and resolution, on the axis
// and in the corners. What it adds to a pixel is its illuminance times the footprint's weight there over the pixel's
// own solid angle, so that the sum over the pixels of luminance times solid angle is its illuminance.
#include "common/scalar.glsl"
#include "common/place.glsl"
#include "eye/tone.glsl"
#include "cloud/fetch.glsl"

layout(location = 0) in vec3 a_direction_enu;
layout(location = 1) in vec3 a_illuminance_lux;    // linear Rec.709 behind the air
layout(location = 2) in vec3 a_background_cd_m2;   // of the sky behind the star

uniform ToneParameters u_tone;
uniform mat4 u_view_from_enu;
uniform mat4 u_enu_from_update;  // what has turned all stars since their directions were written
uniform float u_clouds_shown;    // 0 or 1
uniform vec2 u_size_px;
uniform vec2 u_plane_origin;     // image plane at distance 1: where window coordinate 0 lies,
uniform vec2 u_plane_step;       // and the size of a pixel
uniform float u_peak_gain;       // display linear per lux of a star in the middle of a pixel on the axis

flat out vec2 v_place_px;
flat out vec3 v_peak;
flat out vec3 v_background;      // display linear,
flat out vec3 v_background_code; // and as it is shown

// Its weights sum to 1 within 4e-4 wherever it stands on the pixel grid, sigma 0.7 px.
const float kFootprintPx = 6.0;

void main() {
    vec3 view = (u_view_from_enu * vec4(a_direction_enu, 0.0)).xyz;
    float ahead = max(-view.z, 1e-6);
    vec2 plane = view.xy / ahead;
    v_place_px = (plane - u_plane_origin) / u_plane_step;
    vec3 moved = moved_at(2.0 * v_place_px / u_size_px - 1.0);
    v_place_px += 0.5 * moved.xy * u_size_px;
    // A point is drawn only if its middle lies in the picture: one that stands outside by less than half a footprint is
    // drawn from the edge, which moves no light (see star.frag).
    vec2 middle_px = clamp(v_place_px, vec2(0.0), u_size_px);
    vec2 outside_px = abs(v_place_px - middle_px);
    bool shows = -view.z > 1e-6 && max(outside_px.x, outside_px.y) < 0.5 * kFootprintPx;
    gl_Position = shows ? vec4(2.0 * middle_px / u_size_px - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
    gl_PointSize = kFootprintPx;

    // A pixel's solid angle falls with (1 + x^2 + y^2)^-1.5 of its place on the image plane, and as the warp has it.
    float stretch = 1.0 + dot(plane, plane);
    v_peak = a_illuminance_lux * (u_peak_gain * stretch * sqrt(stretch) / moved.z);
    v_background = display_linear(a_background_cd_m2, u_tone);
    v_background_code = encoded(v_background, u_tone);
    if (u_clouds_shown > 0.5) {
        vec4 clouds = clouds_at((u_enu_from_update * vec4(a_direction_enu, 0.0)).xyz);
        v_peak *= clouds.a;
        v_background = displayed(v_background_code * clouds.a + clouds.rgb, u_tone);
        v_background_code = encoded(v_background, u_tone);
    }
}
