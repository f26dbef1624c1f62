#include "clients/skyig/decode_cigi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

#include "protocol/cigi/layout_host.h"
#include "protocol/cigi/layout_ig.h"
#include "protocol/cigi/layout_sight.h"
#include "protocol/cigi/message.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;

namespace {

template <class T>
CigiValue value_of(const T& value) {
    if constexpr (std::is_same_v<T, std::string_view>) {
        return std::string(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        return static_cast<double>(value);
    } else {
        return static_cast<std::int64_t>(value);
    }
}

/// Fills a CigiDatagram from the walk over the message.
class Collector {
  public:
    Collector(CigiDatagram& datagram, const cigi::Counters& counters)
        : datagram_(datagram), counters_(counters) {}

    template <class P>
    void operator()(const P& packet, const cigi::PacketInfo& info) {
        CigiPacket& out = datagram_.packets.emplace_back();
        out.name = cigi::Layout<P>::kName;
        out.offset = info.offset;
        out.clamped = counters_[cigi::Count::kClamped] > clamped_;
        clamped_ = counters_[cigi::Count::kClamped];
        // Validation has emptied what does not count: the packet as it came says whether it was a number.
        P raw;
        (void)cigi::read_packet(info.bytes, info.version, info.order, raw);
        cigi::for_each_field<P>([&](const auto& field) {
            if (!field.place(info.version).present) return;
            if constexpr (std::is_floating_point_v<typename std::decay_t<decltype(field)>::Value>) {
                if (!std::isfinite(raw.*(field.member))) {
                    out.fields.push_back({field.name, std::monostate{}});
                    return;
                }
            }
            out.fields.push_back({field.name, value_of(packet.*(field.member))});
        });
    }
    void skipped(const cigi::PacketInfo& info) {
        datagram_.skipped.push_back(
            {cigi::listed_packet_name(info.version, info.id), info.id, info.offset, info.bytes.size()});
    }
    void refused(const cigi::RefusedPacket& packet, const cigi::PacketInfo& info) { ignore(packet, info); }
    void passed_over(const cigi::RefusedPacket& packet, const cigi::PacketInfo& info) {
        ignore(packet, info);
    }

  private:
    void ignore(const cigi::RefusedPacket& packet, const cigi::PacketInfo& info) {
        datagram_.ignored.push_back(
            {cigi::packet_name(packet.kind), info.offset, cigi::count_name(packet.reason), packet.field});
    }

    CigiDatagram& datagram_;
    const cigi::Counters& counters_;
    std::uint64_t clamped_ = 0;
};

cigi::MessageSummary detect(std::span<const std::byte> bytes, cigi::Sender sender) {
    return sender == cigi::Sender::kHost ? cigi::detect_host_message(bytes) : cigi::detect_ig_message(bytes);
}

std::string_view direction(cigi::Sender sender) {
    return sender == cigi::Sender::kHost ? "host to image generator" : "image generator to host";
}

std::string value_text(const CigiValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    // Nine digits tell any two binary32 apart.
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.9g}", *number);
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) return "not a number, does not count";
    std::string safe = *text;
    std::replace_if(
        safe.begin(), safe.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
        '?');
    return '"' + safe + '"';
}

std::string heading(const CigiDatagram& datagram) {
    if (datagram.outcome == CigiOutcome::kDrop) {
        return fmt::format("not taken for CIGI, {}: {} bytes dropped, {} (at byte {}){}\n",
                           direction(datagram.sender), datagram.bytes, datagram.reason, datagram.fault_offset,
                           datagram.other_direction ? "; it is a message of the other direction" : "");
    }
    std::string text = fmt::format("CIGI {}, {}-endian, {}, {} bytes", datagram.version, datagram.byte_order,
                                   direction(datagram.sender), datagram.bytes);
    if (datagram.outcome == CigiOutcome::kPartial)
        text += fmt::format("; lost from byte {} on: {}", datagram.fault_offset, datagram.reason);
    return text + '\n';
}

