// What the files of a warped and blended channel hold, as plain values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace skyig::config::warp {

/// Which place of the flat picture each node of the screen shows: parts of it, right and up from its lower
/// left corner; rows from the lowest.
struct WarpMesh {
    /// 2..kMostWarpNodes each.
    int columns = 0;
    int rows = 0;
    /// Whether the outer nodes stand on the screen's edges; else each in the middle of its share.
    bool at_edges = false;
    /// Each within -0.5..1.5; no cell folds over.
    std::vector<std::array<float, 2>> picture;
};
inline constexpr int kMostWarpNodes = 257;

/// One value for each pixel of the screen, 0..1, in linear light, rows from the lowest.
struct BlendMask {
    int width_px = 0;
    int height_px = 0;
    std::vector<float> weight;
    /// Parts of full white; one value stands for all.
    std::vector<float> lift{0.0F};
};

/// A value, or in one line without the file's name what is wrong.
template <class T>
struct FileRead {
    std::optional<T> value;
    std::string fault;
};

}  // namespace skyig::config::warp
