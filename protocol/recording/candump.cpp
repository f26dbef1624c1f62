#include "protocol/recording/candump.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace skyig::protocol::recording {
namespace {

constexpr std::uint32_t kErrorFlag = 0x2000'0000U;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
// The last whole second that nanoseconds in 64 bits can tell.
constexpr std::int64_t kLastSecond = INT64_MAX / kSecond_ns - 1;
constexpr std::size_t kStandardDigits = 3;
constexpr std::size_t kExtendedDigits = 8;
constexpr std::size_t kMostBlanks = 255;

constexpr std::array<std::string_view, static_cast<std::size_t>(CandumpFault::kEnd)> kTexts{
    "write the time stamp as (SECONDS.FRACTION), the fraction of one to nine digits",
    "write the interface's name, 1 to 15 characters, between single blanks",
    "write the identifier as three hex digits (11 bit) or eight (29 bit, error frame)",
    "an identifier of three digits is at most 7FF",
    "an identifier of eight digits is at most 1FFFFFFF, or 20000000 more for an error frame",
    "write # (classic CAN) or ## (CAN FD) behind the identifier",
    "write one hex digit of CAN FD flags behind ##",
    "write each data byte as two hex digits",
    "classic CAN has at most 8 data bytes",
    "CAN FD has 0 to 8, 12, 16, 20, 24, 32, 48 or 64 data bytes",
    "a remote frame asks for 0 to 8 bytes",
    "a length code behind _ is 9 to F and follows 8 bytes",
    "nothing but R or T (received, sent) may follow the frame",
};

constexpr bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

/// -1: none
constexpr int hex_value(char c) noexcept {
    if (is_digit(c)) return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
}

constexpr bool is_fd_length(std::size_t length) noexcept {
    constexpr std::array<std::size_t, 7> kLong{12, 16, 20, 24, 32, 48, 64};
    return length <= kClassicBytes || std::find(kLong.begin(), kLong.end(), length) != kLong.end();
}

/// Walks along one line; the first fault ends the walk.
class Cursor {
  public:
    explicit Cursor(std::string_view text) noexcept : text_(text) {}

