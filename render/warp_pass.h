// What the passes need to draw into warped channels, and the warp of finished flat pictures.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/gl/uniform_block.h"

namespace skyig::render {

/// Of all programs of a rig: those of one without a warp do nothing for it.
[[nodiscard]] gl::Placement placement_of(std::span<const Channel> channels) noexcept;

/// The flat picture of a channel that is resampled.
[[nodiscard]] Channel flat_picture_of(const Channel& channel);

class WarpPass {
  public:
    /// \throws std::runtime_error when a texture cannot be made
    explicit WarpPass(std::span<const Channel> channels);

    /// Until the next call everything is drawn as that channel shows it, or flat.
    void bind(std::size_t channel) const;
    void bind_flat() const;

    /// What of a channel's flat picture may show, with a fiftieth to spare for edges drawn straight.
    [[nodiscard]] glm::dmat4 shown_from_clip(std::size_t channel) const noexcept;

    /// Draws a finished flat picture as that channel shows it, over all of the framebuffer that is bound.
    /// The first call makes the program and may throw.
    void resample(std::size_t channel, const gl::Framebuffer& picture);

  private:
    struct Bound {
        gl::Texture nodes;
        gl::UniformBlock block;
    };
    struct Resampling {
        gl::Program program;
        std::vector<std::optional<gl::Mesh>> screens;  // by channel
    };
    void make_resampling();

    std::span<const Channel> channels_;
    std::optional<Bound> flat_;                 // in rigs that have a warp
    std::vector<std::optional<Bound>> warped_;  // by channel
    std::optional<Resampling> resampling_;
};

}  // namespace skyig::render
