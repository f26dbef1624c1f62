#include "server/log.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <iterator>
#include <utility>

namespace skyig::server {
namespace {

/// One write() a line, so that lines of several threads and processes do not mix. A closed stderr is nobody's
/// concern, and one that nobody reads loses lines, not frames.
void write_all(int descriptor, std::string_view text) noexcept {
    while (!text.empty()) {
        pollfd ready{descriptor, POLLOUT, 0};
        if (::poll(&ready, 1, 0) <= 0 || (ready.revents & POLLOUT) == 0) return;
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

std::string_view level_name(Severity severity) noexcept {
    switch (severity) {
        case Severity::kError:
            return "error";
        case Severity::kWarning:
            return "warning";
        case Severity::kNotice:
            return "notice";
        case Severity::kInfo:
            return "info";
        case Severity::kDebug:
            break;
    }
    return "debug";
}

/// "2026-06-21T12:00:00.123Z"
void append_utc(std::int64_t utc_ns, fmt::memory_buffer& out) {
    using namespace std::chrono;
    const auto time = floor<milliseconds>(sys_time<nanoseconds>(nanoseconds(utc_ns)));
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    fmt::format_to(std::back_inserter(out), "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z",
                   static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                   static_cast<unsigned>(date.day()), clock.hours().count(), clock.minutes().count(),
                   clock.seconds().count(), clock.subseconds().count());
}

void append_json(std::int64_t utc_ns, Severity severity, std::string_view line, fmt::memory_buffer& out) {
    fmt::format_to(std::back_inserter(out), "{{\"time\":\"");
    append_utc(utc_ns, out);
    fmt::format_to(std::back_inserter(out), "\",\"level\":\"{}\",\"source\":\"skyigd\",\"text\":\"",
                   level_name(severity));
    for (const char c : line) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out.push_back('\\');
            out.push_back(c);
        } else if (code < 0x20) {
            fmt::format_to(std::back_inserter(out), "\\u{:04x}", code);
        } else {
            out.push_back(c);
        }
    }
    fmt::format_to(std::back_inserter(out), "\"}}");
}

}  // namespace

Log::Log(const Clock& clock, Severity threshold, Form form)
    : clock_(clock), threshold_(threshold), prefix_(::isatty(STDERR_FILENO) == 0), form_(form) {}

Log::Log(const Clock& clock, Sink sink, Severity threshold)
    : clock_(clock), threshold_(threshold), sink_(std::move(sink)) {}

void Log::write(Severity severity, fmt::string_view format, fmt::format_args args) {
    if (severity > threshold_) return;
    fmt::memory_buffer line;
    fmt::vformat_to(std::back_inserter(line), format, args);
    const std::lock_guard lock(mutex_);
    emit(severity, {line.data(), line.size()});
}

void Log::write_limited(const LimitKey& key, double every_s, Severity severity, fmt::string_view format,
                        fmt::format_args args) {
    if (severity > threshold_) return;
    const std::int64_t now_ns = clock_.monotonic_ns();
    const std::lock_guard lock(mutex_);
    bool first = false;
    Limit& limit = find_limit(key, now_ns, first);
    if (!first && static_cast<double>(now_ns - limit.last_ns) < every_s * 1e9) {
        ++limit.suppressed;
        return;
    }
    fmt::memory_buffer line;
    fmt::vformat_to(std::back_inserter(line), format, args);
    if (limit.suppressed > 0) {
        fmt::format_to(std::back_inserter(line), " ({} more like this left out)", limit.suppressed);
    }
    limit.last_ns = now_ns;
    limit.suppressed = 0;
    emit(severity, {line.data(), line.size()});
}

Log::Limit& Log::find_limit(const LimitKey& key, std::int64_t now_ns, bool& first) {
    for (std::size_t i = 0; i < limit_count_; ++i) {
        if (limits_[i].key == key) return limits_[i];
    }
    if (limit_count_ == kMaxKeys) return limits_[kMaxKeys - 1];
    first = true;
    limits_[limit_count_] = {key, now_ns, 0};
    return limits_[limit_count_++];
}

void Log::emit(Severity severity, std::string_view line) {
    if (also_) also_(severity, line);
    if (sink_) {
        sink_(severity, line);
        return;
    }
    fmt::memory_buffer whole;
    if (form_ == Form::kJson) {
        append_json(clock_.utc_ns(), severity, line, whole);
    } else {
        if (prefix_) fmt::format_to(std::back_inserter(whole), "<{}>", static_cast<int>(severity));
        whole.append(line.data(), line.data() + line.size());
    }
    whole.push_back('\n');
    write_all(STDERR_FILENO, {whole.data(), whole.size()});
}

}  // namespace skyig::server
