// The scene's overlay as it lies over one channel's picture.
#pragma once

#include <cstdint>

#include "render/channel.h"
#include "render/overlay/overlay.h"
#include "render/overlay/text_pass.h"

namespace skyig::render {

/// \param shown  which of its lines, as in ChannelView::overlay. Allocates nothing.
void write_overlay(TextPass& text, const Channel& channel, const Overlay& overlay, std::uint8_t shown,
                   double adaptation_cd_m2);

}  // namespace skyig::render
