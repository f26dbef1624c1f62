// The whole message to the host, as it goes on the wire.
#include "server/answers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "protocol/recording/pcapng_writer.h"
#include "server/inbox.h"
#include "tests/server/world/host_bench.h"
#include "tests/support/allocation_count.h"

namespace skyig::server {
namespace {

namespace cigi = protocol::cigi;
using world::HostBench;
using world::kHostA;
using world::kHostB;

/// What a host reads out of one message.
struct Heard {
    std::size_t start_of_frame = 0;
    cigi::StartOfFrame frame;
    std::vector<cigi::HatHotResponse> heights;
    std::vector<cigi::HatHotExtendedResponse> extended;
    std::vector<cigi::LosResponse> sights;
    std::vector<cigi::LosExtendedResponse> extended_sights;
    std::vector<cigi::PositionResponse> places;
    std::vector<cigi::WeatherConditionsResponse> weather;
    std::vector<cigi::AerosolResponse> aerosols;
    std::vector<cigi::MaritimeSurfaceResponse> seas;
    std::vector<cigi::TerrestrialSurfaceResponse> grounds;
    std::vector<cigi::EventNotification> events;
    std::vector<std::pair<int, std::string>> messages;

    void operator()(const cigi::StartOfFrame& packet) {
        ++start_of_frame;
        frame = packet;
    }
    void operator()(const cigi::HatHotResponse& packet) { heights.push_back(packet); }
    void operator()(const cigi::HatHotExtendedResponse& packet) { extended.push_back(packet); }
    void operator()(const cigi::LosResponse& packet) { sights.push_back(packet); }
    void operator()(const cigi::LosExtendedResponse& packet) { extended_sights.push_back(packet); }
    void operator()(const cigi::PositionResponse& packet) { places.push_back(packet); }
    void operator()(const cigi::WeatherConditionsResponse& packet) { weather.push_back(packet); }
    void operator()(const cigi::AerosolResponse& packet) { aerosols.push_back(packet); }
    void operator()(const cigi::MaritimeSurfaceResponse& packet) { seas.push_back(packet); }
    void operator()(const cigi::TerrestrialSurfaceResponse& packet) { grounds.push_back(packet); }
    void operator()(const cigi::EventNotification& packet) { events.push_back(packet); }
    void operator()(const cigi::IgMessage& packet) {
        messages.emplace_back(packet.message_id, std::string(packet.text));
    }

    [[nodiscard]] std::size_t answers() const {
        return heights.size() + extended.size() + sights.size() + extended_sights.size() + places.size() +
               weather.size() + aerosols.size() + seas.size() + grounds.size() + events.size() +
               messages.size();
    }
};

class AnswersTest : public ::testing::TestWithParam<cigi::Version> {
  protected:
    AnswersTest() { bench_.version = GetParam(); }

    std::span<const std::byte> open() {
        now_ns_ += 16'666'667;
        bench_.world.advance(1.0 / 60.0);
        return answers_.open_frame(bench_.world, now_ns_, false);
    }
    /// The next frame's message, sound and in its version, as a host reads it.
    Heard next() {
        const std::span<const std::byte> bytes = open();
        Heard heard;
        cigi::Counters counters;
        const cigi::MessageSummary summary = cigi::decode_ig_message(bytes, heard, counters);
        EXPECT_TRUE(summary.accepted);
        EXPECT_FALSE(summary.fault.has_value());
        EXPECT_EQ(summary.version, GetParam());
        EXPECT_EQ(heard.start_of_frame, 1U);
        EXPECT_LE(bytes.size(), Answers::kMostBytes);
        EXPECT_EQ(bytes.size() % 8, 0U);
        for (std::size_t i = 0; i < cigi::kCounts; ++i)
            EXPECT_EQ(counters[static_cast<cigi::Count>(i)], 0U) << "count " << i;
        return heard;
    }

