// Where a direction lies on the cloud map: two squares, one for each half of the sphere of directions, an octahedron's
// upper and lower half turned by 45 deg, so that the level circle is the rim of both. One text for GLSL and C++.

// In -1..1 both ways; of either half. The direction may have any length but zero.
SKYIG_INLINE rvec2 cloud_map_place(rvec3 direction) {
    real scale = real(1.0) / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    return rvec2((direction.x + direction.y) * scale, (direction.x - direction.y) * scale);
}

// Of the upper half; the lower one has -z. Its components' sizes sum to 1. Beyond the rim it goes on below the level.
SKYIG_INLINE rvec3 cloud_map_direction(rvec2 place) {
    real x = real(0.5) * (place.x + place.y);
    real y = real(0.5) * (place.x - place.y);
    return rvec3(x, y, real(1.0) - abs(x) - abs(y));
}
