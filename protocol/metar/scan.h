// Walks along one group from left to right.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace skyig::protocol::metar {

[[nodiscard]] constexpr bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}
[[nodiscard]] constexpr bool is_letter(char c) noexcept {
    return c >= 'A' && c <= 'Z';
}
[[nodiscard]] constexpr bool all_slashes(std::string_view text) noexcept {
    return text.find_first_not_of('/') == std::string_view::npos;
}

class Scan {
  public:
    explicit constexpr Scan(std::string_view text) noexcept : rest_(text) {}

    [[nodiscard]] constexpr bool done() const noexcept { return rest_.empty(); }
    [[nodiscard]] constexpr std::string_view rest() const noexcept { return rest_; }

    constexpr bool accept(std::string_view word) noexcept {
        if (!rest_.starts_with(word)) return false;
        rest_.remove_prefix(word.size());
        return true;
    }
    /// As many digits as there are, `least` to `most` (at most 9); more stay where they are.
    constexpr std::optional<int> digits(std::size_t least, std::size_t most) noexcept {
        std::size_t count = 0;
        int value = 0;
        while (count < most && count < rest_.size() && is_digit(rest_[count]))
            value = value * 10 + (rest_[count++] - '0');
        if (count < least) return std::nullopt;
        rest_.remove_prefix(count);
        return value;
    }
    constexpr std::optional<int> digits(std::size_t count) noexcept { return digits(count, count); }
    /// `count` characters, fewer at the end.
    constexpr std::string_view take(std::size_t count) noexcept {
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(taken.size());
        return taken;
    }

  private:
    std::string_view rest_;
};

}  // namespace skyig::protocol::metar
