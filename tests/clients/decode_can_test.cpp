// skyig decode --can: the golden log key by key, hard cases of every outcome, bad lines.
#include "clients/skyig/decode_can.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace skyig::clients {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

/// One frame 10 ms after the other.
std::vector<Json> decode(const std::vector<std::string>& frames) {
    CanLogDecoder decoder("t.log", true);
    std::vector<Json> out;
    int time_us = 0;
    for (const std::string& frame : frames) {
        time_us += 10'000;
        char line[256];
        std::snprintf(line, sizeof line, "(1718994600.%06d) can0 %s", time_us, frame.c_str());
        const auto decoded = decoder.decode(line);
        out.push_back(decoded && !decoded->is_error ? Json::parse(decoded->text) : Json());
    }
    return out;
}

TEST(DecodeCan, GoldenLogKeyByKey) {
    const std::string folder = SKYIG_TEST_DATA "/canaerospace/";
    const Json golden = Json::parse(std::ifstream(folder + "canaerospace_golden.json"));
    std::ifstream log(folder + "canaerospace_golden.log");
    CanLogDecoder decoder("golden", true);
    std::size_t keys = 0;
    std::size_t frames = 0;
    for (std::string line; std::getline(log, line); ++frames) {
        const auto decoded = decoder.decode(line);
        ASSERT_TRUE(decoded && !decoded->is_error) << line;
        const Json got = Json::parse(decoded->text);
        const Json& expected = golden["frames"][frames];
        EXPECT_EQ(got["outcome"], expected["expect"]) << line;
        EXPECT_TRUE(got["reason"].is_null());
        for (const auto& [key, value] : expected.items()) {
            if (key == "frame" || key == "expect" || key == "note") continue;
            EXPECT_EQ(got.value(key, Json()), value) << line << " " << key;
            ++keys;
        }
    }
    std::printf("%zu keys of %zu golden frames agree\n%s\n", keys, frames, decoder.summary().c_str());
    EXPECT_EQ(frames, 34U);
    EXPECT_EQ(decoder.summary(), "34 frames: 34 accept");
}

TEST(DecodeCan, EveryOutcome) {
    const std::vector<Json> got =
        decode({"137#0102001040200000", "137#0102001040200000", "137#0102000F40200000", "137#01020011402000",
                "7F0#0102001040200000", "137##001020010402", "20000004#0001000000000000",
                "419#011F0043381A2CED", "000107F0#0102001040200000", "137#R8"});
    const char* outcomes[]{"accept", "duplicate", "stale",  "reject", "ignore",
                           "ignore", "bus-error", "reject", "reject", "reject"};
    const char* reasons[]{"", "duplicate",  "older",    "length",     "unassigned",
                          "", "controller", "lone_low", "identifier", "remote"};
    EXPECT_TRUE(got[5].is_null());  // seven bytes and a half: told on stderr
    for (std::size_t i = 0; i < got.size(); ++i) {
        if (got[i].is_null()) continue;
        EXPECT_EQ(got[i]["line"], i + 1);
        EXPECT_EQ(got[i]["outcome"], outcomes[i]);
        EXPECT_EQ(got[i]["reason"], *reasons[i] != '\0' ? Json(reasons[i]) : Json());
        EXPECT_EQ(got[i]["value"].is_null(), i != 0) << i;
    }
    EXPECT_EQ(got[3]["name"], "body pitch angle");
    EXPECT_TRUE(got[4]["name"].is_null());
    EXPECT_EQ(got[6]["id"], 4);
    EXPECT_EQ(got[8]["id"], 2032);
    EXPECT_EQ(got[8]["redundancy"], 1);
    EXPECT_TRUE(got[9]["type"].is_null());
}

