// What makes a message of a rig its own: a tag by the rig's key over all that it says.
#pragma once

#include <cstdint>

#include "server/rig/messages.h"
#include "server/rig/tag.h"

namespace skyig::server::rig {

/// Of all members but `tag`, SipHash-2-4. A message of one kind never passes for one of another.
[[nodiscard]] std::uint64_t seal_of(const Key& key, const FrameMessage& message) noexcept;
[[nodiscard]] std::uint64_t seal_of(const Key& key, const ShowMessage& message) noexcept;
[[nodiscard]] std::uint64_t seal_of(const Key& key, const NodeMessage& message) noexcept;

template <class Message>
void seal(const Key& key, Message& message) noexcept {
    message.tag = seal_of(key, message);
}

template <class Message>
[[nodiscard]] bool is_sealed(const Key& key, const Message& message) noexcept {
    return message.tag == seal_of(key, message);
}

}  // namespace skyig::server::rig
