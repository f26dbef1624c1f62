// A foreign reader's opinion: Wireshark's dissector reads our 3.3 messages as they were meant. It knows no
// CIGI 4.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "protocol/cigi/message.h"

namespace skyig::protocol::cigi {
namespace {

template <class T>
void append(std::vector<std::byte>& out, T value, ByteOrder order) {
    const std::size_t end = out.size();
    out.resize(end + sizeof(T));
    store(out.data() + end, order, value);
}

void append_u16(std::vector<std::byte>& out, unsigned value, ByteOrder order) {
    append(out, static_cast<std::uint16_t>(value), order);
}

void append_u32(std::vector<std::byte>& out, std::uint32_t value, ByteOrder order) {
    append(out, value, order);
}

/// A capture file with one UDP datagram in raw IPv4 (link type 101).
std::vector<std::byte> capture_of(std::span<const std::byte> payload) {
    constexpr ByteOrder kFile = ByteOrder::kLittle;
    constexpr ByteOrder kNet = ByteOrder::kBig;
    constexpr std::uint32_t kIpAndUdp = 28;
    constexpr std::uint32_t kLoopback = 0x7F000001;
    const auto length = static_cast<std::uint32_t>(payload.size());
    std::vector<std::byte> file;
    append_u32(file, 0xA1B2C3D4U, kFile);
    append_u16(file, 2, kFile);
    append_u16(file, 4, kFile);
    for (const std::uint32_t word : {0U, 0U, 65535U, 101U})
        append_u32(file, word, kFile);
    for (const std::uint32_t word : {0U, 0U, length + kIpAndUdp, length + kIpAndUdp})
        append_u32(file, word, kFile);
    append_u16(file, 0x4500, kNet);
    append_u16(file, length + kIpAndUdp, kNet);
    append_u32(file, 0, kNet);
    append_u32(file, 0x40110000U, kNet);  // time to live 64, UDP, checksum not computed
    append_u32(file, kLoopback, kNet);
    append_u32(file, kLoopback, kNet);
    append_u16(file, 8005, kNet);
    append_u16(file, 8005, kNet);
    append_u16(file, length + 8, kNet);
    append_u16(file, 0, kNet);
    file.insert(file.end(), payload.begin(), payload.end());
    return file;
}

std::string output_of(const std::string& command) {
    std::string output;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return output;
    std::array<char, 4096> part{};
    while (std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
        output.append(part.data(), count);
    ::pclose(pipe);
    return output;
}

/// What tshark prints of `payload`: every `fields` value, separated by commas.
std::string tshark_fields(std::span<const std::byte> payload, const std::vector<std::string>& fields) {
    const auto path =
        std::filesystem::temp_directory_path() / ("skyig_cigi_" + std::to_string(::getpid()) + ".pcap");
    const std::vector<std::byte> capture = capture_of(payload);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(capture.data()), static_cast<std::streamsize>(capture.size()));
    std::string command =
        "tshark -n -r " + path.string() + " -d udp.port==8005,cigi -T fields -E separator=,";
    for (const std::string& field : fields)
        command += " -e cigi." + field;
    const std::string output = output_of(command + " 2>/dev/null");
    std::filesystem::remove(path);
    return output.substr(0, output.find('\n'));
}

class Tshark : public testing::TestWithParam<ByteOrder> {
  protected:
    void SetUp() override {
        if (output_of("tshark --version 2>/dev/null").empty()) GTEST_SKIP() << "tshark is not installed";
    }
    std::array<std::byte, 512> buffer{};
    MessageWriter writer{buffer, Version::k33, GetParam()};
};

TEST_P(Tshark, ReadsStartOfFrameAsWritten) {
    ASSERT_TRUE(writer.add(StartOfFrame{.database_number = -7,
                                        .ig_status = 9,
                                        .ig_mode = IgMode::kDebug,
                                        .timestamp_valid = true,
                                        .earth_model = true,
                                        .ig_frame_number = 0x01020304,
                                        .timestamp = 0x0A0B0C0D,
                                        .last_host_frame_number = 0xFFFFFFFE}));
    const std::string read =
        tshark_fields(writer.bytes(), {"version", "sof.minor_version", "sof.db_number", "sof.ig_status",
                                       "sof.ig_mode", "sof.timestamp_valid", "sof.earth_reference_model",
                                       "sof.ig_frame_number", "sof.timestamp", "sof.last_host_frame_number"});
    EXPECT_EQ(read, "3,3,-7,9,2,1,1,16909060,168496141,4294967294");
}

TEST_P(Tshark, ReadsIgControlAndOwnshipAsWritten) {
    ASSERT_TRUE(
        writer.add(IgControl{.database_number = 7, .ig_mode = IgMode::kOperate, .host_frame_number = 77}));
    ASSERT_TRUE(writer.add(
        EntityControl{.entity_id = 3, .entity_state = EntityState::kActive, .lat_x = 47.5, .lon_y = -8.25}));
    const std::string read = tshark_fields(
        writer.bytes(), {"ig_control.db_number", "ig_control.ig_mode", "ig_control.host_frame_number",
                         "entity_control.entity_id", "entity_control.lat_xoff", "entity_control.lon_yoff"});
    EXPECT_EQ(read, "7,1,77,3,47.5,-8.25");
}

INSTANTIATE_TEST_SUITE_P(Orders, Tshark, testing::Values(ByteOrder::kLittle, ByteOrder::kBig));

}  // namespace
}  // namespace skyig::protocol::cigi
