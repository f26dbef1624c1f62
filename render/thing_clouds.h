// What the pass over another renderer's picture needs of clouds, as textures and uniforms of its program:
// those before and behind its things, fog's patches among them, and their shadows on them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/cloud_frame.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace skyig::render {

class ThingClouds {
  public:
    /// \throws std::runtime_error when the textures cannot be made
    explicit ThingClouds(const gl::Program& program);

    /// Once a frame, after CloudFrame::tone(). Larger textures are made with the first clouds.
    void prepare(const gl::Program& program, const CloudFrame& clouds, const GroundShadow& shadow);
    /// \param shaded  whether the clouds' shadows fall on things
    void bind(const gl::Program& program, bool shaded) const;

  private:
    void upload(const CloudFrame& clouds);
    void tell_patches(const gl::Program& program, const PatchColumns& patches);
    void tell_shadow(const gl::Program& program, const GroundShadow& shadow);

    int place_, shown_, shaded_, near_range_, eye_height_, source_, beam_, heights_, mean_, patch_heights_,
        patch_fog_;
    std::array<int, cloud::ShadowMap::kLevels> corners_;
    std::vector<gl::Texture> maps_;  // light, distance, near; none before there are clouds
    gl::Texture shadow_;
    gl::Texture patches_;
    std::uint64_t patches_revision_ = 0;
    std::uint64_t size_revision_ = 0;
    std::uint64_t shadow_revision_ = 0;
    bool shadow_told_ = false;
    bool clouds_told_ = false;
    int size_ = 0;
};

}  // namespace skyig::render
