// A small site for end-to-end tests: its settings file, free ports, and a socket to be anyone with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tests/e2e/process.h"

namespace skyig::tests {

/// A UDP port of 127.0.0.1 that nobody has now.
[[nodiscard]] std::uint16_t free_port();

/// A bound UDP socket of 127.0.0.1, or of another address of this machine.
class TestSocket {
  public:
    explicit TestSocket(std::uint16_t port = 0, std::uint32_t address = 0x7F000001);
    ~TestSocket();
    TestSocket(const TestSocket&) = delete;
    TestSocket& operator=(const TestSocket&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    void send(std::uint16_t to_port, std::span<const std::byte> bytes, std::uint32_t to = 0x7F000001) const;

  private:
    int descriptor_ = -1;
    std::uint16_t port_ = 0;
};

/// "http://127.0.0.1:PORT" of a daemon, from the line that says where it is; empty if that does not come.
[[nodiscard]] std::string status_url(const Process& daemon);

/// A [[channel]] 60 degrees wide.
[[nodiscard]] std::string channel_toml(const std::string& name, int width_px, int height_px, int yaw_deg);

/// One channel of 64x48 at 60 Hz, a host lost after 0.4 s, on two free ports.
struct Site {
    Site();

    ScratchDirectory scratch;
    std::uint16_t listen_port = free_port();
    std::uint16_t reply_port = free_port();
    std::string config_path;
    std::string report_path = scratch.file("report.json");

    [[nodiscard]] std::string listen() const { return "127.0.0.1:" + std::to_string(listen_port); }
    [[nodiscard]] std::string reply() const { return "127.0.0.1:" + std::to_string(reply_port); }
};

}  // namespace skyig::tests
