#include "server/rig/tag.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace skyig::server::rig {

namespace {

constexpr std::size_t kHexDigits = 32;

/// The four words of state and their round.
struct Words {
    std::uint64_t a, b, c, d;

    void round() noexcept {
        a += b, b = std::rotl(b, 13) ^ a, a = std::rotl(a, 32);
        c += d, d = std::rotl(d, 16) ^ c;
        a += d, d = std::rotl(d, 21) ^ a;
        c += b, b = std::rotl(b, 17) ^ c, c = std::rotl(c, 32);
    }
    void take(std::uint64_t word) noexcept {
        d ^= word;
        round();
        round();
        a ^= word;
    }
};

std::uint64_t little_endian(std::span<const std::byte> bytes) noexcept {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        word |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    return word;
}

}  // namespace

std::uint64_t siphash(const Key& key, std::span<const std::byte> bytes) noexcept {
    // The paper's words that begin it: "somepseudorandomlygeneratedbytes".
    Words words{key[0] ^ 0x736f6d6570736575U, key[1] ^ 0x646f72616e646f6dU, key[0] ^ 0x6c7967656e657261U,
                key[1] ^ 0x7465646279746573U};
    const std::uint64_t length = bytes.size();
    for (; bytes.size() >= sizeof(std::uint64_t); bytes = bytes.subspan(sizeof(std::uint64_t)))
        words.take(little_endian(bytes.first(sizeof(std::uint64_t))));
    words.take(length << 56U | little_endian(bytes));
    words.c ^= 0xFF;
    for (int i = 0; i < 4; ++i)
        words.round();
    return words.a ^ words.b ^ words.c ^ words.d;
}

protocol::Result<Key, std::string> parse_key(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kSpace);
    text = first == text.npos ? std::string_view{}
                              : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
    const bool hex = text.find_first_not_of("0123456789abcdefABCDEF") == text.npos;
    if (text.size() != kHexDigits || !hex) {
        return protocol::Error{
            fmt::format("holds {}{} characters; it must hold {} hexadecimal digits, as "
                        "\"openssl rand -hex 16\" writes them",
                        text.size(), hex ? "" : " other", kHexDigits)};
    }
    std::array<std::byte, kHexDigits / 2> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        unsigned value = 0;
        std::from_chars(text.data() + 2 * i, text.data() + 2 * i + 2, value, 16);
        bytes[i] = static_cast<std::byte>(value);
    }
    const std::span all(bytes);
    return Key{little_endian(all.first<8>()), little_endian(all.last<8>())};
}

protocol::Result<Key, std::string> read_key(const std::string& path) {
    std::ifstream file(path);
    if (!file) {
        return protocol::Error{
            fmt::format("{}: the rig's key cannot be read ({}); it must hold 32 hexadecimal digits, "
                        "the same on all machines",
                        path, std::strerror(errno))};
    }
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    auto key = parse_key(text);
    if (!key) return protocol::Error{fmt::format("{}: {}", path, key.error())};
    return key;
}

bool is_open_to_all(const std::string& path) noexcept {
    namespace fs = std::filesystem;
    std::error_code none;
    const fs::perms may = fs::status(path, none).permissions();
    return !none && (may & fs::perms::others_read) != fs::perms::none;
}

}  // namespace skyig::server::rig
