#include "render/channel_pictures.h"

#include <algorithm>
#include <stdexcept>

namespace skyig::render {

ChannelPictures::ChannelPictures(std::span<const Channel> channels, gl::PixelFormat format)
    : drawn_(channels.begin(), channels.end()), places_(channels.size()), format_(format) {
    const auto own = static_cast<std::size_t>(std::count_if(
        channels.begin(), channels.end(), [](const Channel& channel) { return !channel.elsewhere; }));
    std::size_t failed = 0;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        places_[i].width_px = channels[i].width_px;
        places_[i].height_px = channels[i].height_px;
        if (channels[i].elsewhere) continue;
        try {
            picture(i);
        } catch (const std::runtime_error&) {
            if (++failed == own) throw;
        }
    }
}

gl::Framebuffer& ChannelPictures::picture(std::size_t channel) {
    Place& place = places_[channel];
    if (!place.picture) place.picture.emplace(place.width_px, place.height_px, format_);
    return *place.picture;
}

void ChannelPictures::take(const Scene& scene) {
    view_count_ = std::min(places_.size(), scene.view_count);
    for (std::size_t i = 0; i < view_count_; ++i) {
        Place& place = places_[i];
        views_[i] = scene.views[i];
        place.drawn = drawn_view(place.width_px, place.height_px, views_[i]);
        views_[i].frustum = place.drawn.frustum;
        drawn_[i].width_px = place.drawn.width_px;
        drawn_[i].height_px = place.drawn.height_px;
    }
}

void ChannelPictures::begin(std::size_t channel) {
    Place& place = places_[channel];
    gl::Framebuffer& whole = picture(channel);
    if (views_[channel].showing.plain()) {
        whole.bind();
        return;
    }
    const DrawnView& drawn = place.drawn;
    const bool fits = place.canvas && place.canvas->width_px() == drawn.width_px &&
                      place.canvas->height_px() == drawn.height_px;
    if (!fits) place.canvas.emplace(drawn.width_px, drawn.height_px, format_);
    place.canvas->bind();
}

void ChannelPictures::finish(std::size_t channel) {
    const Showing& showing = views_[channel].showing;
    if (showing.plain()) return;
    Place& place = places_[channel];
    place.canvas->copy_into(*place.picture, place.drawn.repeat_across, place.drawn.repeat_upright,
                            showing.mirrored_across, showing.mirrored_upright);
    place.picture->bind();
}

void ChannelPictures::cross_out(std::size_t channel) {
    if (channel < places_.size() && places_[channel].picture) places_[channel].picture->cross_out();
}

unsigned ChannelPictures::texture(std::size_t channel) const noexcept {
    return channel < places_.size() && places_[channel].picture ? places_[channel].picture->texture() : 0U;
}

void ChannelPictures::read_back(std::size_t channel, std::span<std::byte> rgba) {
    if (channel >= places_.size()) return;
    if (places_[channel].picture) {
        places_[channel].picture->read_rgba8(rgba);
        return;
    }
    constexpr std::array<std::byte, 4> kRed{std::byte{0xE6}, std::byte{0}, std::byte{0}, std::byte{0xFF}};
    for (std::size_t i = 0; i < rgba.size(); ++i)
        rgba[i] = kRed[i % kRed.size()];
}

void ChannelPictures::read_light(std::size_t channel, std::span<float> rgb) {
    if (channel < places_.size() && places_[channel].picture) places_[channel].picture->read_rgb32f(rgb);
}

}  // namespace skyig::render
