// The pages: what stands in them, in which form, and that every name is documented.
#include "server/status/account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "server/status/from_snapshot.h"
#include "server/status/metrics_text.h"
#include "tests/server/status/example.h"

namespace skyig::server::status {
namespace {

using ::testing::HasSubstr;
using tests::kSecond;
using tests::kStart;
using Json = nlohmann::json;

struct Example {
    Facts facts = tests::example_facts();
    Snapshot snapshot = tests::example_snapshot();

    [[nodiscard]] Account account() const {
        return {facts,
                snapshot,
                tests::with_bus(make_report(facts, snapshot)),
                RecorderState{"flight \xFF.pcapng", 1200, 2, 123456, false},
                PortCounts{5, 4, 1, 0},
                Health{true, "ok"},
                12.5,
                0.01};
    }
};

/// The same as the leader of a rig.
Example rig_example() {
    Example example;
    example.facts = tests::rig_facts();
    example.snapshot.rig = tests::example_rig();
    return example;
}

/// Lines of one sample: name with labels, then the number.
std::map<std::string, double> samples_of(const std::string& text) {
    static const std::regex kSample(
        R"re(([a-zA-Z_:][a-zA-Z0-9_:]*(?:\{(?:[a-zA-Z_]\w*="(?:[^"\\\n]|\\["\\n])*",?)+\})?) (\S+))re");
    std::map<std::string, double> samples;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("# ")) continue;
        std::smatch match;
        EXPECT_TRUE(std::regex_match(line, match, kSample)) << line;
        EXPECT_TRUE(samples.emplace(match.str(1), std::stod(match.str(2))).second) << "twice: " << line;
    }
    return samples;
}

/// Type by family, in the order of the text; fails where a sample stands outside its family.
std::map<std::string, std::string> families_of(const std::string& text) {
    std::map<std::string, std::string> types;
    std::string family;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string mark, kind, name, type;
        if (line.starts_with("# HELP ")) {
            words >> mark >> kind >> family;
            EXPECT_FALSE(types.contains(family)) << "told twice: " << family;
            EXPECT_GT(line.size(), 10 + family.size()) << "no help: " << family;
        } else if (line.starts_with("# TYPE ")) {
            words >> mark >> kind >> name >> type;
            EXPECT_EQ(name, family);
            types[family] = type;
        } else {
            const std::string sample = line.substr(0, line.find_first_of("{ "));
            EXPECT_TRUE(sample == family ||
                        (types[family] == "histogram" && sample.starts_with(family + "_")))
                << line << " in " << family;
        }
    }
    return types;
}

TEST(Account, JsonTellsEverySourceAndWhoHasTheSay) {
    const Json json = Json::parse(to_json(Example().account()));
    const Json& host = json.at("sources").at(0);
    EXPECT_EQ(host.at("name"), "host");
    EXPECT_EQ(host.at("kind"), "cigi");
    EXPECT_EQ(host.at("heard_at"), "127.0.0.1:8004");
    EXPECT_EQ(host.at("peer"), "127.0.0.1:8005");
    EXPECT_EQ(host.at("link"), "live");
    EXPECT_EQ(host.at("arrivals"), 599);
    EXPECT_EQ(host.at("holds"), (Json{"control", "ownship"}));
    EXPECT_TRUE(host.at("counts").empty());
    const Json& bus = json.at("sources").at(1);
    EXPECT_EQ(bus.at("link"), "stale");
    EXPECT_EQ(bus.at("peer"), "");
    EXPECT_EQ(bus.at("owns"), (Json{"ownship", "time"}));
    EXPECT_EQ(bus.at("counts").at("frames"), 1000);
    EXPECT_EQ(bus.at("counts").at("not_taken_range"), 3);
    const Json& flightgear = json.at("sources").at(2);
    EXPECT_EQ(flightgear.at("link"), "waiting");
    EXPECT_TRUE(flightgear.at("silent_s").is_null());
    EXPECT_EQ(flightgear.at("counts").at("packets"), 60);

    const Json& authority = json.at("authority");
    EXPECT_EQ(authority.at("control").at("rule"), "only_owner");
    EXPECT_EQ(authority.at("ownship").at("holder"), "host");
    EXPECT_EQ(authority.at("ownship").at("rule"), "priority");
    EXPECT_EQ(authority.at("ownship").at("overruled"), (Json{{"cockpit", 17}}));
    EXPECT_TRUE(authority.at("weather").at("holder").is_null());
}

