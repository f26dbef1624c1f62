// Heads of requests, good and bad, in pieces and mutated.
#include "server/status/http.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace skyig::server::status {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kGood =
    "GET /status?pretty=1 HTTP/1.1\r\nhOsT:  127.0.0.1:8006 \r\nUser-Agent: curl/7\r\n\r\n";

TEST(HttpHead, IsReadWhenItIsWhole) {
    const Head head = read_head(kGood);
    ASSERT_EQ(head.state, HeadState::kComplete);
    EXPECT_EQ(head.request.method, "GET");
    EXPECT_EQ(head.request.path, "/status");
    EXPECT_EQ(head.request.host, "127.0.0.1");
    for (std::size_t size = 0; size < kGood.size(); ++size)
        EXPECT_EQ(read_head(kGood.substr(0, size)).state, HeadState::kIncomplete) << size;
}

TEST(HttpHead, FaultsAreToldApart) {
    const auto state = [](std::string_view text) { return read_head(text).state; };
    EXPECT_EQ(state("GET /status HTTP/2.0\r\n\r\n"), HeadState::kBadVersion);
    EXPECT_EQ(state("GET / HTTP/1.0\r\n\r\n"), HeadState::kComplete);
    EXPECT_EQ(state("DELETE /status HTTP/1.1\r\n\r\n"), HeadState::kComplete);
    for (const std::string_view bad :
         {"GET status HTTP/1.1\r\n\r\n", "GET /status\r\n\r\n", "GET  HTTP/1.1\r\n\r\n",
          "GET / / HTTP/1.1\r\n\r\n", "GET / FTP/1.1\r\n\r\n", "GET / HTTP/1.1\r\nno colon\r\n\r\n",
          "GET / HTTP/1.1\r\n: x\r\n\r\n", "\r\n\r\n", "get / HTTP/1.1\r\n\r\n"})
        EXPECT_EQ(state(bad), HeadState::kBad) << bad;
}

TEST(HttpHead, GarbageIsToldBeforeItsEnd) {
    EXPECT_EQ(read_head("\x16\x03\x01").state, HeadState::kBad);  // a TLS greeting
    EXPECT_EQ(read_head(std::string_view("GET /\0", 6)).state, HeadState::kBad);
    EXPECT_EQ(read_head("GET /\xC3\xA9").state, HeadState::kBad);
    EXPECT_EQ(read_head("ABCDEFGHIJKLMNOPQ").state, HeadState::kBad);
}

TEST(HttpHead, LengthIsLimited) {
    std::string text = "GET / HTTP/1.1\r\nA: ";
    text.resize(kMaxHeadBytes - 1, 'x');
    EXPECT_EQ(read_head(text).state, HeadState::kIncomplete);
    text += 'x';
    EXPECT_EQ(read_head(text).state, HeadState::kTooLong);
    text += "\r\n\r\n";
    EXPECT_EQ(read_head(text).state, HeadState::kTooLong);
}

TEST(HttpHead, MutationsAreReadWithoutHarm) {
    std::mt19937 random(11);
    int complete = 0;
    int refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text(kGood);
        for (int changes = static_cast<int>(random() % 4); changes >= 0; --changes)
            text[random() % text.size()] = static_cast<char>(random());
        const Head head = read_head(text);
        if (head.state == HeadState::kComplete) {
            ++complete;
            ASSERT_FALSE(head.request.path.empty());
            ASSERT_EQ(head.request.path.front(), '/');
        } else if (head.state != HeadState::kIncomplete) {
            ++refused;
        }
    }
    std::printf("  %d heads still whole, %d refused\n", complete, refused);
    EXPECT_GT(complete, 100);
    EXPECT_GT(refused, 100);
}

TEST(HttpHead, HostIsWithoutItsPort) {
    const auto host_of = [](const std::string& host) {
        const std::string head = "GET / HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
        return std::string(read_head(head).request.host);
    };
    EXPECT_EQ(host_of("localhost"), "localhost");
    EXPECT_EQ(host_of("localhost:8080"), "localhost");
    EXPECT_EQ(host_of("[::1]"), "[::1]");
    EXPECT_EQ(host_of("[fe80::1]:8080"), "[fe80::1]");
    EXPECT_EQ(host_of("[::1"), "[:");  // no host, and no local name
    EXPECT_FALSE(is_local_name("[:"));
}

TEST(HttpHead, NamesOfThisMachine) {
    for (const char* local : {"", "localhost", "LocalHost", "127.0.0.1", "192.168.1.5", "[::1]"})
        EXPECT_TRUE(is_local_name(local)) << local;
    for (const char* foreign : {"example.org", "localhost.example.org", "127.0.0.1.example.org", "a"})
        EXPECT_FALSE(is_local_name(foreign)) << foreign;
}

TEST(HttpAnswer, HeadSaysLengthAndEnd) {
    const std::string head = answer_head(line_answer(404, "no"));
    EXPECT_THAT(head, ::testing::StartsWith("HTTP/1.1 404 Not Found\r\n"));
    EXPECT_THAT(head, HasSubstr("Content-Length: 3\r\n"));
    EXPECT_THAT(head, HasSubstr("Connection: close\r\n"));
    EXPECT_THAT(head, ::testing::EndsWith("\r\n\r\n"));
    EXPECT_THAT(head, Not(HasSubstr("Allow")));
    EXPECT_THAT(answer_head(line_answer(405, "no")), HasSubstr("Allow: GET, HEAD\r\n"));
}

}  // namespace
}  // namespace skyig::server::status
