#include "clients/instructor/sha1.h"

#include <bit>
#include <cstddef>
#include <string>

namespace skyig::clients::instructor {

namespace {

using State = std::array<std::uint32_t, 5>;
constexpr std::size_t kBlockBytes = 64;

struct Round {
    std::uint32_t mixed = 0;
    std::uint32_t constant = 0;
};

Round round(std::size_t t, const State& s) noexcept {
    if (t < 20) return {(s[1] & s[2]) | (~s[1] & s[3]), 0x5A827999U};
    if (t < 40) return {s[1] ^ s[2] ^ s[3], 0x6ED9EBA1U};
    if (t < 60) return {(s[1] & s[2]) | (s[1] & s[3]) | (s[2] & s[3]), 0x8F1BBCDCU};
    return {s[1] ^ s[2] ^ s[3], 0xCA62C1D6U};
}

void take_block(std::string_view block, State& state) noexcept {
    std::array<std::uint32_t, 80> words{};
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t byte = 0; byte < 4; ++byte)
            words[t] = words[t] << 8U | static_cast<std::uint8_t>(block[4 * t + byte]);
    for (std::size_t t = 16; t < words.size(); ++t)
        words[t] = std::rotl(words[t - 3] ^ words[t - 8] ^ words[t - 14] ^ words[t - 16], 1);
    State s = state;
    for (std::size_t t = 0; t < words.size(); ++t) {
        const Round now = round(t, s);
        const std::uint32_t next = std::rotl(s[0], 5) + now.mixed + s[4] + now.constant + words[t];
        s = {next, s[0], std::rotl(s[1], 30), s[2], s[3]};
    }
    for (std::size_t i = 0; i < state.size(); ++i)
        state[i] += s[i];
}

}  // namespace

std::array<std::uint8_t, 20> sha1(std::string_view bytes) {
    std::string padded(bytes);
    padded += '\x80';
    while (padded.size() % kBlockBytes != kBlockBytes - 8)
        padded += '\0';
    const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
    for (int shift = 56; shift >= 0; shift -= 8)
        padded += static_cast<char>(bits >> static_cast<unsigned>(shift) & 0xFFU);
    State state{0x67452301U, 0xEFCDAB89U, 0x98BADCFEU, 0x10325476U, 0xC3D2E1F0U};
    for (std::size_t at = 0; at < padded.size(); at += kBlockBytes)
        take_block(std::string_view(padded).substr(at, kBlockBytes), state);
    std::array<std::uint8_t, 20> digest{};
    for (std::size_t i = 0; i < digest.size(); ++i)
        digest[i] = static_cast<std::uint8_t>(state[i / 4] >> (24U - 8U * static_cast<unsigned>(i % 4)));
    return digest;
}

}  // namespace skyig::clients::instructor
