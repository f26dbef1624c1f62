#include "protocol/transport/endpoint.h"

#include <gtest/gtest.h>

namespace skyig::protocol::transport {
namespace {

TEST(Endpoint, IsReadAndWrittenAsAddressAndPort) {
    for (const char* text : {"127.0.0.1:8004", "0.0.0.0:0", "255.255.255.255:65535", "10.20.30.40:1"}) {
        const auto endpoint = parse_endpoint(text);
        ASSERT_TRUE(endpoint) << endpoint.error();
        EXPECT_EQ(to_string(*endpoint), text);
    }
    EXPECT_EQ(*parse_endpoint("127.0.0.1:8004"), (Endpoint{0x7F000001, 8004}));
}

TEST(Endpoint, AnythingElseIsRefusedInOneLine) {
    for (const char* text :
         {"", ":", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1", "127.0.0.1:+1",
          "127.0.0.1:08004", "127.0.0.1:80x", "127.0.0:8004", "127.0.0.0.1:8004", "256.0.0.1:8004",
          "127.0.0.01:8004", "127..0.1:8004", " 127.0.0.1:8004", "localhost:8004", "[::1]:8004",
          "127.0.0.1:999999999999999999999"}) {
        const auto endpoint = parse_endpoint(text);
        ASSERT_FALSE(endpoint) << text;
        EXPECT_NE(endpoint.error().find("127.0.0.1"), std::string::npos) << endpoint.error();
        EXPECT_EQ(endpoint.error().find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace skyig::protocol::transport
