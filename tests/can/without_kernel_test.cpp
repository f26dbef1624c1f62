// The daemon with a bus in its settings on the kernel that there is: one without CAN ends it with a line that
// says so, one with it lets it wait for the interface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

using ::testing::HasSubstr;

TEST(WithoutCan, TheDaemonSaysWhatIsMissingOrWaits) {
    const Site site;
    const std::string config = site.scratch.write(
        "bus.toml", read_text(site.config_path) +
                        "[[source]]\nname = \"cockpit\"\nkind = \"canaerospace\"\ninterface = \"nocan0\"\n");
    const Finished checked = run({SKYIGD_PROGRAM, "--config", config, "--check"});
    EXPECT_EQ(checked.status, 0) << checked.err;
    const Finished ran = run({SKYIGD_PROGRAM, "--config", config, "--headless", "--frames", "3"});
    const int probe = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
    std::printf("a CAN socket of this kernel: %d; said: %s\n", probe, ran.err.c_str());
    if (probe < 0) {
        EXPECT_EQ(ran.status, 1);
        EXPECT_THAT(ran.err, HasSubstr("skyigd: source cockpit: can nocan0: this kernel has "));
        EXPECT_THAT(ran.err, HasSubstr("modprobe can"));
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    } else {
        ::close(probe);
        EXPECT_EQ(ran.status, 0);
        EXPECT_THAT(ran.err,
                    HasSubstr("cockpit on nocan0 (waiting: there is no CAN interface of this name)"));
    }
}

}  // namespace
}  // namespace skyig::tests
