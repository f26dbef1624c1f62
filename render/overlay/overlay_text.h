// The scene's overlay as it lies over one channel's picture.
#pragma once

#include <cstdint>

#include "render/channel.h"
#include "render/overlay/overlay.h"
#include "render/overlay/text_pass.h"

namespace skyig::render {

/// \param shown  which of its lines, as in ChannelView::overlay \param code  of the text, as text_code() has
/// it. Allocates nothing.
void write_overlay(TextPass& text, const Channel& channel, const Overlay& overlay, std::uint8_t shown,
                   double code);

}  // namespace skyig::render
