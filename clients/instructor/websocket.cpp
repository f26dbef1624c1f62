#include "clients/instructor/websocket.h"

#include <algorithm>
#include <array>

#include "clients/instructor/sha1.h"

namespace skyig::clients::instructor {

namespace {

constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view kGuid = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
constexpr std::uint8_t kFinal = 0x80;
constexpr std::uint8_t kReserved = 0x70;
constexpr std::uint8_t kMasked = 0x80;
constexpr std::uint8_t kShortest = 125;
constexpr std::uint8_t kTwoBytes = 126;
constexpr std::size_t kMaskBytes = 4;

/// Whether a list of words (RFC 9110 5.6.1) holds one, whatever its capitals.
bool lists(std::string_view list, std::string_view word) noexcept {
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        std::string_view one = list.substr(0, end);
        while (one.starts_with(' ') || one.starts_with('\t'))
            one.remove_prefix(1);
        while (one.ends_with(' ') || one.ends_with('\t'))
            one.remove_suffix(1);
        if (server::status::same_word(one, word)) return true;
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return false;
}

/// 16 bytes in base64.
bool is_key(std::string_view key) noexcept {
    constexpr std::size_t kDigits = 22;
    return key.size() == kDigits + 2 && key.ends_with("==") &&
           key.substr(0, kDigits).find_first_not_of(kBase64) == std::string_view::npos;
}

std::string base64(std::span<const std::uint8_t> bytes) {
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8U | (i < count ? bytes[at + i] : 0U);
        for (std::size_t i = 0; i < 4; ++i)
            text += i <= count ? kBase64[group >> (18U - 6U * static_cast<unsigned>(i)) & 0x3FU] : '=';
    }
    return text;
}

std::uint8_t byte_at(const std::string& text, std::size_t at) noexcept {
    return static_cast<std::uint8_t>(text[at]);
}

/// Bytes of the head whose first two have come.
std::size_t head_bytes(const std::string& head) noexcept {
    const std::uint8_t length = byte_at(head, 1) & 0x7FU;
    return 2 + (length < kTwoBytes ? 0U : length == kTwoBytes ? 2U : 8U) + kMaskBytes;
}

bool is_control(Opcode opcode) noexcept {
    return opcode >= Opcode::kClose;
}

}  // namespace

Handshake check_handshake(const server::status::HttpRequest& request) noexcept {
    using server::status::field;
    if (request.method != "GET" || request.version != "HTTP/1.1" ||
        !lists(field(request, "upgrade"), "websocket") || !lists(field(request, "connection"), "upgrade") ||
        !is_key(field(request, "sec-websocket-key")))
        return Handshake::kBad;
    return field(request, "sec-websocket-version") == "13" ? Handshake::kGood : Handshake::kOtherVersion;
}

std::string accept_key(std::string_view key) {
    return base64(sha1(std::string(key).append(kGuid)));
}

std::string make_frame(Opcode opcode, std::string_view payload) {
    std::string frame;
    frame.reserve(payload.size() + 10);
    frame += static_cast<char>(kFinal | static_cast<std::uint8_t>(opcode));
    unsigned length_bytes = 0;
    if (payload.size() <= kShortest) {
        frame += static_cast<char>(payload.size());
    } else {
        length_bytes = payload.size() <= 0xFFFF ? 2 : 8;
        frame += static_cast<char>(length_bytes == 2 ? kTwoBytes : kTwoBytes + 1);
    }
    for (unsigned i = length_bytes; i-- > 0;)
        frame += static_cast<char>(std::uint64_t{payload.size()} >> 8U * i & 0xFFU);
    return frame.append(payload);
}

std::string make_close(CloseCode code) {
    const auto number = static_cast<unsigned>(code);
    const std::array<char, 2> bytes{static_cast<char>(number >> 8U), static_cast<char>(number & 0xFFU)};
    return make_frame(Opcode::kClose, {bytes.data(), bytes.size()});
}

MessageReader::Event MessageReader::take(std::span<const char>& bytes) {
    while (!bytes.empty() || (in_payload_ && missing_ == 0)) {
        if (!in_payload_) {
            head_ += bytes.front();
            bytes = bytes.subspan(1);
            if (head_.size() < 2 || head_.size() < head_bytes(head_)) continue;
            if (const Event event = begin_frame(); event != Event::kNothing) return event;
            continue;
        }
        const std::size_t count = std::min(missing_, bytes.size());
        const std::size_t mask = head_.size() - kMaskBytes;
        for (const char byte : bytes.first(count))
            payload_ += static_cast<char>(byte ^ head_[mask + payload_.size() % kMaskBytes]);
        bytes = bytes.subspan(count);
        missing_ -= count;
        if (missing_ > 0) continue;
        if (const Event event = end_frame(); event != Event::kNothing) return event;
    }
    return Event::kNothing;
}

/// The head is whole: what is to come, and whether it may.
MessageReader::Event MessageReader::begin_frame() {
    const std::uint8_t first = byte_at(head_, 0);
    final_ = (first & kFinal) != 0;
    opcode_ = static_cast<Opcode>(first & 0x0FU);
    std::uint64_t length = byte_at(head_, 1) & 0x7FU;
    if (length >= kTwoBytes) {
        length = 0;
        for (std::size_t at = 2; at < head_.size() - kMaskBytes; ++at)
            length = length << 8U | byte_at(head_, at);
    }
    if ((first & kReserved) != 0 || (byte_at(head_, 1) & kMasked) == 0) return Event::kBroken;
    const bool control = is_control(opcode_);
    if (control ? !final_ || length > kShortest || opcode_ > Opcode::kPong : opcode_ > Opcode::kBinary)
        return Event::kBroken;
    if (!control && in_message_ != (opcode_ == Opcode::kContinuation)) return Event::kBroken;
    if (opcode_ == Opcode::kBinary) return Event::kBinary;
    if (!control && length > most_bytes_ - message_.size()) return Event::kTooBig;
    in_payload_ = true;
    missing_ = static_cast<std::size_t>(length);
    payload_.clear();
    return Event::kNothing;
}

MessageReader::Event MessageReader::end_frame() {
    in_payload_ = false;
    head_.clear();
    if (is_control(opcode_)) {
        told_ = payload_;
        if (opcode_ == Opcode::kClose) return Event::kClose;
        return opcode_ == Opcode::kPing ? Event::kPing : Event::kNothing;
    }
    message_ += payload_;
    in_message_ = !final_;
    if (in_message_) return Event::kNothing;
    told_ = std::move(message_);
    message_.clear();
    return Event::kText;
}

}  // namespace skyig::clients::instructor
