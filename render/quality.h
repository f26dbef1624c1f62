// The passes of a frame by name, and how far the picture may be off.
#pragma once

#include <bitset>
#include <cstddef>
#include <string_view>

namespace skyig::render {

enum class Pass {
    kAirTables,     ///< optical columns and multiple scattering of a new air
    kSunSky,        ///< direction table of sunlit air
    kMoonSky,       ///< direction table of moonlit air
    kNightSky,      ///< direction table of airglow, zodiacal light, even starlight, towns
    kVeil,          ///< light of fog, haze, dust and their like, on the dome's vertices
    kClouds,        ///< map of far clouds for all channels
    kNearClouds,    ///< map of clouds round the eye
    kCloudShadows,  ///< map of single clouds' shadows on the ground
    kDome,          ///< smooth light of all directions, toned at the vertices
    kWaves,         ///< waves of the sea, where pixels resolve them
    kMilkyWay,      ///< what the Milky Way adds to even starlight
    kStars,
    kCorona,  ///< what is left of the Sun in a total eclipse
    kSunDisc,
    kMoonDisc,
    kExposure,       ///< map from above of what falls on another renderer's things
    kCoveredThings,  ///< snow on them, and how water darkens them
    kWetThings,      ///< the sky in the film on things of another renderer
    kPrecipitation,  ///< streaks of what falls near the eye
    kSunGlare,       ///< the veil round the disc in the eye
    kMoonGlare,
    kWindscreen,  ///< drops on the panes of channels that have one
    kPattern,     ///< a test pattern in place of the sky
    kOverlay,     ///< texts over the picture
    kWarp,        ///< everything placed as a curved or turned screen shows it
    kResampling,  ///< the same of a finished flat picture, pixel by pixel
    kBlend,       ///< masks and black levels of projectors that overlap
};
inline constexpr std::size_t kPassCount = 27;

[[nodiscard]] std::string_view pass_name(Pass pass) noexcept;

/// What a frame may leave out where it would else take too long. The numbers stand in recordings: new ones
/// come last, and 1 to 3, of things that saved nothing, are not used again.
enum class Thin {
    kCloudRefresh = 0,   ///< the cloud map is renewed at a third of its pace
    kPrecipitation = 4,  ///< half the streaks, each the more opaque
    kWaves = 5,          ///< resolved waves of the sea
    kGlare = 6,          ///< the veils round Sun and Moon
    kMilkyWay = 7,       ///< its structure: even starlight stays
    kCloudTones = 8,     ///< what is seen of clouds follows light, eye and drift every third frame
    kCloudShadows = 9,   ///< single clouds' shadows on the ground: their mean stays
};
/// One more than the largest number.
inline constexpr std::size_t kThinCount = 10;
using Thinned = std::bitset<kThinCount>;

/// As the settings and the status write it: "cloud-refresh"; empty for a number that is not used.
[[nodiscard]] std::string_view thin_name(Thin thin) noexcept;

/// How far the picture may be off, and what is done for measurements.
struct Quality {
    /// Largest error that smooth light may have by being drawn coarser than pixel by pixel, 8-bit display
    /// codes, 0.1..8.
    double error_codes = 0.5;
    /// Texels on the side of a half of the cloud map, 512, 1024 or 2048; 0: by the rig's finest pixel.
    int cloud_map_size = 0;
    /// Of its tiles, what one frame follows anew, 1..256.
    int cloud_tiles_a_frame = 12;
    /// Passes that run even where they would not show. With Pass::kStars no star is too faint.
    std::bitset<kPassCount> forced;
    /// What is left out for the frame rate's sake.
    Thinned thinned;
};

/// Step of luminance from one code to the next at middle grey on a display of gamma 2.2, percent.
inline constexpr double kCode_pct = 1.7;

}  // namespace skyig::render
