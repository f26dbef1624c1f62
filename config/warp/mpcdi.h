// MPCDI 1.0 (VESA, Multiple Projector Common Data Interchange, 2013): a ZIP archive with mpcdi.xml, warps as
// PFM, blends as PNG. Of its profiles the 3-D simulation one ("3d", a frustum and a warp in it for each
// region) and the 2-D one ("2d", parts of one picture) are read. Places in a PFM are parts of the region,
// right and up from its lower left corner; nodes stand in the middle of their share of the projector's
// picture. Angles are degrees: yaw right, then pitch up, then roll right.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "config/warp/bytes.h"
#include "config/warp/maps.h"

namespace skyig::config::warp {

/// What of one region concerns a channel.
struct MpcdiRegion {
    int width_px = 0;
    int height_px = 0;
    /// Of profile "3d": signed half angles to the left, right, bottom and top, each within
    /// kMaxHalfAngle_deg; yaw, pitch, roll.
    struct View {
        std::array<double, 4> sides_deg{};
        std::array<double, 3> attitude_deg{};
    };
    std::optional<View> view;
    /// Of profile "2d": its part of the whole picture: left, bottom, width, height, each 0..1.
    std::array<double, 4> part{0.0, 0.0, 1.0, 1.0};
    std::optional<WarpMesh> warp;
    std::optional<BlendMask> blend;
};

/// \param region  its id; empty: the only one that there is
[[nodiscard]] FileRead<MpcdiRegion> read_mpcdi(Bytes archive, const std::string& region);

}  // namespace skyig::config::warp
