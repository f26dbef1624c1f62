#include "render/overlay/overlay_text.h"

#include <algorithm>

#include "render/overlay/font.h"

namespace skyig::render {

namespace {

/// In the middle, as large as a third of the picture's width allows.
void write_warning(TextPass& text, const Channel& channel, std::string_view line, float code) {
    constexpr int kPart = 3;
    const int scale = std::clamp(channel.width_px / kPart / std::max(1, text_width(line)), 1, kMaxTextScale);
    text.add(line, (channel.width_px - scale * text_width(line)) / 2,
             (channel.height_px - scale * kGlyphRows) / 2,
             {.scale = scale, .colour = {code, 0.25F * code, 0.2F * code}});
}

}  // namespace

void write_overlay(TextPass& text, const Channel& channel, const Overlay& overlay, std::uint8_t shown,
                   double code) {
    const auto grey = static_cast<float>(code);
    const int scale = std::clamp(channel.text_scale, 1, kMaxTextScale);
    int top_px = scale * kGlyphStep;
    for (std::size_t i = 0; i < Overlay::kLines; ++i) {
        if ((shown >> i & 1U) == 0 || overlay.lines[i].text().empty()) continue;
        text.add(overlay.lines[i].text(), scale * kGlyphStep, top_px,
                 {.scale = scale, .colour = {grey, grey, grey}});
        top_px += scale * kLineStep;
    }
    if ((shown & kShowsWarning) != 0 && !overlay.warning.text().empty())
        write_warning(text, channel, overlay.warning.text(), grey);
}

}  // namespace skyig::render
