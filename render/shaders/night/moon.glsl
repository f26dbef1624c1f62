// The Moon's disc. One text for GLSL and C++.

// Disc-integrated phase function of Lommel-Seeliger reflection, 1 at full Moon, 0 at new.
// Phi(a) = 1 - sin(a/2) tan(a/2) ln cot(a/4), written with u = (pi - a)/2 so that nothing cancels near new Moon.
SKYIG_INLINE real lommel_seeliger_phase(real phase_angle_rad) {
    real u = (real(3.14159265358979) - phase_angle_rad) * real(0.5);
    if (u < real(0.01)) return max(u, real(0.0)) * max(u, real(0.0)) * (real(2.0) / real(3.0) - real(4.0) / real(45.0) * u * u);
    if (phase_angle_rad < real(1e-4)) return real(1.0);
    real s = sin(u);
    real t = tan(u * real(0.5));
    real atanh_t = real(0.5) * log((real(1.0) + t) / (real(1.0) - t));
    return real(1.0) - (real(1.0) - s * s) / s * real(2.0) * atanh_t;
}

// Luminance of a point of the disc relative to the mean of the full disc (Lommel-Seeliger: flat at full Moon).
// cos_sun: cosine of incidence, cos_eye: cosine of emission.
SKYIG_INLINE real lommel_seeliger(real cos_sun, real cos_eye) {
    if (cos_sun <= real(0.0)) return real(0.0);
    return real(2.0) * cos_sun / (cos_sun + max(cos_eye, real(1e-3)));
}

// Parts of its sunlight that reach a point of the Moon in the Earth's shadow.
struct SunInShadow {
    real direct;
    rvec3 refracted; // linear Rec.709
};

// Distances from the shadow's axis in any unit. Through the penumbra the Earth's limb, nearly straight, crosses a
// limb-darkened Sun. Into the umbra the Earth's air bends copper-red light, brighter and less red at the edge where it
// has passed higher: 1e-5 of full sunlight on the axis, 1e-4 at the edge, Danjon's L = 2 to 3 (the Moon at about
// magnitude -1.7).
SKYIG_INLINE SunInShadow sun_in_shadow(real from_axis, real umbra, real penumbra) {
    real x = clamp((from_axis - umbra) / max(penumbra - umbra, real(1e-6)), real(0.0), real(1.0));
    real direct = x * x * (real(3.0) - real(2.0) * x);
    real edge = clamp(from_axis / max(umbra, real(1e-6)), real(0.0), real(1.0));
    real outwards = edge * edge;
    real level = real(1e-5) * exp2(real(3.3) * outwards);
    rvec3 deep = rvec3(real(2.75), real(0.56), real(0.21));
    rvec3 high = rvec3(real(1.75), real(0.84), real(0.38));
    SunInShadow sun;
    sun.direct = direct;
    sun.refracted = (deep + (high - deep) * outwards) * (level * (real(1.0) - direct));
    return sun;
}

// The albedo map is equal-area about the middle of the near side and reaches 10 deg beyond the limb, sin 50 deg on either
// side; its texture coordinates of a selenographic direction (x to the mean Earth point, z to the north pole).
const real kMoonMapReach = real(1.5320888862);
SKYIG_INLINE rvec2 moon_map_place(rvec3 selenographic) {
    real scale = sqrt(real(2.0) / max(real(1.0) + selenographic.x, real(1e-6)));
    return rvec2(selenographic.y, selenographic.z) * (scale * real(0.5) / kMoonMapReach) + rvec2(real(0.5));
}
