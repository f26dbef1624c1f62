// From the part of the sky that a layer is to cover to the value above which there is cloud.
#pragma once

#include <array>

#include "render/cloud/field/noise.h"
#include "render/cloud/field/shapes.h"

namespace skyig::render::cloud::field {

/// Measured once for each genus on the field itself: columns spread over the world, each with the threshold
/// at which it begins to hide what is behind it (opacity 0.5, or a quarter of what the layer has where that
/// is less). The part of the columns above a threshold is the coverage.
class Coverage {
  public:
    explicit Coverage(const Noise& noise);

    /// How a layer is drawn: through its height, or by one look at its flats.
    enum class Drawn : std::size_t { kVolume, kSheet };

    /// \param coverage  0..1: at 0 no column holds cloud, at 1 every one is full \param optical_depth  of the
    /// layer where it is full, > 0
    [[nodiscard]] float threshold(CloudGenus genus, double coverage, double optical_depth,
                                  Drawn drawn = Drawn::kVolume) const noexcept;

  private:
    static constexpr std::size_t kParts = 32;
    static constexpr std::array<double, 4> kDepths{1.0, 8.0, 64.0, 512.0};
    using Curve = std::array<float, kParts + 1>;
    using Curves = std::array<Curve, kDepths.size()>;
    std::array<std::array<Curves, kGenera>, 2> curves_{};
};

}  // namespace skyig::render::cloud::field
