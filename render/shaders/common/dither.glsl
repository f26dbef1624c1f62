// Ordered noise of one display code, fixed to the pixel: the R2 low-discrepancy sequence (additive recurrence with
// the inverse powers of the plastic number).
uniform float u_dither_codes;

const vec2 kDitherStep = vec2(0.7548776662466927, 0.5698402909980532);

// `phase` is dot(pixel position, kDitherStep).
vec3 dithered(vec3 encoded, float phase) {
    return encoded + (fract(phase) - 0.5) * (u_dither_codes / 255.0);
}
