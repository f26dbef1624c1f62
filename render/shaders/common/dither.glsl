// Ordered noise of one display code, fixed to the pixel: the R2 low-discrepancy sequence (additive recurrence with
// the inverse powers of the plastic number).
uniform float u_dither_codes;

vec3 dithered(vec3 encoded) {
    float phase = fract(dot(gl_FragCoord.xy, vec2(0.7548776662466927, 0.5698402909980532)));
    return encoded + (phase - 0.5) * (u_dither_codes / 255.0);
}
