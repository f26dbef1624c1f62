// The stars and planets of one frame: turned, lifted and dimmed by the air, sorted out, ready to draw for all
// channels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky_frame.h"

namespace skyig::render {

/// As the vertex shader night/star.vert takes it.
struct StarVertex {
    glm::vec3 direction_enu;     ///< as it is seen, when the stars were last turned
    glm::vec3 illuminance_lux;   ///< linear Rec.709, behind the air, of what the eye sees of it
    glm::vec3 background_cd_m2;  ///< linear Rec.709, of the sky behind the star
};

/// Standard deviation of a star's footprint in pixels, along both axes of every channel.
inline constexpr double kStarSigma_px = 0.7;

/// V magnitude of a star that, outside the air, adds half a display code to its brightest pixel before a
/// background of this luminance; fainter ones change no picture. Where the background is shown darker than
/// the screen's own black, the star has that to pass first; minus infinity where the screen can add none.
[[nodiscard]] double half_code_mag(double background_cd_m2, const shaders64::ToneParameters& tone,
                                   double pixel_sr) noexcept;

/// Part of a point that the eye sees: 0 below kFaintestSeen of the threshold before its background, 1 as far
/// above it.
[[nodiscard]] float seen_share(float illuminance_lux, float background_cd_m2) noexcept;

class StarField {
  public:
    /// Allocates for the whole catalogue and the planets.
    StarField();

    /// Follows the frame. Light, air and refraction of every star are worked out anew only when something has
    /// changed by what could show: the sky by 0.5 %, directions by a tenth of a pixel (until then one
    /// rotation serves all stars: enu_from_update()), the eye's height by sky::height_is_stale(). Annual
    /// aberration of stars: direction + velocity / c, normalised (second order neglected: 0.001 arcsec).
    /// Refraction is interpolated: within 3 arcsec of the frame's row up to FL600. \param pixel_rad  the
    /// finest pixel of the rig \return how many of stars(), from the first on, have changed
    std::size_t update(const Scene& scene, const SkyFrame& frame, double pixel_rad);

    [[nodiscard]] std::span<const StarVertex> stars() const noexcept { return {stars_.data(), count_}; }
    /// What has turned all stars since their directions were written.
    [[nodiscard]] const glm::dmat3& enu_from_update() const noexcept { return enu_from_update_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return stars_.size(); }

  private:
    struct Frame;
    /// What the air does to a point of light, over airless elevation.
    struct Air {
        glm::vec3 transmittance;
        float lift;  ///< over the cosine of the elevation
        float twinkle_rms;
    };
    struct Source {
        glm::vec3 direction_gcrs;  // J2000
        glm::vec3 motion_rad_per_yr;
        glm::vec3 illuminance_lux;
        float magnitude;
    };
    /// What add() needs of a star or planet besides its direction.
    struct Light {
        glm::vec3 illuminance_lux;
        float twinkle;  ///< factor on the air's flicker, 0: none shows
        std::uint32_t source;
    };
    /// Of a star that flickers.
    struct Twinkle {
        glm::vec3 illuminance_lux;
        float rms;
        std::uint32_t source;
    };
    /// What the vertices were made of.
    struct Made {
        bool valid = false;
        std::uint64_t tables = 0;
        std::uint64_t air_in_use = 0;
        std::uint64_t veil = 0;
        glm::vec3 sun_scale{0.0F};
        glm::vec3 moon_scale{0.0F};
        double height_m = 0.0;
        double horizon_lift_rad = 0.0;  // by refraction, of what is seen on the horizon
        Stars stars;
        StarPlan plan;
        std::array<Planet, kPlanetCount> planets{};
        std::array<glm::dvec3, kPlanetCount> planets_gcrs{};
        glm::dvec3 moon_gcrs{0.0};
        double moon_radius_rad = 0.0;  // 0: switched off
    };

    [[nodiscard]] bool light_is_stale(const Made& now, double pixel_rad) const noexcept;
    [[nodiscard]] bool is_stale(const Made& now, double pixel_rad) const noexcept;
    [[nodiscard]] const glm::vec3& background(const glm::vec3& seen_enu, std::uint32_t source,
                                              const Frame& frame) noexcept;
    [[nodiscard]] static Made made_of(const Scene& scene, const SkyFrame& frame) noexcept;
    void tabulate_air(const SkyFrame& frame, double eye_height_m);
    [[nodiscard]] Air air_at(float sine, float lowest_sine) const noexcept;
    void rebuild(const Scene& scene, const SkyFrame& frame);
    void add(const glm::vec3& direction_enu, const Light& source, const Frame& frame) noexcept;
    void flicker(double time_s) noexcept;

    std::vector<Source> sources_;  // brightest first
    std::vector<StarVertex> stars_;
    std::vector<Twinkle> twinkles_;  // of the first stars_
    std::vector<Air> air_;
    /// Behind each source, worked out when the light changes and when the sky has turned by half a degree.
    struct Background {
        glm::vec3 cd_m2{0.0F};
        std::uint64_t made = 0;  // 0: never
    };
    std::vector<Background> backgrounds_;
    std::uint64_t backgrounds_due_ = 0;
    glm::dmat3 backgrounds_turn_{0.0};
    Made made_;
    std::size_t count_ = 0;
    std::size_t twinkling_ = 0;
    glm::dmat3 enu_from_update_{1.0};
};

}  // namespace skyig::render
