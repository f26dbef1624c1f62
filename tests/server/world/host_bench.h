// A world with hosts that speak to it in real datagrams, written and decoded by the protocol library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cigi/message.h"
#include "server/clock.h"
#include "server/world/world.h"

namespace skyig::server::world {

inline constexpr protocol::transport::Endpoint kHostA{0x7F000001, 40001};
inline constexpr protocol::transport::Endpoint kHostB{0x7F000001, 40002};

inline config::Config three_channels() {
    config::Config config = config::default_config();
    config.start.utc = config::UtcDateTime{2026, 6, 21, 12, 0, 0.0};
    config.channels.resize(3);
    const std::array<const char*, 3> names{"left", "centre", "right"};
    for (std::size_t i = 0; i < 3; ++i) {
        config.channels[i].name = names[i];
        config.channels[i].yaw_deg = -60.0 + 60.0 * static_cast<double>(i);
        config.channels[i].view_id = static_cast<int>(i) + 1;
    }
    return config;
}

inline ephemeris::UtcClockTime utc(std::string_view text) {
    return ephemeris::parse_utc(text).value_or(ephemeris::UtcClockTime{});
}

class HostBench {
  public:
    explicit HostBench(config::Config given = three_channels(),
                       const ephemeris::UtcClockTime& start = utc("2026-06-21T12:00:00Z"))
        : config(std::move(given)),
          log(clock, [this](Severity, std::string_view line) { lines.emplace_back(line); }),
          world(config, start, log) {}

    /// One message: IG Control and the packets given.
    template <class... Packets>
    protocol::cigi::MessageSummary send(const protocol::transport::Endpoint& from,
                                        const Packets&... packets) {
        protocol::cigi::IgControl control;
        control.ig_mode = mode;
        control.host_frame_number = ++frame;
        return send_as(from, control, packets...);
    }

    /// One message of exactly these packets.
    template <class... Packets>
    protocol::cigi::MessageSummary send_as(const protocol::transport::Endpoint& from,
                                           const Packets&... packets) {
        std::array<std::byte, 2048> buffer{};
        protocol::cigi::MessageWriter writer(buffer, version, protocol::cigi::ByteOrder::kBig);
        (static_cast<void>(writer.add(packets)), ...);
        world.begin_message(source, from);
        return protocol::cigi::decode_host_message(writer.bytes(), world, counters);
    }

    /// Sends a Component Control from host A.
    void control(protocol::cigi::ComponentClass component_class, int id, int instance, int state,
                 std::uint32_t data_1 = 0) {
        protocol::cigi::ComponentControl packet;
        packet.component_class = component_class;
        packet.component_id = static_cast<std::uint16_t>(id);
        packet.instance_id = static_cast<std::uint16_t>(instance);
        packet.component_state = static_cast<std::uint8_t>(state);
        packet.data_1 = data_1;
        send(kHostA, packet);
    }

    void wait(double seconds) {
        for (int i = 0; i < 100; ++i) {
            world.advance(seconds / 100.0);
            clock.advance_s(seconds / 100.0);
        }
    }

    [[nodiscard]] std::size_t lines_with(std::string_view text) const {
        std::size_t count = 0;
        for (const std::string& line : lines)
            count += line.find(text) != std::string::npos ? 1U : 0U;
        return count;
    }

    config::Config config;
    ManualClock clock;
    std::vector<std::string> lines;
    Log log;
    World world;
    protocol::cigi::Counters counters;
    protocol::cigi::Version version = protocol::cigi::Version::k33;
    protocol::cigi::IgMode mode = protocol::cigi::IgMode::kOperate;
    std::uint32_t frame = 0;
    /// Whose messages these are.
    std::size_t source = 0;
};

}  // namespace skyig::server::world