/// A paragraph and where its packet stood.
using Paragraph = std::pair<std::uint32_t, std::string>;

Paragraph paragraph(const CigiPacket& packet) {
    std::size_t width = 0;
    for (const CigiField& field : packet.fields)
        width = std::max(width, field.name.size());
    std::string text =
        fmt::format("{} at byte {}{}\n", packet.name, packet.offset, packet.clamped ? ", clamped" : "");
    for (const CigiField& field : packet.fields)
        fmt::format_to(std::back_inserter(text), "    {:<{}}  {}\n", field.name, width,
                       value_text(field.value));
    return {packet.offset, std::move(text)};
}

Paragraph paragraph(const CigiIgnored& packet) {
    return {packet.offset, fmt::format("{} at byte {} ignored: {}{}{}\n", packet.name, packet.offset,
                                       packet.reason, packet.field.empty() ? "" : ", ", packet.field)};
}

Paragraph paragraph(const CigiSkipped& packet) {
    return {packet.offset, fmt::format("{} at byte {} skipped: id {}, {} bytes\n", packet.name, packet.offset,
                                       packet.id, packet.bytes)};
}

std::optional<unsigned> hex_digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10U;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10U;
    return std::nullopt;
}

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

std::string shown(char c) {
    if (c > ' ' && c < 0x7F) return fmt::format("'{}'", c);
    return fmt::format("octet 0x{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
}

}  // namespace

CigiDatagram decode_cigi(std::span<const std::byte> bytes, cigi::Sender sender) {
    CigiDatagram datagram;
    datagram.bytes = bytes.size();
    datagram.sender = sender;
    cigi::Counters counters;
    Collector collector(datagram, counters);
    const cigi::MessageSummary summary = sender == cigi::Sender::kHost
                                             ? cigi::decode_host_message(bytes, collector, counters)
                                             : cigi::decode_ig_message(bytes, collector, counters);
    if (summary.fault) {
        datagram.reason = cigi::count_name(*summary.fault);
        datagram.fault_offset = summary.offset;
    }
    if (summary.accepted) {
        datagram.outcome = summary.fault ? CigiOutcome::kPartial : CigiOutcome::kAccept;
        datagram.version = summary.version == cigi::Version::k33 ? "3.3" : "4.0";
        datagram.byte_order = summary.order == cigi::ByteOrder::kLittle ? "little" : "big";
    } else {
        const bool from_host = sender == cigi::Sender::kHost;
        datagram.other_direction =
            detect(bytes, from_host ? cigi::Sender::kImageGenerator : cigi::Sender::kHost).accepted;
    }
    return datagram;
}

std::string to_text(const CigiDatagram& datagram) {
    std::vector<Paragraph> paragraphs;
    const auto add = [&paragraphs](const auto& list) {
        for (const auto& packet : list)
            paragraphs.push_back(paragraph(packet));
    };
    add(datagram.packets);
    add(datagram.ignored);
    add(datagram.skipped);
    std::sort(paragraphs.begin(), paragraphs.end());
    std::string text = heading(datagram);
    for (const Paragraph& each : paragraphs)
        text += '\n' + each.second;
    return text;
}

std::optional<std::vector<std::byte>> parse_hex(std::string_view text, HexError& error) {
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 2);
    std::optional<unsigned> high;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (is_space(text[i])) continue;
        const std::optional<unsigned> digit = hex_digit(text[i]);
        if (!digit) {
            error = {i + 1, fmt::format("{} is no hexadecimal digit", shown(text[i]))};
            return std::nullopt;
        }
        if (high) bytes.push_back(static_cast<std::byte>(*high << 4U | *digit));
        high = high ? std::nullopt : digit;
    }
    if (!high) return bytes;
    error = {text.size() + 1, "the last byte has one digit, it needs two"};
    return std::nullopt;
}

}  // namespace skyig::clients
