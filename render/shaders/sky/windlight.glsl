// Attenuation and additive scatter towards a convergence colour, sunlight taken at the dominant point of the path
// (US patent 7,710,418). Colours are linear and unitless; angles in radians, lengths in metres.

struct Windlight {
    rvec3 blue_density;
    real haze_density;
    real per_m;      // density multiplier
    real ceiling_m;  // maximum altitude
    rvec3 blue_horizon;
    real haze_horizon;
    rvec3 sunlight;
    rvec3 ambient;
    real glow_size;
    real glow_floor;
    real glow_power;
    real horizon_drop;
};

// An object at the end of the path shows as colour * passed + added; the sky is `added` alone.
struct WindlightAir {
    rvec3 passed;
    rvec3 added;
};

// Sine of the elevation that a unit view ray has once its vertical component is lowered.
SKYIG_INLINE real windlight_lowered(real view_sine, Windlight w) {
    real up = view_sine - w.horizon_drop;
    return up / sqrt(max(real(1.0) - view_sine * view_sine + up * up, real(1e-12)));
}

// From the eye to the dome: level at the ceiling above, deep down below the horizon, and never further than a hundred
// ceilings, which is about where a layer on a round Earth ends.
SKYIG_INLINE real windlight_length(real sine, Windlight w) {
    if (sine >= real(0.0)) return w.ceiling_m / max(sine, real(0.01));
    return real(32000.0) / max(-sine, real(320.0) / w.ceiling_m);
}

// The path through the haze that sunlight has behind it; the quotient's divisor is rounded off near 0, where it would
// cut the light off at a hard edge.
SKYIG_INLINE rvec3 windlight_sunlight(real sine, real sun_sine, Windlight w) {
    real slope = max(sine, real(0.0)) + sun_sine;
    slope = real(0.5) * (slope + sqrt(slope * slope + real(3.6e-3)));
    rvec3 depth = (w.blue_density + rvec3(real(0.25) * w.haze_density)) * (w.per_m * w.ceiling_m);
    return w.sunlight * exp(-depth / slope);
}

SKYIG_INLINE real windlight_glow(real sun_angle, Windlight w) {
    real half_sine = sin(real(0.5) * sun_angle);
    real away = max(real(2.0) * half_sine * half_sine, max(w.glow_floor, real(1e-3)));
    return pow(away * w.glow_size, w.glow_power) + real(0.25);
}

// What endless haze looks like.
SKYIG_INLINE rvec3 windlight_convergence(real sine, real sun_sine, real sun_angle, Windlight w) {
    rvec3 density = max(w.blue_density + rvec3(w.haze_density), rvec3(real(1e-9)));
    rvec3 sunlight = windlight_sunlight(sine, sun_sine, w);
    return w.blue_horizon * w.blue_density / density * (sunlight + w.ambient) +
           w.haze_horizon * w.haze_density / density * (sunlight * windlight_glow(sun_angle, w) + w.ambient);
}

// Near-object form: the path ends at the object or at the dome.
SKYIG_INLINE WindlightAir windlight_air(real view_sine, real sun_sine, real sun_angle, real distance_m, Windlight w) {
    real sine = windlight_lowered(view_sine, w);
    real length_m = min(distance_m, windlight_length(sine, w));
    WindlightAir air;
    air.passed = exp((w.blue_density + rvec3(w.haze_density)) * (-w.per_m * length_m));
    air.added = (rvec3(real(1.0)) - air.passed) * windlight_convergence(sine, sun_sine, sun_angle, w);
    return air;
}
