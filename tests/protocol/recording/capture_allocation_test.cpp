// Recording and reading allocate nothing for a packet, with what both cost.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "protocol/recording/capture_reader.h"
#include "protocol/recording/pcapng_writer.h"
#include "tests/support/allocation_count.h"

namespace skyig::protocol::recording {
namespace {

constexpr int kRounds = 100'000;
constexpr std::size_t kPayloadBytes = 216;  // a host's frame: IG Control, entity, weather

double ns_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

struct File {
    File()
        : path((std::filesystem::temp_directory_path() / ("skyig_alloc_" + std::to_string(::getpid())))
                   .string()) {}
    ~File() { std::filesystem::remove(path); }
    std::string path;
};

TEST(CaptureAllocation, NoneInWritingAndReadingPackets) {
    const File file;
    std::vector<std::byte> bytes;
    bytes.reserve(std::size_t{kRounds} * 400);
    auto writer = PcapngWriter::begin(
        [&bytes](std::span<const std::byte> blocks) {
            bytes.insert(bytes.end(), blocks.begin(), blocks.end());
            return true;
        },
        {.comment = "throughput", .can_names = {"can0"}});
    ASSERT_TRUE(writer.has_value());
    const std::vector<std::byte> payload(kPayloadBytes, std::byte{0x5A});
    std::uint64_t before = skyig::tests::allocation_count();
    auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kRounds; ++i) {
        writer->write_udp(i, {0x7F000001, 8005}, {0x7F000001, 8004}, payload, "comment");
        writer->write_can({.received_ns = i, .id = 0x123, .length = 8});
    }
    double each_ns = ns_since(begin) / (2.0 * kRounds);
    std::uint64_t counted = skyig::tests::allocation_count() - before;
    std::printf("written: %.0f ns a packet, %llu allocations\n", each_ns,
                static_cast<unsigned long long>(counted));
    EXPECT_EQ(counted, 0U);
    EXPECT_EQ(writer->written(), 2U * kRounds);
    EXPECT_LT(each_ns, 20'000.0);  // far above any machine's figure, sanitizers included

    std::ofstream(file.path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    auto reader = CaptureReader::open(file.path);
    ASSERT_TRUE(reader.has_value()) << reader.error();
    ASSERT_NE(reader->next(), nullptr);  // the interfaces before it take memory once
    std::uint64_t payload_bytes = 0;
    before = skyig::tests::allocation_count();
    begin = std::chrono::steady_clock::now();
    while (const CapturedPacket* packet = reader->next())
        payload_bytes += packet->payload.size();
    const double total_ns = ns_since(begin);
    counted = skyig::tests::allocation_count() - before;
    each_ns = total_ns / (2.0 * kRounds);
    std::printf("read: %.0f ns a packet, %.0f MB/s, %llu allocations\n", each_ns,
                static_cast<double>(bytes.size()) * 1e3 / total_ns, static_cast<unsigned long long>(counted));
    EXPECT_EQ(counted, 0U);
    EXPECT_EQ(reader->end(), CaptureReader::End::kComplete) << reader->trouble();
    EXPECT_EQ(payload_bytes, std::uint64_t{kPayloadBytes} * (kRounds - 1));
    EXPECT_EQ(reader->counters().can, std::uint64_t{kRounds});
    EXPECT_LT(each_ns, 20'000.0);
}

}  // namespace
}  // namespace skyig::protocol::recording
