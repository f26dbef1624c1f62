// Preetham, Shirley and Smits, "A practical analytic model for daylight", 1999, appendix A.2. Angles in radians.
// T, the turbidity, 2..10; Sun above the horizon.

struct PerezSky {
    real a;
    real b;
    real c;
    real d;
    real e;
};

SKYIG_INLINE PerezSky preetham_luminance(real t) {
    PerezSky k;
    k.a = real(0.1787) * t - real(1.4630);
    k.b = real(-0.3554) * t + real(0.4275);
    k.c = real(-0.0227) * t + real(5.3251);
    k.d = real(0.1206) * t - real(2.5771);
    k.e = real(-0.0670) * t + real(0.3703);
    return k;
}

SKYIG_INLINE PerezSky preetham_x(real t) {
    PerezSky k;
    k.a = real(-0.0193) * t - real(0.2592);
    k.b = real(-0.0665) * t + real(0.0008);
    k.c = real(-0.0004) * t + real(0.2125);
    k.d = real(-0.0641) * t - real(0.8989);
    k.e = real(-0.0033) * t + real(0.0452);
    return k;
}

SKYIG_INLINE PerezSky preetham_y(real t) {
    PerezSky k;
    k.a = real(-0.0167) * t - real(0.2608);
    k.b = real(-0.0950) * t + real(0.0092);
    k.c = real(-0.0079) * t + real(0.2102);
    k.d = real(-0.0441) * t - real(1.6537);
    k.e = real(-0.0109) * t + real(0.0529);
    return k;
}

// What lies below the horizon continues it.
SKYIG_INLINE real perez(real view_sine, real sun_angle, PerezSky k) {
    real cosine = cos(sun_angle);
    return (real(1.0) + k.a * exp(k.b / max(view_sine, real(0.01)))) *
           (real(1.0) + k.c * exp(k.d * sun_angle) + k.e * cosine * cosine);
}

// Relative to the zenith.
SKYIG_INLINE real perez_relative(real view_sine, real sun_angle, real sun_zenith, PerezSky k) {
    return perez(view_sine, sun_angle, k) / perez(real(1.0), sun_zenith, k);
}

// cd/m2
SKYIG_INLINE real preetham_zenith_luminance(real t, real sun_zenith) {
    real chi = (real(4.0) / real(9.0) - t / real(120.0)) * (real(3.14159265358979324) - real(2.0) * sun_zenith);
    return real(1000.0) * ((real(4.0453) * t - real(4.9710)) * tan(chi) - real(0.2155) * t + real(2.4192));
}

SKYIG_INLINE real preetham_zenith_x(real t, real s) {
    return t * t * (((real(0.00166) * s - real(0.00375)) * s + real(0.00209)) * s) +
           t * (((real(-0.02903) * s + real(0.06377)) * s - real(0.03202)) * s + real(0.00394)) +
           (((real(0.11693) * s - real(0.21196)) * s + real(0.06052)) * s + real(0.25886));
}

SKYIG_INLINE real preetham_zenith_y(real t, real s) {
    return t * t * (((real(0.00275) * s - real(0.00610)) * s + real(0.00317)) * s) +
           t * (((real(-0.04214) * s + real(0.08970)) * s - real(0.04153)) * s + real(0.00516)) +
           (((real(0.15346) * s - real(0.26756)) * s + real(0.06670)) * s + real(0.26688));
}
