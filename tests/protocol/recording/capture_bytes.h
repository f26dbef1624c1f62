// Captures and packets put together byte by byte, in either order, without the code under test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/byte_order.h"

namespace skyig::protocol::recording {

using ByteVector = std::vector<std::byte>;

/// A time whose every digit counts.
inline constexpr std::int64_t kTime_ns = 1'718'978'566'123'456'789;

struct Builder {
    explicit Builder(ByteOrder file_order) : order(file_order) {}

    template <class T>
    Builder& put(T value) {
        bytes.resize(bytes.size() + sizeof(T));
        store(bytes.data() + bytes.size() - sizeof(T), order, value);
        return *this;
    }
    Builder& u8(unsigned value) { return put(static_cast<std::uint8_t>(value)); }
    Builder& u16(unsigned value) { return put(static_cast<std::uint16_t>(value)); }
    Builder& u32(std::uint32_t value) { return put(value); }
    Builder& u64(std::uint64_t value) { return put(value); }
    Builder& raw(std::span<const std::byte> more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
        return *this;
    }
    Builder& text(std::string_view more) { return raw(std::as_bytes(std::span(more))); }
    Builder& pad() {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return *this;
    }
    Builder& option(unsigned code, std::string_view value) {
        return u16(code).u16(static_cast<unsigned>(value.size())).text(value).pad();
    }

    /// A whole block round `body`, which is padded.
    Builder& block(std::uint32_t type, const Builder& body) {
        Builder inside = body;
        inside.pad();
        const auto length = static_cast<std::uint32_t>(inside.bytes.size() + 12);
        return u32(type).u32(length).raw(inside.bytes).u32(length);
    }
    [[nodiscard]] Builder body() const { return Builder(order); }

    Builder& section(std::string_view comment = {}) {
        Builder inside = body().u32(0x1A2B3C4D).u16(1).u16(0).u64(~std::uint64_t{0});
        if (!comment.empty()) inside.option(1, comment).u32(0);
        return block(0x0A0D0D0A, inside);
    }
    /// if_tsresol 0xFF: left out
    Builder& interface(unsigned link_type, unsigned resolution = 0xFF, std::int64_t offset_s = 0,
                       std::uint32_t snap_length = 0) {
        Builder inside = body().u16(link_type).u16(0).u32(snap_length);
        if (resolution != 0xFF) inside.u16(9).u16(1).u8(resolution).pad();
        if (offset_s != 0) inside.u16(14).u16(8).u64(static_cast<std::uint64_t>(offset_s));
        return block(1, inside.u32(0));
    }
    Builder& packet(std::uint32_t interface_id, std::uint64_t ticks, std::span<const std::byte> data,
                    std::string_view comment = {}, std::size_t original = 0) {
        Builder inside = body()
                             .u32(interface_id)
                             .u32(static_cast<std::uint32_t>(ticks >> 32U))
                             .u32(static_cast<std::uint32_t>(ticks & 0xFFFF'FFFFU))
                             .u32(static_cast<std::uint32_t>(data.size()))
                             .u32(static_cast<std::uint32_t>(original == 0 ? data.size() : original))
                             .raw(data)
                             .pad();
        if (!comment.empty()) inside.option(1, comment).u32(0);
        return block(6, inside);
    }
    Builder& pcap_header(std::uint32_t magic, std::uint32_t link_type) {
        return u32(magic).u16(2).u16(4).u32(0).u32(0).u32(65'535).u32(link_type);
    }
    Builder& pcap_record(std::uint32_t seconds, std::uint32_t fraction, std::span<const std::byte> data,
                         std::size_t original = 0) {
        return u32(seconds)
            .u32(fraction)
            .u32(static_cast<std::uint32_t>(data.size()))
            .u32(static_cast<std::uint32_t>(original == 0 ? data.size() : original))
            .raw(data);
    }

    ByteOrder order;
    ByteVector bytes;
};

inline Builder big_endian() {
    return Builder(ByteOrder::kBig);
}

/// 10.0.0.1:1000 to 10.0.0.2:2000; `fragment` is the word of flags and offset.
inline ByteVector ipv4_udp(std::string_view payload, unsigned fragment = 0, unsigned protocol = 17) {
    const auto udp_bytes = static_cast<unsigned>(payload.size() + 8);
    return big_endian()
        .u16(0x4500)
        .u16(udp_bytes + 20)
        .u16(7)
        .u16(fragment)
        .u8(64)
        .u8(protocol)
        .u16(0)
        .u32(0x0A000001)
        .u32(0x0A000002)
        .u16(1000)
        .u16(2000)
        .u16(udp_bytes)
        .u16(0)
        .text(payload)
        .bytes;
}

/// SocketCAN's frame with its flags in `word`.
inline ByteVector can_bytes(std::uint32_t word, std::string_view data, unsigned fd_flags = 0,
                            ByteOrder order = ByteOrder::kBig) {
    return Builder(order)
        .u32(word)
        .u8(static_cast<unsigned>(data.size()))
        .u8(fd_flags)
        .u16(0)
        .text(data)
        .bytes;
}

inline std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace skyig::protocol::recording