TEST(DecodeCan, NamesUnitsAndValuesOfEachKind) {
    const std::vector<Json> got =
        decode({"73C#140A010205", "73C#140201033F000000", "081#0519000041422243", "080#07000000",
                "7D1#05000400", "137#0140001040200000", "5DC#0102001040200000", "73A#14020900447A0000",
                "750#141E000042C2B000", "137##50102001040200000"});
    EXPECT_EQ(got[0]["unit"], "oktas");
    EXPECT_EQ(got[0]["value"], 5);
    EXPECT_TRUE(got[0]["value"].is_number_integer());
    EXPECT_EQ(got[1]["unit"], "fraction");
    EXPECT_EQ(got[1]["value"], 0.5);
    EXPECT_EQ(got[2]["value"], "AB\"C");
    EXPECT_EQ(got[3]["name"], "IDS request to node 7");
    EXPECT_EQ(got[4]["name"], "SCS reply of node 5");
    EXPECT_EQ(got[5]["reason"], "reserved_type");
    EXPECT_EQ(got[5]["type"], 64);
    EXPECT_EQ(got[6]["outcome"], "ignore");
    EXPECT_EQ(got[6]["reason"], "unknown");
    EXPECT_EQ(got[7]["reason"], "layer");
    EXPECT_EQ(got[7]["name"], "proposed: cloud layer 9 base");
    EXPECT_EQ(got[8]["name"], "proposed: Julian date UTC (high word)");
    EXPECT_EQ(got[9]["outcome"], "ignore");
    EXPECT_EQ(got[9]["reason"], "fd");
}

TEST(DecodeCan, CommitTellsLayersThatStayStaged) {
    const std::vector<Json> got = decode({"73A#14020201447A0000", "73B#14020201447A0000", "758#14000001"});
    EXPECT_EQ(got[2]["outcome"], "accept");
    EXPECT_EQ(got[2]["held_layers"], Json::array({2}));
    EXPECT_TRUE(got[2]["value"].is_null());
}

TEST(DecodeCan, EachInterfaceHasItsOwnMemory) {
    CanLogDecoder decoder("t.log", true);
    const auto outcome = [&decoder](const char* line) {
        return Json::parse(decoder.decode(line).value().text)["outcome"];
    };
    EXPECT_EQ(outcome("(1.000000) can0 137#0102001040200000"), "accept");
    EXPECT_EQ(outcome("(1.000000) can1 137#0102001040200000"), "accept");
    EXPECT_EQ(outcome("(1.000000) can0 137#0102001040200000"), "duplicate");
    for (int i = 2; i < 64; ++i)
        EXPECT_EQ(outcome(("(1.0) vcan" + std::to_string(i) + " 137#0102001040200000").c_str()), "accept");
    const auto beyond = decoder.decode("(1.0) vcan64 137#0102001040200000").value();
    EXPECT_TRUE(beyond.is_error);
    EXPECT_THAT(beyond.text, HasSubstr("64 interfaces"));
}

TEST(DecodeCan, BadLinesAreToldAndPassedOver) {
    CanLogDecoder decoder("bad.log", false);
    EXPECT_FALSE(decoder.decode("# device: none"));
    EXPECT_FALSE(decoder.decode(""));
    const auto bad = decoder.decode("(1.0) can0 137#01020").value();
    EXPECT_TRUE(bad.is_error);
    EXPECT_EQ(bad.text, "bad.log:3:21: write each data byte as two hex digits");
    const auto good = decoder.decode("(1.0) can0 137#0102001040200000\r").value();
    EXPECT_FALSE(good.is_error);
    EXPECT_THAT(good.text, HasSubstr("body pitch angle = 2.5 deg"));
    const auto refused = decoder.decode("(1.0) can0 137#0102001040").value();
    EXPECT_THAT(refused.text, HasSubstr("[reject: length]"));
    std::printf("%s\n%s\n%s\n", bad.text.c_str(), good.text.c_str(), refused.text.c_str());
    EXPECT_EQ(decoder.summary(), "2 frames: 1 accept, 1 reject");
}

TEST(DecodeCan, CommandLine) {
    const auto parse = [](std::vector<const char*> words) {
        words.insert(words.begin(), "skyig");
        return read_command_line(static_cast<int>(words.size()), words.data());
    };
    const Invocation good = parse({"decode", "--can", "a.log", "--json"});
    const auto* options = std::get_if<DecodeOptions>(&good.options);
    ASSERT_NE(options, nullptr);
    EXPECT_EQ(options->can_path, "a.log");
    EXPECT_TRUE(options->json);
    EXPECT_EQ(parse({"decode", "--json"}).exit_status, 2);
    EXPECT_EQ(parse({"decode", "--can"}).exit_status, 2);
}

}  // namespace
}  // namespace skyig::clients
