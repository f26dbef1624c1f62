// What `skyig decode --cigi` tells of good and bad datagrams: the golden ones whole, and each rule by its own
// case.
#include "clients/skyig/decode_cigi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "clients/skyig/decode.h"
#include "protocol/cigi/message.h"
#include "protocol/transport/udp.h"

namespace skyig::clients {
namespace {

namespace cigi = protocol::cigi;
namespace transport = protocol::transport;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const json& golden() {
    static const json file = json::parse(std::ifstream(SKYIG_TEST_DATA "/cigi/cigi_golden.json"));
    return file.at("datagrams");
}

/// What the verb says of `input`, one line a datagram.
std::vector<json> answers(const std::string& input, bool from_ig = false, int status = 0) {
    std::istringstream in(input);
    std::ostringstream out;
    DecodeOptions options;
    options.from_ig = from_ig;
    options.json = true;
    EXPECT_EQ(run_decode(options, in, out), status);
    std::vector<json> objects;
    std::istringstream lines(out.str());
    for (std::string line; std::getline(lines, line);)
        objects.push_back(json::parse(line));
    return objects;
}

/// A message under construction, in every version and byte order.
class DecodeCigi : public testing::TestWithParam<std::tuple<cigi::Version, cigi::ByteOrder>> {
  protected:
    DecodeCigi() : writer(buffer, std::get<0>(GetParam()), std::get<1>(GetParam())) {
        EXPECT_TRUE(writer.add(cigi::IgControl{.ig_mode = cigi::IgMode::kOperate}));
    }
    [[nodiscard]] bool is_33() const { return writer.version() == cigi::Version::k33; }
    [[nodiscard]] json decoded(std::size_t cut = 0) const {
        return json::parse(
            to_json(decode_cigi(writer.bytes().first(writer.bytes().size() - cut), cigi::Sender::kHost)));
    }
    /// `packet` is refused for `reason`, and the good one behind it is kept.
    template <class P>
    void expect_ignored(const P& packet, const std::string& name, const std::string& reason) {
        writer.clear();
        ASSERT_TRUE(writer.add(cigi::IgControl{}));
        ASSERT_TRUE(writer.add(packet));
        ASSERT_TRUE(writer.add(cigi::PositionRequest{}));
        const json object = decoded();
        EXPECT_EQ(object.at("outcome"), "accept");
        EXPECT_TRUE(object.at("reason").is_null());
        EXPECT_EQ(object.at("ignored"), json::array({{{"packet", name}, {"reason", reason}}}));
        EXPECT_EQ(object.at("packets").size(), 2U);
        EXPECT_EQ(object.at("packets").back().at("packet"), "position_request");
    }
    /// Fields of `packet` as they are told.
    template <class P>
    json fields_of(const P& packet) {
        writer.clear();
        EXPECT_TRUE(writer.add(cigi::IgControl{}) && writer.add(packet));
        return decoded().at("packets").at(1).at("fields");
    }

