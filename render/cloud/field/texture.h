// A picture that a sheet of cloud is made of, in place of noise: it repeats over the ground.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace skyig::render::cloud::field {

/// Entries of square slices of texels, `size` on a side, that repeat: each holds a texel and its next
/// neighbours along x, y and both, lowest byte first, so that one fetch serves a bilinear look-up.
[[nodiscard]] std::vector<std::uint32_t> packed(std::span<const std::uint8_t> bytes, std::size_t size);

/// With all its halvings down to one texel, so that what is far is its mean. Kept in 255ths.
class Texture {
  public:
    static constexpr int kLeastSide = 16;
    static constexpr int kMostSide = 2048;
    static constexpr std::size_t kMostLevels = 12;

    /// \param side  a power of two, kLeastSide..kMostSide \param values  0..1, rows from the southernmost,
    /// each from west to east
    Texture(int side, std::span<const float> values);

    [[nodiscard]] int side() const noexcept { return 1 << side_log2_; }
    [[nodiscard]] int side_log2() const noexcept { return side_log2_; }
    /// Of all levels, the finest first.
    [[nodiscard]] std::span<const std::uint32_t> entries() const noexcept { return entries_; }
    /// Where each level begins in them.
    [[nodiscard]] std::span<const std::uint32_t> starts() const noexcept { return starts_; }

  private:
    int side_log2_ = 0;
    std::vector<std::uint32_t> entries_;
    std::array<std::uint32_t, kMostLevels> starts_{};
};

}  // namespace skyig::render::cloud::field
