// A whole `skyig host` against an image generator of a few lines, in time that passes by hand.
#include "clients/skyig/host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "protocol/cigi/message.h"
#include "protocol/transport/udp.h"
#include "server/clock.h"

namespace skyig::clients {
namespace {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;
using ::testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// Takes what a host sends, answers in the mode asked for.
class ImageGenerator {
  public:
    ImageGenerator() : receiver_(transport::UdpReceiver::open({.listen = loopback()}).value()) {}

    [[nodiscard]] std::string address() const { return transport::to_string(receiver_.local()); }
    [[nodiscard]] std::uint32_t heard() const { return heard_; }

    void operator()(const cigi::IgControl& control) {
        ++heard_;
        mode_ = control.ig_mode;
        host_frame_ = control.host_frame_number;
    }

    void listen() {
        cigi::Counters counters;
        receiver_.drain([&](const transport::Datagram& datagram) {
            cigi::decode_host_message(datagram.bytes, *this, counters);
        });
    }

    void answer(const transport::Endpoint& to, std::uint32_t ig_frame) {
        if (heard_ == 0) return;
        cigi::MessageWriter writer(buffer_, cigi::Version::k33, cigi::ByteOrder::kLittle);
        ASSERT_TRUE(writer.add(cigi::StartOfFrame{
            .ig_mode = mode_, .ig_frame_number = ig_frame, .last_host_frame_number = host_frame_}));
        ASSERT_TRUE(sender_.send(to, writer.bytes()));
    }

  private:
    static transport::Endpoint loopback() { return transport::parse_endpoint("127.0.0.1:0").value(); }

    transport::UdpReceiver receiver_;
    transport::UdpSender sender_ = transport::UdpSender::open().value();
    std::array<std::byte, 256> buffer_{};
    cigi::IgMode mode_ = cigi::IgMode::kStandby;
    std::uint32_t heard_ = 0;
    std::uint32_t host_frame_ = 0;
};

/// Sleeping moves the time at once, after what happens in between and a moment for the receiving threads.
class StagedClock final : public server::Clock {
  public:
    using Act = std::function<void(double now_s)>;
    explicit StagedClock(Act act) : act_(std::move(act)) {}

    [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_ns_; }
    [[nodiscard]] std::int64_t utc_ns() const noexcept override { return now_ns_ + utc_offset_ns_; }
    [[nodiscard]] std::int64_t steady_utc_ns() const noexcept override { return now_ns_; }
    void sleep_until_ns(std::int64_t deadline_ns) override {
        now_ns_ = std::max(now_ns_, deadline_ns);
        act_(static_cast<double>(now_ns_) / static_cast<double>(kSecondNs));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    void step_utc_s(std::int64_t step_s) { utc_offset_ns_ += step_s * kSecondNs; }

  private:
    Act act_;
    std::int64_t now_ns_ = 0;
    std::int64_t utc_offset_ns_ = 0;
};

struct Told {
    int status = 0;
    std::string out;
    std::string err;
};

class HostTest : public ::testing::Test {
  protected:
    HostTest() {
        std::ofstream(flight_path_) << "t_s,lat_deg,lon_deg,alt_msl_m,yaw_deg,pitch_deg,roll_deg\n"
                                       "5,10,20,100,30,0,0\n13,10,20,100,30,0,0\n";
        options_.flight_path = flight_path_;
        options_.utc = "2026-06-21T12:00:00Z";
        options_.to = generator_.address();
        options_.listen = transport::to_string(listen_);
        options_.rate_hz = 20.0;
        options_.wait_s = 5.0;
        options_.json = true;
    }
    ~HostTest() override { std::remove(flight_path_.c_str()); }

    /// A port that was free a moment ago.
    static transport::Endpoint free_endpoint() {
        return transport::UdpReceiver::open({.listen = transport::parse_endpoint("127.0.0.1:0").value()})
            .value()
            .local();
    }

    Told fly(server::Clock& clock) {
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        Told told;
        told.status = run_host(options_, clock);
        std::fflush(stdout);
        told.out = ::testing::internal::GetCapturedStdout();
        told.err = ::testing::internal::GetCapturedStderr();
        return told;
    }

    std::string flight_path_ = ::testing::TempDir() + "skyig_host_test.csv";
    ImageGenerator generator_;
    transport::Endpoint listen_ = free_endpoint();
    HostOptions options_;
    std::uint32_t ig_frame_ = 0;
};

TEST_F(HostTest, WholeFlightIsCompleteAndStatusZeroThoughUtcSteps) {
    StagedClock* staged = nullptr;
    StagedClock clock([&](double now_s) {
        if (now_s > 4.0 && now_s < 4.06) staged->step_utc_s(3600);
        generator_.listen();
        generator_.answer(listen_, ++ig_frame_);
    });
    staged = &clock;
    const Told told = fly(clock);
    EXPECT_EQ(told.status, 0) << told.err;
    EXPECT_EQ(told.err, "");
    const auto json = nlohmann::json::parse(told.out);
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_NEAR(json.at("flown_s").get<double>(), 8.0, 0.06);
}

TEST_F(HostTest, SilenceIsToldAlthoughUtcStepsBack) {
    StagedClock* staged = nullptr;
    StagedClock clock([&](double now_s) {
        generator_.listen();
        if (now_s < 2.0) generator_.answer(listen_, ++ig_frame_);
        if (now_s > 3.0 && now_s < 3.06) staged->step_utc_s(-3600);
    });
    staged = &clock;
    const Told told = fly(clock);
    EXPECT_EQ(told.status, 1);
    EXPECT_THAT(told.err, HasSubstr("stopped answering 5.0 s ago"));
}

TEST_F(HostTest, OvertakenAnswersAreSignsOfLife) {
    StagedClock clock([&](double now_s) {
        generator_.listen();
        // From the second second on every answer is older than the latest one.
        generator_.answer(listen_, now_s < 2.0 ? ++ig_frame_ : ig_frame_ - 1);
    });
    const Told told = fly(clock);
    EXPECT_EQ(told.status, 0) << told.err;
}

TEST_F(HostTest, InterruptedFlightTellsItsResultsAndStatusOne) {
    StagedClock clock([&](double now_s) {
        generator_.listen();
        generator_.answer(listen_, ++ig_frame_);
        if (now_s > 3.0 && now_s < 3.06) std::raise(SIGINT);
    });
    const Told told = fly(clock);
    EXPECT_EQ(told.status, 1);
    EXPECT_THAT(told.err, HasSubstr("interrupted after "));
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    const auto json = nlohmann::json::parse(told.out);
    EXPECT_EQ(json.at("complete"), false);
    EXPECT_GT(json.at("flown_s").get<double>(), 1.0);
    EXPECT_LT(json.at("flown_s").get<double>(), 4.0);
}

TEST_F(HostTest, StartOutsideTheFlightIsWrongUsage) {
    StagedClock clock([](double) {});
    for (const double start_s : {4.99, 13.01, -1e9}) {
        options_.start_s = start_s;
        const Told told = fly(clock);
        EXPECT_EQ(told.status, 2) << start_s;
        EXPECT_EQ(told.out, "");
        EXPECT_THAT(told.err, HasSubstr("from second 5 to second 13"));
    }
    EXPECT_EQ(generator_.heard(), 0U);
}

}  // namespace
}  // namespace skyig::clients
