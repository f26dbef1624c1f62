// What the image generator says to its host: Start of Frame at the start of each frame, in the host's
// version, and behind it what the host has asked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "config/config.h"
#include "protocol/cigi/message.h"
#include "protocol/transport/endpoint.h"
#include "server/world/state.h"
#include "server/world/world.h"

namespace skyig::server {

class Answers {
  public:
    /// \param host  says where answers go
    explicit Answers(const config::Host& host);

    /// One message a frame, however much there is to say: what does not fit (one Ethernet frame, so that no
    /// router cuts it) waits for the next.
    static constexpr std::size_t kMostBytes = 1472;
    /// Requests that look through all regions, a frame: 20 microseconds each as a rule, a
    /// millisecond where 256 regions overlap.
    static constexpr int kMostSearches = 8;
    /// Image Generator Messages a frame.
    static constexpr int kMostMessages = 2;

    /// The message that opens the next frame; call it once a frame, host or no host. Start of Frame, then, in
    /// Operate and Debug, what the world's outbox holds: events, lines for the developer, answers to requests
    /// from the world as it stands. The bytes stay until the next call. \param start_ns  when the frame
    /// starts, any steady clock; \param late  the frame before took too long (4.0 tells the host)
    [[nodiscard]] std::span<const std::byte> open_frame(world::World& world, std::int64_t start_ns,
                                                        bool late);

    /// Packets sent behind Start of Frame, since the start.
    [[nodiscard]] std::uint64_t written() const noexcept { return written_; }

    /// To the host: the configured address, else the one that is obeyed or was last. To any other source in
    /// control: whoever speaks for it. Nothing before the first, and nothing without a host.
    [[nodiscard]] std::optional<protocol::transport::Endpoint> destination(
        std::size_t source, const world::Link& link) const noexcept;

  private:
    /// Each false when the message is full and there is more.
    bool write_events(world::Events& events, protocol::cigi::MessageWriter& writer) noexcept;
    bool write_messages(world::IgMessages& messages, protocol::cigi::MessageWriter& writer) noexcept;
    bool write_responses(world::World& world, protocol::cigi::MessageWriter& writer) noexcept;

    std::optional<protocol::transport::Endpoint> reply_to_;
    std::array<std::byte, kMostBytes> buffer_{};
    std::uint64_t written_ = 0;
};

}  // namespace skyig::server
