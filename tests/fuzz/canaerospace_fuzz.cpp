// Any sequence of frames on one bus. Sixteen bytes a frame: identifier with the flags of SocketCAN
// (little-endian), length, bit 0: CAN FD, milliseconds since the frame before (little-endian), eight bytes of
// data.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <span>

#include "protocol/canaerospace/receiver.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::size_t kRecordBytes = 16;

CanFrame frame_of(std::span<const std::uint8_t> record, std::int64_t& now_ns) {
    const auto byte = [&record](std::size_t i) { return std::uint32_t{record[i]}; };
    const std::uint32_t id = byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
    now_ns += std::int64_t{byte(6) | byte(7) << 8} * 1'000'000;
    CanFrame frame;
    frame.received_ns = now_ns;
    frame.extended = (id >> 31 & 1U) != 0;
    frame.remote = (id >> 30 & 1U) != 0;
    frame.error = (id >> 29 & 1U) != 0;
    frame.id = id & (frame.extended || frame.error ? kMaxExtendedId : kMaxStandardId);
    frame.length = record[4];
    frame.fd = (record[5] & 1U) != 0;
    std::memcpy(frame.data.data(), &record[8], kClassicBytes);
    return frame;
}

void check(const Reception& reception, const Receiver& receiver, std::int64_t now_ns) {
    const bool accepted = reception.reading.reason == Reason::kNone;
    if (reception.published && (!accepted || reception.reading.message.entry == nullptr)) std::abort();
    if (!std::isfinite(reception.reading.value.number) || !std::isfinite(reception.update.value))
        std::abort();
    const std::optional<BusTime> time = receiver.clock().at(now_ns);
    if (time && !(time->second_of_day >= 0.0 && time->second_of_day < 86'401.0)) std::abort();
}

}  // namespace
}  // namespace skyig::protocol::canaerospace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::canaerospace;
    Receiver receiver;
    std::int64_t now_ns = 0;
    for (std::span<const std::uint8_t> rest(data, size); rest.size() >= kRecordBytes;
         rest = rest.subspan(kRecordBytes))
        check(receiver.receive(frame_of(rest.first(kRecordBytes), now_ns)), receiver, now_ns);
    return 0;
}
