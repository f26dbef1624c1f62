#version 450 core
// Patterns of the picture's own pixels.
uniform float u_pattern;      // 0 one colour, 1 resolution bars, 2 ramp
uniform vec3 u_colour;
uniform vec2 u_size_px;
uniform float u_gamma;        // of the screen; 0: the sRGB curve

layout(location = 0) out vec4 o_colour;

const float kSteps = 16.0;

float code_of(float light) {
    if (u_gamma > 0.0) return pow(light, 1.0 / u_gamma);
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

// Cells of 48 pixels, a whole number of each pair of lines.
float bars(ivec2 px) {
    ivec2 cell = px / 48;
    ivec2 in_cell = px - 48 * cell;
    int width = 1 + ((cell.x + cell.y / 2) & 3);
    int along = (cell.y & 1) == 0 ? in_cell.x : in_cell.y;
    return float(along / width & 1);
}

// Ordered by halves: of each 4 x 4 pixels as many are lit as the light has sixteenths.
float halftone(ivec2 px, float light) {
    ivec2 fine = px & 1;
    ivec2 coarse = px >> 1 & 1;
    int order = 4 * ((fine.x ^ fine.y) * 2 + fine.y) + (coarse.x ^ coarse.y) * 2 + coarse.y;
    return float(order) + 0.5 < 16.0 * light ? 1.0 : 0.0;
}

float ramp(ivec2 px) {
    float step_of_17 = min(floor(gl_FragCoord.x / u_size_px.x * (kSteps + 1.0)), kSteps);
    float part = step_of_17 / kSteps;
    float up = gl_FragCoord.y / u_size_px.y;
    return up > 2.0 / 3.0 ? code_of(part) : up > 1.0 / 3.0 ? halftone(px, part) : part;
}

void main() {
    ivec2 px = ivec2(gl_FragCoord.xy);
    float grey = u_pattern < 0.5 ? 1.0 : u_pattern < 1.5 ? bars(px) : ramp(px);
    o_colour = vec4(u_colour * grey, 1.0);
}
