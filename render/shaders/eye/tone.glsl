// From absolute luminance to the value sent to the display. One text for GLSL and C++.
// The curve is log10 Ld = p + q log10 L (Tumblin and Rushmeier 1993 by day, threshold matching by night: p, q and
// the rod share come from render/eye/tone_curve.h), the night colour follows Jensen et al. 2000.

struct ToneParameters {
    real log2_gain;          // p / log10(2): log2 of the display luminance, cd/m2, of a world luminance of 1
    real exponent;           // q
    real photopic;           // 0 rods only .. 1 cones only, from the adaptation luminance
    real point_gain;         // display luminance per world luminance of point sources
    real inv_display_max;    // 1 / luminance of full white, m2/cd
    real encode_power;       // 0: sRGB curve, else 1 / gamma
};

SKYIG_INLINE real luminance_709(rvec3 rgb) { return real(0.2126) * rgb.x + real(0.7152) * rgb.y + real(0.0722) * rgb.z; }

// max(a, b) with its corner rounded over about `width`.
SKYIG_INLINE real rounded_max(real a, real b, real width) {
    real apart = a - b;
    return real(0.5) * (a + b + sqrt(apart * apart + width * width));
}

// Moves colours with a negative component towards grey at constant luminance; those just inside a little, so that the
// hues of a sunset do not break off where the gamut ends.
SKYIG_INLINE rvec3 inside_gamut(rvec3 rgb, real grey) {
    if (grey <= real(0.0)) return max(rgb, rvec3(real(0.0)));
    real low = min(rgb.x, min(rgb.y, rgb.z));
    real depth = -low / max(grey - low, real(1e-6) * grey);
    real t = rounded_max(depth, real(0.0), real(0.02));
    return max(rgb + (rvec3(grey) - rgb) * t, rvec3(real(0.0)));
}

// Cone share of a luminance, 0.01 .. 4 cd/m2 on a log scale (Jensen et al. 2000).
SKYIG_INLINE real photopic_share(real luminance) {
    real t = clamp((log2(max(luminance, real(1e-9))) * real(0.30102999566) + real(2.0)) / real(2.6), real(0.0), real(1.0));
    return t * t * (real(3.0) - real(2.0) * t);
}

// Rods see no colour and prefer blue: grey of unchanged white, tinted to (x, y) = (0.25, 0.25).
SKYIG_INLINE rvec3 night_coloured(rvec3 rgb, real photopic) {
    real rod = real(0.0329) * rgb.x + real(0.7653) * rgb.y + real(0.2016) * rgb.z;
    rvec3 tinted = rvec3(real(0.7063), real(0.9899), real(1.9661)) * rod;
    return tinted + (rgb - tinted) * photopic;
}

// World linear Rec.709, cd/m2 -> display linear, 1 = full white, not clipped.
SKYIG_INLINE rvec3 display_linear(rvec3 rgb_cd_m2, ToneParameters tone) {
    real luminance = luminance_709(rgb_cd_m2);
    if (!(luminance > real(1e-12))) return rvec3(real(0.0));
    if (luminance > real(1e12)) luminance = real(1e12);
    real gain = exp2(tone.log2_gain + (tone.exponent - real(1.0)) * log2(luminance));
    real photopic = max(tone.photopic, photopic_share(luminance));
    rvec3 rgb = night_coloured(inside_gamut(rgb_cd_m2, luminance), photopic);
    return rgb * (gain * tone.inv_display_max);
}

// What is brighter than the display can show keeps its hue and goes to white: a shoulder on the largest component from
// 0.7 of full white on, and a share of white that grows with what the shoulder takes away.
SKYIG_INLINE rvec3 highlights(rvec3 display) {
    real largest = rounded_max(rounded_max(display.x, display.y, real(0.05)), display.z, real(0.05));
    if (!(largest > real(0.7))) return max(display, rvec3(real(0.0)));
    real kept = real(1.0) - real(0.3) * exp2((real(0.7) - largest) * real(4.8089834696));
    real share = kept / largest;
    real white = (real(1.0) - share) * (real(1.0) - share);
    rvec3 scaled = display * share;
    return scaled + (rvec3(kept) - scaled) * white;
}

// Display linear -> display code in 0..1.
SKYIG_INLINE rvec3 encoded(rvec3 display, ToneParameters tone) {
    rvec3 v = clamp(highlights(display), rvec3(real(0.0)), rvec3(real(1.0)));
    // Software GL computes both sides of a branch: one power serves either curve.
    bool srgb = tone.encode_power <= real(0.0);
    real power = srgb ? real(1.0) / real(2.4) : tone.encode_power;
    real scale = srgb ? real(1.055) : real(1.0);
    real toe = srgb ? real(0.0031308) : real(0.0);
    rvec3 low = v * real(12.92);
    rvec3 high = pow(max(v, rvec3(real(1e-9))), rvec3(power)) * scale - rvec3(scale - real(1.0));
    return rvec3(v.x <= toe ? low.x : high.x, v.y <= toe ? low.y : high.y, v.z <= toe ? low.z : high.z);
}

SKYIG_INLINE rvec3 shown(rvec3 rgb_cd_m2, ToneParameters tone) { return encoded(display_linear(rgb_cd_m2, tone), tone); }
