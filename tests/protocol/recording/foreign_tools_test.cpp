// Wireshark's programs read what we write as it was meant, and we read what they write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "protocol/recording/pcapng_writer.h"
#include "tests/protocol/recording/capture_bytes.h"

namespace skyig::protocol::recording {
namespace {

using testing::HasSubstr;

std::string output_of(const std::string& command) {
    std::string output;
    FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
    if (pipe == nullptr) return output;
    std::array<char, 4096> part{};
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
        output.append(part.data(), count);
    ::pclose(pipe);
    return output;
}

class ForeignTools : public testing::Test {
  protected:
    void SetUp() override {
        if (output_of("command -v tshark && command -v editcap && command -v mergecap && command -v capinfos")
                .empty())
            GTEST_SKIP() << "tshark, capinfos, editcap and mergecap are not installed";
        folder_ = std::filesystem::temp_directory_path() / ("skyig_foreign_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        if (!folder_.empty()) std::filesystem::remove_all(folder_);
    }
    [[nodiscard]] std::string path(std::string_view name) const { return (folder_ / name).string(); }

    std::string write(std::string_view name, const ByteVector& bytes) const {
        std::ofstream(path(name), std::ios::binary) << text_of(bytes);
        return path(name);
    }
    /// One line a packet, the fields separated by '|'.
    static std::string fields(const std::string& file, const std::string& names,
                              const std::string& options = {}) {
        std::string command = "tshark -n -r " + file + " -o udp.check_checksum:TRUE" +
                              " -o ip.check_checksum:TRUE -T fields -E separator='|' " + options;
        for (std::size_t at = 0; at < names.size();) {
            const std::size_t end = std::min(names.find(' ', at), names.size());
            command += " -e " + names.substr(at, end - at);
            at = end + 1;
        }
        return output_of(command);
    }

    /// Three datagrams and, with CAN, frames of five kinds, as the recorder writes them.
    std::string our_recording(bool with_can = true) const {
        ByteVector bytes;
        auto writer = PcapngWriter::begin(
            [&bytes](std::span<const std::byte> blocks) {
                bytes.insert(bytes.end(), blocks.begin(), blocks.end());
                return true;
            },
            {.comment = "skyig test\nsecond line",
             .program = "skyig 0.1",
             .can_names = with_can ? std::vector<std::string>{"can0", "can1"} : std::vector<std::string>{}});
        EXPECT_TRUE(writer.has_value());
        const transport::Endpoint from{0xC0A80102, 40'001};
        const transport::Endpoint to{0x7F000001, 40'002};
        for (const std::string_view payload : {"", "odd", "even"})
            writer->write_udp(kTime_ns, from, to, std::as_bytes(std::span(payload)), "note");
        if (!with_can) return write("datagrams.pcapng", bytes);
        CanFrame frame{.received_ns = kTime_ns + 1, .id = 0x123, .length = 4};
        frame.data = {0xDE, 0xAD, 0xBE, 0xEF};
        writer->write_can(frame);
        writer->write_can(
            {.received_ns = kTime_ns + 2, .id = 0x1ABCDEF0, .length = 2, .bus = 1, .extended = true});
        writer->write_can({.received_ns = kTime_ns + 3, .id = 0x7FF, .length = 4, .remote = true});
        writer->write_can({.received_ns = kTime_ns + 4, .id = 0x4, .length = 8, .error = true});
        writer->write_can({.received_ns = kTime_ns + 5, .id = 0x321, .length = 12, .fd = true, .fd_flags = 5},
                          "fd");
        return write("ours.pcapng", bytes);
    }

    static std::vector<CapturedPacket> read(const std::string& file,
                                            std::vector<std::string>* payloads = nullptr) {
        auto reader = CaptureReader::open(file);
        EXPECT_TRUE(reader.has_value()) << reader.error();
        std::vector<CapturedPacket> packets;
        if (!reader) return packets;
        while (const CapturedPacket* packet = reader->next()) {
            packets.push_back(*packet);
            if (payloads != nullptr) payloads->push_back(text_of(packet->payload));
        }
        EXPECT_EQ(reader->end(), CaptureReader::End::kComplete) << reader->trouble();
        return packets;
    }

  private:
    std::filesystem::path folder_;
};

TEST_F(ForeignTools, TsharkReadsOurDatagrams) {
    const std::string seen = fields(our_recording(),
                                    "frame.time_epoch ip.src ip.dst udp.srcport udp.dstport udp.payload "
                                    "ip.checksum.status udp.checksum.status frame.comment",
                                    "-Y udp");
    const std::string common = "1718978566.123456789|192.168.1.2|127.0.0.1|40001|40002|";
    EXPECT_EQ(seen, common + "|1|1|note\n" + common + "6f6464|1|1|note\n" + common + "6576656e|1|1|note\n");
}

TEST_F(ForeignTools, TsharkReadsOurCanFrames) {
    const std::string seen = fields(
        our_recording(),
        "frame.time_epoch frame.interface_name can.id can.len can.flags.xtd can.flags.rtr can.flags.err "
        "canfd.flags.brs canfd.flags.esi data.data frame.comment _ws.malformed",
        "-Y 'can or canfd'");
    EXPECT_EQ(
        seen,
        "1718978566.123456790|can0|291|4|0|0|0|||deadbeef||\n"
        "1718978566.123456791|can1|448585456|2|1|0|0|||0000||\n"
        "1718978566.123456792|can0|2047|4|0|1|0|||||\n"
        "1718978566.123456793|can0||8|||1|||||\n"  // an error frame has classes in place of an identifier
        "1718978566.123456794|can0|801|12|0|||1|0|000000000000000000000000|fd|\n");
}

TEST_F(ForeignTools, CapinfosKnowsOurHead) {
    const std::string seen = output_of("capinfos " + our_recording());
    EXPECT_THAT(seen, HasSubstr("Wireshark/... - pcapng"));
    EXPECT_THAT(seen, HasSubstr("nanoseconds (9)"));
    EXPECT_THAT(seen, HasSubstr("Number of packets:   8"));
    EXPECT_THAT(seen, HasSubstr("skyig test"));
    EXPECT_THAT(seen, HasSubstr("Capture application: skyig 0.1"));
    EXPECT_THAT(seen, HasSubstr("Name = can1"));
}

TEST_F(ForeignTools, EveryFormatOfEditcapGivesTheSamePackets) {
    const std::string ours = our_recording(false);
    for (const auto& [format, step_ns] :
         {std::pair{"pcap", std::int64_t{1000}}, std::pair{"nsecpcap", std::int64_t{1}},
          std::pair{"pcapng", std::int64_t{1}}}) {
        const std::string other = path(std::string("edited.") + format);
        output_of("editcap -F " + std::string(format) + " " + ours + " " + other);
        std::vector<std::string> payloads;
        const auto packets = read(other, &payloads);
        ASSERT_EQ(packets.size(), 3U) << format;
        EXPECT_EQ(payloads, (std::vector<std::string>{"", "odd", "even"}));
        EXPECT_EQ(packets[2].time_ns, kTime_ns / step_ns * step_ns);
        EXPECT_EQ(packets[2].from, (transport::Endpoint{0xC0A80102, 40'001}));
    }
}

TEST_F(ForeignTools, EditcapAndMergecapKeepOurCanFrames) {
    const std::string ours = our_recording();
    const std::string edited = path("edited.pcapng");
    const std::string merged = path("merged.pcapng");
    output_of("editcap -a '5:another comment' " + ours + " " + edited);
    output_of("mergecap -w " + merged + " " + ours + " " + edited);
    const auto expected = read(ours);
    ASSERT_EQ(expected.size(), 8U);
    const auto packets = read(edited);
    ASSERT_EQ(packets.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(packets[i].can, expected[i].can) << i;
    EXPECT_EQ(read(merged).size(), 16U);
}

TEST_F(ForeignTools, CanInCookedCapturesIsReadAsTsharkReadsIt) {
    for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
        const ByteVector inside = can_bytes(0x123, "1234", 0, order);
        const ByteVector cooked = big_endian().u16(0).u16(280).u16(0).u64(0).u16(0x000C).raw(inside).bytes;
        const std::string file = write(
            "cooked.pcap",
            Builder(order).pcap_header(0xA1B23C4D, link_type::kLinuxCooked).pcap_record(5, 6, cooked).bytes);
        EXPECT_EQ(fields(file, "can.id data.data"), "291|31323334\n");
        const auto packets = read(file);
        ASSERT_EQ(packets.size(), 1U);
        EXPECT_EQ(packets[0].can.id, 0x123U);
    }
}

}  // namespace
}  // namespace skyig::protocol::recording