TEST(Account, JsonTellsFramesWorldPlanAndRecorder) {
    const Json json = Json::parse(to_json(Example().account()));
    EXPECT_EQ(json.at("frames"), 600);
    EXPECT_EQ(json.at("packets").at("ig_control"), 599);
    EXPECT_EQ(json.at("rejects").at("truncated"), 4);
    EXPECT_EQ(json.at("rejects").at("second_host"), 7);
    EXPECT_EQ(json.at("rejects").at("not_allowed"), 9);
    EXPECT_EQ(json.at("recent").at("frames"), FrameRecord::kKept);
    EXPECT_NEAR(json.at("recent").at("rate_hz").get<double>(), 50.0, 1e-9);
    EXPECT_EQ(json.at("late_by_cause").at("channels"), 1);
    EXPECT_EQ(json.at("world").at("mode"), "operate");
    EXPECT_EQ(json.at("world").at("sun").at("elevation_deg"), -5.25);
    EXPECT_EQ(json.at("channels").at(0).at("failures"), 0);
    EXPECT_EQ(json.at("channels").at(1), (Json{{"name", "right"},
                                               {"failed", false},
                                               {"failures", 2},
                                               {"hidden", false},
                                               {"last_failure", "OpenGL reported an error"}}));
    EXPECT_EQ(json.at("plan").size(), 2U);
    EXPECT_EQ(json.at("plan").at(1).at("reason"), "the sky is too bright");
    EXPECT_EQ(json.at("recorder").at("bytes"), 123456);
    EXPECT_EQ(json.at("buses").at(0).at("counts").at("fd_frames"), 2);
    EXPECT_EQ(json.at("health").at("ok"), true);
    EXPECT_EQ(json.at("uptime_s"), 12.5);
}

TEST(Account, JsonTellsTheRigAndNothingOfItOnAMachineAlone) {
    EXPECT_TRUE(Json::parse(to_json(Example().account())).at("rig").is_null());
    const Json rig = Json::parse(to_json(rig_example().account())).at("rig");
    EXPECT_EQ(rig.at("name"), "main");
    EXPECT_EQ(rig.at("role"), "leads");
    EXPECT_EQ(rig.at("channels"), (Json{"left"}));
    EXPECT_EQ(rig.at("wait").at("p99_ms"), 1.75);
    EXPECT_EQ(rig.at("counts").at("unsealed"), 12);
    EXPECT_EQ(rig.at("counts").at("strangers"), 0);
    ASSERT_EQ(rig.at("nodes").size(), 2U);
    const Json& side = rig.at("nodes").at(0);
    EXPECT_EQ(side.at("channels"), (Json{"right"}));
    EXPECT_EQ(side.at("state"), "ready");
    EXPECT_EQ(side.at("lag"), 1);
    EXPECT_EQ(side.at("left_out"), 3);
    EXPECT_EQ(side.at("gl"), "4.5 llvmpipe");
    EXPECT_EQ(side.at("why"), "");
    const Json& rear = rig.at("nodes").at(1);
    EXPECT_EQ(rear.at("state"), "refused");
    EXPECT_EQ(rear.at("why"), "settings 1, the leader's are 2");
    EXPECT_TRUE(rear.at("channels").empty());
}

TEST(Account, MetricsTellTheRigAndNothingOfItOnAMachineAlone) {
    for (const auto& [family, type] : families_of(to_metrics(Example().account())))
        EXPECT_FALSE(family.starts_with("skyig_rig")) << family;
    const auto samples = samples_of(to_metrics(rig_example().account()));
    EXPECT_EQ(samples.at(R"(skyig_rig_role{role="leads"})"), 1.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_role{role="follows"})"), 0.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_wait_seconds{statistic="p99"})"), 1.75e-3);
    EXPECT_EQ(samples.at(R"(skyig_rig_counts_total{count="incomplete"})"), 3.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_node_state{node="rear",state="refused"})"), 1.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_node_state{node="rear",state="ready"})"), 0.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_node_lag_frames{node="side"})"), 1.0);
    EXPECT_EQ(samples.at(R"(skyig_rig_node_frame_seconds{node="side"})"), 7.25e-3);
    EXPECT_EQ(samples.at(R"(skyig_rig_node_counts_total{node="side",count="left_out"})"), 3.0);
}

TEST(Account, MetricsAreWellFormedAndCountersEndInTotal) {
    const std::string text = to_metrics(rig_example().account());
    const auto samples = samples_of(text);
    EXPECT_EQ(samples.at("skyig_frames_total"), 600.0);
    EXPECT_EQ(samples.at(R"(skyig_packets_total{packet="ig_control"})"), 599.0);
    EXPECT_EQ(samples.at(R"(skyig_rejects_total{reason="second_host"})"), 7.0);
    EXPECT_EQ(samples.at(R"(skyig_source_link{source="host",state="live"})"), 1.0);
    EXPECT_EQ(samples.at(R"(skyig_source_link{source="host",state="lost"})"), 0.0);
    EXPECT_EQ(samples.at(R"(skyig_source_overruled_total{source="cockpit",aspect="ownship"})"), 17.0);
    EXPECT_EQ(samples.at(R"(skyig_bus_counts_total{source="cockpit",interface="can0",count="received"})"),
              1000.0);
    EXPECT_EQ(samples.at(R"(skyig_build_info{version="1.2.3",renderer="4.5 \"quoted\" \\ back"})"), 1.0);
    EXPECT_EQ(samples.at("skyig_sun_elevation_degrees"), -5.25);
    for (const auto& [family, type] : families_of(text)) {
        EXPECT_TRUE(family.starts_with("skyig_")) << family;
        EXPECT_EQ(type == "counter", family.ends_with("_total")) << family;
        EXPECT_TRUE(type == "counter" || type == "gauge" || type == "histogram") << type;
    }
}

