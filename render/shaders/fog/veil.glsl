// The veil of fog, haze and other obscurants along a ray: shells round the Earth in which extinction is linear with height.
// One text for GLSL and C++. Heights are told from the eye and crossings in forms that do not cancel, for the radius is
// 6 371 km and a fog's top may be a metre away.
//
// Optical depths come twice: true, for what is sharp, and cut, without the forward peak of the scattering, for smooth light
// (Joseph, Wiscombe & Weinman, J. Atmos. Sci. 33 (1976) 2452). Light that was scattered once has the whole phase function
// (Nakajima & Tanaka, J. Quant. Spectrosc. 40 (1988) 51); the rest is even + slope * cosine, told at the ends of a segment
// and linear in cut depth between them.

struct VeilRay {
    real sine;               // of its elevation at the eye
    real radius_m;           // of the eye's place, from the Earth's centre
};

struct VeilSegment {
    real low_m;              // its ends, over the eye
    real high_m;
    real low_per_m;          // extinction just inside them
    real high_per_m;
    real low_depth;          // cut vertical depth above them
    real high_depth;
    real kept;               // cut depth over true depth
    real g;                  // mean cosine of scattering
    rvec3 albedo;
    rvec3 low_even;          // light sent to everywhere, cd/m2,
    rvec3 high_even;
    rvec3 low_slope;         // and what a unit of the cosine with which it goes down adds
    rvec3 high_slope;
};

struct VeilBeams {
    rvec3 first_lux;         // above all segments, on a plane that faces the source
    rvec3 second_lux;
    real first_slant;        // cut depth towards the source over the vertical one
    real second_slant;
    real first_cosine;       // of the ray with the direction to the source
    real second_cosine;
};

struct VeilSum {
    real depth;
    real cut_depth;
    rvec3 added_cd_m2;
    real moment_m;           // of what was kept away: its mean distance times its share,
    real square_m2;          // and that of the distance's square
};

// Nothing yet.
SKYIG_INLINE VeilSum veil_none() {
    VeilSum sum;
    sum.depth = sum.cut_depth = real(0.0);
    sum.added_cd_m2 = rvec3(real(0.0));
    sum.moment_m = sum.square_m2 = real(0.0);
    return sum;
}

// Height over the eye of a place on the ray.
SKYIG_INLINE real veil_rise_m(real along_m, VeilRay ray) {
    real gain = along_m * (real(2.0) * ray.radius_m * ray.sine + along_m);
    return gain / (sqrt(max(ray.radius_m * ray.radius_m + gain, real(0.0))) + ray.radius_m);
}

// Where the ray is below a height over the eye: from .x to .y; both at its lowest place where it is nowhere.
SKYIG_INLINE rvec2 veil_below_m(real over_m, VeilRay ray) {
    real fall = -ray.radius_m * ray.sine;
    real lift = over_m * (real(2.0) * ray.radius_m + over_m);
    real square = fall * fall + lift;
    if (square <= real(0.0)) return rvec2(fall, fall);
    real larger = fall < real(0.0) ? fall - sqrt(square) : fall + sqrt(square);
    real other = -lift / larger;
    return fall < real(0.0) ? rvec2(larger, other) : rvec2(other, larger);
}

SKYIG_INLINE real veil_extinction(real rise_m, VeilSegment at) {
    real share = (rise_m - at.low_m) / max(at.high_m - at.low_m, real(1e-6));
    return max(at.low_per_m + (at.high_per_m - at.low_per_m) * clamp(share, real(0.0), real(1.0)), real(0.0));
}

// By Gauss's rule of three points where extinction changes: heights along a ray are all but quadratic.
SKYIG_INLINE real veil_depth(VeilSegment at, real from_m, real to_m, VeilRay ray) {
    real half_m = real(0.5) * (to_m - from_m);
    if (at.low_per_m == at.high_per_m) return real(2.0) * half_m * at.low_per_m;
    real middle_m = from_m + half_m;
    real aside_m = real(0.774596669) * half_m;
    real ends = veil_extinction(veil_rise_m(middle_m - aside_m, ray), at) +
                veil_extinction(veil_rise_m(middle_m + aside_m, ray), at);
    return half_m * (real(5.0) * ends + real(8.0) * veil_extinction(veil_rise_m(middle_m, ray), at)) / real(9.0);
}

// 1 - exp(-x), x >= 0.
SKYIG_INLINE real veil_lost(real x) {
    if (x < real(0.02)) return x * (real(1.0) - x * (real(0.5) - x * (real(1.0) - real(0.25) * x) / real(6.0)));
    return real(1.0) - exp(-x);
}

