// The test patterns that a channel may show, by name.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace skyig::config {

enum class Pattern : std::uint8_t {
    kOff,
    kChecker,
    kGrid,
    kResolution,
    kRamp,
    kSeam,
    kWhite,
    kGrey,
    kBlack,
    kName
};
inline constexpr std::array<std::string_view, 10> kPatternNames{
    "off", "checker", "grid", "resolution", "ramp", "seam", "white", "grey", "black", "name"};

}  // namespace skyig::config
