// Edges of a disc and of the horizon in front of it, softened over one pixel's angle.
uniform float u_radius;          // tangent of the angular radius
uniform float u_pixel_rad;
uniform float u_horizon_sin;
uniform float u_horizon_cos;

uniform vec3 u_background_cd_m2; // of the sky at the disc's centre,
uniform vec3 u_background_right; // and what it gains over one radius
uniform vec3 u_background_up;

in vec2 v_seen;                  // from the centre of what is seen,
in vec2 v_offset;                // and without refraction
in float v_stretch;              // d(v_offset.y) / d(v_seen.y)
in float v_height;
in vec3 v_light;                 // of this height of the disc, behind the air

float above_horizon() {
    float elevation_sin = v_height * inversesqrt(1.0 + dot(v_seen, v_seen));
    float above = (elevation_sin - u_horizon_sin) / (max(u_horizon_cos, 1e-3) * u_pixel_rad);
    return clamp(above + 0.5, 0.0, 1.0);
}

float disc_coverage() {
    float from_centre = length(v_offset);
    vec2 outwards = v_offset / max(from_centre, 1e-9);
    float steepness = length(vec2(outwards.x, outwards.y * v_stretch));
    float disc = clamp((u_radius - from_centre) / (max(steepness, 1e-3) * u_pixel_rad) + 0.5, 0.0, 1.0);
    return disc * above_horizon();
}

vec3 sky_behind() {
    vec2 at = v_seen / u_radius;
    return max(u_background_cd_m2 + u_background_right * at.x + u_background_up * at.y, vec3(0.0));
}