// The integral of y exp(-y) from 0 to x, over x: the mean share of the way times what is lost.
SKYIG_INLINE real veil_moment(real x) {
    if (x < real(0.1))
        return x * (real(0.5) - x * (real(1.0 / 3.0) - x * (real(0.125) - x * (real(1.0 / 30.0) - x / real(144.0)))));
    return (real(1.0) - (real(1.0) + x) * exp(-x)) / x;
}

// The integral of y^2 exp(-y) from 0 to x, over x^2.
SKYIG_INLINE real veil_square(real x) {
    if (x < real(0.2))
        return x * (real(1.0 / 3.0) - x * (real(0.25) - x * (real(0.1) - x * (real(1.0 / 36.0) - x / real(168.0)))));
    return (real(2.0) - (real(2.0) + x * (real(2.0) + x)) * exp(-x)) / (x * x);
}

// Henyey and Greenstein, 1 over the sphere.
SKYIG_INLINE real veil_phase(real g, real cosine) {
    real base = (real(1.0) - g) * (real(1.0) - g) + real(2.0) * g * (real(1.0) - cosine);
    return real(0.0795774715) * (real(1.0) - g * g) / (base * sqrt(base));
}

// The integral of exp(-slant * depth - x) over the cut depth x of a piece of ray, vertical depth linear between its ends.
SKYIG_INLINE real veil_beam(real cut, real near_depth, real far_depth, real slant) {
    real exponent = cut + slant * (far_depth - near_depth);
    real dim = exponent < real(0.0) ? slant * far_depth + cut : slant * near_depth;
    real size = abs(exponent);
    real mean = size > real(0.0) ? veil_lost(size) / size : real(1.0);
    return exp(-dim) * cut * mean;
}

// Cut vertical depth above a height in the segment.
SKYIG_INLINE real veil_depth_above(real rise_m, VeilSegment at) {
    return at.high_depth +
           at.kept * (at.high_m - rise_m) * real(0.5) * (veil_extinction(rise_m, at) + at.high_per_m);
}

// Adds the piece of a ray from `from_m` to `to_m`, which lies in the segment, behind all that the sum holds.
SKYIG_INLINE VeilSum veil_add(VeilSum sum, VeilSegment at, real from_m, real to_m, VeilRay ray, VeilBeams beams) {
    if (!(to_m > from_m) || at.low_per_m + at.high_per_m <= real(0.0)) return sum;
    real depth = veil_depth(at, from_m, to_m, ray);
    real cut = at.kept * depth;
    if (!(cut > real(0.0))) return sum;
    real passed = exp(-sum.cut_depth);
    real near_depth = veil_depth_above(clamp(veil_rise_m(from_m, ray), at.low_m, at.high_m), at);
    real far_depth = veil_depth_above(clamp(veil_rise_m(to_m, ray), at.low_m, at.high_m), at);
    // The light's own cosine: what the segment has of the vertical.
    real down = clamp((near_depth - far_depth) / cut, real(-1.0), real(1.0));
    real whole = max(at.low_depth - at.high_depth, real(1e-12));
    real near_share = clamp((near_depth - at.high_depth) / whole, real(0.0), real(1.0));
    real far_share = clamp((far_depth - at.high_depth) / whole, real(0.0), real(1.0));
    rvec3 high = at.high_even + down * at.high_slope;
    rvec3 low = at.low_even + down * at.low_slope;
    rvec3 near = high + (low - high) * near_share;
    real lost = veil_lost(cut);
    real moment = veil_moment(cut);
    rvec3 added = near * lost + (low - high) * ((far_share - near_share) * moment);
    real first = veil_phase(at.g, beams.first_cosine) * veil_beam(cut, near_depth, far_depth, beams.first_slant);
    real second = veil_phase(at.g, beams.second_cosine) * veil_beam(cut, near_depth, far_depth, beams.second_slant);
    added = added + at.albedo * (beams.first_lux * first + beams.second_lux * second) / at.kept;
    sum.depth += depth;
    sum.cut_depth += cut;
    sum.added_cd_m2 = sum.added_cd_m2 + max(added, rvec3(real(0.0))) * passed;
    real long_m = to_m - from_m;
    sum.moment_m += passed * (from_m * lost + long_m * moment);
    sum.square_m2 += passed * (from_m * (from_m * lost + real(2.0) * long_m * moment) + long_m * long_m * veil_square(cut));
    return sum;
}

// The air before a veil far away: exponential in height.
struct VeilAir {
    rvec3 molecules_per_m;   // at the eye, or at the height below it where there is next to none any more
    rvec3 aerosol_per_m;
    real molecules_height_m;
    real aerosol_height_m;
    real above_m;            // of the eye over that height
};

