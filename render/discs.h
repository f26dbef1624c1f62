// The discs of Sun and Moon: exact per pixel, in each channel.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "render/disc_frame.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/glare.h"
#include "render/scene.h"
#include "render/shaders/shared.h"
#include "render/sky_frame.h"

namespace skyig::render {

/// Uniforms of shaders/eye/tone.glsl in one program.
class ToneUniforms {
  public:
    /// \param all  false for programs that only encode
    ToneUniforms(const gl::Program& program, bool all);
    void set(const gl::Program& program, const shaders32::ToneParameters& tone) const;

  private:
    int log2_gain_ = -1, exponent_ = -1, compression_ = -1, burn_ = -1, photopic_ = -1, inv_display_max_ = -1;
    int ambient_ = -1, shoulder_ = -1, encode_power_ = -1;
};

/// The program and the strip that a disc is drawn with, and the uniforms that all discs have.
class DiscPass {
  public:
    /// \param fragment  shader of the disc
    /// \param dithers  whether it has the uniform for it
    /// \throws std::runtime_error when the program cannot be made
    DiscPass(std::string_view fragment, gl::Placement placement, bool dithers);

    /// \param frame  before clouds stand in front of it
    void prepare(const SkyFrame& sky, DiscFrame frame, const shaders32::ToneParameters& tone, bool dither);
    /// Nothing where clouds hide it.
    void draw(const glm::mat4& clip_from_enu) const;

    [[nodiscard]] const gl::Program& program() const noexcept { return program_; }

  private:
    bool shows_ = true;
    gl::Program program_;
    gl::Mesh strip_;
    ToneUniforms tone_;
    int clip_, centre_, right_, up_, radius_, pixel_, horizon_sin_, horizon_cos_, background_,
        background_right_, background_up_, dither_;
};

class SunDisc {
  public:
    explicit SunDisc(gl::Placement placement);
    void prepare(const Scene& scene, const SkyFrame& frame, double pixel_rad,
                 const shaders32::ToneParameters& tone, bool dither);
    void draw(const glm::mat4& clip_from_enu) const { pass_.draw(clip_from_enu); }

  private:
    DiscPass pass_;
    int limb_;
};

/// Seen when the Moon covers the Sun; blended by adding.
class Corona {
  public:
    explicit Corona(gl::Placement placement);
    void prepare(const Scene& scene, const SkyFrame& frame, double pixel_rad,
                 const shaders32::ToneParameters& tone, double share);
    void draw(const glm::mat4& clip_from_enu) const { pass_.draw(clip_from_enu); }

  private:
    DiscPass pass_;
    int share_;
};

class MoonDisc {
  public:
    explicit MoonDisc(gl::Placement placement);
    /// \param fovea  the eye that looks at it; \param veil  its own glare
    void prepare(const Scene& scene, const SkyFrame& frame, double pixel_rad,
                 const shaders32::ToneParameters& tone, bool dither, const shaders64::Fovea& fovea,
                 const Glare::Limb& veil);
    void draw(const glm::mat4& clip_from_enu) const;

  private:
    DiscPass pass_;
    gl::Texture map_;
    int face_, earthshine_, mean_, veil_, to_sun_, shadow_axis_, shadow_radii_, selenographic_, map_level_,
        veil_own_, fovea_factor_, fovea_slope_;
};

}  // namespace skyig::render