    std::array<std::byte, 1024> buffer{};
    cigi::MessageWriter writer;
};

TEST(DecodeCigiGolden, EveryDatagramIsToldAsTheFileHasIt) {
    std::size_t fields = 0;
    for (const json& row : golden()) {
        SCOPED_TRACE(row.at("name"));
        const auto objects =
            answers(row.at("hex").get<std::string>() + '\n', row.at("direction") == "ig_to_host");
        ASSERT_EQ(objects.size(), 1U);
        json wanted{{"cigi", row.at("cigi")},  {"byte_order", row.at("byte_order")}, {"outcome", "accept"},
                    {"reason", nullptr},       {"packets", json::array()},           {"skipped_unknown", 0},
                    {"ignored", json::array()}};
        for (const json& packet : row.at("packets")) {
            if (packet.at("packet").is_null()) {
                wanted["skipped_unknown"] = wanted["skipped_unknown"].get<int>() + 1;
                continue;
            }
            fields += packet.at("fields").size();
            wanted["packets"].push_back({{"packet", packet.at("packet")},
                                         {"offset", packet.at("offset")},
                                         {"fields", packet.at("fields")}});
        }
        EXPECT_EQ(objects.front(), wanted);
    }
    std::printf("%zu datagrams, %zu fields\n", golden().size(), fields);
    EXPECT_GT(fields, 800U);
}

TEST(DecodeCigiGolden, TheOtherDirectionIsDroppedAndTextSaysSo) {
    for (const json& row : golden()) {
        const bool from_ig = row.at("direction") == "ig_to_host";
        const auto objects = answers(row.at("hex").get<std::string>(), !from_ig);
        EXPECT_EQ(objects.at(0).at("outcome"), "drop");
        EXPECT_EQ(objects.at(0).at("reason"), "first_packet");
        HexError error;
        const auto bytes = parse_hex(row.at("hex").get<std::string>(), error);
        const auto sender = from_ig ? cigi::Sender::kHost : cigi::Sender::kImageGenerator;
        EXPECT_THAT(to_text(decode_cigi(*bytes, sender)), HasSubstr("of the other direction"));
    }
}

TEST(DecodeCigiDrop, NamesTheFirstReason) {
    const std::string rest(32, '0');  // 16 bytes
    const struct {
        std::string hex;
        std::string reason;
    } rows[] = {{"", "short"},
                {"0118030031000080b00400008084", "short"},
                {"0118030031000081" + rest, "bad_magic"},
                {"0118030031000000" + rest, "bad_magic"},
                {"0118040031000080" + rest, "bad_version"},
                {"0110030031000080" + rest, "bad_version"},  // 3.0 and 3.1
                {"0110020031000080" + rest, "bad_version"},
                {"0118010031000080" + rest, "bad_version"},
                {"0120030031000080" + rest, "first_packet"},
                {"1800000005000001" + rest, "bad_version"},
                {"0018000003000001" + rest, "bad_version"},
                {"2000000004000001" + rest, "first_packet"},
                {"1800250004000001" + rest, "first_packet"},
                {"0230000001000000" + rest, "first_packet"},
                {"6518030031000080" + rest, "first_packet"}};
    for (const auto& row : rows) {
        const json object = answers(row.hex + '\n').at(0);
        EXPECT_EQ(object.at("outcome"), "drop") << row.hex;
        EXPECT_EQ(object.at("reason"), row.reason) << row.hex;
        EXPECT_TRUE(object.at("cigi").is_null());
        EXPECT_TRUE(object.at("byte_order").is_null());
        EXPECT_EQ(object.at("packets"), json::array());
        EXPECT_EQ(object.at("ignored"), json::array());
        EXPECT_EQ(object.at("skipped_unknown"), 0);
    }
}

TEST_P(DecodeCigi, FramingLostPartWayKeepsThePacketsBefore) {
    ASSERT_TRUE(writer.add(cigi::AtmosphereControl{}));
    ASSERT_TRUE(writer.add(cigi::ViewControl{}));
    for (const std::size_t cut : {1U, 8U, 20U}) {
        const json object = decoded(cut);
        EXPECT_EQ(object.at("outcome"), "partial");
        EXPECT_EQ(object.at("reason"), "truncated");
        EXPECT_EQ(object.at("packets").size(), 2U);
        EXPECT_EQ(object.at("cigi"), is_33() ? "3.3" : "4.0");
    }
    ASSERT_TRUE(writer.add_raw(std::array<std::byte, 8>{}));
    const json object = decoded();
    EXPECT_EQ(object.at("outcome"), "partial");
    EXPECT_EQ(object.at("reason"), "bad_size");
    EXPECT_EQ(object.at("packets").size(), 3U);
    ASSERT_EQ(decoded(7).at("reason"), "truncated");  // less than a header is left
}

TEST_P(DecodeCigi, WrongSizesAndSecondIgControlsAreIgnoredByName) {
    std::array<std::byte, 40> celestial{};
    if (is_33()) {
        celestial[0] = std::byte{9};
        celestial[1] = std::byte{40};
    } else {
        cigi::store(celestial.data(), writer.order(), std::uint16_t{40});
        cigi::store(celestial.data() + 2, writer.order(), std::uint16_t{8});
    }
    ASSERT_TRUE(writer.add_raw(celestial));
    ASSERT_TRUE(writer.add(cigi::IgControl{}));
    ASSERT_TRUE(writer.add(cigi::PositionRequest{}));
    const json object = decoded();
    EXPECT_EQ(object.at("outcome"), "accept");
    EXPECT_EQ(object.at("ignored"),
              json::array({{{"packet", "celestial_sphere_control"}, {"reason", "wrong_size"}},
                           {{"packet", "ig_control"}, {"reason", "duplicate_ig_control"}}}));
    EXPECT_EQ(object.at("packets").size(), 2U);
    EXPECT_EQ(object.at("skipped_unknown"), 0);
}

TEST_P(DecodeCigi, PacketsOutOfRangeAreIgnored) {
    expect_ignored(cigi::EnvConditionsRequest{.request_type = 4, .latitude = 90.5}, "env_conditions_request",
                   "out_of_range");
    expect_ignored(cigi::HatHotRequest{.lon_y = 721.0}, "hat_hot_request", "out_of_range");
    expect_ignored(cigi::CelestialSphereControl{.date_time_valid = true, .date = 2292023},
                   "celestial_sphere_control", "out_of_range");
    expect_ignored(cigi::AtmosphereControl{.visibility = -1.0F}, "atmosphere_control", "out_of_range");
    expect_ignored(cigi::ViewDefinition{.left_enable = true, .right_enable = true}, "view_definition",
                   "out_of_range");
    expect_ignored(cigi::EnvRegionControl{}, "env_region_control", "out_of_range");
    expect_ignored(cigi::EntityControl{.entity_state = cigi::EntityState{3}}, "entity_control",
                   "out_of_range");
    expect_ignored(cigi::WaveControl{.breaker_type = cigi::BreakerType{3}}, "wave_control", "out_of_range");
    expect_ignored(cigi::WeatherControl{.pressure = kNan}, "weather_control", "nonfinite");
    expect_ignored(cigi::MaritimeSurfaceControl{.clarity = kNan}, "maritime_surface_control", "nonfinite");
}

TEST_P(DecodeCigi, SecondsMayBeAnIntegerAndNeverSixty) {
    if (is_33()) return;  // it has no seconds
    cigi::CelestialSphereControl sky{
        .seconds = std::bit_cast<float>(std::uint32_t{59}), .date_time_valid = true, .date = 6212026};
    EXPECT_EQ(fields_of(sky).at("seconds"), 59);
    sky.seconds = std::bit_cast<float>(std::uint32_t{60});
    expect_ignored(sky, "celestial_sphere_control", "out_of_range");
    sky.seconds = 60.0F;
    expect_ignored(sky, "celestial_sphere_control", "out_of_range");
}

TEST_P(DecodeCigi, ValuesAreWrappedAndClampedAsTheyAreTakenIn) {
    json fields = fields_of(cigi::AtmosphereControl{.humidity = 120, .wind_direction = -45.0F});
    EXPECT_EQ(fields.at("humidity"), 100);
    EXPECT_EQ(fields.at("wind_direction"), 315.0);
    fields = fields_of(cigi::HatHotRequest{.lat_x = 10.0, .lon_y = 190.0});
    EXPECT_EQ(fields.at("lon_y"), -170.0);
    fields = fields_of(cigi::WeatherControl{.coverage = -5.0F});
    EXPECT_EQ(fields.at("coverage"), 0.0);
    EXPECT_TRUE(decoded().at("ignored").empty());
    EXPECT_THAT(to_text(decode_cigi(writer.bytes(), cigi::Sender::kHost)), HasSubstr(", clamped\n"));
}

TEST_P(DecodeCigi, AFieldThatDoesNotCountMayHoldNoNumberAndIsThenNull) {
    const json fields = fields_of(cigi::ViewControl{.x_enable = true, .x_offset = 2.5F, .yaw = kNan});
    EXPECT_EQ(fields.at("x_offset"), 2.5);
    EXPECT_TRUE(fields.at("yaw").is_null());
    EXPECT_TRUE(decoded().at("ignored").empty());
    EXPECT_THAT(to_text(decode_cigi(writer.bytes(), cigi::Sender::kHost)),
                HasSubstr("yaw           not a number"));
}

TEST_P(DecodeCigi, ATextOfAnyOctetsIsToldAsValidText) {
    writer.clear();
    ASSERT_TRUE(writer.add(cigi::StartOfFrame{}));
    ASSERT_TRUE(writer.add(cigi::IgMessage{.message_id = 7, .text = "a\xFF\x1B\"b"}));
    const CigiDatagram datagram = decode_cigi(writer.bytes(), cigi::Sender::kImageGenerator);
    const json object = json::parse(to_json(datagram));
    EXPECT_EQ(object.at("packets").at(1).at("fields").at("text"), "a\xEF\xBF\xBD\x1B\"b");
    EXPECT_EQ(to_text(datagram).find('\x1B'), std::string::npos);
}

TEST_P(DecodeCigi, TextForPeopleNamesWhatIsSkippedAndIgnored) {
    std::array<std::byte, 32> part{};
    if (is_33()) {
        part[0] = std::byte{6};
        part[1] = std::byte{32};
    } else {
        cigi::store(part.data(), writer.order(), std::uint16_t{32});
        cigi::store(part.data() + 2, writer.order(), std::uint16_t{5});
    }
    ASSERT_TRUE(writer.add_raw(part));
    ASSERT_TRUE(writer.add(cigi::AtmosphereControl{.visibility = -1.0F}));
    const std::string text = to_text(decode_cigi(writer.bytes(), cigi::Sender::kHost));
    EXPECT_THAT(text, HasSubstr(is_33() ? "CIGI 3.3, " : "CIGI 4.0, "));
    EXPECT_THAT(text, HasSubstr("\n\nig_control at byte 0\n    major_version "));
    EXPECT_THAT(text, HasSubstr(is_33() ? "articulated_part_control at byte 24 skipped: id 6, 32 bytes\n"
                                        : "articulated_part_control at byte 24 skipped: id 5, 32 bytes\n"));
    EXPECT_THAT(text, HasSubstr("atmosphere_control at byte 56 ignored: out_of_range, visibility\n"));
}

INSTANTIATE_TEST_SUITE_P(Dialects, DecodeCigi,
                         testing::Combine(testing::Values(cigi::Version::k33, cigi::Version::k40),
                                          testing::Values(cigi::ByteOrder::kLittle, cigi::ByteOrder::kBig)));

TEST(ParseHex, TakesDigitsInAnyCaseWithWhiteSpaceAnywhere) {
    HexError error;
    const auto bytes = parse_hex(" 0 1\tfF aB\r", error);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, (std::vector{std::byte{0x01}, std::byte{0xFF}, std::byte{0xAB}}));
    EXPECT_TRUE(parse_hex("", error)->empty());
}

TEST(ParseHex, SaysWhereItIsBadAndWhy) {
    HexError error;
    EXPECT_FALSE(parse_hex("01 x2", error));
    EXPECT_EQ(error.column, 4U);
    EXPECT_EQ(error.text, "'x' is no hexadecimal digit");
    EXPECT_FALSE(parse_hex("0", error));
    EXPECT_EQ(error.column, 2U);
    EXPECT_THAT(error.text, HasSubstr("needs two"));
    EXPECT_FALSE(parse_hex("01\xC3", error));
    EXPECT_EQ(error.text, "octet 0xC3 is no hexadecimal digit");
}

TEST(DecodeVerb, GoesOnAfterABadLineAndLeavesWithOne) {
    const std::string good = golden().at(0).at("hex");
    testing::internal::CaptureStderr();
    const auto objects = answers(good + "\n01 1g\n" + good + "\r\n", false, 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "skyig decode: line 2, column 5: 'g' is no hexadecimal digit\n");
    ASSERT_EQ(objects.size(), 2U);
    EXPECT_EQ(objects[0], objects[1]);
}

TEST(DecodeVerb, TakesArgumentsBeforeStandardInput) {
    std::istringstream in("not looked at");
    std::ostringstream out;
    DecodeOptions options;
    options.cigi = {golden().at(0).at("hex"), golden().at(1).at("hex")};
    EXPECT_EQ(run_decode(options, in, out), 0);
    EXPECT_THAT(out.str(), HasSubstr("CIGI 3.3, little-endian"));
    EXPECT_THAT(out.str(), HasSubstr("\n\nCIGI 3.3, big-endian"));
}

DecodeOptions asked(std::vector<const char*> words) {
    words.insert(words.begin(), {"skyig", "decode"});
    const Invocation invocation = read_command_line(static_cast<int>(words.size()), words.data());
    EXPECT_EQ(invocation.error, "");
    const auto* options = std::get_if<DecodeOptions>(&invocation.options);
    return options == nullptr ? DecodeOptions{} : *options;
}

TEST(DecodeVerb, ReadsStandardInputWithoutDatagramsOnTheCommandLine) {
    const std::string line = golden().at(0).at("hex").get<std::string>() + '\n';
    for (const auto& words : std::vector<std::vector<const char*>>{
             {"--cigi", "--json"}, {"--json", "--cigi"}, {"--cigi", "-", "--json"}}) {
        std::istringstream in(line + line);
        std::ostringstream out;
        EXPECT_EQ(run_decode(asked(words), in, out), 0);
        const std::string told = out.str();
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2);
    }
    EXPECT_EQ(asked({"--cigi", "", "01 18"}).cigi, (std::vector<std::string>{"", "01 18"}));
    EXPECT_EQ(asked({"--cigi", ""}).cigi, std::vector<std::string>{""});  // a datagram without bytes
}

