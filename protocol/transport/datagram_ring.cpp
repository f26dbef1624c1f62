#include "protocol/transport/datagram_ring.h"

#include <algorithm>
#include <bit>

namespace skyig::protocol::transport {
namespace {

constexpr std::size_t kSmallestRing = std::size_t{256} << 10U;

}  // namespace

DatagramRing::DatagramRing(std::size_t capacity_bytes)
    : capacity_(std::bit_ceil(std::max(capacity_bytes, kSmallestRing))), storage_(new std::byte[capacity_]) {}

bool DatagramRing::push(const Datagram& datagram) noexcept {
    const std::size_t released = released_.load(std::memory_order_acquire);
    std::size_t position = written_.load(std::memory_order_relaxed);
    const std::size_t size = record_bytes(datagram.bytes.size());
    const std::size_t to_end = capacity_ - offset(position);
    const std::size_t skipped = to_end < size ? to_end : 0;
    if (size + skipped > capacity_ - (position - released)) return false;

    if (skipped > 0) {
        if (to_end >= sizeof(Record)) {
            const Record skip{0, {}, kSkipToStart, 0};
            std::memcpy(storage_.get() + offset(position), &skip, sizeof(skip));
        }
        position += skipped;
    }
    const Record record{datagram.arrival_ns, datagram.from, static_cast<std::uint32_t>(datagram.bytes.size()),
                        0};
    std::byte* place = storage_.get() + offset(position);
    std::memcpy(place, &record, sizeof(record));
    std::copy(datagram.bytes.begin(), datagram.bytes.end(), place + sizeof(record));
    written_.store(position + size, std::memory_order_release);
    return true;
}

}  // namespace skyig::protocol::transport
