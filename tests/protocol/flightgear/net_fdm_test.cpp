// FGNetFDM packets that FlightGear sent, and what may be wrong with one.
#include "protocol/flightgear/net_fdm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "protocol/byte_order.h"
#include "tests/protocol/flightgear/samples.h"
#include "tests/support/allocation_count.h"

namespace skyig::protocol::flightgear {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kFoot_m = 0.3048;

/// A recorded packet to be changed.
struct Packet {
    template <class T>
    Packet& put(std::size_t offset, T value) {
        store(bytes.data() + offset, ByteOrder::kBig, value);
        return *this;
    }
    [[nodiscard]] NetFdm state() const {
        const auto decoded = decode_net_fdm(bytes);
        EXPECT_TRUE(decoded.has_value()) << to_string(decoded.error());
        return decoded ? *decoded : NetFdm{};
    }
    [[nodiscard]] Refusal refusal() const {
        const auto decoded = decode_net_fdm(bytes);
        EXPECT_FALSE(decoded.has_value());
        return decoded ? Refusal{} : decoded.error();
    }

    std::vector<std::byte> bytes = samples().front().bytes;
};

TEST(NetFdm, RecordedPacketsGiveTheirFields) {
    const std::vector<Sample> all = samples();
    ASSERT_EQ(all.size(), 5U);
    double worst = 0.0;
    for (const Sample& sample : all) {
        const auto decoded = decode_net_fdm(sample.bytes);
        ASSERT_TRUE(decoded.has_value()) << to_string(decoded.error());
        const NetFdm& state = *decoded;
        const auto agrees = [&](double got, const char* name, double scale) {
            const double expected = sample.fields.at(name).get<double>() * scale;
            worst = std::max(worst, std::abs(got - expected));
            EXPECT_NEAR(got, expected, 1e-12 * (1.0 + std::abs(expected))) << name;
        };
        agrees(state.longitude_deg, "lon_rad", kDegrees);
        agrees(state.latitude_deg, "lat_rad", kDegrees);
        agrees(state.altitude_msl_m, "alt_m", 1.0);
        agrees(state.height_above_ground_m, "agl_m", 1.0);
        agrees(state.roll_deg, "phi_rad", kDegrees);
        agrees(state.pitch_deg, "theta_rad", kDegrees);
        agrees(state.heading_deg, "psi_rad", kDegrees);
        agrees(state.roll_rate_deg_s, "phidot_rps", kDegrees);
        agrees(state.pitch_rate_deg_s, "thetadot_rps", kDegrees);
        agrees(state.heading_rate_deg_s, "psidot_rps", kDegrees);
        agrees(state.velocity_north_m_s, "vn_fps", kFoot_m);
        agrees(state.velocity_east_m_s, "ve_fps", kFoot_m);
        agrees(state.velocity_down_m_s, "vd_fps", kFoot_m);
        agrees(state.visibility_m, "visibility_m", 1.0);
        EXPECT_EQ(state.time_unix_s, sample.fields.at("cur_time").get<std::int64_t>());
    }
    std::printf("5 recorded packets, largest difference of a field %.2g\n", worst);
}

TEST(NetFdm, TimeHoldsTheWarpAlready) {
    Packet packet;
    const std::int64_t before = packet.state().time_unix_s;
    packet.put<std::int32_t>(360, 86'400);
    EXPECT_EQ(packet.state().time_unix_s, before);
    packet.put<std::uint32_t>(356, 0xFFFF'FFFFU);
    EXPECT_EQ(packet.state().time_unix_s, 4'294'967'295);
}

TEST(NetFdm, OtherSizesAreRefused) {
    const Packet packet;
    for (const std::size_t size : {0U, 4U, 407U}) {
        const auto decoded = decode_net_fdm(std::span(packet.bytes).first(size));
        ASSERT_FALSE(decoded.has_value());
        EXPECT_EQ(decoded.error().reason, Reason::kSize);
    }
    Packet longer;
    longer.bytes.resize(kNetFdmBytes + 1);
    EXPECT_EQ(longer.refusal().reason, Reason::kSize);
    EXPECT_EQ(to_string(longer.refusal()), "409 bytes; FGNetFDM version 24 has 408");
}

TEST(NetFdm, OtherVersionsAreRefusedByName) {
    EXPECT_EQ(to_string(Packet{}.put<std::uint32_t>(0, 23).refusal()), "version 23; 24 is read");
    EXPECT_EQ(Packet{}.put<std::uint32_t>(0, 23).refusal().reason, Reason::kVersion);
    const Refusal withdrawn = Packet{}.put<std::uint32_t>(0, 25).refusal();
    EXPECT_EQ(withdrawn.reason, Reason::kWithdrawnVersion);
    EXPECT_EQ(to_string(withdrawn), "version 25 was withdrawn before any release sent it; 24 is read");
    const Refusal swapped = Packet{}.put<std::uint32_t>(0, 0x1800'0000U).refusal();
    EXPECT_EQ(swapped.reason, Reason::kByteOrder);
    EXPECT_EQ(to_string(swapped), "little-endian; FGNetFDM is sent big-endian");
}

struct Taken {
    std::size_t offset;
    bool is_double;
};
constexpr std::array kTaken{Taken{8, true},   Taken{16, true},  Taken{24, true},  Taken{32, false},
                            Taken{36, false}, Taken{40, false}, Taken{44, false}, Taken{56, false},
                            Taken{60, false}, Taken{64, false}, Taken{76, false}, Taken{80, false},
                            Taken{84, false}, Taken{364, false}};

TEST(NetFdm, NoTakenFieldMayBeNanOrInfinite) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const Taken& field : kTaken) {
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
            Packet packet;
            if (field.is_double)
                packet.put(field.offset, bad);
            else
                packet.put(field.offset, static_cast<float>(bad));
            const Refusal refusal = packet.refusal();
            EXPECT_EQ(refusal.reason, Reason::kNonFinite) << field.offset;
            EXPECT_EQ(refusal.offset, field.offset);
        }
    }
    EXPECT_EQ(to_string(Packet{}.put(364, std::numeric_limits<float>::infinity()).refusal()),
              "byte 364: visibility is inf; a finite number");
}

TEST(NetFdm, WhatIsNotTakenIsNotChecked) {
    const NetFdm plain = Packet{}.state();
    Packet packet;
    for (const std::size_t offset : {48U, 52U, 68U, 72U, 88U, 100U, 112U, 140U, 288U, 320U, 368U, 404U})
        packet.put(offset, std::numeric_limits<float>::quiet_NaN());
    packet.put<std::uint32_t>(120, 99).put<std::uint32_t>(4, 0xFFFF'FFFFU);
    EXPECT_EQ(packet.state(), plain);
}

TEST(NetFdm, RangesHoldAtTheirEnds) {
    constexpr double kPi = std::numbers::pi;
    EXPECT_DOUBLE_EQ(Packet{}.put(16, kPi / 2).state().latitude_deg, 90.0);
    EXPECT_EQ(Packet{}.put(16, 1.5708).refusal().reason, Reason::kOutOfRange);
    EXPECT_EQ(Packet{}.put(16, -1.5708).refusal().offset, 16U);
    EXPECT_EQ(Packet{}.put(24, -13e3).refusal().offset, 24U);
    EXPECT_EQ(Packet{}.put(24, 1.1e8).refusal().offset, 24U);
    EXPECT_DOUBLE_EQ(Packet{}.put(24, 35'786e3).state().altitude_msl_m, 35'786e3);
    EXPECT_EQ(Packet{}.put(80, 1e6F).refusal().offset, 80U);
    EXPECT_EQ(Packet{}.put(364, -1.0F).refusal().offset, 364U);
    EXPECT_EQ(Packet{}.put(36, 3.1417F).refusal().offset, 36U);
    EXPECT_EQ(Packet{}.put(44, 6.2833F).refusal().offset, 44U);
    EXPECT_EQ(to_string(Packet{}.put(364, -1.0F).refusal()), "byte 364: visibility is -1; 0 to 1.79769e+308");
}

TEST(NetFdm, SinglePrecisionAnglesBeyondTheirEndAreBroughtBack) {
    // The single-precision numbers nearest to a half turn and a quarter lie beyond them.
    EXPECT_EQ(Packet{}.put(36, static_cast<float>(std::numbers::pi)).state().roll_deg, 180.0);
    EXPECT_EQ(Packet{}.put(40, static_cast<float>(-std::numbers::pi / 2)).state().pitch_deg, -90.0);
    const double full = Packet{}.put(44, static_cast<float>(2 * std::numbers::pi)).state().heading_deg;
    EXPECT_GE(full, 0.0);
    EXPECT_LT(full, 1e-4);
    EXPECT_EQ(Packet{}.put(44, -1e-30F).state().heading_deg, 0.0);
    EXPECT_NEAR(Packet{}.put(44, -0.5F).state().heading_deg, 360.0 - 0.5 * kDegrees, 1e-9);
    EXPECT_NEAR(Packet{}.put(8, 1.5 * std::numbers::pi).state().longitude_deg, -90.0, 1e-9);
}

TEST(NetFdm, RandomBytesBreakNoPromise) {
    constexpr int kRounds = 150'000;
    const std::uint64_t seed = std::random_device{}();
    std::mt19937_64 random(seed);
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    const std::vector<Sample> all = samples();
    // Ends where the storage ends, so that the sanitizer sees a read beyond.
    const std::unique_ptr<std::byte[]> storage(new std::byte[kNetFdmBytes]);
    const std::span<std::byte> bytes(storage.get(), kNetFdmBytes);
    std::array<std::uint64_t, kReasons> refused{};
    std::uint64_t accepted = 0;
    for (int round = 0; round < kRounds && !testing::Test::HasFailure(); ++round) {
        std::ranges::copy(all[random() % all.size()].bytes, bytes.begin());
        for (std::uint64_t changes = 1 + random() % 6; changes > 0; --changes) {
            const std::size_t field = kTaken[random() % kTaken.size()].offset;
            const std::size_t at = random() % 64 == 0 ? random() % 4 : field + random() % 4;
            bytes[at] = random() % 8 == 0 ? std::byte{0x7F} : static_cast<std::byte>(random() & 0xFFU);
        }
        if (random() % 256 == 0) bytes[3] = std::byte{25};
        if (random() % 256 == 0)
            std::ranges::copy(std::array{std::byte{24}, std::byte{}, std::byte{}, std::byte{}},
                              bytes.begin());
        const std::size_t size = random() % 64 == 0 ? random() % kNetFdmBytes : kNetFdmBytes;
        const auto decoded = decode_net_fdm(bytes.last(size));
        if (!decoded) {
            ++refused[static_cast<std::size_t>(decoded.error().reason)];
            continue;
        }
        ++accepted;
        EXPECT_LE(std::abs(decoded->longitude_deg), 180.0);
        EXPECT_LE(std::abs(decoded->latitude_deg), 90.0);
        EXPECT_LE(std::abs(decoded->roll_deg), 180.0);
        EXPECT_LE(std::abs(decoded->pitch_deg), 90.0);
        EXPECT_TRUE(decoded->heading_deg >= 0.0 && decoded->heading_deg < 360.0) << decoded->heading_deg;
        EXPECT_TRUE(std::isfinite(decoded->heading_rate_deg_s) && std::isfinite(decoded->visibility_m));
    }
    std::printf("%llu accepted\n", static_cast<unsigned long long>(accepted));
    EXPECT_GT(accepted, 10'000U);
    for (std::size_t i = 0; i < kReasons; ++i) {
        const auto reason = static_cast<Reason>(i);
        std::printf("  %-18s %llu\n", std::string(reason_name(reason)).c_str(),
                    static_cast<unsigned long long>(refused[i]));
        EXPECT_GT(refused[i], 0U) << reason_name(reason);
    }
}

TEST(NetFdm, DecodingAllocatesNothing) {
    constexpr int kRounds = 100'000;
    const std::vector<Sample> all = samples();
    double sum = 0.0;
    const std::uint64_t before = skyig::tests::allocation_count();
    const auto begin = std::chrono::steady_clock::now();
    for (int round = 0; round < kRounds; ++round) {
        const auto decoded = decode_net_fdm(all[static_cast<std::size_t>(round) % all.size()].bytes);
        if (decoded) sum += decoded->latitude_deg;
        static_cast<void>(decode_net_fdm({}));
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    const std::uint64_t counted = skyig::tests::allocation_count() - before;
    std::printf("%.0f ns a packet, %llu allocations (mean latitude %.3f)\n", time.count() / kRounds,
                static_cast<unsigned long long>(counted), sum / kRounds);
    EXPECT_EQ(counted, 0U);
    EXPECT_LT(time.count() / kRounds, 20'000.0);  // far above any machine's figure, sanitizers included
}

}  // namespace
}  // namespace skyig::protocol::flightgear