TEST(Account, HistogramOfFramesIsCumulativeAndWhole) {
    const auto samples = samples_of(to_metrics(Example().account()));
    double before = 0.0;
    for (const double end_s : FrameRecord::kClassEnds_s) {
        std::ostringstream label;
        label << "skyig_frame_seconds_bucket{le=\"" << end_s << "\"}";
        EXPECT_GE(samples.at(label.str()), before);
        before = samples.at(label.str());
    }
    EXPECT_EQ(samples.at(R"(skyig_frame_seconds_bucket{le="0.004"})"), 0.0);
    EXPECT_EQ(samples.at(R"(skyig_frame_seconds_bucket{le="0.006"})"), 599.0);
    EXPECT_EQ(samples.at(R"(skyig_frame_seconds_bucket{le="+Inf"})"), 600.0);
    EXPECT_EQ(samples.at("skyig_frame_seconds_count"), 600.0);
    EXPECT_NEAR(samples.at("skyig_frame_seconds_sum"), 599 * 0.005 + 0.03, 1e-9);
}

std::string operations_page() {
    std::ifstream file(SKYIG_SOURCE_DIR "/docs/operations.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Account, EveryMetricAndEveryKeyStandsInTheDocs) {
    const std::string page = operations_page();
    const auto families = families_of(to_metrics(rig_example().account()));
    for (const auto& [family, type] : families)
        EXPECT_THAT(page, HasSubstr("`" + family + "`"));
    const Json json = Json::parse(to_json(Example().account()));
    for (const auto& [key, value] : json.items())
        EXPECT_THAT(page, HasSubstr("`" + key)) << "a key of /status";
    // And the other way round: no row for what is not told any more. (Columns of `skyig sky` stand in no
    // row's first cell.)
    const std::regex named(R"(\n\| `(skyig_\w+)`)");
    for (std::sregex_iterator it(page.begin(), page.end(), named), end; it != end; ++it)
        EXPECT_TRUE(families.contains((*it)[1])) << (*it)[1] << " is documented and not told";
    for (const std::string_view name : kRigCountNames)
        EXPECT_THAT(page, HasSubstr("`" + std::string(name) + "`"));
    for (const std::string_view name : kRigNodeStateNames)
        EXPECT_THAT(page, HasSubstr("`" + std::string(name) + "`"));
    std::printf("  %zu metrics, %zu keys\n", families.size(), json.size());
}

TEST(Account, EveryCounterStandsInTheDocs) {
    std::ifstream file(SKYIG_SOURCE_DIR "/docs/protocols.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    for (const NamedCount& reason : Example().account().report.rejects)
        EXPECT_THAT(page, HasSubstr("`" + reason.name + "`"));
}

TEST(MetricsText, EscapesLabels) {
    MetricsText out;
    out.family("skyig_x", "gauge", "Help.");
    out.sample({{"a", "1\n2\"3\\"}, {"b", ""}}, 0.1);
    EXPECT_EQ(std::move(out).take(),
              "# HELP skyig_x Help.\n# TYPE skyig_x gauge\nskyig_x{a=\"1\\n2\\\"3\\\\\",b=\"\"} 0.1\n");
}

TEST(Health, IsGoodWhileFramesComeAndSaysWhatIsNot) {
    const Facts facts = tests::example_facts();
    EXPECT_EQ(health_of(facts, Snapshot{}, kStart).text, "no frame yet");
    Snapshot snapshot = tests::example_snapshot();
    const std::int64_t end_ns = snapshot.record.end_ns();
    EXPECT_TRUE(health_of(facts, snapshot, end_ns + kSecond / 2).good);
    snapshot.health[1].failed = true;
    EXPECT_EQ(health_of(facts, snapshot, end_ns).text,
              "channel right cannot be drawn: OpenGL reported an error");
    snapshot.health[1].failed = false;
    const Health stuck = health_of(facts, snapshot, end_ns + 3 * kSecond);
    EXPECT_FALSE(stuck.good);
    EXPECT_EQ(stuck.text, "no frame for 3.0 s");
    for (std::size_t i = 0; i < FrameRecord::kKept; ++i) {
        FrameParts parts;
        parts.start_ns = end_ns + static_cast<std::int64_t>(i) * 40 * tests::kMs;
        parts.channels_ns = 40 * tests::kMs;
        snapshot.record.add(parts, i % 4 != 0, 0.02);
    }
    const Health late = health_of(facts, snapshot, snapshot.record.end_ns());
    EXPECT_FALSE(late.good);
    EXPECT_EQ(late.text, "384 of the last 512 frames were late");
}

}  // namespace
}  // namespace skyig::server::status
