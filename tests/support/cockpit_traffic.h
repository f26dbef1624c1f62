// What a busy cockpit sends: a host at 60 Hz in CIGI and a bus with 1000 CANaerospace frames a second, both
// about the same flight. Made from the time alone, so alike in every run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/can_frame.h"

namespace skyig::tests {

/// The host (3.3, big-endian) sends IG Control and the ownship in every message, a view that turns, the
/// weather every five seconds, the time every twenty. The bus sends attitude, its rates and the place 100
/// times a second each, speeds, air, time and date 10 times. It is silent for 1.5 s from second 4 of each
/// minute on.
class CockpitTraffic {
  public:
    static constexpr std::int64_t kHostStep_ns = 1'000'000'000 / 60;
    static constexpr std::int64_t kBusStep_ns = 1'000'000;

    struct Arrival {
        /// Never earlier than the one before.
        std::int64_t utc_ns = 0;
        bool is_can = false;
        /// Of the host; until the next call.
        std::span<const std::byte> message{};
        protocol::CanFrame frame{};
    };

    explicit CockpitTraffic(std::int64_t start_utc_ns) noexcept : start_utc_ns_(start_utc_ns) {}

    [[nodiscard]] const Arrival& next();

  private:
    void make_message(double time_s);
    void make_frame(double time_s);

    std::int64_t start_utc_ns_;
    std::int64_t messages_ = 0;
    std::int64_t frames_ = 0;
    std::array<std::uint8_t, 2048> sent_by_id_{};
    std::array<std::byte, 512> buffer_{};
    Arrival arrival_;
};

}  // namespace skyig::tests
