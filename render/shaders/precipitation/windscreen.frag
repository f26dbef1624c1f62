#version 450 core
// What is seen through a drop on the pane: the picture, turned over by Snell's law at the cap's surface.
uniform vec2 u_size_px;
uniform vec2 u_focal_px;         // pixels to a unit of tangent
uniform float u_contact_sine;    // of the cap's rim

layout(binding = 0) uniform sampler2D u_picture;

in vec2 v_across;
in vec2 v_radius_px_there;
layout(location = 0) out vec4 o_colour;

void main() {
    float across = length(v_across);
    float covered = clamp((1.0 - across) * v_radius_px_there.x + 0.5, 0.0, 1.0) * v_radius_px_there.y;
    if (!(covered > 0.0)) discard;
    float sine = min(across, 1.0) * u_contact_sine;
    float turn = tan(asin(min(1.333 * sine, 1.0)) - asin(sine));
    vec2 beyond_px = gl_FragCoord.xy - v_across * (turn / max(across, 1e-4)) * u_focal_px;
    // As coarse as the drop makes it small.
    float level = log2(max(0.34 * u_focal_px.y / v_radius_px_there.x, 1.0));
    // A rim mirrors some of the light back.
    vec3 seen = textureLod(u_picture, beyond_px / u_size_px, level).rgb * (1.0 - 0.15 * pow(min(across, 1.0), 8.0));
    o_colour = vec4(seen, covered);
}
