// Optical depth of patches of fog along a ray. They are columns: a patch's density is that of its place on the ground times
// that of the height, which rises over a band to 1, stays and falls over another. So the depth of a piece of ray in one band
// is made of sums along the ground in its direction, of the places' density. Rays go straight within a band: the Earth's bend
// over what is seen among patches is far below a band.

// Heights over the eye at which the density begins, is full, begins to fall and ends.
struct PatchHeights {
    real begin_m;
    real base_m;
    real top_m;
    real end_m;
};

struct PatchBand {
    real low_m;
    real high_m;
    rvec2 density;  // at its lower and upper end
};

SKYIG_INLINE PatchBand patch_band(int band, PatchHeights heights) {
    PatchBand at;
    at.low_m = band == 0 ? heights.begin_m : (band == 1 ? heights.base_m : heights.top_m);
    at.high_m = band == 0 ? heights.base_m : (band == 1 ? heights.top_m : heights.end_m);
    at.density = rvec2(band == 0 ? real(0.0) : real(1.0), band == 2 ? real(0.0) : real(1.0));
    return at;
}

// Where a ray from the eye is in a band, before the ground ends it: from .x to .y, empty if .y <= .x.
SKYIG_INLINE rvec2 patch_piece_m(PatchBand band, VeilRay ray) {
    rvec2 below_high = veil_below_m(band.high_m, ray);
    rvec2 below_low = veil_below_m(band.low_m, ray);
    rvec2 piece;
    if (ray.sine < real(0.0)) {
        piece = rvec2(below_high.x, below_low.y > below_low.x ? below_low.x : below_high.y);
    } else {
        piece = rvec2(below_low.y, below_high.y);
    }
    return rvec2(max(piece.x, real(0.0)), piece.y);
}

SKYIG_INLINE real patch_density(real along_m, PatchBand band, VeilRay ray) {
    real share = (veil_rise_m(along_m, ray) - band.low_m) / max(band.high_m - band.low_m, real(1e-3));
    return band.density.x + (band.density.y - band.density.x) * clamp(share, real(0.0), real(1.0));
}

// As many parts of a piece are asked for: one where the height changes nothing.
SKYIG_INLINE int patch_parts(PatchBand band) { return band.density.x == band.density.y ? 1 : 4; }

// Rings round the eye at which the sums are told: even at first, then each further than the last by a part.
SKYIG_INLINE real patch_ring(real ground_m) {
    return ground_m < real(640.0) ? ground_m / real(12.8) : real(50.0) * (real(1.0) + log(ground_m / real(640.0)));
}
SKYIG_INLINE real patch_ring_m(real ring) {
    return ring < real(50.0) ? ring * real(12.8) : real(640.0) * exp(ring / real(50.0) - real(1.0));
}

// Of a place where all clouds together leave `passed` what the others leave, besides the patches. The map that tells it is
// coarser than the patches: what it is off by is no cloud. And next to nothing is known of what stands behind fog that hides it.
SKYIG_INLINE real patch_others(real passed, real patches_passed) {
    return patches_passed > real(2e-3) ? clamp(passed / (real(0.7) * patches_passed), real(0.0), real(1.0)) : real(1.0);
}
