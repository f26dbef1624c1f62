// The time of day and the date of a bus as one running clock. They come in two frames, a second apart and in
// whole seconds; the clock runs on between them, is slewed and not stepped by small differences, and changes
// its date at midnight by itself, whichever of the two frames of the new day comes first.
#pragma once

#include <cstdint>
#include <optional>

namespace skyig::protocol::canaerospace {

struct BusTime {
    /// Days since 1970-01-01.
    std::int64_t day = 0;
    /// 0..86400; up to 86401 within a leap second.
    double second_of_day = 0.0;
};

class BusClock {
  public:
    /// A time of day in seconds (0 .. 86401, the last second being a leap second) that was true in
    /// [second, second + step) when it was sent: 1 for whole seconds, 0.01, 0.001.
    void set_time_of_day(double second_of_day, double step_s, std::int64_t received_ns) noexcept;
    /// days since 1970-01-01
    void set_date(std::int64_t day, std::int64_t received_ns) noexcept;
    /// Days since -4712-01-01 12 h, UTC.
    void set_julian_date(double julian_date, std::int64_t received_ns) noexcept;
    /// Seconds of this clock to one of the receive times; 0 stops it. At least 0.
    void set_rate(double rate, std::int64_t received_ns) noexcept;

    /// The time at `now_ns` (a receive time); none before both time and date came. The date of a time of day
    /// that came first is not guessed.
    [[nodiscard]] std::optional<BusTime> at(std::int64_t now_ns) const noexcept;
    [[nodiscard]] double rate() const noexcept { return rate_; }
    /// Times that were set at once, since they were too far off to be slewed to; the first one counts too.
    [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }

  private:
    /// The clock at one moment: running days of 86400 s. In a leap second the last second of the day is
    /// counted a second time.
    struct State {
        std::int64_t at_ns = 0;
        std::int64_t day = 0;
        double second = 0.0;
        /// How much of a difference is still to be made good.
        double slew_s = 0.0;
        bool leap = false;

        [[nodiscard]] double shown_second() const noexcept { return leap ? second + 1.0 : second; }
    };

    [[nodiscard]] State run_to(std::int64_t now_ns) const noexcept;
    void step_to(std::int64_t day, double second_of_day) noexcept;
    /// True if the clock was within reach of a leap second and now stands in it.
    [[nodiscard]] bool enter_leap_second() noexcept;
    [[nodiscard]] bool is_far_from_midnight() const noexcept;
    /// Seconds from the clock to the nearest moment of `day`, 0 within it.
    [[nodiscard]] double distance_s(std::int64_t day) const noexcept;

    State state_;
    double rate_ = 1.0;
    bool has_time_ = false;
    bool has_date_ = false;
    std::int64_t sent_date_ = 0;
    /// Since sent_date_ was sent first, the clock has stood well within that day: if it does no more, then
    /// because it has passed midnight.
    bool agreed_ = false;
    bool date_waits_ = false;
    std::int64_t date_waits_since_ns_ = 0;
    std::uint64_t steps_ = 0;
};

}  // namespace skyig::protocol::canaerospace
