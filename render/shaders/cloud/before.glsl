// Clouds and things of another renderer among each other, by distance; and where the beam that reaches a thing would come
// to the ground. One text for GLSL and C++.

// Part of the depth of clouds that lies before a thing: they are thicker than a sheet, and their mean distance is told
// over some of them. 0 <= inverse_per_m, over their distance.
SKYIG_INLINE real clouds_before(real distance_m, real inverse_per_m) {
    real clouds_m = real(1.0) / max(inverse_per_m, real(1e-7));
    real half_m = real(40.0) + real(0.04) * clouds_m;
    real x = clamp((distance_m - clouds_m) / (real(2.0) * half_m) + real(0.5), real(0.0), real(1.0));
    return x * x * (real(3.0) - real(2.0) * x);
}

// Transmittance of the clouds before a thing out of that of all: near ones are taken as even over their range.
SKYIG_INLINE real passed_before(real passed, real near_passed, real distance_m, real near_range_m, real inverse_per_m) {
    real near = max(near_passed, real(1e-6));
    real far = clamp(passed / near, real(1e-6), real(1.0));
    real near_share = clamp(distance_m / near_range_m, real(0.0), real(1.0));
    return pow(near, near_share) * pow(far, clouds_before(distance_m, inverse_per_m));
}

// Of all clouds' light, what comes from those before the thing.
SKYIG_INLINE real light_before(real passed, real before) {
    return passed < real(0.9999) ? clamp((real(1.0) - before) / (real(1.0) - passed), real(0.0), real(1.0)) : real(0.0);
}

// Height of a place over the round ground, metres; `at_m` is east, north and up of the eye.
SKYIG_INLINE real height_over_ground(rvec3 at_m, real eye_height_m) {
    return eye_height_m + at_m.z + (at_m.x * at_m.x + at_m.y * at_m.y) * real(7.848061e-8);
}

// Where the line from a source through a place meets the ground, east and north of below the eye.
SKYIG_INLINE rvec2 shadow_place(rvec3 at_m, real height_m, rvec3 source) {
    real along = max(height_m, real(0.0)) / source.z;
    return rvec2(at_m.x - along * source.x, at_m.y - along * source.y);
}

// How much of the ground's shadow there is at a height: all below the clouds, none above.
SKYIG_INLINE real shadow_strength(real height_m, real low_m, real high_m) {
    return clamp((high_m - height_m) / max(high_m - low_m, real(1.0)), real(0.0), real(1.0));
}
