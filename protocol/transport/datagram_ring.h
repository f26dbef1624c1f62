// Ring of datagrams between one producer thread and one consumer thread: fixed storage, no locks, each
// datagram in one piece.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>

#include "protocol/transport/endpoint.h"

namespace skyig::protocol::transport {

struct Datagram {
    Endpoint from;
    /// The kernel's receive stamp: nanoseconds of CLOCK_REALTIME since 1970-01-01 UTC.
    std::int64_t arrival_ns = 0;
    std::span<const std::byte> bytes;
};

class DatagramRing {
  public:
    /// Capacity is the next power of two, 256 KiB at least (room for three of the largest datagrams).
    explicit DatagramRing(std::size_t capacity_bytes);

    [[nodiscard]] std::size_t capacity_bytes() const noexcept { return capacity_; }

    /// Producer: copies the datagram in. False if there is no room; nothing is then changed.
    [[nodiscard]] bool push(const Datagram& datagram) noexcept;

    /// Consumer: `take(const Datagram&)` for each one that was there when the call began.
    template <class Take>
    std::size_t drain(Take&& take, std::size_t most_bytes = std::numeric_limits<std::size_t>::max()) {
        const std::size_t end = written_.load(std::memory_order_acquire);
        std::size_t position = released_.load(std::memory_order_relaxed);
        const std::size_t start = position;
        std::size_t taken = 0;
        while (position != end && position - start < most_bytes) {
            const Record record = record_at(position);
            if (record.size != kSkipToStart) {
                const std::span<const std::byte> bytes(storage_.get() + offset(position) + sizeof(Record),
                                                       record.size);
                take(Datagram{record.from, record.arrival_ns, bytes});
                ++taken;
                position += record_bytes(record.size);
            } else {
                position += capacity_ - offset(position);
            }
            released_.store(position, std::memory_order_release);
        }
        return taken;
    }

    /// Consumer: nothing waits.
    [[nodiscard]] bool empty() const noexcept {
        return released_.load(std::memory_order_relaxed) == written_.load(std::memory_order_acquire);
    }

  private:
    struct Record {
        std::int64_t arrival_ns;
        Endpoint from;
        std::uint32_t size;
        std::uint32_t reserved;
    };
    static_assert(sizeof(Record) % 8 == 0);
    static constexpr std::uint32_t kSkipToStart = 0xFFFFFFFFU;
    static constexpr std::size_t kCacheLine = 64;

    [[nodiscard]] static constexpr std::size_t record_bytes(std::size_t size) noexcept {
        return (sizeof(Record) + size + 7) & ~std::size_t{7};
    }
    [[nodiscard]] std::size_t offset(std::size_t position) const noexcept {
        return position & (capacity_ - 1);
    }
    /// Less than a whole record may be left before the end: that much is always skipped.
    [[nodiscard]] Record record_at(std::size_t position) const noexcept {
        Record record{};
        record.size = kSkipToStart;
        if (capacity_ - offset(position) >= sizeof(Record)) {
            std::memcpy(&record, storage_.get() + offset(position), sizeof(record));
        }
        return record;
    }

    // Both count bytes since the start and never wrap in practice; each is written by one side only and has
    // its own line.
    alignas(kCacheLine) std::atomic<std::size_t> written_{0};
    std::size_t capacity_;
    std::unique_ptr<std::byte[]> storage_;
    alignas(kCacheLine) std::atomic<std::size_t> released_{0};
};

}  // namespace skyig::protocol::transport
