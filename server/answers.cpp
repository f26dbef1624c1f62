#include "server/answers.h"

#include <variant>

#include "protocol/cigi/message.h"
#include "server/world/responder.h"

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

std::span<const std::byte> Answers::open_frame(world::World& world, std::int64_t start_ns, bool late) {
    cigi::Session& session = world.session();
    cigi::StartOfFrame start_of_frame = session.next_frame(static_cast<std::uint32_t>(start_ns / kTickNs));
    start_of_frame.overframing = late;
    start_of_frame.earth_model = world.earth().custom;
    cigi::MessageWriter writer(buffer_, session.version(), cigi::Session::order());
    // It always fits: 24 bytes in both versions.
    (void)writer.add(start_of_frame);
    if (session.mode() != cigi::IgMode::kOperate && session.mode() != cigi::IgMode::kDebug)
        return writer.bytes();

    world::Outbox& outbox = world.outbox();
    outbox.requests.next_frame();
    if (write_events(outbox.events, writer) && write_messages(outbox.messages, writer) &&
        write_responses(world, writer))
        return writer.bytes();
    // 4.0 tells the host that there is more to say than fits.
    start_of_frame.excess_variable_data = true;
    cigi::MessageWriter again(buffer_, session.version(), cigi::Session::order());
    (void)again.add(start_of_frame);
    return writer.bytes();
}

bool Answers::write_events(world::Events& events, cigi::MessageWriter& writer) noexcept {
    for (; !events.empty(); events.pop()) {
        if (!writer.add(events.front())) return false;
        ++written_;
    }
    return true;
}

bool Answers::write_messages(world::IgMessages& messages, cigi::MessageWriter& writer) noexcept {
    for (int count = 0; count < kMostMessages && !messages.empty(); ++count, messages.pop()) {
        const world::IgMessages::Line& line = messages.front();
        if (!writer.add(cigi::IgMessage{static_cast<std::uint16_t>(line.matter), line.text()})) return false;
        ++written_;
    }
    return true;
}

bool Answers::write_responses(world::World& world, cigi::MessageWriter& writer) noexcept {
    world::Outbox& outbox = world.outbox();
    for (int searches = 0;;) {
        for (; !outbox.responses.empty(); outbox.responses.pop()) {
            const auto add = [&writer](const auto& response) { return writer.add(response); };
            if (!std::visit(add, outbox.responses.front())) return false;
            ++written_;
        }
        if (outbox.requests.empty()) return true;
        const world::Request& request = outbox.requests.front();
        if (world::searches_regions(world, request) && ++searches > kMostSearches) return false;
        world::respond(world, request, outbox.responses);
        outbox.requests.pop();
    }
}

std::optional<transport::Endpoint> Answers::destination(std::size_t source,
                                                        const world::Link& link) const noexcept {
    if (source == 0 && reply_to_) return reply_to_;
    if (link.state == world::LinkState::kWaiting) return std::nullopt;
    return link.host;
}

}  // namespace skyig::server
