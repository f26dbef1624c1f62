#version 450 core
// Patterns that stand still in the world: lines and fields of azimuth and elevation, whose edges are softened over one
// pixel by the angles' own gradients.
in vec3 v_direction;

uniform float u_pattern;      // 0 checker, 1 grid, 2 seam
uniform vec3 u_colour;        // the channel's own
uniform vec2 u_size_px;

layout(location = 0) out vec4 o_colour;

const float kDegrees = 57.29577951308232;
const vec3 kHorizon = vec3(0.1, 0.9, 0.3);

struct Angle {
    float deg;
    vec2 per_px;    // its change from one pixel to the next
};

// From the middle of the nearest line of those that stand `step_deg` apart, in pixels.
float line_px(Angle a, float step_deg) {
    return abs(a.deg - step_deg * round(a.deg / step_deg)) / max(length(a.per_px), 1e-6);
}

float line(Angle a, float step_deg, float width_px) {
    return clamp(0.5 * width_px + 0.5 - line_px(a, step_deg), 0.0, 1.0);
}

// Where lines stand closer than a few pixels, as those of azimuth do about the poles, they fade to nothing.
float crowded(Angle a, float step_deg) {
    return clamp(2.0 - 4.0 * length(a.per_px) / step_deg, 0.0, 1.0);
}

// +1 and -1 in turn.
float fields(Angle a, float step_deg) {
    float nearest = round(a.deg / step_deg);
    float from_edge_px = (a.deg - step_deg * nearest) / max(length(a.per_px), 1e-6);
    float side = mod(nearest, 2.0) < 0.5 ? 1.0 : -1.0;
    return side * clamp(2.0 * from_edge_px, -1.0, 1.0) * crowded(a, step_deg);
}

vec3 checker(Angle azimuth, Angle elevation) {
    vec3 colour = vec3(0.5 + 0.5 * fields(azimuth, 5.0) * fields(elevation, 5.0));
    return mix(colour, kHorizon, line(elevation, 360.0, 2.0));
}

vec3 grid(Angle azimuth, Angle elevation) {
    float fine = max(line(azimuth, 5.0, 1.0) * crowded(azimuth, 5.0), line(elevation, 5.0, 1.0));
    float bold = max(line(azimuth, 10.0, 2.0) * crowded(azimuth, 10.0), line(elevation, 10.0, 2.0));
    return mix(vec3(max(0.45 * fine, 0.9 * bold)), kHorizon, line(elevation, 360.0, 2.0));
}

vec3 seam(Angle azimuth, Angle elevation) {
    Angle rising = Angle(azimuth.deg - elevation.deg, azimuth.per_px - elevation.per_px);
    Angle falling = Angle(azimuth.deg + elevation.deg, azimuth.per_px + elevation.per_px);
    float upright = max(line(azimuth, 2.5, 1.0), max(line(rising, 5.0, 1.0), line(falling, 5.0, 1.0)));
    float net = max(upright * crowded(azimuth, 2.5), line(elevation, 2.5, 1.0));
    vec2 from_edge_px = min(gl_FragCoord.xy, u_size_px - gl_FragCoord.xy);
    float edge = min(from_edge_px.x, from_edge_px.y) < 6.0 ? 1.0 : 0.0;
    return u_colour * max(net, edge);
}

void main() {
    vec3 d = v_direction;
    vec3 dx = dFdx(d), dy = dFdy(d);
    float level = max(length(d.xy), 1e-6);
    vec2 level_per_px = vec2(dot(d.xy, dx.xy), dot(d.xy, dy.xy)) / level;
    Angle azimuth = Angle(kDegrees * atan(d.x, d.y),
                          kDegrees * vec2(d.y * dx.x - d.x * dx.y, d.y * dy.x - d.x * dy.y) / (level * level));
    Angle elevation = Angle(kDegrees * atan(d.z, level),
                            kDegrees * (level * vec2(dx.z, dy.z) - d.z * level_per_px) / dot(d, d));
    vec3 colour = u_pattern < 0.5   ? checker(azimuth, elevation)
                  : u_pattern < 1.5 ? grid(azimuth, elevation)
                                    : seam(azimuth, elevation);
    o_colour = vec4(colour, 1.0);
}
