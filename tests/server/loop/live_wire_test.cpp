// Buses of the settings; what passes over UDP sockets is tested with whole programs.
#include "server/live_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/transport/file_descriptor.h"
#include "server/clock.h"

namespace skyig::server {
namespace {

using ::testing::HasSubstr;

class LiveWireTest : public ::testing::Test {
  protected:
    LiveWireTest() {
        config_.host.listen.port = 0;
        config::Source& bus = config_.sources.emplace_back();
        bus.name = "cockpit";
        bus.kind = config::SourceKind::kCanAerospace;
        bus.interface = "no_such_can";
    }

    config::Config config_ = config::default_config();
    ManualClock clock_;
    std::vector<std::string> said_;
    Log log_{clock_, [this](Severity, std::string_view line) { said_.emplace_back(line); }};
};

struct Nobody final : ArrivalTaker {
    void take(std::size_t, const protocol::transport::Datagram&) override {}
    void take(std::size_t, const protocol::CanFrame&) override {}
};

TEST_F(LiveWireTest, ABusIsWaitedForOrItsKernelIsToldApart) {
    const protocol::transport::FileDescriptor probe(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
    if (!probe) {
        try {
            const LiveWire wire(config_, clock_, log_);
            FAIL() << "a wire without its bus";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("source cockpit: can no_such_can: "));
            EXPECT_THAT(error.what(), HasSubstr("modprobe can"));
        }
        return;
    }
    LiveWire wire(config_, clock_, log_);
    Nobody nobody;
    wire.drain(nobody);
    EXPECT_TRUE(said_.empty()) << said_.front();
    ASSERT_EQ(wire.bus_rows().size(), 1U);
    EXPECT_EQ(wire.bus_rows()[0].state, "missing");
}

TEST_F(LiveWireTest, SettingsWithoutABusNeedNoCan) {
    config_.sources.clear();
    LiveWire wire(config_, clock_, log_);
    Nobody nobody;
    wire.drain(nobody);
    EXPECT_TRUE(wire.bus_rows().empty());
    EXPECT_EQ(wire.bus(1), nullptr);
    EXPECT_TRUE(wire.local(0).has_value());
}

/// The system's, which a test sets.
class SetClock final : public Clock {
  public:
    [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return system_.monotonic_ns(); }
    [[nodiscard]] std::int64_t utc_ns() const noexcept override { return system_.utc_ns() + set_by_ns; }
    [[nodiscard]] std::int64_t steady_utc_ns() const noexcept override { return system_.steady_utc_ns(); }
    void sleep_until_ns(std::int64_t deadline_ns) override { system_.sleep_until_ns(deadline_ns); }

    std::int64_t set_by_ns = 0;

  private:
    SystemClock system_;
};

struct LastStamp final : ArrivalTaker {
    void take(std::size_t, const protocol::transport::Datagram& datagram) override {
        arrival_ns = datagram.arrival_ns;
    }
    void take(std::size_t, const protocol::CanFrame&) override {}

    std::int64_t arrival_ns = 0;
};

TEST_F(LiveWireTest, StampsArrivalsAsIfTheClockHadNotBeenSet) {
    namespace transport = protocol::transport;
    config_.sources.clear();
    SetClock clock;
    LiveWire wire(config_, clock, log_);
    LastStamp taker;
    wire.drain(taker);
    transport::UdpOptions options;
    options.listen = {0x7F000001, 0};
    auto other = transport::UdpReceiver::open(options);
    ASSERT_TRUE(other);
    auto sender = other->make_sender();
    ASSERT_TRUE(sender);
    const std::int64_t sent_ns = clock.steady_utc_ns();
    ASSERT_TRUE(sender->send(*wire.local(0), std::array<std::byte, 8>{}));
    ASSERT_TRUE(wire.wait(0, 1'000'000'000));
    clock.set_by_ns = 3'600'000'000'000;
    wire.drain(taker);
    EXPECT_GE(taker.arrival_ns, sent_ns - 1'000'000);
    EXPECT_LE(taker.arrival_ns, clock.steady_utc_ns());
    ASSERT_EQ(said_.size(), 1U);
    EXPECT_THAT(said_.front(), HasSubstr("the system's clock was set by +3600.000 s"));
}

}  // namespace
}  // namespace skyig::server
