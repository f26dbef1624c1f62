// What water mirrors, and what a film of it does to the ground below. One text for GLSL and C++.

// Fresnel's reflectance of unpolarised light at a level mirror. `cosine`: of the angle of incidence, 0..1; `index`: of
// refraction.
SKYIG_INLINE real fresnel_reflectance(real cosine, real index) {
    real inside = sqrt(index * index - real(1.0) + cosine * cosine);
    real across = (cosine - inside) / (cosine + inside);
    real along = (index * index * cosine - inside) / (index * index * cosine + inside);
    return real(0.5) * (across * across + along * along);
}

// Of a film of water on ground, which is not level everywhere.
SKYIG_INLINE real film_slope_variance() { return real(0.01); }

// Mean of Fresnel's over slopes of that variance, for an eye whose ray rises by the sine `up`: within 3 % from 3 degrees up
// (9 % at half a degree); from 15 degrees up that of a level mirror.
SKYIG_INLINE real film_reflectance(real up) {
    real square = up * up;
    real lifted = square + film_slope_variance() * max(real(1.0) - real(16.0) * square, real(0.0));
    return fresnel_reflectance(min(sqrt(lifted), real(1.0)), real(1.333));
}

// Albedo of ground under such a film: what gets in is sent back and forth below its surface (Angstrom 1925, after Lekner and
// Dorf 1988), whose diffuse reflectance is 0.066 from above and 1 - 0.934 / 1.33^2 from below. What the film mirrors is
// not in it.
SKYIG_INLINE real wet_albedo(real dry) {
    real enters = real(1.0) - real(0.066);
    real held = real(1.0) - enters / real(1.33 * 1.33);
    return enters * (real(1.0) - held) * dry / (real(1.0) - held * dry);
}
