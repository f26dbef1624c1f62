#include "protocol/cigi/message.h"

#include <algorithm>
#include <array>

namespace skyig::protocol::cigi {
namespace {

// Both directions begin with a packet of 24 bytes; 3.x carries the magic at byte 6.
constexpr std::size_t kFirstPacketBytes = 24;
constexpr unsigned kOldFirstPacketBytes = 16;  // IG Control and Start of Frame of 3.0 and 3.1
constexpr std::size_t kMagicOffset = 6;
constexpr unsigned kMajor33 = 3;
constexpr unsigned kMajor40 = 4;

MessageSummary dropped(Count fault, std::uint32_t offset) noexcept {
    MessageSummary summary;
    summary.fault = fault;
    summary.offset = offset;
    return summary;
}

MessageSummary accepted(Version version, ByteOrder order, std::size_t size) noexcept {
    MessageSummary summary;
    summary.accepted = true;
    summary.version = version;
    summary.order = order;
    summary.offset = static_cast<std::uint32_t>(size);
    return summary;
}

/// The order in which a 4.0 header says 24 bytes and `id40`; none if it says something else.
std::optional<ByteOrder> order_of_40(std::span<const std::byte> bytes, std::uint16_t id40) noexcept {
    for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
        const PacketHeader header = read_header(bytes.data(), Version::k40, order);
        if (header.size == kFirstPacketBytes && header.id == id40) return order;
    }
    return std::nullopt;
}

/// The first packet has the 3.x id. `size` and `major` are its bytes 1 and 2.
MessageSummary detect_33(std::span<const std::byte> bytes, unsigned size, unsigned major) noexcept {
    const bool older = major == 1 || major == 2 || (major == kMajor33 && size == kOldFirstPacketBytes);
    if (older || (size == kFirstPacketBytes && major != kMajor33)) return dropped(Count::kBadVersion, 2);
    if (size != kFirstPacketBytes) return dropped(Count::kFirstPacket, 0);
    for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
        if (load<std::uint16_t>(bytes.data() + kMagicOffset, order) == kByteSwapMagic) {
            return accepted(Version::k33, order, bytes.size());
        }
    }
    return dropped(Count::kBadMagic, kMagicOffset);
}

MessageSummary detect(std::span<const std::byte> bytes, unsigned id33, std::uint16_t id40) noexcept {
    if (bytes.size() < kFirstPacketBytes)
        return dropped(Count::kShort, static_cast<std::uint32_t>(bytes.size()));
    const auto octet = [&bytes](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
    if (const std::optional<ByteOrder> order = order_of_40(bytes, id40)) {
        if (octet(4) != kMajor40) return dropped(Count::kBadVersion, 4);
        return accepted(Version::k40, *order, bytes.size());
    }
    if (octet(0) == id33) return detect_33(bytes, octet(1), octet(2));
    return dropped(Count::kFirstPacket, 0);
}

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

MessageSummary detect_host_message(std::span<const std::byte> bytes) noexcept {
    return detect(bytes, 1, 0x0000);
}

MessageSummary detect_ig_message(std::span<const std::byte> bytes) noexcept {
    return detect(bytes, 101, 0xFFFF);
}

namespace detail {

bool PacketWalk::next(PacketInfo& info) noexcept {
    const std::size_t left = bytes_.size() - offset_;
    if (left == 0) return false;
    const std::size_t header_size = header_bytes(summary_.version);
    const auto stop = [this](Count fault) {
        summary_.fault = fault;
        summary_.offset = static_cast<std::uint32_t>(offset_);
        return false;
    };
    if (left < header_size) return stop(Count::kTruncated);
    const PacketHeader header = read_header(bytes_.data() + offset_, summary_.version, summary_.order);
    if (header.size < header_size) return stop(Count::kBadSize);
    if (header.size > left) return stop(Count::kTruncated);
    info = {summary_.version, summary_.order, header.id, static_cast<std::uint32_t>(offset_),
            bytes_.subspan(offset_, header.size)};
    offset_ += header.size;
    return true;
}

}  // namespace detail

bool MessageWriter::add_raw(std::span<const std::byte> packet) noexcept {
    if (packet.size() > buffer_.size() - used_) return false;
    std::copy(packet.begin(), packet.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ += packet.size();
    return true;
}

}  // namespace skyig::protocol::cigi
