#include "server/rig/seal.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace skyig::server::rig {

namespace {

/// A message as the bytes that are sealed: every text behind its length, numbers little-endian.
class SealedBytes {
  public:
    explicit SealedBytes(char kind) noexcept { add(static_cast<std::uint64_t>(kind)); }

    SealedBytes& add(std::uint64_t number) noexcept {
        std::array<std::byte, sizeof(number)> bytes{};
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::byte>(number >> (8 * i));
        return put(bytes);
    }
    SealedBytes& add(std::string_view text) noexcept { return add_bytes(std::as_bytes(std::span{text})); }
    SealedBytes& add_bytes(std::span<const std::byte> bytes) noexcept { return add(bytes.size()).put(bytes); }
    SealedBytes& add(const Speaker& from) noexcept {
        return add(from.node).add(from.session).add(from.build).add(from.settings);
    }

    [[nodiscard]] std::uint64_t tag(const Key& key) const noexcept {
        return siphash(key, std::span{bytes_}.first(size_));
    }

  private:
    /// What is longer than any message that is sent is cut: its length is sealed all the same.
    SealedBytes& put(std::span<const std::byte> bytes) noexcept {
        const std::size_t fits = std::min(bytes.size(), bytes_.size() - size_);
        if (fits > 0) std::memcpy(bytes_.data() + size_, bytes.data(), fits);
        size_ += fits;
        return *this;
    }

    std::array<std::byte, kMostStateBytes + 1024> bytes_;
    std::size_t size_ = 0;
};

}  // namespace

std::uint64_t seal_of(const Key& key, const FrameMessage& message) noexcept {
    return SealedBytes('f')
        .add(message.from)
        .add(message.rank)
        .add(message.frame)
        .add_bytes(message.state)
        .tag(key);
}

std::uint64_t seal_of(const Key& key, const ShowMessage& message) noexcept {
    return SealedBytes('s').add(message.node).add(message.session).add(message.frame).tag(key);
}

std::uint64_t seal_of(const Key& key, const NodeMessage& message) noexcept {
    return SealedBytes('n')
        .add(message.from)
        .add(static_cast<std::uint64_t>(message.state))
        .add(message.leader)
        .add(message.leader_session)
        .add(message.drawn_frame)
        .add(static_cast<std::uint64_t>(message.drawing_ns))
        .add(message.repeats)
        .add(message.late)
        .add(message.gl)
        .add(message.gl_errors)
        .tag(key);
}

}  // namespace skyig::server::rig
