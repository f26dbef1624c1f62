// Buses of the settings; what passes over UDP sockets is tested with whole programs.
#include "server/live_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>

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
            const LiveWire wire(config_, log_);
            FAIL() << "a wire without its bus";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("source cockpit: can no_such_can: "));
            EXPECT_THAT(error.what(), HasSubstr("modprobe can"));
        }
        return;
    }
    LiveWire wire(config_, log_);
    Nobody nobody;
    wire.drain(nobody);
    EXPECT_TRUE(said_.empty()) << said_.front();
    ASSERT_EQ(wire.bus_rows().size(), 1U);
    EXPECT_EQ(wire.bus_rows()[0].state, "missing");
}

TEST_F(LiveWireTest, SettingsWithoutABusNeedNoCan) {
    config_.sources.clear();
    LiveWire wire(config_, log_);
    Nobody nobody;
    wire.drain(nobody);
    EXPECT_TRUE(wire.bus_rows().empty());
    EXPECT_EQ(wire.bus(1), nullptr);
    EXPECT_TRUE(wire.local(0).has_value());
}

}  // namespace
}  // namespace skyig::server
