// Any bytes as a message in either direction: no read outside them, nothing but finite numbers delivered, and
// what is written from a decoded packet reads back.
#include <array>
#include <cmath>
#include <cstdlib>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/message.h"

namespace skyig::protocol::cigi {
namespace {

struct Check {
    template <class P>
    void operator()(const P& packet, const PacketInfo& info) {
        visit_fields(packet, info.version, [](std::string_view /*name*/, const auto& value) {
            if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>) {
                if (!std::isfinite(value)) std::abort();
            }
        });
        MessageWriter writer(buffer, info.version, info.order);
        if (!writer.add(packet)) return;  // only a text can be longer than the buffer
        P again;
        if (!read_packet(writer.bytes(), info.version, info.order, again)) std::abort();
    }

    std::array<std::byte, 4096> buffer{};
};

}  // namespace
}  // namespace skyig::protocol::cigi

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::cigi;
    const auto bytes = std::as_bytes(std::span(data, size));
    Check check;
    Counters counters;
    static_cast<void>(decode_host_message(bytes, check, counters));
    static_cast<void>(decode_ig_message(bytes, check, counters));
    const auto ignore = [](const auto& /*packet*/) {};
    static_cast<void>(decode_host_message(bytes, ignore, counters, Validation::kOff));
    return 0;
}
