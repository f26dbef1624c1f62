#version 450 core
// A glyph is a point that carries its own bitmap.
layout(location = 0) in vec2 a_middle_px;    // from the upper left corner of the picture
layout(location = 1) in float a_glyph_px;
layout(location = 2) in vec2 a_rows;         // two words of four rows of five bits, as render/overlay/font.h has them
layout(location = 3) in vec4 a_colour_shade;

uniform vec2 u_size_px;

flat out uvec2 v_rows;
flat out vec4 v_colour_shade;

void main() {
    v_rows = uvec2(a_rows);
    v_colour_shade = a_colour_shade;
    gl_Position = vec4(vec2(2.0, -2.0) * a_middle_px / u_size_px + vec2(-1.0, 1.0), 0.0, 1.0);
    gl_PointSize = a_glyph_px;
}
