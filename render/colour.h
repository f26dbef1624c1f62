// Linear Rec.709 with D65 white, the colour space of the frame buffer, from CIE 1931 XYZ. Y of XYZ is
// luminance.
#pragma once

#include <glm/glm.hpp>

namespace skyig::render {

/// Inverse of the Rec.709 primaries matrix (ITU-R BT.709-6, table 1), columns are what X, Y and Z contribute.
inline constexpr glm::dmat3 kRec709FromXyz{3.2404541621,  -0.9692660305, 0.0556434310,   //
                                           -1.5371385128, 1.8760108454,  -0.2040259135,  //
                                           -0.4985314096, 0.0415560175,  1.0572251882};

[[nodiscard]] inline glm::vec3 rec709_from_xyz(const glm::vec3& xyz) noexcept {
    return glm::mat3(kRec709FromXyz) * xyz;
}

/// The same primaries the other way.
inline constexpr glm::dmat3 kXyzFromRec709{0.4124564391, 0.2126728514, 0.0193338956,  //
                                           0.3575760776, 0.7151521553, 0.1191920259,  //
                                           0.1804374833, 0.0721749934, 0.9503040785};

[[nodiscard]] inline glm::vec3 xyz_from_rec709(const glm::vec3& rgb) noexcept {
    return glm::mat3(kXyzFromRec709) * rgb;
}

}  // namespace skyig::render
