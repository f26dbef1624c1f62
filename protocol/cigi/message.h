// One datagram, read and written. Version and byte order are found anew in every datagram; packets go to the
// handler in their order; nothing is allocated, nothing throws, nothing outside `bytes` is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "protocol/cigi/codec.h"
#include "protocol/cigi/counters.h"
#include "protocol/cigi/detect.h"
#include "protocol/cigi/packet_list.h"
#include "protocol/cigi/validate.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

enum class Validation : bool { kOff, kOn };

/// Where a packet stood; second argument of a handler that wants it.
struct PacketInfo {
    Version version = Version::k33;
    ByteOrder order = kNativeOrder;
    std::uint16_t id = 0;
    std::uint32_t offset = 0;          // of the packet's first byte in the datagram
    std::span<const std::byte> bytes;  // the packet with its header
};

/// A known packet that was not handed on. `field` is empty if the fault is no field's.
struct RefusedPacket {
    std::size_t kind = 0;  // index in AllPackets
    Count reason = Count::kOutOfRange;
    std::string_view field;
};

namespace detail {

/// Goes from packet to packet of an accepted datagram by the stated sizes.
class PacketWalk {
  public:
    PacketWalk(std::span<const std::byte> bytes, MessageSummary& summary) noexcept
        : bytes_(bytes), summary_(summary) {}
    /// False at the end; a fault is then in the summary.
    [[nodiscard]] bool next(PacketInfo& info) noexcept {
        const std::size_t left = bytes_.size() - offset_;
        if (left == 0) return false;
        const std::size_t header_size = header_bytes(summary_.version);
        if (left < header_size) return stop(Count::kTruncated);
        const PacketHeader header = read_header(bytes_.data() + offset_, summary_.version, summary_.order);
        if (header.size < header_size) return stop(Count::kBadSize);
        if (header.size > left) return stop(Count::kTruncated);
        info = {summary_.version, summary_.order, header.id, static_cast<std::uint32_t>(offset_),
                bytes_.subspan(offset_, header.size)};
        offset_ += header.size;
        return true;
    }

  private:
    [[nodiscard]] bool stop(Count fault) noexcept {
        summary_.fault = fault;
        summary_.offset = static_cast<std::uint32_t>(offset_);
        return false;
    }

    std::span<const std::byte> bytes_;
    MessageSummary& summary_;
    std::size_t offset_ = 0;
};

template <class Handler, class P>
void deliver(Handler& handler, const P& packet, const PacketInfo& info) {
    if constexpr (std::is_invocable_v<Handler&, const P&, const PacketInfo&>) {
        handler(packet, info);
    } else if constexpr (std::is_invocable_v<Handler&, const P&>) {
        handler(packet);
    }
}

template <class Handler>
void pass_over(Handler& handler, std::size_t kind, Count reason, const PacketInfo& info, Counters& counters) {
    ++counters[reason];
    if constexpr (requires { handler.passed_over(RefusedPacket{}, info); }) {
        handler.passed_over(RefusedPacket{kind, reason, {}}, info);
    }
}

template <class P, class Handler>
void decode_packet(const PacketInfo& info, Handler& handler, Counters& counters, Validation validation) {
    P packet;
    Verdict verdict;
    const bool read = validation == Validation::kOn
                          ? read_valid(info.bytes, info.version, info.order, packet, verdict)
                          : read_packet(info.bytes, info.version, info.order, packet);
    if (!read) {
        pass_over(handler, kPacketKind<P>, Count::kWrongSize, info, counters);
        return;
    }
    if (!verdict.accepted) {
        ++counters[verdict.reason];
        if constexpr (requires { handler.refused(RefusedPacket{}, info); }) {
            handler.refused(RefusedPacket{kPacketKind<P>, verdict.reason, verdict.field}, info);
        }
        return;
    }
    if (verdict.clamped) ++counters[Count::kClamped];
    ++counters.packets[kPacketKind<P>];
    deliver(handler, packet, info);
}

/// Decodes a packet whose kind is First + one of I.
template <std::size_t First, class Handler, std::size_t... I>
void decode_kind(std::size_t kind, const PacketInfo& info, Handler& handler, Counters& counters,
                 Validation validation, std::index_sequence<I...> /*kinds*/) {
    using Decode = void (*)(const PacketInfo&, Handler&, Counters&, Validation);
    static constexpr Decode kDecode[] = {
        &decode_packet<std::tuple_element_t<First + I, AllPackets>, Handler>...};
    kDecode[kind - First](info, handler, counters, validation);
}

template <std::size_t First, std::size_t Kinds, class Handler, class KindOf>
MessageSummary decode_message(std::span<const std::byte> bytes, const FirstPacket& first, Handler& handler,
                              Counters& counters, Validation validation, Count duplicate, KindOf kind_of_id) {
    MessageSummary summary;
    detect(bytes, first, summary);
    if (!summary.accepted) {
        ++counters[summary.fault.value_or(Count::kFirstPacket)];
        return summary;
    }
    ++counters.messages;
    PacketWalk walk(bytes, summary);
    PacketInfo info;
    while (walk.next(info)) {
        const std::size_t kind = kind_of_id(info.version, info.id);
        if (kind == kPacketKinds) {
            ++counters[Count::kSkipped];
            if constexpr (requires { handler.skipped(info); }) handler.skipped(info);
        } else if (kind == First && info.offset != 0) {
            // Of another size it is not even a second one.
            const bool whole = info.bytes.size() == kFirstPacketBytes;
            pass_over(handler, kind, whole ? duplicate : Count::kWrongSize, info, counters);
        } else {
            decode_kind<First>(kind, info, handler, counters, validation, std::make_index_sequence<Kinds>{});
        }
    }
    if (summary.fault) ++counters[*summary.fault];
    return summary;
}

}  // namespace detail

