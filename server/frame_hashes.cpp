#include "server/frame_hashes.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace skyig::server {

std::uint64_t hash_of(std::span<const std::byte> bytes) noexcept {
    constexpr std::uint64_t kPrime = 0x100000001B3U;
    std::uint64_t hash = 0xCBF29CE484222325U;
    const auto mix = [&hash](std::uint64_t word) { hash = (hash ^ word) * kPrime; };
    while (bytes.size() >= sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), sizeof(word));
        mix(word);
        // The product carries upwards only: what the high bits know is brought down.
        hash ^= hash >> 32U;
        bytes = bytes.subspan(sizeof(word));
    }
    for (const std::byte byte : bytes)
        mix(std::to_integer<std::uint64_t>(byte));
    return hash;
}

FrameHashes::FrameHashes(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {
    if (!file_)
        throw std::runtime_error(
            fmt::format("{}: cannot be made for hashes: {}", path, std::strerror(errno)));
}

void FrameHashes::add(std::uint64_t frame, std::string_view channel,
                      std::span<const std::byte> rgba) noexcept {
    std::array<char, 96> line{};
    const auto end =
        fmt::format_to_n(line.data(), line.size(), "{} {} {:016x}\n", frame, channel, hash_of(rgba));
    std::fwrite(line.data(), 1, std::min(end.size, line.size()), file_.get());
}

bool FrameHashes::finish() noexcept {
    return std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
}

}  // namespace skyig::server
