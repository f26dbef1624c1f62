#include "server/status/frame_record.h"

#include <algorithm>
#include <cmath>

namespace skyig::server::status {

namespace {

/// The smallest of the sorted values that the fraction `q` of all stay at or below.
double quantile(const float* sorted, std::size_t count, double q) noexcept {
    const double rank = std::ceil(q * static_cast<double>(count));
    return static_cast<double>(sorted[std::max<std::size_t>(1, static_cast<std::size_t>(rank)) - 1]);
}

}  // namespace

LateCause late_cause(const FrameParts& parts, double period_s) noexcept {
    const auto fits = [period_s](std::int64_t duration_ns) {
        return static_cast<double>(duration_ns) * 1e-9 <= period_s;
    };
    if (fits(parts.duration_ns())) return LateCause::kMachine;
    if (fits(parts.work_ns()))
        return parts.host_ns > parts.display_ns ? LateCause::kHost : LateCause::kDisplay;
    // Work in one thread or in many takes no longer than all of them together.
    if (parts.processor_ns && fits(*parts.processor_ns)) return LateCause::kMachine;
    const std::array<std::int64_t, 4> durations{parts.input_ns, parts.shared_ns, parts.channels_ns,
                                                parts.output_ns};
    const auto longest =
        static_cast<LateCause>(std::max_element(durations.begin(), durations.end()) - durations.begin());
    return longest == LateCause::kShared && parts.rebuilt ? LateCause::kRebuild : longest;
}

void FrameRecord::add(const FrameParts& parts, bool late, double period_s) noexcept {
    if (late) {
        const bool fitted = static_cast<double>(last_.duration_ns()) * 1e-9 <= period_s;
        if (!fitted || !last_late_) last_cause_ = late_cause(last_, period_s);
        ++late_[static_cast<std::size_t>(last_cause_)];
    }
    last_late_ = late;
    last_ = parts;
    const std::int64_t duration_ns = parts.duration_ns();
    kept_[count_ % kKept] = {parts.start_ns, static_cast<float>(static_cast<double>(duration_ns) * 1e-6),
                             late};
    const auto* const end =
        std::lower_bound(kClassEnds_s.begin(), kClassEnds_s.end(), static_cast<double>(duration_ns) * 1e-9);
    ++classes_[static_cast<std::size_t>(end - kClassEnds_s.begin())];
    sum_ns_ += duration_ns;
    ++count_;
}

RecentFrames FrameRecord::recent() const noexcept {
    RecentFrames out;
    out.frames = static_cast<std::size_t>(std::min<std::uint64_t>(count_, kKept));
    if (out.frames == 0) return out;
    std::array<float, kKept> sorted{};
    for (std::size_t i = 0; i < out.frames; ++i) {
        sorted[i] = kept_[i].duration_ms;
        if (kept_[i].late) ++out.late;
    }
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(out.frames));
    out.median_ms = quantile(sorted.data(), out.frames, 0.5);
    out.p95_ms = quantile(sorted.data(), out.frames, 0.95);
    out.largest_ms = static_cast<double>(sorted[out.frames - 1]);
    const std::int64_t first_ns = kept_[count_ > kKept ? count_ % kKept : 0].start_ns;
    const std::int64_t last_ns = kept_[(count_ - 1) % kKept].start_ns;
    if (last_ns > first_ns)
        out.rate_hz = static_cast<double>(out.frames - 1) * 1e9 / static_cast<double>(last_ns - first_ns);
    return out;
}

}  // namespace skyig::server::status