SKYIG_INLINE real veil_air_column_m(real rise_m, real along_m, real scale_m) {
    real scaled = abs(rise_m) / scale_m;
    real mean = scaled > real(0.0) ? veil_lost(scaled) / scaled : real(1.0);
    return along_m * exp(-min(rise_m, real(0.0)) / scale_m) * mean;
}

// Optical depth up to that far, to a place so much higher.
SKYIG_INLINE rvec3 veil_air_depth(real rise_m, real along_m, VeilAir air) {
    if (air.above_m > real(0.0)) {
        real inside_m = min(rise_m + air.above_m, real(0.0));
        along_m *= rise_m < real(0.0) ? inside_m / rise_m : real(0.0);
        rise_m = inside_m;
    }
    return air.molecules_per_m * veil_air_column_m(rise_m, along_m, air.molecules_height_m) +
           air.aerosol_per_m * veil_air_column_m(rise_m, along_m, air.aerosol_height_m);
}

// Of light from that far, from a place so much higher.
SKYIG_INLINE rvec3 veil_air_passes(real rise_m, real along_m, VeilAir air) {
    return exp(-veil_air_depth(rise_m, along_m, air));
}

// A column towards there over the upright one: in Rozenberg's form, for any scale height; at the level Chapman's
// sqrt(pi R / (2 H)), 35 of air and 91 of haze that thins out by e in 1200 m.
SKYIG_INLINE real veil_air_mass(real sine, real scale_m) {
    real up = max(sine, real(0.0));
    real level = sqrt(scale_m * real(0.636619772 / 6371000.0));
    return real(1.0) / (up + level * exp(real(-0.275) * up / level));
}

// Of light from outside the air.
SKYIG_INLINE rvec3 veil_all_air_passes(real sine, VeilAir air) {
    return exp(-(air.molecules_per_m * (air.molecules_height_m * veil_air_mass(sine, air.molecules_height_m)) +
                 air.aerosol_per_m * (air.aerosol_height_m * veil_air_mass(sine, air.aerosol_height_m))));
}

// Mean distance of what the veil keeps away.
SKYIG_INLINE real veil_distance_m(VeilSum sum) {
    return sum.moment_m / max(veil_lost(sum.cut_depth), real(1e-30));
}

// What the air lets through of the veil's light, the mean over the distances that it comes from: these lie as a gamma
// distribution of the same mean and variance, which is what they are where veil and air are one even mixture.
SKYIG_INLINE rvec3 veil_air_passes_before(VeilSum sum, VeilRay ray, VeilAir air) {
    real mean_m = veil_distance_m(sum);
    rvec3 depth = veil_air_depth(veil_rise_m(mean_m, ray), mean_m, air);
    real lost = max(veil_lost(sum.cut_depth), real(1e-30));
    real spread = min(sum.square_m2 / max(lost * mean_m * mean_m, real(1e-30)) - real(1.0), real(1.0));
    if (!(spread > real(1e-3))) return exp(-depth);
    return exp(-log(rvec3(real(1.0)) + spread * depth) / spread);
}

// Air and veil together along a ray, smooth light: of the veil's light `added` the part `air_passes` gets through
// the air before it, and where it is, that air's own light (`air_cd_m2`, of endless air) is before it.
SKYIG_INLINE rvec3 veil_in_air(VeilSum sum, rvec3 air_passes, rvec3 air_cd_m2, rvec3 behind_cd_m2) {
    rvec3 kept_away = air_cd_m2 * veil_lost(sum.cut_depth);
    return kept_away + air_passes * (sum.added_cd_m2 - kept_away) + behind_cd_m2 * exp(-sum.cut_depth);
}

// The air's light before a thing, the more the veil hides the more as the dome has it behind the same veil: of endless air.
// Else what little both differ would spoil the faint contrast that is left.
SKYIG_INLINE rvec3 veil_own_air(rvec3 added_cd_m2, rvec3 air_passed, rvec3 air_cd_m2, VeilSum near) {
    return added_cd_m2 + ((rvec3(real(1.0)) - air_passed) * air_cd_m2 - added_cd_m2) * veil_lost(near.depth);
}

// What is added before a thing: the light up to it, and of the light that would come from behind it so much as is scattered
// by small angles alone, from beside it. Far off its contrast falls with what passes sharply: Koschmieder's law.
SKYIG_INLINE rvec3 veil_before(rvec3 near_cd_m2, rvec3 whole_cd_m2, VeilSum near) {
    return near_cd_m2 + max(whole_cd_m2 - near_cd_m2, rvec3(real(0.0))) * veil_lost(near.depth - near.cut_depth);
}
