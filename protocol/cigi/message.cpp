#include "protocol/cigi/message.h"

#include <algorithm>
#include <array>

namespace skyig::protocol::cigi {
namespace {

struct CountWords {
    std::string_view name;
    std::string_view text;
};

constexpr std::array<CountWords, kCounts> kCountWords{{
    {"short", "shorter than 24 bytes: a CIGI message begins with IG Control or Start of Frame"},
    {"first_packet", "does not begin with IG Control (host) or Start of Frame (image generator): not CIGI"},
    {"bad_version", "CIGI version not spoken here: use 3.2, 3.3 or 4.0"},
    {"bad_magic", "byte swap magic is neither order of 0x8000"},
    {"bad_size", "a packet states a size smaller than its own header; the rest of the message is lost"},
    {"truncated", "a packet reaches beyond the datagram; it is lost"},
    {"wrong_size", "a packet's size is not the one of its id"},
    {"skipped", "a packet of unknown id was passed over"},
    {"nonfinite", "a packet holds a NaN or an infinity"},
    {"out_of_range", "a packet holds a value out of its range"},
    {"clamped", "a percentage or corner radius was brought into its range"},
    {"duplicate_ig_control", "more than one IG Control in a message: the later ones are ignored"},
    {"duplicate_start_of_frame", "more than one Start of Frame in a message: the later ones are ignored"},
}};

}  // namespace

std::string_view count_name(Count count) noexcept {
    const auto index = static_cast<std::size_t>(count);
    return index < kCounts ? kCountWords[index].name : std::string_view("none");
}

std::string_view count_text(Count count) noexcept {
    const auto index = static_cast<std::size_t>(count);
    return index < kCounts ? kCountWords[index].text : std::string_view("no fault");
}

bool MessageWriter::add_raw(std::span<const std::byte> packet) noexcept {
    if (packet.size() > buffer_.size() - used_) return false;
    std::copy(packet.begin(), packet.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ += packet.size();
    return true;
}

}  // namespace skyig::protocol::cigi
