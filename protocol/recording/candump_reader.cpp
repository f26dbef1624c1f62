#include "protocol/recording/candump_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "protocol/recording/candump.h"

namespace skyig::protocol::recording {
namespace {

/// With room for comments; a frame's line is far shorter.
constexpr std::size_t kMostLineBytes = CandumpReader::kHeadBytes;

std::string_view as_text(std::span<const std::byte> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool CandumpReader::recognises(std::span<const std::byte> head) noexcept {
    // Comments begin many files: the first line that is none decides.
    bool commented = false;
    for (std::string_view ahead = as_text(head); !ahead.empty();) {
        const std::size_t end = ahead.find('\n');
        const std::string_view line = ahead.substr(0, end);
        if (!is_blank_or_comment(line)) return line.front() == '(';
        commented = commented || line.find('#') != std::string_view::npos;
        ahead.remove_prefix(end == std::string_view::npos ? ahead.size() : end + 1);
    }
    return commented;
}

Step CandumpReader::next(ByteWindow& window, RawPacket& packet, Trouble& trouble) {
    if (!begun_) {
        begun_ = true;
        return Step::kOther;
    }
    const std::uint64_t offset = window.offset();
    const std::string_view ahead = as_text(window.peek(kMostLineBytes));
    if (ahead.empty()) return Step::kEnd;
    const std::size_t end = ahead.find('\n');
    const bool ended = end != std::string_view::npos;
    ++lines_;
    if (!ended && ahead.size() == kMostLineBytes) {
        trouble = {offset, fmt::format("line {}: longer than {} characters", lines_, kMostLineBytes)};
        return Step::kDamaged;
    }
    const std::string_view line = ahead.substr(0, end);
    trouble.offset_bytes = offset;
    packet.offset_bytes = offset;
    const Step step = take_line(line, ended, packet, trouble);
    if (step == Step::kPacket || step == Step::kOther) window.skip(line.size() + (ended ? 1U : 0U));
    return step;
}

Step CandumpReader::take_line(std::string_view line, bool ended, RawPacket& packet, Trouble& trouble) {
    if (is_blank_or_comment(line)) return Step::kOther;
    const auto parsed = parse_candump(line);
    if (!parsed) {
        trouble.text = fmt::format("line {}, column {}: {}", lines_, parsed.error().column,
                                   candump_fault_text(parsed.error().fault));
        return ended ? Step::kDamaged : Step::kTruncated;
    }
    frame_ = parsed->frame;
    if (frame_.fd) frame_.fd_flags = fd_flags_from(frame_.fd_flags);
    packet.time_ns = frame_.received_ns;
    packet.stamped = true;
    packet.interface = interface_of(parsed->interface);
    packet.origin = &interfaces_[packet.interface];
    packet.bytes = {};
    packet.original_bytes = 0;
    packet.comment = {};
    packet.frame = &frame_;
    return Step::kPacket;
}

std::uint32_t CandumpReader::interface_of(std::string_view name) {
    const auto found =
        std::find_if(interfaces_.begin(), interfaces_.end(),
                     [name](const CaptureInterface& interface) { return interface.name == name; });
    if (found != interfaces_.end()) return static_cast<std::uint32_t>(found - interfaces_.begin());
    CaptureInterface made;
    made.link_type = link_type::kSocketCan;
    made.unit.exponent = 9;
    made.bus = static_cast<std::uint8_t>(
        std::min<std::size_t>(interfaces_.size(), std::numeric_limits<std::uint8_t>::max()));
    made.name = name;
    interfaces_.push_back(std::move(made));
    return static_cast<std::uint32_t>(interfaces_.size() - 1);
}

}  // namespace skyig::protocol::recording
