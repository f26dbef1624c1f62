// Test patterns that a channel shows in place of the sky: what a technician sets up a display by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skyig::render {

/// Angles are the world's: azimuth clockwise from true north, elevation from the level.
enum class Pattern : std::uint8_t {
    kOff,
    kChecker,     ///< black and white fields of 5 degrees, the horizon marked
    kGrid,        ///< lines each 5 degrees, each 10 brighter, with their angles; the horizon marked
    kResolution,  ///< pairs of black and white lines, 1 to 4 pixels wide, across and upright
    kRamp,        ///< luminance in 17 steps: as one code, as black and white pixels; and steps of code
    kSeam,        ///< a net of thin lines in the channel's own colour, as are the picture's edges
    kWhite,
    kGrey,  ///< half the luminance of white
    kBlack,
    kName,  ///< what the channel is called, its pixels and its field
};
inline constexpr std::array<std::string_view, 10> kPatternNames{
    "off", "checker", "grid", "resolution", "ramp", "seam", "white", "grey", "black", "name"};
inline constexpr std::size_t kPatternCount = kPatternNames.size();

}  // namespace skyig::render
