// Angle between two directions, given by elevations and the difference of their azimuths (haversine form: exact also
// where they meet).
SKYIG_INLINE real angle_between(real elevation, real source_elevation, real azimuth) {
    real rise = sin(real(0.5) * (elevation - source_elevation));
    real turn = sin(real(0.5) * azimuth);
    real square = rise * rise + cos(elevation) * cos(source_elevation) * turn * turn;
    return real(2.0) * asin(sqrt(clamp(square, real(0.0), real(1.0))));
}
