// Texts with a form of their own: addresses and dates.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "config/schema.h"

namespace skyig::config {
namespace {

bool all_digits(std::string_view text) noexcept {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool read_digits(std::string_view text, std::size_t from, std::size_t count, int& out) noexcept {
    if (text.size() < from + count || !all_digits(text.substr(from, count))) return false;
    std::from_chars(text.data() + from, text.data() + from + count, out);
    return true;
}

int days_in_month(int year, int month) noexcept {
    constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return month == 2 && leap ? 29 : kDays[static_cast<std::size_t>(month - 1)];
}

}  // namespace

bool is_ipv4(std::string_view text) noexcept {
    for (int part = 0; part < 4; ++part) {
        const std::size_t dot = part < 3 ? text.find('.') : text.size();
        if (dot == std::string_view::npos) return false;
        const std::string_view digits = text.substr(0, dot);
        int value = 0;
        if (digits.size() > 3 || (digits.size() > 1 && digits[0] == '0')) return false;
        if (!read_digits(digits, 0, digits.size(), value) || value > 255) return false;
        text.remove_prefix(std::min(dot + 1, text.size()));
    }
    return true;
}

bool parse_udp_address(std::string_view text, UdpAddress& out) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos || !is_ipv4(text.substr(0, colon))) return false;
    const std::string_view digits = text.substr(colon + 1);
    std::uint16_t port = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    if (fault != std::errc{} || end != digits.data() + digits.size()) return false;
    out = {std::string(text.substr(0, colon)), port};
    return true;
}

bool is_short_name(std::string_view name) noexcept {
    return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_';
    });
}

bool is_valid(const UtcDateTime& time) noexcept {
    return time.year >= 1900 && time.year <= 2100 && time.month >= 1 && time.month <= 12 && time.day >= 1 &&
           time.day <= days_in_month(time.year, time.month) && time.hour >= 0 && time.hour <= 23 &&
           time.minute >= 0 && time.minute <= 59 && time.second >= 0.0 && time.second < 60.0;
}

bool parse_utc(std::string_view text, UtcDateTime& out) noexcept {
    UtcDateTime time;
    if (text.empty() || text.back() != 'Z') return false;
    text.remove_suffix(1);
    if (text.size() < 16 || text[4] != '-' || text[7] != '-' || (text[10] != 'T' && text[10] != ' ') ||
        text[13] != ':') {
        return false;
    }
    if (!read_digits(text, 0, 4, time.year) || !read_digits(text, 5, 2, time.month) ||
        !read_digits(text, 8, 2, time.day) || !read_digits(text, 11, 2, time.hour) ||
        !read_digits(text, 14, 2, time.minute)) {
        return false;
    }
    if (text.size() > 16) {
        int whole = 0;
        if (text[16] != ':' || !read_digits(text, 17, 2, whole)) return false;
        time.second = whole;
        if (text.size() > 19) {
            if (text[19] != '.' || !all_digits(text.substr(20))) return false;
            double fraction = 0.0, unit = 0.1;
            for (const char digit : text.substr(20)) {
                fraction += unit * (digit - '0');
                unit *= 0.1;
            }
            time.second += std::min(fraction, 0.999999999);
        }
    }
    if (!is_valid(time)) return false;
    out = time;
    return true;
}

}  // namespace skyig::config
