// The server's log: one line a fact to stderr, with journald's <N> priority prefix unless a person watches a
// terminal. Lines that could repeat are limited by key. Safe from several threads; lines up to 500 bytes
// allocate nothing.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>

#include "server/clock.h"

namespace skyig::server {

/// syslog priorities
enum class Severity { kError = 3, kWarning = 4, kNotice = 5, kInfo = 6, kDebug = 7 };

/// Between two lines of one key, usually. A link that comes and goes, or a host that asks for the impossible
/// in every message, fills no log.
inline constexpr double kRepeatAfter_s = 10.0;

/// What a limited line is about: its kind, and which of several it is. The text must be a literal (it is
/// kept, not copied).
struct LimitKey {
    LimitKey(const char* literal) noexcept : text(literal) {}
    LimitKey(const char* literal, std::size_t number) noexcept : text(literal), of(number) {}

    std::string_view text;
    std::size_t of = 0;

    friend bool operator==(const LimitKey&, const LimitKey&) = default;
};

class Log {
  public:
    /// Receives whole lines without prefix and line end.
    using Sink = std::function<void(Severity, std::string_view)>;

    /// Writes to stderr. `clock` must outlive the log; it measures the limits of repeated lines.
    explicit Log(const Clock& clock, Severity threshold = Severity::kInfo);
    /// Writes to `sink` (tests).
    Log(const Clock& clock, Sink sink, Severity threshold = Severity::kDebug);

    /// A second reader of every line; to be set before other threads write.
    void also_to(Sink sink) { also_ = std::move(sink); }

    template <typename... Args>
    void error(fmt::format_string<Args...> format, Args&&... args) {
        write(Severity::kError, fmt::string_view(format), fmt::make_format_args(args...));
    }
    template <typename... Args>
    void warning(fmt::format_string<Args...> format, Args&&... args) {
        write(Severity::kWarning, fmt::string_view(format), fmt::make_format_args(args...));
    }
    template <typename... Args>
    void notice(fmt::format_string<Args...> format, Args&&... args) {
        write(Severity::kNotice, fmt::string_view(format), fmt::make_format_args(args...));
    }
    template <typename... Args>
    void info(fmt::format_string<Args...> format, Args&&... args) {
        write(Severity::kInfo, fmt::string_view(format), fmt::make_format_args(args...));
    }

    /// At most one line of this key each `every_s` seconds; the next one says how many were left out. Keys
    /// beyond kMaxKeys share one limit.
    template <typename... Args>
    void limited(const LimitKey& key, double every_s, Severity severity, fmt::format_string<Args...> format,
                 Args&&... args) {
        write_limited(key, every_s, severity, fmt::string_view(format), fmt::make_format_args(args...));
    }

    /// A dozen kinds, a few of them for each of 17 sources.
    static constexpr std::size_t kMaxKeys = 160;

  private:
    struct Limit {
        LimitKey key{""};
        std::int64_t last_ns = 0;
        std::uint64_t suppressed = 0;
    };

    void write(Severity severity, fmt::string_view format, fmt::format_args args);
    void write_limited(const LimitKey& key, double every_s, Severity severity, fmt::string_view format,
                       fmt::format_args args);
    void emit(Severity severity, std::string_view line);
    Limit& find_limit(const LimitKey& key, std::int64_t now_ns, bool& first);

    const Clock& clock_;
    Severity threshold_;
    Sink sink_;
    Sink also_;
    bool prefix_ = false;
    std::mutex mutex_;
    std::array<Limit, kMaxKeys> limits_{};
    std::size_t limit_count_ = 0;
};

}  // namespace skyig::server
