// Edges of a disc and of the horizon in front of it, softened over one pixel's angle.
uniform float u_radius;          // tangent of the angular radius
uniform float u_pixel_rad;
uniform float u_horizon_sin;
uniform float u_horizon_cos;

uniform vec3 u_background_cd_m2; // of the sky at the disc's centre,
uniform vec3 u_background_right; // and what it gains over one radius
uniform vec3 u_background_up;

in vec2 v_offset;
in float v_height;

float disc_coverage() {
    float disc = clamp((u_radius - length(v_offset)) / u_pixel_rad + 0.5, 0.0, 1.0);
    float elevation_sin = v_height * inversesqrt(1.0 + dot(v_offset, v_offset));
    float above = (elevation_sin - u_horizon_sin) / (max(u_horizon_cos, 1e-3) * u_pixel_rad);
    return disc * clamp(above + 0.5, 0.0, 1.0);
}

vec3 sky_behind() {
    vec2 at = v_offset / u_radius;
    return max(u_background_cd_m2 + u_background_right * at.x + u_background_up * at.y, vec3(0.0));
}
