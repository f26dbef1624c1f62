// What tests do to the CAN bus of the guest that they run in (script/uml-can-run): root's commands, logs
// played, frames sent.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "protocol/can_frame.h"

namespace skyig::tests {

inline constexpr const char* kInterface = "vcan0";

/// Runs a shell command. \throws std::runtime_error unless it ends with 0
void shell(const std::string& command);

/// Until `done` or the time is over.
template <class Done>
bool eventually(Done done, std::chrono::milliseconds limit = std::chrono::seconds(10)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

/// A raw socket of its own that sends to an interface.
class TestBus {
  public:
    /// \throws std::runtime_error if the interface cannot be had
    explicit TestBus(const std::string& interface = kInterface);
    ~TestBus();
    TestBus(const TestBus&) = delete;
    TestBus& operator=(const TestBus&) = delete;

    /// False if the system did not take it.
    bool send(const protocol::CanFrame& frame) noexcept;
    /// The number as 11-bit identifier (its low bits) and as data.
    bool send_number(std::uint32_t number) noexcept;

  private:
    int descriptor_ = -1;
};

[[nodiscard]] protocol::CanFrame numbered_frame(std::uint32_t number) noexcept;

/// The frames of a candump log; received_ns are its time stamps.
[[nodiscard]] std::vector<protocol::CanFrame> frames_of_log(const std::string& text);

/// One line of a log, on the interface "can0".
[[nodiscard]] std::string log_line(const protocol::CanFrame& frame);

}  // namespace skyig::tests
