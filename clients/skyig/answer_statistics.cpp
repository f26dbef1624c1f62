#include "clients/skyig/answer_statistics.h"

#include <algorithm>

namespace skyig::clients {

namespace cigi = protocol::cigi;

namespace {

/// A number that jumps back by more than datagrams overtake each other is a restarted peer.
constexpr std::int32_t kRestartFrames = 300;

}  // namespace

void AnswerStatistics::sent(std::uint32_t host_frame_number, std::int64_t at_ns) noexcept {
    sent_at_ns_[host_frame_number % kRemembered] = at_ns;
    last_sent_ = host_frame_number;
    ++sent_count_;
}

void AnswerStatistics::received(const cigi::StartOfFrame& start_of_frame, cigi::Version version,
                                std::int64_t at_ns) noexcept {
    if (count_ == 0) {
        first_at_ns_ = at_ns;
    } else {
        const auto step = static_cast<std::int32_t>(start_of_frame.ig_frame_number - last_.ig_frame_number);
        if (step < -kRestartFrames || step > kRestartFrames * 60) {
            ++restarts_;
        } else if (step > 1) {
            lost_ += static_cast<std::uint64_t>(step - 1);
        } else if (step <= 0) {
            // An overtaken answer: it had been counted as lost.
            lost_ -= std::min<std::uint64_t>(lost_, 1);
            ++count_;
            last_at_ns_ = at_ns;
            return;
        }
    }
    ++count_;
    last_at_ns_ = at_ns;
    last_ = start_of_frame;
    version_ = version;
    note_echo(start_of_frame.last_host_frame_number, at_ns);
}

void AnswerStatistics::note_echo(std::uint32_t host_frame_number, std::int64_t at_ns) noexcept {
    if (host_frame_number == last_echo_) return;
    const std::uint32_t behind = last_sent_ - host_frame_number;
    if (behind >= std::min<std::uint64_t>(sent_count_, kRemembered)) return;
    last_echo_ = host_frame_number;
    round_trip_.add(at_ns - sent_at_ns_[host_frame_number % kRemembered]);
    frames_behind_.add(behind);
}

double AnswerStatistics::rate_hz() const noexcept {
    if (last_at_ns_ <= first_at_ns_) return 0.0;
    return static_cast<double>(count_ - 1) / (static_cast<double>(last_at_ns_ - first_at_ns_) * 1e-9);
}

}  // namespace skyig::clients
