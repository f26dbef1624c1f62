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
