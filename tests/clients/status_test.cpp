// skyig status against a daemon's port in this process, and the page that it makes.
#include "clients/skyig/status.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "clients/skyig/status/http_get.h"
#include "clients/skyig/status/page.h"
#include "server/status/from_snapshot.h"
#include "server/status/http_server.h"
#include "server/status/status_port.h"
#include "tests/server/status/example.h"

namespace skyig::clients {
namespace {

namespace pages = server::status;
using status::parse_url;
using status::Url;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

TEST(StatusUrl, IsReadInItsForms) {
    EXPECT_EQ(*parse_url("http://10.0.0.7:9000"), (Url{"10.0.0.7", 9000}));
    EXPECT_EQ(*parse_url("http://sim-3/"), (Url{"sim-3", 8006}));
    EXPECT_EQ(*parse_url("localhost:80/status"), (Url{"localhost", 80}));
    for (const char* wrong : {"", "https://a", "http://a:0", "http://a:65536", "http://a:x", "http://a/other",
                              "http://me@a", "http://[::1]:80"})
        EXPECT_FALSE(parse_url(wrong)) << wrong;
    EXPECT_THAT(parse_url("ftp://a").error(), HasSubstr("write it as http://127.0.0.1:8006"));
}

TEST(StatusAnswer, BodyOrWhy) {
    EXPECT_EQ(*status::body_of("HTTP/1.1 200 OK\r\nA: b\r\n\r\nx\r\n\r\ny"), "x\r\n\r\ny");
    EXPECT_EQ(status::body_of("HTTP/1.1 404 Not Found\r\n\r\n").error(), "it answers 404 Not Found");
    EXPECT_THAT(status::body_of("220 mail ready\r\n").error(), HasSubstr("no HTTP"));
    EXPECT_FALSE(status::body_of(""));
    EXPECT_FALSE(status::body_of("HTTP/1.1\r\n\r\n"));
}

Json example(const pages::Snapshot& snapshot) {
    const pages::Facts facts = pages::tests::example_facts();
    return Json::parse(pages::to_json({facts,
                                       snapshot,
                                       pages::tests::with_bus(pages::make_report(facts, snapshot)),
                                       pages::RecorderState{"flight.pcapng", 1200, 2, 123456, true},
                                       {},
                                       {false, "no frame for 3.0 s"},
                                       3725.0,
                                       0.01}));
}

TEST(StatusPage, TellsWhatMattersAndLeavesZerosOut) {
    const std::string page = status::page_text(example(pages::tests::example_snapshot()), nullptr);
    EXPECT_THAT(page, HasSubstr("1.2.3, up 1 h 2 min since 2026-06-21T12:00:00Z\n"));
    EXPECT_THAT(page, HasSubstr("NOT GOOD: no frame for 3.0 s\n"));
    EXPECT_THAT(page, HasSubstr("50.0 a second of 50; 600 since the start\n"));
    EXPECT_THAT(page, HasSubstr("late            1 of the last 512; 1 since the start (channels 1)\n"));
    EXPECT_THAT(page,
                HasSubstr("host (cigi on 127.0.0.1:8004): live from 127.0.0.1:8005, heard 0.0 s ago, 599 "
                          "arrivals, lost 1 times; holds control, ownship\n"));
    EXPECT_THAT(page, HasSubstr("flightgear (fgnetfdm): waiting, 0 arrivals"));
    EXPECT_THAT(page, HasSubstr("conflict        ownship is with host (priority); overruled: cockpit 17\n"));
    EXPECT_THAT(page, HasSubstr("packets         ig_control 599\n"));
    EXPECT_THAT(page, HasSubstr("rejected        truncated 4, second_host 7, not_allowed 9\n"));
    EXPECT_THAT(page, HasSubstr("frames 1000, not_taken_range 3\n"));
    EXPECT_THAT(page, HasSubstr("drawn           dome\n"));
    EXPECT_THAT(page, HasSubstr("123456 bytes, 2 lost; WRITING FAILED\n"));
    EXPECT_THAT(page, Not(HasSubstr("GL errors")));
}

TEST(StatusPage, ShowsWhatHasGrownSinceTheLast) {
    pages::Snapshot snapshot = pages::tests::example_snapshot();
    const Json before = example(snapshot);
    snapshot.frames += 50;
    snapshot.cigi.packets[0] += 48;
    snapshot.refused.second_host += 1;
    snapshot.sources[0].arrivals += 49;
    const std::string page = status::page_text(example(snapshot), &before);
    EXPECT_THAT(page, HasSubstr("650 (+50) since the start"));
    EXPECT_THAT(page, HasSubstr("ig_control 647 (+48)"));
    EXPECT_THAT(page, HasSubstr("truncated 4, second_host 8 (+1)"));
    EXPECT_THAT(page, HasSubstr("648 (+49) arrivals"));
}

TEST(StatusPage, TellsOfARigInALine) {
    pages::Snapshot snapshot = pages::tests::example_snapshot();
    EXPECT_THAT(status::page_text(example(snapshot), nullptr), Not(HasSubstr("rig ")));
    snapshot.rig = pages::tests::example_rig();
    EXPECT_THAT(status::page_text(example(snapshot), nullptr),
                HasSubstr("rig             main leads, frame 600; nodes: 1 ready, 1 refused\n"));
}

class StatusVerb : public ::testing::Test {
  protected:
    StatusVerb() {
        config::Status settings;
        settings.listen.port = 0;
        auto opened = pages::StatusPort::open(settings, pages::tests::rig_facts(), *exchange_, clock_,
                                              [] { return pages::Edges{}; });
        EXPECT_TRUE(opened);
        port_ = std::move(opened).value();
        exchange_->draft() = pages::tests::example_snapshot();
        exchange_->publish();
        options_.url = fmt::format("http://127.0.0.1:{}", port_->local().port);
    }
    /// Status and both streams.
    int run(int pages = 1) {
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        const int status = run_status(options_, clock_, pages);
        out_ = ::testing::internal::GetCapturedStdout();
        err_ = ::testing::internal::GetCapturedStderr();
        return status;
    }

