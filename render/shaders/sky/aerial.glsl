// Where a ray from the eye to a thing stands in the tables of the air between. One text for GLSL and C++.

struct AerialMap {
    real eye_radius_m;       // from the Earth's centre
    real outside_m2;         // eye radius^2 - lid radius^2 of an eye above the lid, else 0
    real inside_radius_m;    // of the place where rays enter the air: the eye or the lid
    real horizon_sine;       // of the tangent ray, at that place
    real scale;              // sines from the horizon within which rows are even
    real rise_m;             // how high and how deep steep rays are followed
    real fall_m;
    real longest_m;          // and how far the tangent ray is
};

struct AerialPlace {
    real near_m;             // where the ray enters the air
    real sine;               // of its elevation there
    bool meets_air;
};

SKYIG_INLINE AerialPlace aerial_place(real view_sine, AerialMap map) {
    if (map.outside_m2 <= real(0.0)) return AerialPlace(real(0.0), view_sine, true);
    real fall = -map.eye_radius_m * view_sine;
    real square = fall * fall - map.outside_m2;
    if (fall <= real(0.0) || square <= real(0.0)) return AerialPlace(real(0.0), real(0.0), false);
    real enter_m = map.outside_m2 / (fall + sqrt(square));
    return AerialPlace(enter_m, min((enter_m - fall) / map.inside_radius_m, real(0.0)), true);
}

// 0 straight down .. 0.5 the horizon .. 1 straight up. The sine at the place where the ray enters the air.
SKYIG_INLINE real aerial_row(real sine, AerialMap map) {
    real from = sine - map.horizon_sine;
    real range = from < real(0.0) ? real(1.0) + map.horizon_sine : real(1.0) - map.horizon_sine;
    real part = log2(real(1.0) + abs(from) / map.scale) / log2(real(1.0) + range / map.scale);
    return clamp(real(0.5) + (from < real(0.0) ? real(-0.5) : real(0.5)) * part, real(0.0), real(1.0));
}

// Sine of half the azimuth from the source: even about it and about its opposite.
SKYIG_INLINE real aerial_column(real azimuth_cosine) {
    return sqrt(clamp(real(0.5) - real(0.5) * azimuth_cosine, real(0.0), real(1.0)));
}

// Where the table of that row ends, from the place where it enters the air.
SKYIG_INLINE real aerial_far_m(real sine, AerialMap map) {
    real from = sine - map.horizon_sine;
    real steep = abs(from) / (from < real(0.0) ? map.fall_m : map.rise_m);
    return real(1.0) / (real(1.0) / map.longest_m + steep);
}

SKYIG_INLINE real aerial_slice(real inside_m, real far_m) {
    return sqrt(clamp(inside_m / far_m, real(0.0), real(1.0)));
}

// Cornette and Shanks, Appl. Opt. 31 (1992) 3152; 1 over the sphere.
SKYIG_INLINE real aerial_haze_phase(real g, real cosine) {
    real base = (real(1.0) - g) * (real(1.0) - g) + real(2.0) * g * (real(1.0) - cosine);
    return real(0.1193662073) * (real(1.0) - g * g) / (real(2.0) + g * g) * (real(1.0) + cosine * cosine) /
           (base * sqrt(base));
}
