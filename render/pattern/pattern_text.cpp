#include "render/pattern/pattern_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "render/overlay/font.h"

namespace skyig::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Where a direction lies in the finished picture, pixels from its upper left corner.
std::optional<glm::dvec2> picture_place(const Channel& channel, const ChannelView& view,
                                        const glm::dvec3& direction_enu) {
    const glm::dvec3 d = view.view_from_enu * direction_enu;
    if (d.z > -1e-6) return std::nullopt;
    const ImagePlane p = image_plane(view.frustum);
    glm::dvec2 part{(d.x / -d.z - p.left) / (p.right - p.left), (p.top - d.y / -d.z) / (p.top - p.bottom)};
    if (part.x < 0.0 || part.x > 1.0 || part.y < 0.0 || part.y > 1.0) return std::nullopt;
    if (view.showing.mirrored_across) part.x = 1.0 - part.x;
    if (view.showing.mirrored_upright) part.y = 1.0 - part.y;
    return glm::dvec2{part.x * channel.width_px, part.y * channel.height_px};
}

/// A number of degrees between labels that leaves room for each.
int label_step_deg(const Channel& channel, const ChannelView& view) {
    constexpr double kRoom_px = 90.0;
    const double pixel_deg = pixel_angle_rad(channel, view.frustum) / kDegree;
    for (const int step_deg : {10, 20, 30}) {
        if (step_deg > kRoom_px * pixel_deg) return step_deg;
    }
    return 90;
}

void write_angles(TextPass& text, const Channel& channel, const ChannelView& view) {
    const TextStyle style{.scale = 1, .colour = {0.4F, 0.85F, 1.0F}, .shade = 0.7F};
    constexpr int kGap_px = 3;
    const int step_deg = label_step_deg(channel, view);
    for (int elevation_deg = -90 + step_deg; elevation_deg < 90; elevation_deg += step_deg) {
        for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += step_deg) {
            const double e = elevation_deg * kDegree, a = azimuth_deg * kDegree;
            const glm::dvec3 direction{std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
            const auto place = picture_place(channel, view, direction);
            if (!place) continue;
            std::array<char, 16> label{};
            const int length =
                std::snprintf(label.data(), label.size(), "%03d/%+03d", azimuth_deg, elevation_deg);
            text.add({label.data(), static_cast<std::size_t>(length)}, static_cast<int>(place->x) + kGap_px,
                     static_cast<int>(place->y) + kGap_px, style);
        }
    }
}

void write_name(TextPass& text, const Channel& channel) {
    constexpr int kScale = 2;
    const int margin_px = kScale * kGlyphStep * 2;
    text.add(channel.name, margin_px, channel.height_px - margin_px - kScale * kLineStep, {.scale = kScale});
}

int fitting_scale(std::string_view line, int width_px) {
    return std::clamp(width_px / std::max(1, text_width(line) + 2 * kGlyphStep), 1, kMaxTextScale);
}

void write_large(TextPass& text, const Channel& channel, const ChannelView& view) {
    std::array<char, 96> facts{};
    const int length =
        std::snprintf(facts.data(), facts.size(), "%d x %d pixels, %.1f x %.1f deg", channel.width_px,
                      channel.height_px, (view.frustum.right_rad - view.frustum.left_rad) / kDegree,
                      (view.frustum.top_rad - view.frustum.bottom_rad) / kDegree);
    const std::string_view below{facts.data(), static_cast<std::size_t>(length)};
    int top_px = channel.height_px / 2 - kMaxTextScale * kLineStep;
    const std::array<std::pair<std::string_view, int>, 2> lines{{{channel.name, kMaxTextScale}, {below, 2}}};
    for (const auto& [line, most] : lines) {
        const int scale = std::min(most, fitting_scale(line, channel.width_px));
        text.add(line, (channel.width_px - scale * text_width(line)) / 2, top_px,
                 {.scale = scale, .shade = 0.0F});
        top_px += (scale + 1) * kLineStep;
    }
}

}  // namespace

void write_pattern_text(TextPass& text, const Channel& channel, const ChannelView& view) {
    switch (view.pattern) {
        case Pattern::kGrid:
            if (!view.showing.parallel) write_angles(text, channel, view);
            [[fallthrough]];
        case Pattern::kChecker:
        case Pattern::kResolution:
        case Pattern::kRamp:
        case Pattern::kSeam:
            return write_name(text, channel);
        case Pattern::kName:
            return write_large(text, channel, view);
        case Pattern::kOff:
        case Pattern::kWhite:
        case Pattern::kGrey:
        case Pattern::kBlack:
            return;
    }
}

}  // namespace skyig::render
