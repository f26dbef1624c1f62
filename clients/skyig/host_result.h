// What `skyig host` tells at the end of a flight.
#pragma once

#include <cstdint>
#include <string>

namespace skyig::clients {

struct HostResult {
    std::string flight;
    std::string to;
    double flown_s = 0.0;
    /// What was to be flown.
    double asked_s = 0.0;
    /// All that was asked for is flown; false after an interrupt.
    bool complete = false;
    double rate_hz = 0.0;
    std::uint64_t messages = 0;
    std::uint64_t late_messages = 0;

    /// As the image generator answers: "3.3" or "4.0"; "standby", "operate", ...
    std::string version;
    std::string mode;
    std::int8_t database_number = 0;
    std::uint64_t answers = 0;
    std::uint64_t answers_lost = 0;
    std::uint64_t restarts = 0;
    double answer_rate_hz = 0.0;
    std::uint32_t round_trip_frames_p50 = 0;
    std::uint32_t round_trip_frames_p99 = 0;
    double round_trip_p50_ms = 0.0;
    double round_trip_p99_ms = 0.0;
};

/// Lines for people.
[[nodiscard]] std::string to_text(const HostResult& result);
[[nodiscard]] std::string to_json(const HostResult& result);

}  // namespace skyig::clients