    [[nodiscard]] bool at_end() const noexcept { return at_ == text_.size(); }
    [[nodiscard]] char peek() const noexcept { return at_end() ? '\0' : text_[at_]; }
    [[nodiscard]] std::size_t position() const noexcept { return at_; }
    [[nodiscard]] std::string_view since(std::size_t start) const noexcept {
        return text_.substr(start, at_ - start);
    }
    void advance() noexcept { ++at_; }
    bool accept(char c) noexcept {
        if (peek() != c || at_end()) return false;
        ++at_;
        return true;
    }
    template <class Is>
    std::string_view take_while(Is&& is) noexcept {
        const std::size_t start = at_;
        while (!at_end() && is(text_[at_]))
            ++at_;
        return since(start);
    }
    /// Always false, so that callers can return it.
    bool fail(CandumpFault fault, std::size_t position) noexcept {
        error_ = {static_cast<std::uint32_t>(position + 1), fault};
        return false;
    }
    bool fail(CandumpFault fault) noexcept { return fail(fault, at_); }
    [[nodiscard]] const CandumpError& error() const noexcept { return error_; }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
    CandumpError error_;
};

bool read_time(Cursor& cursor, CandumpLine& out) noexcept {
    if (!cursor.accept('(')) return cursor.fail(CandumpFault::kTime);
    const std::size_t start = cursor.position();
    std::int64_t seconds = 0;
    for (const char c : cursor.take_while(is_digit)) {
        seconds = seconds * 10 + (c - '0');
        if (seconds > kLastSecond) return cursor.fail(CandumpFault::kTime, start);
    }
    if (cursor.position() == start || !cursor.accept('.')) return cursor.fail(CandumpFault::kTime);
    const std::string_view fraction = cursor.take_while(is_digit);
    if (fraction.empty() || fraction.size() > 9 || !cursor.accept(')'))
        return cursor.fail(CandumpFault::kTime);
    std::int64_t fraction_ns = 0;
    for (std::size_t i = 0; i < 9; ++i)
        fraction_ns = fraction_ns * 10 + (i < fraction.size() ? fraction[i] - '0' : 0);
    out.frame.received_ns = seconds * kSecond_ns + fraction_ns;
    out.fraction_digits = static_cast<std::uint8_t>(fraction.size());
    return true;
}

bool read_interface(Cursor& cursor, CandumpLine& out) noexcept {
    const auto is_blank = [](char c) { return c == ' '; };
    const std::size_t blanks = cursor.take_while(is_blank).size();
    if (blanks == 0 || blanks > kMostBlanks) return cursor.fail(CandumpFault::kInterface);
    const std::size_t start = cursor.position();
    out.blanks = static_cast<std::uint8_t>(blanks);
    out.interface = cursor.take_while([](char c) { return c > ' ' && c < '\x7F'; });
    if (out.interface.empty() || out.interface.size() > kInterfaceChars)
        return cursor.fail(CandumpFault::kInterface, start);
    return cursor.accept(' ') || cursor.fail(CandumpFault::kInterface);
}

bool read_identifier(Cursor& cursor, CanFrame& frame) noexcept {
    const std::size_t start = cursor.position();
    const std::string_view digits = cursor.take_while([](char c) { return hex_value(c) >= 0; });
    if (digits.size() != kStandardDigits && digits.size() != kExtendedDigits)
        return cursor.fail(CandumpFault::kIdentifier, start);
    std::uint32_t id = 0;
    for (const char c : digits)
        id = id << 4 | static_cast<std::uint32_t>(hex_value(c));
    if (digits.size() == kStandardDigits) {
        if (id > kMaxStandardId) return cursor.fail(CandumpFault::kStandardRange, start);
        frame.id = id;
        return true;
    }
    if (id > (kErrorFlag | kMaxExtendedId)) return cursor.fail(CandumpFault::kExtendedRange, start);
    frame.error = (id & kErrorFlag) != 0;
    frame.extended = !frame.error;
    frame.id = id & kMaxExtendedId;
    return true;
}

bool read_data(Cursor& cursor, CanFrame& frame, std::size_t most, CandumpFault too_long) noexcept {
    const std::size_t start = cursor.position();
    std::size_t length = 0;
    while (hex_value(cursor.peek()) >= 0) {
        if (length == most) return cursor.fail(too_long, start);
        const int high = hex_value(cursor.peek());
        cursor.advance();
        const int low = hex_value(cursor.peek());
        if (low < 0) return cursor.fail(CandumpFault::kDigits);
        cursor.advance();
        frame.data[length++] = static_cast<std::uint8_t>(high * 16 + low);
    }
    frame.length = static_cast<std::uint8_t>(length);
    return true;
}

bool read_fd(Cursor& cursor, CanFrame& frame) noexcept {
    const int flags = hex_value(cursor.peek());
    if (flags < 0) return cursor.fail(CandumpFault::kFlags);
    cursor.advance();
    frame.fd = true;
    frame.fd_flags = static_cast<std::uint8_t>(flags);
    const std::size_t start = cursor.position();
    if (!read_data(cursor, frame, kFdBytes, CandumpFault::kFdLength)) return false;
    return is_fd_length(frame.length) || cursor.fail(CandumpFault::kFdLength, start);
}

bool read_classic(Cursor& cursor, CandumpLine& out) noexcept {
    CanFrame& frame = out.frame;
    if (!frame.error && cursor.accept('R')) {
        frame.remote = true;
        if (is_digit(cursor.peek())) {
            if (cursor.peek() > '8') return cursor.fail(CandumpFault::kRemoteLength);
            frame.length = static_cast<std::uint8_t>(cursor.peek() - '0');
            cursor.advance();
        }
    } else if (!read_data(cursor, frame, kClassicBytes, CandumpFault::kClassicLength)) {
        return false;
    }
    if (!cursor.accept('_')) return true;
    const int code = hex_value(cursor.peek());
    if (code < 9 || frame.length != kClassicBytes) return cursor.fail(CandumpFault::kLengthCode);
    cursor.advance();
    out.raw_length_code = static_cast<std::uint8_t>(code);
    return true;
}

bool read_line(Cursor& cursor, CandumpLine& out) noexcept {
    if (!read_time(cursor, out) || !read_interface(cursor, out)) return false;
    if (!read_identifier(cursor, out.frame)) return false;
    if (!cursor.accept('#')) return cursor.fail(CandumpFault::kSeparator);
    if (!out.frame.error && cursor.accept('#')) {
        if (!read_fd(cursor, out.frame)) return false;
    } else if (!read_classic(cursor, out)) {
        return false;
    }
    // A digit that belongs to nothing is a data byte gone wrong.
    if (!cursor.at_end() && cursor.peek() != ' ')
        return cursor.fail(out.frame.remote ? CandumpFault::kRemoteLength : CandumpFault::kDigits);
    cursor.take_while([](char c) { return c == ' '; });
    if (cursor.at_end()) return true;
    if (cursor.peek() != 'R' && cursor.peek() != 'T') return cursor.fail(CandumpFault::kTrailing);
    out.direction = cursor.peek();
    cursor.advance();
    cursor.take_while([](char c) { return c == ' '; });
    return cursor.at_end() || cursor.fail(CandumpFault::kTrailing);
}

char* write_bytes(char* out, const CanFrame& frame) noexcept {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    for (const std::uint8_t byte : frame.bytes()) {
        *out++ = kHex[byte >> 4];
        *out++ = kHex[byte & 0xFU];
    }
    return out;
}

char* write_identifier(char* out, const CanFrame& frame) noexcept {
    if (frame.error) return fmt::format_to(out, "{:08X}#", (frame.id & kMaxExtendedId) | kErrorFlag);
    if (frame.extended) return fmt::format_to(out, "{:08X}#", frame.id & kMaxExtendedId);
    return fmt::format_to(out, "{:03X}#", frame.id & kMaxStandardId);
}

}  // namespace

