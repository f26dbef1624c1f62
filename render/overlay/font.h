// A font of 5 x 8 pixels, drawn for this project: ASCII 32..126.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace skyig::render {

/// The last row is for what hangs below the line.
inline constexpr int kGlyphColumns = 5;
inline constexpr int kGlyphRows = 8;
/// From one glyph to the next, and from one line to the next, in the font's pixels.
inline constexpr int kGlyphStep = 6;
inline constexpr int kLineStep = 10;

/// Rows from the top, four to a word, the first in its highest bits; of a row the left column is the highest
/// bit. A word has 20 bits: a float holds it.
using Glyph = std::array<std::uint32_t, 2>;

/// What is not in the font is shown as a question mark.
[[nodiscard]] const Glyph& glyph(char character) noexcept;

/// Width of a text at a scale of 1, without the gap behind its last glyph.
[[nodiscard]] constexpr int text_width(std::string_view text) noexcept {
    return text.empty() ? 0 : kGlyphStep * static_cast<int>(text.size()) - 1;
}

}  // namespace skyig::render
