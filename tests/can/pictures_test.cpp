// The daemon on a CAN bus, from frames to pictures: a played log sets clock, place and weather and so changes
// what is drawn, also after the interface was down or gone. Runs in script/uml-can-run with vcan0 up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/can/guest.h"
#include "tests/e2e/process.h"
#include "tests/e2e/site.h"

namespace skyig::tests {
namespace {

using protocol::CanFrame;
using std::chrono::seconds;
using ::testing::HasSubstr;
using Json = nlohmann::json;

// Data types of CANaerospace.
constexpr std::uint8_t kFloat = 2;
constexpr std::uint8_t kLong = 3;
constexpr std::uint8_t kChar4 = 15;

/// A log in the making: what one sender says, with its message codes.
class BusLog {
  public:
    void say(std::uint32_t id, std::uint8_t type, std::initializer_list<std::uint32_t> bytes) {
        CanFrame frame;
        frame.received_ns = now_ns_;
        frame.id = id;
        frame.length = static_cast<std::uint8_t>(4 + bytes.size());
        frame.data[0] = 1;
        frame.data[1] = type;
        frame.data[3] = codes_[id]++;
        std::transform(bytes.begin(), bytes.end(), frame.data.begin() + 4,
                       [](std::uint32_t byte) { return static_cast<std::uint8_t>(byte); });
        text_ += log_line(frame);
        now_ns_ += 500'000;
    }
    void word(std::uint32_t id, std::uint8_t type, std::uint32_t bits) {
        say(id, type, {bits >> 24U, bits >> 16U & 0xFFU, bits >> 8U & 0xFFU, bits & 0xFFU});
    }
    void real(std::uint32_t id, float value) { word(id, kFloat, std::bit_cast<std::uint32_t>(value)); }
    void degrees(std::uint32_t id, double value_deg) {
        word(id, kLong, static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value_deg * 1e7))));
    }

    void place(double latitude_deg, double longitude_deg, float height_m) {
        real(1038, height_m);
        degrees(1036, latitude_deg);
        degrees(1037, longitude_deg);
    }
    void time(std::uint32_t hour, std::uint32_t minute, std::uint32_t second) {
        say(1206, kChar4, {21, 6, 20, 24});
        say(1200, kChar4, {hour, minute, second, 0});
    }
    void visibility(float visibility_m) {
        real(1840, visibility_m);
        say(1880, 0, {});
    }
    void wait_ms(std::int64_t ms) { now_ns_ += ms * 1'000'000; }

    /// The log so far; the next part goes on from there, with the codes that follow.
    [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

  private:
    std::int64_t now_ns_ = 1'700'000'000'000'000'000;
    std::array<std::uint8_t, 2048> codes_{};
    std::string text_;
};

struct Picture {
    std::vector<std::uint8_t> rgb;
};

Picture read_picture(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw std::runtime_error(path);
    image.format = PNG_FORMAT_RGB;
    Picture picture;
    picture.rgb.resize(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0)
        throw std::runtime_error(path);
    return picture;
}

/// Mean difference of a value of 0..255.
double difference(const Picture& a, const Picture& b) {
    if (a.rgb.size() != b.rgb.size() || a.rgb.empty()) throw std::runtime_error("pictures of two sizes");
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        sum += std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i]));
    return sum / static_cast<double>(a.rgb.size());
}

/// skyigd with one small channel and the bus, from midnight on, and its pictures as they come.
class BusDaemon {
  public:
    /// A picture that was begun after this call, and is complete.
    Picture picture() {
        const std::uint64_t before = newest();
        // The one that is being drawn and those under way to their files may be older than what was said.
        const std::uint64_t wanted = before + 6;
        if (!eventually([&] { return newest() > wanted; }, seconds(30)))
            throw std::runtime_error("no pictures: " + process_.err_so_far());
        const std::uint64_t number = newest() - 1;
        return read_picture(pictures_ + "/only_" + digits(number) + ".png");
    }

    void play(const std::string& log) const {
        const std::string path = scratch_.write("played.log", log);
        shell("canplayer -I " + path + " vcan0=can0");
    }
    [[nodiscard]] bool says(const std::string& part) const {
        return process_.wait_for_err(part, seconds(20));
    }

    Json stop() {
        process_.signal(SIGTERM);
        const Finished finished = process_.wait();
        EXPECT_EQ(finished.status, 0);
        std::printf("%s", finished.err.c_str());
        EXPECT_THAT(finished.out, HasSubstr("cockpit on vcan0, up: received"));
        return Json::parse(read_text(report_));
    }

