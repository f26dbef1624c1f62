// CIE S 011 / ISO 15469:2004, standard general sky: luminance relative to the zenith. Angles in radians.

struct CieSky {
    real a;  // gradation
    real b;
    real c;  // indicatrix
    real d;
    real e;
};

// 1 on the horizon, which what lies below it continues: exp(b / sine) has long ended at the least sine.
SKYIG_INLINE real cie_gradation(real sine, CieSky sky) {
    return real(1.0) + sky.a * exp(sky.b / max(sine, real(0.01)));
}

// 1 at a right angle to the Sun.
SKYIG_INLINE real cie_indicatrix(real sun_angle, CieSky sky) {
    real cosine = cos(sun_angle);
    return real(1.0) + sky.c * (exp(sky.d * sun_angle) - exp(sky.d * real(1.5707963267948966))) +
           sky.e * cosine * cosine;
}

// view_sine: of the elevation; sun_angle: between view and Sun; sun_zenith: of the Sun, beyond a right angle below the
// horizon.
SKYIG_INLINE real cie_relative(real view_sine, real sun_angle, real sun_zenith, CieSky sky) {
    return cie_indicatrix(sun_angle, sky) * cie_gradation(view_sine, sky) /
           (cie_indicatrix(sun_zenith, sky) * cie_gradation(real(1.0), sky));
}

// Type 16, Moon and Spencer's overcast sky.
SKYIG_INLINE real cie_overcast(real view_sine) {
    return (real(1.0) + real(2.0) * max(view_sine, real(0.0))) / real(3.0);
}
