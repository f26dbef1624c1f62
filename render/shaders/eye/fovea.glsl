// What is small and looked at, the Moon's face above all, falls on the middle of the eye: it has no rods, and its cones
// adapt to what they get there, not to the night around. One text for GLSL and C++, after eye/tone.glsl; the numbers of a frame come from
// render/eye/fovea.h.

// How much light the fovea takes of something: a factor that never rises above 1, a power of the luminance that it is
// adapted to.
struct Fovea {
    real log2_factor; // at 1 cd/m2
    real slope;
};

SKYIG_INLINE real foveal_factor(Fovea fovea, real luminance) {
    return exp2(min(fovea.log2_factor + fovea.slope * log2(max(luminance, real(1e-9))), real(0.0)));
}

// What the fovea is adapted to at one place of what is looked at: as much to the whole of it as to that place, so that the
// dark part of the Moon is not lost beside its crescent.
SKYIG_INLINE real foveal_adaptation(real mean, real own) { return sqrt(max(mean * own, real(1e-12))); }

// Cone share of what is looked at: cones see colours down to 0.01 cd/m2 and end at 0.001, whatever the field around.
SKYIG_INLINE real foveal_share(real luminance) {
    real t = clamp(log2(max(luminance, real(1e-9))) * real(0.30102999566) + real(3.0), real(0.0), real(1.0));
    return t * t * (real(3.0) - real(2.0) * t);
}

// A light and the veil of glare over it, each as its own state of adaptation shows it. What is fainter than the veil adds
// to it; of a light and a veil that are both strong the stronger counts, as the fourth power mean has it, so that the veil
// ends where the light is the brighter. `share`: of the light in the sum of both, before any adaptation.
SKYIG_INLINE rvec3 beside_veil(rvec3 light, rvec3 veil, real share) {
    rvec3 veiled = veil * (real(1.0) + share);
    real a = luminance_709(light);
    real b = luminance_709(veiled);
    real sum = a + b;
    if (!(sum > real(0.0)) || !(min(a, b) > real(0.0))) return light + veiled;
    real x = a / sum * (a / sum);
    real y = b / sum * (b / sum);
    real fourth = x * x + y * y;
    // Each with its own colour, as much as it counts.
    return (light * (x * x / a) + veiled * (y * y / b)) * (sum * sqrt(sqrt(fourth)) / fourth);
}

// Display linear of a light before a sky, where the light is seen with another share of cones than the sky: what it adds
// is never less than nothing, in any colour.
SKYIG_INLINE rvec3 seen_before(rvec3 light, real photopic, rvec3 sky, ToneParameters tone) {
    if (photopic <= tone.photopic) return display_linear(sky + light, tone);
    ToneParameters seen = tone;
    seen.photopic = photopic;
    return max(display_linear(sky, tone) + display_linear(sky + light, seen) - display_linear(sky, seen), rvec3(real(0.0)));
}
