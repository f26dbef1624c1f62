// Text that lies over a picture: what it says, and which of it a channel shows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::render {

/// A line of text of fixed room; what does not fit is cut off.
class OverlayLine {
  public:
    static constexpr std::size_t kMost = 64;

    void say(std::string_view text) noexcept {
        length_ = std::min(text.size(), kMost);
        std::copy_n(text.begin(), length_, text_.begin());
    }
    [[nodiscard]] std::string_view text() const noexcept { return {text_.data(), length_}; }

  private:
    std::array<char, kMost> text_{};
    std::size_t length_ = 0;
};

/// Small lines from the upper left corner down, and one in large in the middle that warns.
struct Overlay {
    static constexpr std::size_t kLines = 3;
    std::array<OverlayLine, kLines> lines;
    OverlayLine warning;
};

/// Screen pixels to a pixel of the font: a glyph is a point of eight times that, and drivers draw points of
/// 64 pixels.
inline constexpr int kMaxTextScale = 8;

/// Which of the lines a view shows: bit i is line i, and this one the warning.
inline constexpr std::uint8_t kShowsWarning = 1U << Overlay::kLines;

/// Code of the text, 0..1, for an eye adapted to a luminance: bright by day, and by night no more than
/// kNightTextCode, so that text does not blind who looks past it at the stars.
inline constexpr double kDayTextCode = 0.9;
inline constexpr double kNightTextCode = 0.5;
[[nodiscard]] double text_code(double adaptation_cd_m2) noexcept;

}  // namespace skyig::render
