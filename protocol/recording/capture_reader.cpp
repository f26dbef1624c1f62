#include "protocol/recording/capture_reader.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "protocol/recording/pcapng_blocks.h"

namespace skyig::protocol::recording {
namespace {

std::string located(const std::string& name, const Trouble& trouble) {
    return fmt::format("{}: byte {}: {}", name, trouble.offset_bytes, trouble.text);
}

std::string unknown_head(std::span<const std::byte> head) {
    if (head.empty()) return "empty; a pcapng or pcap capture or a candump log is read";
    constexpr std::byte kGzip[] = {std::byte{0x1F}, std::byte{0x8B}};
    if (head.size() >= 2 && head[0] == kGzip[0] && head[1] == kGzip[1])
        return "compressed with gzip; unpack it first (gunzip)";
    std::string hex;
    for (const std::byte each : head)
        hex += fmt::format("{:02X} ", static_cast<unsigned>(each));
    return fmt::format(
        "{}is the head of no capture; pcapng begins with 0A 0D 0D 0A, pcap with A1 B2 C3 D4 or "
        "A1 B2 3C 4D or their reverse, a candump log with a time stamp in round brackets",
        hex);
}

std::uint64_t& counter_of(CaptureCounters& counters, Contents contents) noexcept {
    switch (contents) {
        case Contents::kUdp:
            return counters.udp;
        case Contents::kCan:
            return counters.can;
        case Contents::kFragment:
            return counters.fragments;
        case Contents::kIpv6:
            return counters.ipv6;
        case Contents::kOtherProtocol:
            return counters.other_protocols;
        case Contents::kUnknownLink:
            return counters.unknown_link;
        case Contents::kCutShort:
            return counters.cut_short;
        case Contents::kMalformed:
            break;
    }
    return counters.malformed;
}

}  // namespace

CaptureReader::CaptureReader(ByteWindow window, Format format, std::string name) noexcept
    : window_(std::move(window)), format_(std::move(format)), name_(std::move(name)) {}

Result<CaptureReader, std::string> CaptureReader::open(const std::string& path) {
    auto window = ByteWindow::open(path);
    if (!window) return Error{window.error()};
    return begin(std::move(*window), path == "-" ? "standard input" : path);
}

Result<CaptureReader, std::string> CaptureReader::over(std::span<const std::byte> bytes, std::string name) {
    return begin(ByteWindow::over(bytes), std::move(name));
}

Result<CaptureReader, std::string> CaptureReader::begin(ByteWindow window, std::string name) {
    const auto head = window.peek(4);
    Format format;
    if (PcapReader::recognises(head)) {
        format.emplace<PcapReader>();
    } else if (head.size() < 4 || load<std::uint32_t>(head.data(), kNativeOrder) != pcapng::block::kSection) {
        // Looked for last: text asks for a longer look than a pipe may have to give at once.
        if (!CandumpReader::recognises(window.peek(CandumpReader::kHeadBytes)))
            return Error{located(name, {0, unknown_head(window.peek(4))})};
        format.emplace<CandumpReader>();
    }
    CaptureReader reader(std::move(window), std::move(format), std::move(name));
    const Step first = reader.step();
    if (first != Step::kOther) {
        reader.finish(first);
        return Error{reader.trouble_};
    }
    return reader;
}

Step CaptureReader::step() {
    return std::visit([this](auto& format) { return format.next(window_, raw_, found_); }, format_);
}

const CapturedPacket* CaptureReader::next() {
    while (end_ == End::kNotYet) {
        switch (const Step now = step()) {
            case Step::kPacket:
                ++counters_.packets;
                if (take_packet()) return &packet_;
                break;
            case Step::kOversized:
                ++counters_.packets;
                ++counters_.oversized;
                break;
            case Step::kOther:
                break;
            case Step::kEnd:
            case Step::kTruncated:
            case Step::kDamaged:
                finish(now);
                break;
        }
    }
    return nullptr;
}

Contents CaptureReader::take_contents() noexcept {
    if (raw_.frame != nullptr) {
        packet_.kind = CapturedPacket::Kind::kCan;
        packet_.can = *raw_.frame;
        return Contents::kCan;
    }
    const bool whole = raw_.bytes.size() >= raw_.original_bytes;
    return take_apart(raw_.origin->link_type, raw_.bytes, whole, raw_.file_order, packet_);
}

/// Brings the raw packet into `packet_`; false if it is none for us.
bool CaptureReader::take_packet() noexcept {
    const Contents contents = take_contents();
    ++counter_of(counters_, contents);
    if (contents != Contents::kUdp && contents != Contents::kCan) return false;
    packet_.stamped = raw_.stamped;
    packet_.time_ns = raw_.time_ns;
    packet_.comment = raw_.comment;
    packet_.interface = raw_.interface;
    packet_.number = counters_.packets;
    packet_.offset_bytes = raw_.offset_bytes;
    if (contents == Contents::kCan) {
        packet_.payload = {};
        packet_.can.received_ns = raw_.time_ns;
        packet_.can.bus = raw_.origin->bus;
    }
    return true;
}

void CaptureReader::finish(Step last) {
    end_ = last == Step::kEnd ? End::kComplete : last == Step::kTruncated ? End::kTruncated : End::kDamaged;
    if (window_.read_error() != 0) {
        end_ = End::kDamaged;
        found_ = {window_.offset(), std::generic_category().message(window_.read_error())};
    }
    if (end_ != End::kComplete) trouble_ = located(name_, found_);
}

std::span<const CaptureInterface> CaptureReader::interfaces() const noexcept {
    return std::visit([](const auto& format) { return format.interfaces(); }, format_);
}

const CaptureInterface& CaptureReader::interface_of_last() const noexcept {
    const auto* sections = std::get_if<PcapngReader>(&format_);
    return interfaces()[packet_.interface - (sections == nullptr ? 0 : sections->first_interface())];
}

std::string_view CaptureReader::section_comment() const noexcept {
    const auto* sections = std::get_if<PcapngReader>(&format_);
    return sections == nullptr ? std::string_view() : sections->section_comment();
}

}  // namespace skyig::protocol::recording
