#include "render/pattern_pass.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace skyig::render {

namespace {

// A grid, so that a picture that is bent by a warp is bent here too.
constexpr std::uint32_t kCells = 32;
constexpr std::uint32_t kNodes = kCells + 1;
constexpr std::size_t kIndices = std::size_t{6} * kCells * kCells;

std::vector<float> grid_vertices() {
    std::vector<float> places;
    for (std::uint32_t y = 0; y < kNodes; ++y) {
        for (std::uint32_t x = 0; x < kNodes; ++x) {
            places.push_back(static_cast<float>(x) / kCells);
            places.push_back(static_cast<float>(y) / kCells);
        }
    }
    return places;
}

std::vector<std::uint32_t> grid_indices() {
    std::vector<std::uint32_t> indices;
    indices.reserve(kIndices);
    for (std::uint32_t y = 0; y < kCells; ++y) {
        for (std::uint32_t x = 0; x < kCells; ++x) {
            const std::uint32_t at = y * kNodes + x;
            for (const std::uint32_t corner : {at, at + 1, at + kNodes, at + kNodes, at + 1, at + kNodes + 1})
                indices.push_back(corner);
        }
    }
    return indices;
}

/// Neighbours in the order of the channels are far apart, so that two that overlap make a third colour.
glm::vec3 colour_of(std::size_t index) {
    constexpr std::array<std::array<float, 3>, 6> kColours{{{1.0F, 0.35F, 0.35F},
                                                            {0.35F, 1.0F, 0.35F},
                                                            {0.45F, 0.55F, 1.0F},
                                                            {1.0F, 0.9F, 0.3F},
                                                            {1.0F, 0.4F, 1.0F},
                                                            {0.3F, 1.0F, 1.0F}}};
    const std::array<float, 3>& rgb = kColours[index % kColours.size()];
    return {rgb[0], rgb[1], rgb[2]};
}

/// Of half the light of white.
float grey_code(const Screen& screen) {
    const double code =
        screen.srgb ? 1.055 * std::pow(0.5, 1.0 / 2.4) - 0.055 : std::pow(0.5, 1.0 / screen.gamma);
    return static_cast<float>(code);
}

// Numbers of pixels.frag and directions.frag.
constexpr float kOneColour = 0.0F, kBars = 1.0F, kRamp = 2.0F;
constexpr float kChecker = 0.0F, kGrid = 1.0F, kSeam = 2.0F;
constexpr float kNameGround = 0.15F;

}  // namespace

PatternPass::PatternPass(gl::Placement placement)
    : directions_("pattern/pattern.vert", "pattern/directions.frag", placement),
      plane_(directions_.uniform("u_plane")),
      enu_from_view_(directions_.uniform("u_enu_from_view")),
      clip_from_enu_(directions_.uniform("u_clip_from_enu")),
      direction_pattern_(directions_.uniform("u_pattern")),
      direction_colour_(directions_.uniform("u_colour")),
      direction_size_(directions_.uniform("u_size_px")),
      pixels_("common/write.vert", "pattern/pixels.frag"),
      pixel_pattern_(pixels_.uniform("u_pattern")),
      pixel_colour_(pixels_.uniform("u_colour")),
      pixel_size_(pixels_.uniform("u_size_px")),
      pixel_gamma_(pixels_.uniform("u_gamma")),
      grid_({2}, std::size_t{kNodes} * kNodes) {
    grid_.set_indices(grid_indices());
    grid_.update(grid_vertices());
}

void PatternPass::draw_directions(const Channel& drawn, const ChannelView& view,
                                  const glm::dmat4& clip_from_enu, float pattern,
                                  const glm::vec3& colour) const {
    const ImagePlane p = image_plane(view.frustum);
    directions_.use();
    directions_.set(plane_, glm::vec4{glm::dvec4{p.left, p.bottom, p.right - p.left, p.top - p.bottom}});
    directions_.set(enu_from_view_, glm::mat3{glm::transpose(view.view_from_enu)});
    directions_.set(clip_from_enu_, glm::mat4{clip_from_enu});
    directions_.set(direction_pattern_, pattern);
    directions_.set(direction_colour_, colour);
    directions_.set(direction_size_, glm::vec2{drawn.width_px, drawn.height_px});
    grid_.draw_triangles(0, kIndices);
}

void PatternPass::draw(const Channel& drawn, const ChannelView& view, const glm::dmat4& clip_from_enu,
                       const Screen& screen, std::size_t index) const {
    const auto draw_pixels = [&](float pattern, const glm::vec3& colour) {
        pixels_.use();
        pixels_.set(pixel_pattern_, pattern);
        pixels_.set(pixel_colour_, colour);
        pixels_.set(pixel_size_, glm::vec2{drawn.width_px, drawn.height_px});
        pixels_.set(pixel_gamma_, screen.srgb ? 0.0F : static_cast<float>(screen.gamma));
        grid_.draw_strip(3);
    };
    switch (view.pattern) {
        case Pattern::kChecker:
            return draw_directions(drawn, view, clip_from_enu, kChecker, glm::vec3{1.0F});
        case Pattern::kGrid:
            return draw_directions(drawn, view, clip_from_enu, kGrid, glm::vec3{1.0F});
        case Pattern::kSeam:
            return draw_directions(drawn, view, clip_from_enu, kSeam, colour_of(index));
        case Pattern::kResolution:
            return draw_pixels(kBars, glm::vec3{1.0F});
        case Pattern::kRamp:
            return draw_pixels(kRamp, glm::vec3{1.0F});
        case Pattern::kWhite:
            return draw_pixels(kOneColour, glm::vec3{1.0F});
        case Pattern::kGrey:
            return draw_pixels(kOneColour, glm::vec3{grey_code(screen)});
        case Pattern::kName:
            return draw_pixels(kOneColour, kNameGround * colour_of(index));
        case Pattern::kBlack:
        case Pattern::kOff:
            return draw_pixels(kOneColour, glm::vec3{0.0F});
    }
}

}  // namespace skyig::render
