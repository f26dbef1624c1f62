// What of a pixel a streak covers, the same for a direction in every channel; after precipitation/streak.vert.

uniform float u_pixel_rad;

in vec4 v_lines;
in vec3 v_ray;
flat in float v_opacity;
flat in vec3 v_colour;

float streak_coverage() {
    vec4 lines = v_lines * inversesqrt(1.0 + dot(v_ray.xy, v_ray.xy));
    float beyond = max(max(lines.y, lines.z), 0.0);
    float apart = sqrt(lines.x * lines.x + beyond * beyond);
    // A box as wide as the rod, spread over a box as wide as a pixel.
    float width = 2.0 * max(lines.w, 0.0);
    return v_opacity * clamp((0.5 * (width + u_pixel_rad) - apart) / u_pixel_rad, 0.0, min(width / u_pixel_rad, 1.0));
}
