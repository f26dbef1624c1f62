// The discs of Sun and Moon: exact per pixel, in each channel.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky/air_tables.h"
#include "render/sky_light.h"

namespace skyig::render {

/// Uniforms of shaders/eye/tone.glsl in one program.
class ToneUniforms {
  public:
    /// \param all  false for programs that only encode
    ToneUniforms(const gl::Program& program, bool all);
    void set(const gl::Program& program, const shaders32::ToneParameters& tone) const;

  private:
    int log2_gain_ = -1, exponent_ = -1, photopic_ = -1, inv_display_max_ = -1, encode_power_ = -1;
};

/// What a disc's pass knows of the frame, whatever the channel.
struct DiscFrame {
    glm::vec3 centre_enu{0.0F};
    glm::vec3 right_enu{0.0F};
    glm::vec3 up_enu{0.0F};
    float radius = 0.0F;     ///< tangent of the angular radius
    float pixel_rad = 0.0F;  ///< softening of edges
    float horizon_rad = 0.0F;
    glm::vec3 background_cd_m2{0.0F};  ///< of the sky at the centre,
    glm::vec3 background_right{0.0F};  ///< and what it gains over one radius
    glm::vec3 background_up{0.0F};
};

/// Axes of a disc about its centre: up is towards the zenith, right completes them as the viewer sees it.
[[nodiscard]] DiscFrame disc_frame(const glm::dvec3& centre_enu, double angular_radius_rad, double pixel_rad,
                                   const SkyLight& light) noexcept;

/// The program and the square that a disc is drawn with, and the uniforms that both discs have.
class DiscPass {
  public:
    /// \param fragment  shader of the disc
    /// \throws std::runtime_error when the program cannot be made
    explicit DiscPass(std::string_view fragment);

    void prepare(const DiscFrame& frame, const shaders32::ToneParameters& tone, bool dither) const;
    void draw(const glm::mat4& clip_from_enu) const;

    [[nodiscard]] const gl::Program& program() const noexcept { return program_; }

  private:
    gl::Program program_;
    gl::Mesh square_;
    ToneUniforms tone_;
    int clip_, centre_, right_, up_, extent_, radius_, pixel_, horizon_sin_, horizon_cos_, background_,
        background_right_, background_up_, dither_;
};

class SunDisc {
  public:
    SunDisc();
    void prepare(const Scene& scene, const sky::AirTables& air, const SkyLight& light, double pixel_rad,
                 const shaders32::ToneParameters& tone, bool dither) const;
    void draw(const glm::mat4& clip_from_enu) const { pass_.draw(clip_from_enu); }

  private:
    DiscPass pass_;
    int disc_, limb_;
};

class MoonDisc {
  public:
    MoonDisc();
    void prepare(const Scene& scene, const sky::AirTables& air, const SkyLight& light, double pixel_rad,
                 const shaders32::ToneParameters& tone, bool dither) const;
    void draw(const glm::mat4& clip_from_enu) const { pass_.draw(clip_from_enu); }

  private:
    DiscPass pass_;
    int face_, earthshine_, to_sun_;
};

}  // namespace skyig::render
