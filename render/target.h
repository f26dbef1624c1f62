// What a renderer's pixels hold.
#pragma once

#include <cstdint>

namespace skyig::render {

enum class Target : std::uint8_t {
    /// Display codes, 8 bits.
    kDisplay,
    /// Linear Rec.709, 32-bit floats: the light itself, without an eye. All stars are drawn.
    kLuminance,
    /// The same in 16-bit floats, times a power of two that follows the adaptation. \see eye/exposure.h
    kHalfLuminance,
};

}  // namespace skyig::render
