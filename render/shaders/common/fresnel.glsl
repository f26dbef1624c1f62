// What water mirrors. One text for GLSL and C++.

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
