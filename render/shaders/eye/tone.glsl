// From absolute luminance to the value sent to the display. One text for GLSL and C++.
// Every operator is log10 Ld = p + q log10 L, Reinhard's compressed after that; p, q and the rod share come from
// render/eye/tone_curve.h. The night colour follows Jensen et al. 2000.

struct ToneParameters {
    real log2_gain;          // p / log10(2): log2 of the display luminance, cd/m2, of a world luminance of 1
    real exponent;           // q
    real compression;        // 1: x = Ld / white is shown as x (1 + burn x) / (1 + x) (Reinhard et al. 2002); 0: as x
    real burn;
    real photopic;           // 0 rods only .. 1 cones only, from the adaptation luminance
    real point_gain;         // display luminance per world luminance of point sources
    real inv_display_max;    // 1 / luminance of full white, m2/cd
    real ambient;            // luminance of the display at code 0, parts of full white
    real shoulder;           // parts of full white above which brightness is compressed; 1: it is clipped
    real encode_power;       // 0: sRGB curve, > 0: 1 / gamma, -1: none, linear and without bounds,
                             // -2: luminance itself, see stores_luminance()
};

// Targets of luminance hold linear Rec.709 times 2^log2_gain: no eye, no display (render/eye/exposure.h).
SKYIG_INLINE bool stores_luminance(ToneParameters tone) { return tone.encode_power < real(-1.5); }

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
    if (stores_luminance(tone)) return rgb_cd_m2 * exp2(tone.log2_gain);
    if (!(luminance_709(rgb_cd_m2) > real(1e-12))) return rvec3(real(0.0));
    rvec3 finite = min(rgb_cd_m2, rvec3(real(1e12)));
    real luminance = max(luminance_709(finite), real(1e-12));
    real gain = exp2(tone.log2_gain + (tone.exponent - real(1.0)) * log2(luminance)) * tone.inv_display_max;
    real white_parts = gain * luminance;
    gain *= (real(1.0) + tone.compression * tone.burn * white_parts) / (real(1.0) + tone.compression * white_parts);
    real photopic = max(tone.photopic, photopic_share(luminance));
    return night_coloured(inside_gamut(finite, luminance), photopic) * gain;
}

// What is brighter than the display can show keeps its hue and goes to white: a shoulder on the largest component, and a
// share of white that grows with what the shoulder takes away.
SKYIG_INLINE rvec3 highlights(rvec3 display, real shoulder) {
    real largest = rounded_max(rounded_max(display.x, display.y, real(0.05)), display.z, real(0.05));
    if (!(largest > shoulder) || shoulder >= real(1.0)) return max(display, rvec3(real(0.0)));
    real width = real(1.0) - shoulder;
    real kept = real(1.0) - width * exp2((shoulder - largest) * (real(1.4426950409) / width));
    real share = kept / largest;
    real white = (real(1.0) - share) * (real(1.0) - share);
    rvec3 scaled = display * share;
    return scaled + (rvec3(kept) - scaled) * white;
}

// What a screen is to emit beyond its black, 0..1 -> code. \param power  ToneParameters::encode_power, >= 0
SKYIG_INLINE rvec3 code_of(rvec3 v, real encode_power) {
    // Software GL computes both sides of a branch: one power serves either curve.
    bool srgb = encode_power == real(0.0);
    real power = srgb ? real(1.0) / real(2.4) : encode_power;
    real scale = srgb ? real(1.055) : real(1.0);
    real toe = srgb ? real(0.0031308) : real(0.0);
    rvec3 low = v * real(12.92);
    rvec3 high = pow(max(v, rvec3(real(1e-9))), rvec3(power)) * scale - rvec3(scale - real(1.0));
    return rvec3(v.x <= toe ? low.x : high.x, v.y <= toe ? low.y : high.y, v.z <= toe ? low.z : high.z);
}

// The other way.
SKYIG_INLINE rvec3 emitted(rvec3 code, real encode_power) {
    bool srgb = encode_power == real(0.0);
    real power = srgb ? real(2.4) : real(1.0) / encode_power;
    real scale = srgb ? real(1.0) / real(1.055) : real(1.0);
    real toe = srgb ? real(0.04045) : real(0.0);
    rvec3 v = clamp(code, rvec3(real(0.0)), rvec3(real(1.0)));
    rvec3 low = v * (real(1.0) / real(12.92));
    rvec3 high = pow((v + rvec3(srgb ? real(0.055) : real(0.0))) * scale, rvec3(power));
    return rvec3(v.x <= toe ? low.x : high.x, v.y <= toe ? low.y : high.y, v.z <= toe ? low.z : high.z);
}

// Display linear -> display code in 0..1. The display adds its black and what it reflects to all that it is sent.
SKYIG_INLINE rvec3 encoded(rvec3 display, ToneParameters tone) {
    if (stores_luminance(tone)) return min(display, rvec3(real(65504.0)));
    if (tone.encode_power < real(0.0)) return display;
    rvec3 sent = highlights(display - rvec3(tone.ambient), tone.shoulder);
    return code_of(clamp(sent, rvec3(real(0.0)), rvec3(real(1.0))), tone.encode_power);
}

// What encoded() was given for a code below the shoulder: where it bends nothing.
SKYIG_INLINE rvec3 displayed(rvec3 code, ToneParameters tone) {
    if (stores_luminance(tone) || tone.encode_power < real(0.0)) return code;
    return emitted(code, tone.encode_power) + rvec3(tone.ambient);
}

SKYIG_INLINE rvec3 shown(rvec3 rgb_cd_m2, ToneParameters tone) { return encoded(display_linear(rgb_cd_m2, tone), tone); }
