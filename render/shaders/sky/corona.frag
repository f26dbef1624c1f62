#version 450 core
// The Sun's corona round the eclipsed disc: Baumbach's law of its brightness (Allen 1947, electrons and dust near sunspot
// maximum), parts of the disc's centre over the distance in radii. Adds what it brightens the display over the sky.
#include "common/scalar.glsl"
#include "eye/tone.glsl"
#include "common/disc.glsl"

uniform ToneParameters u_tone;
uniform float u_share;           // fades it in as the last of the disc goes

const float kCentreOverMean = 1.25;
const float kReachRadii = 8.0;   // as render/discs.cpp lays the strip

layout(location = 0) out vec4 o_colour;

void main() {
    float r = max(length(v_offset) / u_radius, 1.0);
    float parts = 1e-6 * (0.0532 * pow(r, -2.5) + 1.425 * pow(r, -7.0) + 2.565 * pow(r, -17.0));
    float ends = smoothstep(kReachRadii, 0.6 * kReachRadii, r);
    vec3 sky = sky_behind();
    vec3 light = v_light * (kCentreOverMean * parts * ends * u_share * above_horizon());
    o_colour = vec4(shown(sky + light, u_tone) - shown(sky, u_tone), 0.0);
}