  private:
    static std::string digits(std::uint64_t number) {
        std::string text = std::to_string(number);
        return std::string(6 - std::min<std::size_t>(6, text.size()), '0') + text;
    }
    [[nodiscard]] std::uint64_t newest() const {
        std::uint64_t largest = 0;
        std::error_code none_yet;
        for (const auto& entry : std::filesystem::directory_iterator(pictures_, none_yet)) {
            const std::string name = entry.path().stem().string();
            largest = std::max<std::uint64_t>(largest, std::stoull(name.substr(name.find('_') + 1)));
        }
        return largest;
    }

    ScratchDirectory scratch_;
    std::string pictures_ = scratch_.file("pictures");
    std::string report_ = scratch_.file("report.json");
    std::string config_ =
        scratch_.write("site.toml",
                       "version = 1\n[daemon]\nrate_hz = 10\n[host]\nenabled = false\n[start]\nutc = "
                       "\"2024-06-21T00:00:00Z\"\nlatitude_deg = 47.46\nlongitude_deg = 8.55\n"
                       "[[source]]\nname = \"cockpit\"\nkind = \"canaerospace\"\ninterface = \"vcan0\"\n" +
                           channel_toml("only", 160, 128, 0));
    Process process_{
        {SKYIGD_PROGRAM, "--config", config_, "--headless", "--out", pictures_, "--report", report_}};
};

TEST(Pictures, ABusMovesClockPlaceAndWeatherAndSurvivesItsInterface) {
    BusDaemon daemon;
    ASSERT_TRUE(daemon.says("cockpit on vcan0"));
    BusLog log;
    const Picture midnight = daemon.picture();
    const double quiet = difference(midnight, daemon.picture());

    for (std::uint32_t second = 0; second < 3; ++second) {
        log.time(11, 30, second);
        log.wait_ms(300);
    }
    daemon.play(log.take());
    EXPECT_TRUE(daemon.says("2024-06-21T11:30:0"));
    const Picture noon = daemon.picture();
    const double by_clock = difference(midnight, noon);

    shell("ip link set vcan0 down");
    EXPECT_TRUE(daemon.says("cockpit: vcan0 is down"));
    const double by_down = difference(noon, daemon.picture());
    shell("ip link set vcan0 up");
    EXPECT_TRUE(daemon.says("cockpit: listening on vcan0"));
    for (int i = 0; i < 10; ++i) {
        log.place(-47.46, -171.45, 9000.0F);
        log.wait_ms(50);
    }
    daemon.play(log.take());
    const double by_place = difference(noon, daemon.picture());

    shell("ip link del vcan0");
    EXPECT_TRUE(daemon.says("cockpit: vcan0 is gone"));
    shell("ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 up");
    std::this_thread::sleep_for(seconds(2));
    for (int i = 0; i < 10; ++i) {
        log.place(47.46, 8.55, 1000.0F);
        log.wait_ms(50);
    }
    daemon.play(log.take());
    // The eye comes from the night and takes its time.
    Picture back;
    double after_return = 255.0;
    EXPECT_TRUE(eventually(
        [&] {
            back = daemon.picture();
            after_return = difference(noon, back);
            return after_return < 3.0;
        },
        seconds(40)));
    log.visibility(1000.0F);
    daemon.play(log.take());
    double by_weather = 0.0;
    // The air's tables are made over several frames.
    EXPECT_TRUE(eventually(
        [&] {
            by_weather = difference(back, daemon.picture());
            return by_weather > 8.0;
        },
        seconds(20)));

    const Json report = daemon.stop();
    std::printf(
        "mean differences of pictures (0..255): quiet %.2f, interface down %.2f, place left and "
        "returned to %.2f; clock %.1f, place %.1f, weather %.1f\n",
        quiet, by_down, after_return, by_clock, by_place, by_weather);
    EXPECT_LT(quiet, 1.0);
    EXPECT_LT(by_down, 1.0);
    EXPECT_GT(by_clock, 20.0);
    EXPECT_GT(by_place, 20.0);

    EXPECT_EQ(report.at("gl_errors"), 0);
    ASSERT_EQ(report.at("buses").size(), 1U);
    const Json& bus = report.at("buses").at(0);
    EXPECT_EQ(bus.at("state"), "up");
    const Json& counts = bus.at("counts");
    EXPECT_EQ(counts.at("received"), 2 * 3 + 3 * 10 + 3 * 10 + 2);
    EXPECT_EQ(counts.at("opened"), 2);
    EXPECT_EQ(counts.at("went_away"), 1);
    EXPECT_EQ(counts.at("errors"), 0);
    EXPECT_EQ(counts.at("dropped"), 0);
    EXPECT_GE(counts.at("went_down"), 1);
}

}  // namespace
}  // namespace skyig::tests
