// What is written beside a test pattern: the channel's name, and the angles at a grid's lines.
#pragma once

#include "render/channel.h"
#include "render/overlay/text_pass.h"

namespace skyig::render {

/// As it stands in the channel's finished picture. Allocates nothing.
void write_pattern_text(TextPass& text, const Channel& channel, const ChannelView& view);

}  // namespace skyig::render
