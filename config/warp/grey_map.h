// A PNG file as one value a pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "config/warp/maps.h"

namespace skyig::config::warp {

/// Which part of a picture is the mask: its transparency if it has one, else its grey; or one of them.
enum class MaskPart : std::uint8_t { kEither, kAlpha, kGrey };

struct GreyMap {
    int width_px = 0;
    int height_px = 0;
    /// As the file has them, 0..1, rows from the lowest.
    std::vector<float> values;
};

/// Any PNG of 8 or 16 bits, sides up to 16384; of colours the mean of red, green and blue.
[[nodiscard]] FileRead<GreyMap> read_grey_map(std::span<const std::byte> bytes,
                                              MaskPart part = MaskPart::kEither);

/// The same over another number of pixels, bilinear between their middles.
[[nodiscard]] GreyMap stretched(const GreyMap& map, int width_px, int height_px);

}  // namespace skyig::config::warp
