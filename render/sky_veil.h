// What lights a frame's fog and lies before it: the sources of fog/veil.h out of the sky's own tables. Free
// of GL.
#pragma once

#include "render/fog/veil.h"
#include "render/scene.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

/// Sun and Moon through air and clouds above the veil's top, and the even light of their skies and of the
/// dark one there. Where the air's model follows one order of scattering alone, the sky is what `light` has
/// round the eye.
[[nodiscard]] fog::VeilSources veil_sources(const Scene& scene, const sky::AirTables& air,
                                            const SkyLight& light, double top_m) noexcept;

/// Of level ground that sends back all light, in the mean under clouds and fog: illuminance / pi.
[[nodiscard]] glm::dvec3 white_ground_cd_m2(const Scene& scene, const sky::AirTables& air,
                                            const SkyLight& light) noexcept;

/// What a property of the air or the ground is at the wavelengths next to those of linear red, green and
/// blue: 621, 558, 474 nm.
[[nodiscard]] glm::dvec3 rgb_of(const sky::Spectrum& spectrum) noexcept;

/// The air as seen from that height.
[[nodiscard]] shaders64::VeilAir front_air(const sky::AirModel& model, double eye_height_m) noexcept;

/// The veil of a frame, and when it shows otherwise than the frames before.
class SkyVeil {
  public:
    /// Gives the frame's light its veil; none where there are no obscurants. Allocates nothing. \param
    /// smallest  part of 1 or of the light that shows
    void lay(const Scene& scene, const sky::AirTables& air, double smallest, SkyLight& light) noexcept;

    [[nodiscard]] const fog::Veil& veil() const noexcept { return veil_; }
    /// Rises when the light bends elsewhere than it did.
    [[nodiscard]] std::uint64_t bends_revision() const noexcept { return bends_revision_; }

  private:
    fog::Veil veil_;
    fog::VeilMark shown_;
    fog::VeilMark bent_;
    std::uint64_t revision_ = 0;
    std::uint64_t bends_revision_ = 0;
};

}  // namespace skyig::render