/// Reads a host-to-IG datagram. For each good packet P calls `handler(const P&, const PacketInfo&)` or
/// `handler(const P&)`, whichever exists; a kind without overload is counted and passed over. If the handler
/// has them, `handler.skipped(const PacketInfo&)` gets the unknown ids and `handler.refused(const
/// RefusedPacket&, const PacketInfo&)` those that validation refused, `handler.passed_over(...)` those of a
/// wrong size and a second IG Control. IG Control, if it is good, comes first and only once.
template <class Handler>
MessageSummary decode_host_message(std::span<const std::byte> bytes, Handler&& handler, Counters& counters,
                                   Validation validation = Validation::kOn) {
    return detail::decode_message<0, kHostPacketKinds>(bytes, detail::kFromHost, handler, counters,
                                                       validation, Count::kDuplicateIgControl,
                                                       host_packet_kind);
}

/// Reads an IG-to-host datagram in the same way; Start of Frame comes first.
template <class Handler>
MessageSummary decode_ig_message(std::span<const std::byte> bytes, Handler&& handler, Counters& counters,
                                 Validation validation = Validation::kOn) {
    return detail::decode_message<kHostPacketKinds, kPacketKinds - kHostPacketKinds>(
        bytes, detail::kFromIg, handler, counters, validation, Count::kDuplicateStartOfFrame, ig_packet_kind);
}

/// Builds a message in the caller's buffer. The caller adds IG Control or Start of Frame first.
class MessageWriter {
  public:
    MessageWriter(std::span<std::byte> buffer, Version version, ByteOrder order) noexcept
        : buffer_(buffer.first(buffer.size() < kMaxMessageBytes ? buffer.size() : kMaxMessageBytes)),
          version_(version),
          order_(order) {}

    /// Appends a packet. False, and nothing is written, if there is no room or the version has no such
    /// packet.
    template <class P>
    [[nodiscard]] bool add(const P& packet) noexcept {
        const std::size_t size = packet_bytes(packet, version_);
        if (size == 0 || size > buffer_.size() - used_) return false;
        write_packet(packet, version_, order_, buffer_.data() + used_);
        used_ += size;
        return true;
    }
    /// Appends a packet that is bytes already, header included (user-defined ids).
    [[nodiscard]] bool add_raw(std::span<const std::byte> packet) noexcept;

    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return buffer_.first(used_); }
    void clear() noexcept { used_ = 0; }
    [[nodiscard]] Version version() const noexcept { return version_; }
    [[nodiscard]] ByteOrder order() const noexcept { return order_; }

  private:
    std::span<std::byte> buffer_;
    Version version_;
    ByteOrder order_;
    std::size_t used_ = 0;
};

}  // namespace skyig::protocol::cigi
