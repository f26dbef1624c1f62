// A whole recorded flight, from the capture file to states that must agree with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "protocol/flightgear/net_fdm.h"
#include "protocol/recording/capture_reader.h"

namespace skyig::protocol::flightgear {
namespace {

struct Stamped {
    std::int64_t time_ns;
    NetFdm state;
};

std::vector<Stamped> flight(const std::string& path) {
    std::vector<Stamped> states;
    auto reader = recording::CaptureReader::open(path);
    EXPECT_TRUE(reader.has_value()) << reader.error();
    if (!reader) return states;
    while (const recording::CapturedPacket* packet = reader->next()) {
        EXPECT_EQ(packet->kind, recording::CapturedPacket::Kind::kUdp);
        EXPECT_EQ(packet->to, (transport::Endpoint{0x7F000001, 5500}));
        const auto decoded = decode_net_fdm(packet->payload);
        EXPECT_TRUE(decoded.has_value()) << to_string(decoded.error());
        if (decoded) states.push_back({packet->time_ns, *decoded});
    }
    EXPECT_EQ(reader->end(), recording::CaptureReader::End::kComplete) << reader->trouble();
    EXPECT_EQ(reader->counters().udp, reader->counters().packets);
    return states;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Medians of |position difference / time - velocity|, m/s.
struct Disagreement {
    double north = 0.0;
    double east = 0.0;
    double down = 0.0;
};

/// Metres on the WGS 84 ellipsoid over a step of some metres: the two radii of curvature at its middle.
Disagreement compare(const std::vector<Stamped>& states, std::size_t span) {
    constexpr double kAxis_m = 6'378'137.0;
    constexpr double kSquaredEccentricity = 6.694379990141e-3;
    constexpr double kRadians = std::numbers::pi / 180.0;
    std::vector<double> north, east, down;
    for (std::size_t i = 0; i + span < states.size(); ++i) {
        const Stamped& a = states[i];
        const Stamped& b = states[i + span];
        const double seconds = static_cast<double>(b.time_ns - a.time_ns) * 1e-9;
        const double sine = std::sin(a.state.latitude_deg * kRadians);
        const double w2 = 1.0 - kSquaredEccentricity * sine * sine;
        const double height = a.state.altitude_msl_m;
        const double meridian_m = kAxis_m * (1.0 - kSquaredEccentricity) / (w2 * std::sqrt(w2)) + height;
        const double parallel_m = (kAxis_m / std::sqrt(w2) + height) * std::sqrt(1.0 - sine * sine);
        double vn = 0.0, ve = 0.0, vd = 0.0;
        for (std::size_t k = i; k <= i + span; ++k) {
            const double weight = (k == i || k == i + span ? 0.5 : 1.0) / static_cast<double>(span);
            vn += weight * states[k].state.velocity_north_m_s;
            ve += weight * states[k].state.velocity_east_m_s;
            vd += weight * states[k].state.velocity_down_m_s;
        }
        north.push_back(
            std::abs((b.state.latitude_deg - a.state.latitude_deg) * kRadians * meridian_m / seconds - vn));
        east.push_back(
            std::abs((b.state.longitude_deg - a.state.longitude_deg) * kRadians * parallel_m / seconds - ve));
        down.push_back(std::abs((a.state.altitude_msl_m - b.state.altitude_msl_m) / seconds - vd));
    }
    return {median(north), median(east), median(down)};
}

void check(const std::vector<Stamped>& states, const char* name, std::size_t span, double bound_m_s) {
    ASSERT_GT(states.size(), span);
    for (std::size_t i = 1; i < states.size(); ++i) {
        ASSERT_GT(states[i].time_ns, states[i - 1].time_ns);
        ASSERT_GE(states[i].state.time_unix_s, states[i - 1].state.time_unix_s);
    }
    const Disagreement off = compare(states, span);
    std::printf(
        "%s: %zu packets, position against velocity over %zu packets: median north %.3f, east %.3f, "
        "down %.3f m/s\n",
        name, states.size(), span, off.north, off.east, off.down);
    EXPECT_LT(off.north, bound_m_s);
    EXPECT_LT(off.east, bound_m_s);
    EXPECT_LT(off.down, bound_m_s);
}

TEST(RecordedFlight, TwoSecondsOfItMoveAsTheySay) {
    const auto states = flight(SKYIG_TEST_DATA "/flights/fg_native_fdm_2s.pcap");
    EXPECT_EQ(states.size(), 60U);
    check(states, "2 s", 30, 0.25);
}

TEST(RecordedFlight, TwentySecondsOfItMoveAsTheySay) {
    const std::string path = SKYIG_REFERENCE "/flights/fg_native_fdm_20s.pcap";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the recording of 20 s is not beside this clone";
    const auto states = flight(path);
    EXPECT_EQ(states.size(), 593U);
    // Packet times are those of the arrival, not of the flight model: what is left is their unevenness.
    check(states, "20 s", 60, 0.25);
}

}  // namespace
}  // namespace skyig::protocol::flightgear
