#include "server/answers.h"

#include "protocol/cigi/message.h"

namespace skyig::server {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;

namespace {

/// CIGI's time stamps count 10 microseconds.
constexpr std::int64_t kTickNs = 10'000;

std::optional<transport::Endpoint> endpoint(const std::optional<config::UdpAddress>& address) {
    if (!address) return std::nullopt;
    const auto ipv4 = transport::parse_ipv4(address->address);
    if (!ipv4) return std::nullopt;
    return transport::Endpoint{*ipv4, address->port};
}

}  // namespace

Answers::Answers(const config::Host& host)
    : reply_to_(host.enabled ? endpoint(host.reply_to) : std::nullopt) {}

std::span<const std::byte> Answers::open_frame(cigi::Session& session, std::int64_t start_ns,
                                               bool late) noexcept {
    cigi::StartOfFrame start_of_frame = session.next_frame(static_cast<std::uint32_t>(start_ns / kTickNs));
    start_of_frame.overframing = late;
    cigi::MessageWriter writer(buffer_, session.version(), cigi::Session::order());
    // It always fits: 24 bytes in both versions.
    (void)writer.add(start_of_frame);
    return writer.bytes();
}

std::optional<transport::Endpoint> Answers::destination(std::size_t source,
                                                        const world::Link& link) const noexcept {
    if (source == 0 && reply_to_) return reply_to_;
    if (link.state == world::LinkState::kWaiting) return std::nullopt;
    return link.host;
}

}  // namespace skyig::server