TEST(DecodeVerb, RefusesWordsThatContradict) {
    for (const auto& words : std::vector<std::vector<const char*>>{{"--json"},
                                                                   {"--cigi", "00", "--can", "a.log"},
                                                                   {"--live", "70000"},
                                                                   {"--live", "8004", "--cigi", "00"},
                                                                   {"--count", "2"},
                                                                   {"0118"}}) {
        std::vector<const char*> all{"skyig", "decode"};
        all.insert(all.end(), words.begin(), words.end());
        EXPECT_EQ(read_command_line(static_cast<int>(all.size()), all.data()).exit_status, 2)
            << words.front();
    }
}

TEST(DecodeVerb, WatchesAPort) {
    const auto free_port = [] {
        auto receiver = transport::UdpReceiver::open({.listen = {0x7F000001, 0}});
        return receiver.value().local().port;
    };
    DecodeOptions options;
    options.live_port = free_port();
    options.count = 2;
    options.json = true;
    std::istringstream in;
    std::ostringstream out;
    std::atomic<int> status = -1;
    std::thread watching([&] { status = run_decode(options, in, out); });
    HexError error;
    const auto bytes = parse_hex(golden().at(0).at("hex").get<std::string>(), error);
    auto sender = transport::UdpSender::open();
    // The watcher may not listen yet: it is told until it has heard enough.
    std::thread telling([&] {
        for (int i = 0; i < 500 && status < 0; ++i) {
            (void)sender.value().send({0x7F000001, *options.live_port}, *bytes);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    });
    telling.join();
    watching.join();
    EXPECT_EQ(status, 0);
    const std::string told = out.str();
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2);
}

}  // namespace
}  // namespace skyig::clients