    HostBench bench_;
    Answers answers_{bench_.config.host};
    std::int64_t now_ns_ = 0;
};

cigi::HatHotRequest hat(int id, int period = 0) {
    cigi::HatHotRequest request;
    request.request_id = static_cast<std::uint16_t>(id);
    request.update_period = static_cast<std::uint8_t>(period);
    request.lat_x = 47.0;
    request.alt_z = 100.0;
    return request;
}

TEST_P(AnswersTest, StandBehindStartOfFrameOfTheNextFrame) {
    cigi::EnvConditionsRequest conditions;
    conditions.request_type = 15;
    conditions.request_id = 3;
    cigi::PositionRequest place;
    cigi::HatHotRequest both = hat(8);
    both.request_type = cigi::HatHotType::kExtended;
    cigi::WeatherControl fog;
    fog.weather_enable = true;
    fog.thickness = 100.0F;
    fog.visibility = 200.0F;
    fog.aerosol = 0.5F;
    bench_.send(kHostA, fog, hat(7), both, place, conditions);
    const Heard heard = next();
    ASSERT_EQ(heard.answers(), 7U);
    EXPECT_EQ(heard.heights[0].request_id, 7);
    EXPECT_EQ(heard.heights[0].height, 100.0);
    EXPECT_EQ(heard.heights[0].host_frame_lsn, 1);
    EXPECT_EQ(heard.extended[0].hat, 100.0);
    EXPECT_EQ(heard.places[0].lat_x, bench_.config.start.latitude_deg);
    EXPECT_EQ(heard.weather[0].visibility, 200.0F);
    EXPECT_EQ(heard.aerosols[0].aerosol, 0.5F);
    EXPECT_EQ(heard.seas[0].request_id, 3);
    EXPECT_EQ(heard.grounds[0].condition_id, 0U);
    EXPECT_EQ(next().answers(), 0U);
    EXPECT_EQ(answers_.written(), 7U);
}

TEST_P(AnswersTest, ComeAgainEveryPeriodAndEveryFrame) {
    cigi::PositionRequest place;
    place.object_class = 2;
    place.object_id = 1;
    place.update_mode = true;
    bench_.send(kHostA, hat(1, 4), place);
    std::string heights;
    for (int frame = 0; frame < 9; ++frame) {
        const Heard heard = next();
        heights += heard.heights.empty() ? '.' : 'x';
        EXPECT_EQ(heard.places.size(), 1U);
    }
    EXPECT_EQ(heights, "x...x...x");
}

TEST_P(AnswersTest, LinesOfSightAreAnsweredEveryPeriodAsNotValid) {
    cigi::LosSegmentRequest segment;
    segment.request_id = 5;
    segment.update_period = 3;
    cigi::LosVectorRequest vector;
    vector.request_id = 6;
    vector.request_type = true;
    bench_.send(kHostA, segment, vector);
    std::string frames;
    std::size_t extended = 0;
    for (int frame = 0; frame < 6; ++frame) {
        const Heard heard = next();
        frames += heard.sights.empty() ? '.' : 'x';
        extended += heard.extended_sights.size();
        for (const cigi::LosResponse& response : heard.sights)
            EXPECT_FALSE(response.valid);
    }
    EXPECT_EQ(frames, "x..x..");
    EXPECT_EQ(extended, 1U);
}

TEST_P(AnswersTest, StartOfFrameTellsWhoseEarthItIs) {
    cigi::EarthModelDefinition sphere;
    sphere.custom_enable = true;
    sphere.equatorial_radius = 6'371'000.0;
    sphere.flattening = 0.0;
    bench_.send(kHostA, sphere);
    EXPECT_TRUE(next().frame.earth_model);
    sphere.equatorial_radius = 3'390'000.0;
    bench_.send(kHostA, sphere);
    EXPECT_TRUE(next().frame.earth_model) << "what is refused changes nothing";
    bench_.send(kHostA, cigi::EarthModelDefinition{});
    EXPECT_FALSE(next().frame.earth_model);
}

TEST_P(AnswersTest, NothingButStartOfFrameInStandby) {
    bench_.mode = cigi::IgMode::kStandby;
    bench_.send(kHostA, hat(1, 1));
    EXPECT_EQ(next().answers(), 0U);
    bench_.mode = cigi::IgMode::kOperate;
    bench_.send(kHostA, hat(1, 1));
    EXPECT_EQ(next().answers(), 1U);
    bench_.mode = cigi::IgMode::kStandby;
    bench_.send(kHostA);
    EXPECT_EQ(next().answers(), 0U);
    bench_.mode = cigi::IgMode::kOperate;
    bench_.send(kHostA);
    EXPECT_EQ(next().answers(), 0U) << "Standby forgets";
}

TEST_P(AnswersTest, AFloodIsSpreadOverFrames) {
    std::size_t asked = 0;
    for (int message = 0; message < 100; ++message) {
        bench_.send(kHostA, hat(message * 4), hat(message * 4 + 1), hat(message * 4 + 2),
                    hat(message * 4 + 3));
        asked += 4;
    }
    std::vector<int> ids;
    std::size_t frames = 0;
    while (ids.size() < asked && frames < 50) {
        const Heard heard = next();
        for (const cigi::HatHotResponse& response : heard.heights)
            ids.push_back(response.request_id);
        ++frames;
        if (GetParam() == cigi::Version::k40) {
            EXPECT_EQ(heard.frame.excess_variable_data, ids.size() < asked);
        }
    }
    ASSERT_EQ(ids.size(), asked);
    for (std::size_t i = 0; i < ids.size(); ++i)
        ASSERT_EQ(ids[i], static_cast<int>(i)) << "first asked, first answered";
    EXPECT_EQ(frames, 5U) << "90 responses of 16 bytes a message";
    for (int i = 0; i < 2000; ++i)
        bench_.send(kHostA, hat(i));
    EXPECT_EQ(bench_.world.counters().request_full, 2000U - world::Requests::kMostWaiting);
    std::printf("  %zu requests answered in %zu frames\n", asked, frames);
}

TEST_P(AnswersTest, ResponsesToOneRequestGoOnInTheNextFrame) {
    for (int id = 0; id < 256; ++id) {
        cigi::WeatherControl layer;
        layer.layer_id = static_cast<std::uint8_t>(id);
        layer.weather_enable = true;
        layer.thickness = 100.0F;
        layer.aerosol = static_cast<float>(id);
        bench_.send(kHostA, layer);
    }
    cigi::EnvConditionsRequest conditions;
    conditions.request_type = 8;
    bench_.send(kHostA, conditions, hat(1));
    std::vector<int> layers;
    std::size_t heights = 0;
    for (int frame = 0; frame < 5; ++frame) {
        const Heard heard = next();
        for (const cigi::AerosolResponse& response : heard.aerosols)
            layers.push_back(response.layer_id);
        heights += heard.heights.size();
    }
    ASSERT_EQ(layers.size(), 256U);
    for (int id = 0; id < 256; ++id)
        EXPECT_EQ(layers[static_cast<std::size_t>(id)], id);
    EXPECT_EQ(heights, 1U);
}

TEST_P(AnswersTest, SearchesAFrameAreFew) {
    cigi::EnvConditionsRequest conditions;
    conditions.request_type = 4;
    for (int i = 0; i < 3 * Answers::kMostSearches; ++i)
        bench_.send(kHostA, conditions);
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(next().weather.size(), static_cast<std::size_t>(Answers::kMostSearches));
    EXPECT_EQ(next().answers(), 0U);
}

TEST_P(AnswersTest, EventsAreTold) {
    cigi::ShortComponentControl enable;
    enable.component_class = cigi::ComponentClass::kEvent;
    enable.instance_id = 3;
    enable.component_state = 1;
    cigi::CelestialSphereControl sky;
    sky.hour = 3;
    sky.date = 1012027;
    sky.date_time_valid = true;
    bench_.send(kHostA, enable, sky);
    const Heard heard = next();
    ASSERT_EQ(heard.events.size(), 1U);
    EXPECT_EQ(heard.events[0].event_id, 3);
    EXPECT_EQ(heard.events[0].data_1, 1012027U);
    EXPECT_EQ(heard.events[0].data_2, 30000U);
}

TEST_P(AnswersTest, AnotherHostHearsNothingOfWhatTheFirstHasAsked) {
    bench_.send(kHostA, hat(1, 1));
    EXPECT_EQ(next().answers(), 1U);
    bench_.wait(30.0);
    EXPECT_EQ(next().answers(), 1U) << "it may be listening still";
    bench_.send(kHostB, hat(2));
    const Heard heard = next();
    ASSERT_EQ(heard.heights.size(), 1U);
    EXPECT_EQ(heard.heights[0].request_id, 2);
    EXPECT_EQ(next().answers(), 0U);
}

/// Through the inbox, which sees what the decoder refuses.
TEST_P(AnswersTest, DebugTellsWhatIsRefused) {
    Inbox inbox(bench_.config, bench_.world, bench_.log);
    const auto send = [&](cigi::IgMode mode, double latitude_deg, std::uint16_t entity_id) {
        std::array<std::byte, 256> buffer{};
        cigi::MessageWriter writer(buffer, GetParam(), cigi::ByteOrder::kBig);
        cigi::IgControl control;
        control.ig_mode = mode;
        control.host_frame_number = ++bench_.frame;
        cigi::HatHotRequest request = hat(1);
        request.lat_x = latitude_deg;
        cigi::PositionRequest place;
        place.object_id = entity_id;
        EXPECT_TRUE(writer.add(control) && writer.add(request) && writer.add(place));
        inbox.take(0, {kHostA, 0, writer.bytes()});
    };
    send(cigi::IgMode::kOperate, 91.0, 0);
    EXPECT_TRUE(next().messages.empty()) << "in Operate no word";
    send(cigi::IgMode::kDebug, std::numeric_limits<double>::quiet_NaN(), 77);
    Heard heard = next();
    ASSERT_EQ(heard.messages.size(), 2U);
    EXPECT_TRUE(heard.heights.empty());
    EXPECT_EQ(heard.messages[0].first, 1);
    EXPECT_EQ(heard.messages[0].second, "hat_hot_request at byte 24: lat_x is not a finite number");
    EXPECT_EQ(heard.messages[1].first, 4);
    EXPECT_EQ(heard.messages[1].second, "position of class 0, id 77: not known here");
    std::size_t told = 0;
    for (int frame = 0; frame < 60; ++frame) {
        send(cigi::IgMode::kDebug, 91.0, 0);
        told += next().messages.size();
    }
    EXPECT_GE(told, 1U);
    EXPECT_LE(told, 2U) << "in a second";
    EXPECT_GT(bench_.world.counters().ig_message_lost, 50U);
    send(cigi::IgMode::kOperate, 91.0, 77);
    EXPECT_TRUE(next().messages.empty());
}

TEST_P(AnswersTest, NothingIsAllocated) {
    Inbox inbox(bench_.config, bench_.world, bench_.log);
    std::size_t bytes = 0;
    const auto frame = [&] {
        cigi::EnvConditionsRequest conditions;
        conditions.request_type = 15;
        cigi::PositionRequest place, unknown;
        place.object_class = 2;
        place.object_id = 1;
        unknown.object_id = 9;
        cigi::WeatherControl layer;
        layer.layer_id = static_cast<std::uint8_t>(bench_.frame);
        layer.weather_enable = true;
        layer.thickness = 10.0F;
        cigi::ComponentControl component;
        component.component_id = 9;
        cigi::MaritimeSurfaceControl sea;
        sea.enable = true;
        bench_.send(kHostA, hat(1, 2), hat(2), conditions, place, unknown, layer, component, sea);
        bytes += open().size();
    };
    bench_.mode = cigi::IgMode::kDebug;
    // Until all is full and every line of the log was said once.
    while (bench_.world.counters().request_full == 0 && bench_.frame < 5000)
        frame();
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int i = 0; i < 1000; ++i)
        frame();
    const std::uint64_t made = skyig::tests::allocation_count() - before;
    std::printf("  %llu allocations in 1000 frames, %zu bytes a frame\n",
                static_cast<unsigned long long>(made), bytes / bench_.frame);
    EXPECT_EQ(made, 0U);
    EXPECT_GT(bytes / bench_.frame, 200U);
    EXPECT_GT(bench_.world.counters().request_full, 0U);
}

INSTANTIATE_TEST_SUITE_P(Versions, AnswersTest, ::testing::Values(cigi::Version::k33, cigi::Version::k40),
                         [](const auto& version) {
                             return version.param == cigi::Version::k33 ? "Cigi33" : "Cigi40";
                         });

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

/// One message with an answer of every kind.
std::vector<std::byte> message_of_all_kinds() {
    HostBench bench;
    bench.mode = cigi::IgMode::kDebug;
    Answers answers(bench.config.host);
    cigi::ComponentControl enable;
    enable.component_class = cigi::ComponentClass::kEvent;
    enable.instance_id = 3;
    enable.component_state = 1;
    cigi::CelestialSphereControl sky;
    sky.hour = 3;
    sky.date = 1012027;
    sky.date_time_valid = true;
    cigi::WeatherControl fog;
    fog.layer_id = 9;
    fog.weather_enable = true;
    fog.thickness = 100.0F;
    fog.visibility = 250.0F;
    fog.aerosol = 0.5F;
    cigi::MaritimeSurfaceControl sea;
    sea.enable = true;
    sea.sea_surface_height = 1.5F;
    cigi::TerrestrialSurfaceControl ice;
    ice.enable = true;
    ice.condition_id = 12;
    cigi::EnvConditionsRequest conditions;
    conditions.request_type = 15;
    conditions.request_id = 77;
    cigi::PositionRequest place, unknown;
    place.object_class = 2;
    place.object_id = 3;
    unknown.object_id = 5;
    cigi::HatHotRequest both = hat(43);
    both.request_type = cigi::HatHotType::kExtended;
    bench.send(kHostA, enable, sky, fog, sea, ice, hat(42), both, place, unknown, conditions);
    bench.world.advance(1.0 / 60.0);
    const auto bytes = answers.open_frame(bench.world, 0, false);
    return {bytes.begin(), bytes.end()};
}

TEST(AnswersToTshark, AreReadAsTheyWereMeant) {
    if (output_of("tshark --version 2>/dev/null").empty()) GTEST_SKIP() << "tshark is not installed";
    const std::vector<std::byte> message = message_of_all_kinds();
    const auto path =
        std::filesystem::temp_directory_path() / ("skyig_answers_" + std::to_string(::getpid()) + ".pcapng");
    {
        std::ofstream file(path, std::ios::binary);
        const auto sink = [&file](std::span<const std::byte> bytes) {
            file.write(reinterpret_cast<const char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
            return file.good();
        };
        auto writer = protocol::recording::PcapngWriter::begin(sink, {});
        ASSERT_TRUE(writer.has_value());
        EXPECT_TRUE(writer.value().write_udp(0, {0x7F000001, 8004}, {0x7F000001, 8005}, message));
    }
    const std::string text =
        output_of("tshark -n -r " + path.string() + " -d udp.port==8005,cigi -O cigi 2>/dev/null");
    std::filesystem::remove(path);
    for (const char* const line :
         {"Start of Frame", "HAT/HOT Response", "HAT/HOT Extended Response", "Position Response",
          "Weather Conditions Response", "Aerosol Concentration Response",
          "Maritime Surface Conditions Response", "Terrestrial Surface Conditions Response",
          "Event Notification", "Image Generator Message", "position of class 0, id 5: not known here"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << " is missing in\n" << text;
    }
    EXPECT_EQ(text.find("Malformed"), std::string::npos) << text;
    EXPECT_EQ(text.find("Unknown"), std::string::npos) << text;
    std::printf("  %zu bytes, an answer of each kind\n", message.size());
}

}  // namespace
}  // namespace skyig::server
