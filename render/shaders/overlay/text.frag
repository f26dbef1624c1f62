#version 450 core
flat in uvec2 v_rows;
flat in vec4 v_colour_shade;

layout(location = 0) out vec4 o_colour;

void main() {
    // Of the eight columns of a point the first five are the glyph's, the sixth is the gap to the next one.
    ivec2 at = ivec2(gl_PointCoord * 8.0);
    uint word = at.y < 4 ? v_rows.x : v_rows.y;
    uint shift = uint(19 - 5 * (at.y & 3) - at.x);
    bool inked = at.x < 5 && (word >> shift & 1u) == 1u;
    o_colour = inked ? vec4(v_colour_shade.rgb, 1.0) : vec4(vec3(0.0), at.x < 6 ? v_colour_shade.a : 0.0);
}