std::string_view candump_fault_text(CandumpFault fault) noexcept {
    const auto index = static_cast<std::size_t>(fault);
    return index < kTexts.size() ? kTexts[index] : std::string_view("no fault");
}

std::string describe(const CandumpError& error, std::string_view file, std::uint64_t line) {
    return fmt::format("{}:{}:{}: {}", file, line, error.column, candump_fault_text(error.fault));
}

bool is_blank_or_comment(std::string_view line) noexcept {
    const std::size_t first = line.find_first_not_of(" \t\r");
    return first == std::string_view::npos || line[first] == '#';
}

Result<CandumpLine, CandumpError> parse_candump(std::string_view line) noexcept {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    Cursor cursor(line);
    CandumpLine out;
    if (!read_line(cursor, out)) return Error{cursor.error()};
    return out;
}

std::string_view write_candump(const CandumpLine& line, std::span<char, kCandumpLineChars> buffer) noexcept {
    const CanFrame& frame = line.frame;
    const std::int64_t time_ns = std::max<std::int64_t>(frame.received_ns, 0);
    const std::size_t digits = std::clamp<std::size_t>(line.fraction_digits, 1, 9);
    std::int64_t fraction = time_ns % kSecond_ns;
    for (std::size_t i = digits; i < 9; ++i)
        fraction /= 10;
    char* out = buffer.data();
    out =
        fmt::format_to(out, "({:010}.{:0{}}){:{}}", time_ns / kSecond_ns, fraction, digits, "", line.blanks);
    const std::string_view name = line.interface.substr(0, kInterfaceChars);
    out = std::copy(name.begin(), name.end(), out);
    *out++ = ' ';
    out = write_identifier(out, frame);
    if (frame.fd) {
        out = write_bytes(fmt::format_to(out, "#{:X}", frame.fd_flags & 0xFU), frame);
    } else if (frame.remote) {
        *out++ = 'R';
        if (frame.length > 0) *out++ = static_cast<char>('0' + std::min<int>(frame.length, 8));
    } else {
        out = write_bytes(out, frame);
    }
    if (!frame.fd && line.raw_length_code >= 9 && line.raw_length_code <= 15)
        out = fmt::format_to(out, "_{:X}", line.raw_length_code);
    if (line.direction != 0) {
        *out++ = ' ';
        *out++ = line.direction;
    }
    return {buffer.data(), static_cast<std::size_t>(out - buffer.data())};
}

}  // namespace skyig::protocol::recording