    server::SystemClock clock_;
    std::unique_ptr<pages::SnapshotExchange> exchange_ = std::make_unique<pages::SnapshotExchange>();
    std::unique_ptr<pages::StatusPort> port_;
    StatusOptions options_;
    std::string out_;
    std::string err_;
};

TEST_F(StatusVerb, PrintsThePageOrTheJson) {
    EXPECT_EQ(run(), 0) << err_;
    EXPECT_THAT(out_, HasSubstr("600 since the start"));
    options_.json = true;
    EXPECT_EQ(run(), 0) << err_;
    EXPECT_EQ(Json::parse(out_).at("frames"), 600);
}

TEST_F(StatusVerb, WatchesAndTellsWhenNobodyAnswersAnyMore) {
    options_.watch_s = 0.15;
    options_.json = true;
    EXPECT_EQ(run(3), 0) << err_;
    EXPECT_EQ(std::count(out_.begin(), out_.end(), '\n'), 3);
    options_.json = false;
    EXPECT_EQ(run(2), 0) << err_;
    EXPECT_THAT(out_, HasSubstr("\n\nskyigd "));
}

TEST_F(StatusVerb, PrintsNothingThatIsNoStatus) {
    for (const char* body : {"<html>welcome</html>", "[]", "{}", "{\"frames\": "}) {
        const auto other = pages::HttpServer::open({}, clock_, [body](std::string_view, const auto&) {
            return pages::HttpAnswer{200, "text/html", std::make_shared<const std::string>(body)};
        });
        ASSERT_TRUE(other);
        options_.url = fmt::format("http://127.0.0.1:{}", (*other)->local().port);
        for (const bool json : {true, false}) {
            options_.json = json;
            EXPECT_EQ(run(), 1) << body;
            EXPECT_EQ(out_, "");
            EXPECT_EQ(err_, fmt::format("skyig status: what answers at {} is not skyigd\n", options_.url));
        }
    }
}

TEST_F(StatusVerb, TellsOnlyTheRigOrThatThereIsNone) {
    options_.rig = true;
    EXPECT_EQ(run(), 1);
    EXPECT_EQ(out_, "");
    EXPECT_EQ(err_, fmt::format("skyig status: {} draws alone: its settings have no [rig]\n", options_.url));

    exchange_->draft() = pages::tests::example_snapshot();
    exchange_->draft().rig = pages::tests::example_rig();
    exchange_->publish();
    // A page is made anew at most ten times a second.
    for (int i = 0; i < 100 && run() != 0; ++i)
        clock_.sleep_until_ns(clock_.monotonic_ns() + 20'000'000);
    EXPECT_EQ(
        out_,
        "main leads, frame 600; draws left\n"
        "wait for nodes: median 0.40 ms, p99 1.75 ms, largest 10.00 ms\n"
        "counts: incomplete 3, unsealed 12\n"
        "\n"
        "node  channels  state    frame  lag  frame ms  wait ms  left out  repeats  late  lost      heard\n"
        "side  right     ready      599    1      7.25     0.50         3        0     0     0  0.0 s ago\n"
        "rear  -         refused      0    0      0.00     0.00         0        0     0     0  0.1 s ago\n"
        "\n"
        "side: skyigd 1.2.3, 4.5 llvmpipe\n"
        "rear: skyigd 1.2.3; REFUSED: settings 1, the leader's are 2\n");
    options_.json = true;
    EXPECT_EQ(run(), 0) << err_;
    EXPECT_EQ(Json::parse(out_).at("leader"), "main");
}

TEST_F(StatusVerb, SaysInOneLineThatNobodyAnswers) {
    port_.reset();
    EXPECT_EQ(run(), 1);
    EXPECT_EQ(out_, "");
    EXPECT_EQ(err_,
              fmt::format("skyig status: no answer from {}: nobody listens there; is skyigd running, and is "
                          "that its [status] port?\n",
                          options_.url));
}

}  // namespace
}  // namespace skyig::clients
