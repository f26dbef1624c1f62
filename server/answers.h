// What the image generator says to its host: Start of Frame at the start of each frame, in the host's
// version.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "config/config.h"
#include "protocol/cigi/session.h"
#include "protocol/transport/endpoint.h"
#include "server/world/state.h"

namespace skyig::server {

class Answers {
  public:
    /// \param host  says where answers go
    explicit Answers(const config::Host& host);

    /// The message that opens the next frame; call it once a frame, host or no host. The bytes stay until the
    /// next call. \param start_ns  when the frame starts, any steady clock; \param late  the frame before
    /// took too long (4.0 tells the host)
    [[nodiscard]] std::span<const std::byte> open_frame(protocol::cigi::Session& session,
                                                        std::int64_t start_ns, bool late) noexcept;

    /// To the host: the configured address, else the one that is obeyed or was last. To any other source in
    /// control: whoever speaks for it. Nothing before the first, and nothing without a host.
    [[nodiscard]] std::optional<protocol::transport::Endpoint> destination(
        std::size_t source, const world::Link& link) const noexcept;

  private:
    std::optional<protocol::transport::Endpoint> reply_to_;
    std::array<std::byte, 64> buffer_{};
};

}  // namespace skyig::server
