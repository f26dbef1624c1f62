// The pictures of a rig's channels, and how what is drawn becomes one: mirrored, repeated. \see Showing
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/gl/framebuffer.h"
#include "render/scene.h"

namespace skyig::render {

class ChannelPictures {
  public:
    /// \throws std::runtime_error when no channel's picture can be made. Those of which only some cannot are
    /// tried again when they are to be drawn.
    ChannelPictures(std::span<const Channel> channels, gl::PixelFormat format);

    /// Of the frame in hand. \param scene  its views are asked for
    void take(const Scene& scene);
    /// Channels with the pixels that are drawn of them, and the views through which.
    [[nodiscard]] std::span<const Channel> drawn() const noexcept { return drawn_; }
    [[nodiscard]] std::span<const ChannelView> views() const noexcept {
        return std::span(views_).first(view_count_);
    }
    [[nodiscard]] const Channel& drawn(std::size_t channel) const noexcept { return drawn_[channel]; }
    [[nodiscard]] const ChannelView& view(std::size_t channel) const noexcept { return views_[channel]; }

    /// A channel is drawn from now on. \throws std::runtime_error when what it is drawn on cannot be made
    void begin(std::size_t channel);
    /// What is drawn becomes the picture; draws onto that follow.
    void finish(std::size_t channel);

    /// Of a channel that is finished.
    [[nodiscard]] const gl::Framebuffer& whole(std::size_t channel) const noexcept {
        return *places_[channel].picture;
    }

    /// A red cross. Nothing where there is no picture.
    void cross_out(std::size_t channel);
    /// 0 where there is none.
    [[nodiscard]] unsigned texture(std::size_t channel) const noexcept;
    /// Top row first; red where there is none.
    void read_back(std::size_t channel, std::span<std::byte> rgba);
    /// As the picture holds it, top row first; left as it is where there is none.
    void read_light(std::size_t channel, std::span<float> rgb);

  private:
    gl::Framebuffer& picture(std::size_t channel);

    struct Place {
        int width_px = 0;
        int height_px = 0;
        std::optional<gl::Framebuffer> picture;
        /// What it is drawn on where that is not the picture itself.
        std::optional<gl::Framebuffer> canvas;
        DrawnView drawn;
    };
    std::vector<Channel> drawn_;
    std::array<ChannelView, kMaxChannels> views_{};
    std::size_t view_count_ = 0;
    std::vector<Place> places_;
    gl::PixelFormat format_;
};

}  // namespace skyig::render
