// What a rig of channels covers, seen from its one eye: fields, pixels, overlaps and gaps. Pure geometry on
// the sphere of directions, where the four sides of a picture are great circles.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/channel.h"

namespace skyig::render {

struct ChannelField {
    /// Between the sides, radians, through the view axis.
    double across_rad = 0.0;
    double upright_rad = 0.0;
    double solid_angle_sr = 0.0;
    /// Angle from one pixel to the next across and upright, the larger, radians: in the picture's middle and
    /// in its corners: bottom left, bottom right, top left, top right.
    double centre_pixel_rad = 0.0;
    std::array<double, 4> corner_pixel_rad{};
};

/// Two channels, as they stand to one another.
struct ChannelPair {
    std::size_t first = 0;
    std::size_t second = 0;
    /// What both show; 0 if they do not meet.
    double overlap_sr = 0.0;
    /// How wide that is, radians: of the ways to lay a side against it, the least.
    double overlap_rad = 0.0;
    /// The smallest angle between the two, radians; 0 if they meet.
    double gap_rad = 0.0;
};

struct RigField {
    std::vector<ChannelField> channels;
    /// Each two once, in the order of the channels.
    std::vector<ChannelPair> pairs;
    /// What at least one channel shows.
    double solid_angle_sr = 0.0;
};

/// \param views  as many as channels, with one frame for all directions; their frusta must have an area.
[[nodiscard]] RigField rig_field(std::span<const Channel> channels, std::span<const ChannelView> views);

}  // namespace skyig::render
