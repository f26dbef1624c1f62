// The noise that clouds are cut from: tiles made once from fixed seeds, so that every program has the same.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/weather.h"

namespace skyig::render::cloud::field {

/// What a flat tile looks like from above.
using Sheet = CloudNoise;
inline constexpr std::size_t kSheets = 4;

/// Tiles of bytes, periodic, as packed() has them. Values of a sheet are spread evenly over 0..255 (each is
/// a rank among all), so that the part of the area above a value is known.
class Noise {
  public:
    static constexpr int kSheetLog2 = 8;
    static constexpr int kSheetSize = 1 << kSheetLog2;
    static constexpr int kBlockLog2 = 5;
    static constexpr int kBlockSize = 1 << kBlockLog2;

    Noise();

    /// kSheetSize squared, rows of x.
    [[nodiscard]] std::span<const std::uint32_t> sheet(Sheet which) const noexcept {
        return sheets_[static_cast<std::size_t>(which)];
    }
    /// kBlockSize cubed, x fastest, z slowest: folded noise (billows), neighbours along x and y packed.
    [[nodiscard]] std::span<const std::uint32_t> block() const noexcept { return block_; }

  private:
    std::array<std::vector<std::uint32_t>, kSheets> sheets_;
    std::vector<std::uint32_t> block_;
};

}  // namespace skyig::render::cloud::field
