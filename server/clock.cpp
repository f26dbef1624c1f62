#include "server/clock.h"

#include <cerrno>
#include <ctime>

namespace skyig::server {
namespace {

constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

std::int64_t read_ns(clockid_t clock) noexcept {
    std::timespec time{};
    ::clock_gettime(clock, &time);
    return std::int64_t{time.tv_sec} * kNanosPerSecond + time.tv_nsec;
}

}  // namespace

SystemClock::SystemClock() noexcept : steady_offset_ns_(read_ns(CLOCK_REALTIME) - read_ns(CLOCK_MONOTONIC)) {}

std::int64_t SystemClock::steady_utc_ns() const noexcept {
    return monotonic_ns() + steady_offset_ns_;
}

std::int64_t SystemClock::monotonic_ns() const noexcept {
    return read_ns(CLOCK_MONOTONIC);
}

std::int64_t SystemClock::utc_ns() const noexcept {
    return read_ns(CLOCK_REALTIME);
}

std::int64_t SystemClock::processor_ns() const noexcept {
    return read_ns(CLOCK_PROCESS_CPUTIME_ID);
}

void SystemClock::sleep_until_ns(std::int64_t monotonic_deadline_ns) {
    if (monotonic_deadline_ns <= 0) return;
    std::timespec deadline{};
    deadline.tv_sec = static_cast<std::time_t>(monotonic_deadline_ns / kNanosPerSecond);
    deadline.tv_nsec = static_cast<long>(monotonic_deadline_ns % kNanosPerSecond);
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
    }
}

void ManualClock::sleep_until_ns(std::int64_t monotonic_deadline_ns) {
    if (monotonic_deadline_ns > monotonic_ns_) monotonic_ns_ = monotonic_deadline_ns;
}

}  // namespace skyig::server
