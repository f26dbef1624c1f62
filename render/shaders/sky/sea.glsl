// The sea where a pixel resolves its waves: what their slopes make of the mean light. One text for GLSL and C++.
// The sky's part is the Hermite series to the second degree of what facets send to the eye (render/sky/sea_view), so that
// it leaves the mean as it is, whatever the waves. The glitter's is the density of the mirroring slope about the waves'
// own slope, with the roughness that is left (Cox and Munk 1954).

struct WaveTrain {
    rvec2 number_rad_m;      // phase per metre to the east and to the north
    real phase_rad;          // below the eye
    rvec2 rise;              // amplitude of the slope's first harmonic, to the east and to the north
    real skew;               // the second harmonic's share of it: the crest leads
};

struct ResolvedSlope {
    rvec2 slope;             // rise to the east and to the north
    rvec3 variance;          // what the roughness has handed over: east-east, north-north, east-north
};

struct WaveLight {
    rvec3 smooth_part;       // mean of all waves without glitter, cd/m2
    rvec3 east;              // what a unit of slope adds to it
    rvec3 north;
    rvec3 bend;              // a unit of slope^2, as a share of the same: east-east, north-north, east-north
    rvec3 glitter;           // a unit of density of slopes at the mirroring one
};

// Where a ray meets the water, from the point below the eye; its direction's z is negative.
// `curvature_m2`: 1 / (2 Earth's radius * height), first order in the sea's fall below the level.
SKYIG_INLINE rvec2 sea_point_m(rvec3 ray, real height_m, real curvature_m2) {
    rvec2 level = rvec2(ray.x, ray.y) * (height_m / max(-ray.z, real(1e-4)));
    return level * (real(1.0) + dot(level, level) * curvature_m2);
}

// The longer side of a pixel's footprint.
SKYIG_INLINE real footprint_m(rvec2 at_m, real height_m, real pixel_rad) {
    return pixel_rad * (dot(at_m, at_m) / height_m + height_m);
}

// Part of a wave's amplitude that is drawn where its phase turns by `number` radians a metre and pixels leave such a
// footprint: 1 near the eye, as the mean over a footprint leaves it, and 0 from two pixels a wave on.
SKYIG_INLINE real resolved_share(rvec2 number_rad_m, real footprint) {
    real left = real(1.0) - dot(number_rad_m, number_rad_m) * footprint * footprint * real(0.1013211836);
    return max(left, real(0.0)) * max(left, real(0.0));
}

// How much of this shading is shown over the mean's colour: all of it until the longest train all but ends.
SKYIG_INLINE real shaded_share(rvec2 longest_rad_m, real footprint) {
    return min(real(4.0) * resolved_share(longest_rad_m, footprint), real(1.0));
}

// Sine by two parabolas a period, within 0.0011.
SKYIG_INLINE real wave_sine(real phase_rad) {
    real turns = phase_rad * real(0.1591549431);
    real x = turns - floor(turns + real(0.5));
    real rough = x * (real(8.0) - real(16.0) * abs(x));
    return rough * (real(0.775) + real(0.225) * abs(rough));
}

SKYIG_INLINE ResolvedSlope with_train(ResolvedSlope sum, WaveTrain train, rvec2 at_m, real footprint) {
    real share = resolved_share(train.number_rad_m, footprint);
    real s = wave_sine(dot(train.number_rad_m, at_m) + train.phase_rad);
    rvec2 rise = train.rise * share;
    real variance = real(0.5) + real(0.5) * train.skew * train.skew;
    return ResolvedSlope(sum.slope + rise * (train.skew * (real(1.0) - real(2.0) * s * s) - s),
                         sum.variance + variance * rvec3(rise.x * rise.x, rise.y * rise.y, rise.x * rise.y));
}

// Slope of the facet that mirrors a source into the eye; both unit vectors from the water, east-north-up.
SKYIG_INLINE rvec2 mirroring_slope(rvec3 to_eye, rvec3 to_source) {
    real up = max(to_eye.z + max(to_source.z, real(1e-5)), real(1e-5));
    return rvec2(to_eye.x + to_source.x, to_eye.y + to_source.y) / -up;
}

// Roughness that every surface keeps, each way: a slope of 1 deg.
SKYIG_INLINE real least_slope_variance() { return real(3e-4); }

// Finite for any variance, also one that is none for want of digits.
SKYIG_INLINE real slope_density(rvec2 slope, rvec3 variance) {
    real least = least_slope_variance();
    real east = max(variance.x, least);
    real north = max(variance.y, least);
    real determinant = max(east * north - variance.z * variance.z, least * least);
    real exponent = (north * slope.x * slope.x + east * slope.y * slope.y -
                     real(2.0) * variance.z * slope.x * slope.y) / determinant;
    return exp(real(-0.5) * max(exponent, real(0.0))) * real(0.1591549431) / sqrt(determinant);
}

// `variance` is that of all slopes. No water is darker than a thirtieth of its smooth part.
SKYIG_INLINE rvec3 wave_lit(WaveLight light, ResolvedSlope waves, rvec2 mirroring, rvec3 variance) {
    rvec2 s = waves.slope;
    rvec3 square = rvec3(s.x * s.x, s.y * s.y, s.x * s.y) - waves.variance;
    real bend = light.bend.x * square.x + light.bend.y * square.y + real(2.0) * light.bend.z * square.z;
    rvec3 lit = light.smooth_part * (real(1.0) + bend) + light.east * s.x + light.north * s.y;
    return max(lit, light.smooth_part * real(0.03)) +
           light.glitter * slope_density(mirroring - s, variance - waves.variance);
}
