#include "protocol/recording/candump_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

TEST(CandumpReader, LogIsACaptureOfCan) {
    const std::string log =
        "# made by hand\n"
        "(1718994600.002500) can1 138#01020010\r\n"
        "\n"
        "(1718994600.0035)   can0 00010130#0102 T\n"
        "(1718994600.004000) can1 123##5001122\n"
        "(1718994600.005000) can1 20000004#0001000000000000";
    auto reader = CaptureReader::over(std::as_bytes(std::span(log)), "FILE");
    ASSERT_TRUE(reader) << reader.error();
    std::vector<std::string> seen;
    while (const CapturedPacket* packet = reader->next()) {
        EXPECT_EQ(packet->kind, CapturedPacket::Kind::kCan);
        EXPECT_EQ(packet->can.received_ns, packet->time_ns);
        seen.push_back(reader->interface_of_last().name + ' ' + std::to_string(packet->can.bus) + ' ' +
                       std::to_string(packet->can.id) + ' ' +
                       std::to_string(packet->time_ns % 1'000'000'000));
    }
    EXPECT_THAT(seen, testing::ElementsAre("can1 0 312 2500000", "can0 1 65840 3500000", "can1 0 291 4000000",
                                           "can1 0 4 5000000"));
    EXPECT_EQ(reader->end(), CaptureReader::End::kComplete);
    EXPECT_EQ(reader->counters().can, 4U);
    EXPECT_EQ(reader->interfaces().size(), 2U);
}

// `##` says CAN FD and old kernels set no bit for it: a frame is the same in whatever recording it stands.
TEST(CandumpReader, CanFdFramesAreThoseOfACapture) {
    const std::string log = "(4.40) can0 70E##2FEEEEE\n";
    auto from_log = CaptureReader::over(std::as_bytes(std::span(log)), "FILE");
    ASSERT_TRUE(from_log);
    const CapturedPacket* logged = from_log->next();
    ASSERT_NE(logged, nullptr);
    const auto bytes = can_bytes(0x70E, "\xFE\xEE\xEE", 2 | 4);
    const auto capture = Builder(ByteOrder::kLittle)
                             .section()
                             .interface(link_type::kSocketCan, 9)
                             .packet(0, logged->time_ns, bytes);
    auto from_capture = CaptureReader::over(capture.bytes, "FILE");
    ASSERT_TRUE(from_capture);
    const CapturedPacket* captured = from_capture->next();
    ASSERT_NE(captured, nullptr);
    EXPECT_EQ(logged->can.fd_flags, 6);
    EXPECT_TRUE(logged->can == captured->can);
}

}  // namespace
}  // namespace skyig::protocol::recording
