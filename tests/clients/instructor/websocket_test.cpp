// Frames and handshake against the examples of RFC 6455, and what is refused.
#include "clients/instructor/websocket.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clients/instructor/admission.h"
#include "clients/instructor/sha1.h"

namespace skyig::clients::instructor {
namespace {

using Event = MessageReader::Event;

/// A client's frame, masked.
std::string masked(unsigned char first, const std::string& payload) {
    const std::string mask("\x37\xfa\x21\x3d", 4);
    std::string frame(1, static_cast<char>(first));
    if (payload.size() < 126) {
        frame += static_cast<char>(0x80U | payload.size());
    } else {
        frame += static_cast<char>(0x80U | 126U);
        frame += static_cast<char>(payload.size() >> 8U);
        frame += static_cast<char>(payload.size() & 0xFFU);
    }
    frame += mask;
    for (std::size_t i = 0; i < payload.size(); ++i)
        frame += static_cast<char>(payload[i] ^ mask[i % 4]);
    return frame;
}

Event take(MessageReader& reader, const std::string& bytes) {
    std::span<const char> rest(bytes.data(), bytes.size());
    return reader.take(rest);
}

TEST(WebSocket, AnswersTheHandshakeOfTheStandard) {
    EXPECT_EQ(accept_key("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
    // FIPS 180-4: of nothing.
    EXPECT_EQ(sha1("")[0], 0xDA);
    EXPECT_EQ(sha1("")[19], 0x09);
    // Two blocks: its example of 56 letters.
    const auto long_one = sha1("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq");
    EXPECT_EQ(long_one[0], 0x84);
    EXPECT_EQ(long_one[19], 0xF1);
}

TEST(WebSocket, ReadsTheStandardsMaskedHello) {
    MessageReader reader(100);
    EXPECT_EQ(take(reader, std::string("\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58", 11)), Event::kText);
    EXPECT_EQ(reader.message(), "Hello");
    EXPECT_EQ(make_frame(Opcode::kText, "Hello"), "\x81\x05Hello");
    EXPECT_EQ(make_frame(Opcode::kBinary, std::string(256, 'x')).substr(0, 4),
              std::string("\x82\x7e\x01\x00", 4));
    EXPECT_EQ(make_frame(Opcode::kBinary, std::string(65536, 'x')).substr(0, 10),
              std::string("\x82\x7f\0\0\0\0\0\x01\0\0", 10));
}

TEST(WebSocket, PutsPartsTogetherWhereverTheyAreCut) {
    const std::string bytes = masked(0x01, "Hel") + masked(0x89, "still there?") + masked(0x80, "lo");
    MessageReader reader(100);
    std::vector<std::pair<Event, std::string>> events;
    for (const char byte : bytes) {
        std::span<const char> rest(&byte, 1);
        const Event event = reader.take(rest);
        if (event != Event::kNothing) events.emplace_back(event, reader.message());
    }
    const std::vector<std::pair<Event, std::string>> wanted{{Event::kPing, "still there?"},
                                                            {Event::kText, "Hello"}};
    EXPECT_EQ(events, wanted);
}

TEST(WebSocket, RefusesWhatIsTooBigByItsHeadAlone) {
    MessageReader ten_megabytes(65536);
    EXPECT_EQ(take(ten_megabytes, std::string("\x81\xff\0\0\0\0\0\x98\x96\x80\x37\xfa\x21\x3d", 14)),
              Event::kTooBig);
    MessageReader most(65536);
    EXPECT_EQ(take(most, std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff\x37\xfa\x21\x3d", 14)),
              Event::kTooBig);
    MessageReader parts(10);
    EXPECT_EQ(take(parts, masked(0x01, "123456")), Event::kNothing);
    EXPECT_EQ(take(parts, masked(0x80, "78901")), Event::kTooBig);
}

TEST(WebSocket, RefusesWhatNoClientSends) {
    const std::vector<std::string> broken{
        std::string("\x81\x05Hello", 7),       // not masked
        masked(0xC1, "x"),                     // a reserved bit
        masked(0x80, "x"),                     // goes on with nothing
        masked(0x83, "x"),                     // no such kind
        masked(0x09, "x"),                     // a ping in parts
        masked(0x89, std::string(126, 'x')),   // and one that is too long
        masked(0x01, "x") + masked(0x81, "y")  // a text within a text
    };
    for (const std::string& bytes : broken) {
        MessageReader reader(1000);
        EXPECT_EQ(take(reader, bytes), Event::kBroken) << bytes.size();
    }
    MessageReader reader(1000);
    EXPECT_EQ(take(reader, masked(0x82, "x")), Event::kBinary);
}

server::status::HttpRequest asked(const std::string& head) {
    return server::status::read_head(head).request;
}

TEST(Handshake, IsAsTheStandardHasIt) {
    const auto stands = [](const std::string& request, const std::string& upgrade,
                           const std::string& connection, const std::string& key,
                           const std::string& version) {
        const std::string head = request + "\r\nUpgrade: " + upgrade + "\r\nConnection: " + connection +
                                 "\r\nSec-WebSocket-Key: " + key + "\r\nSec-WebSocket-Version: " + version +
                                 "\r\n\r\n";
        return check_handshake(asked(head));
    };
    const std::string get = "GET /ws HTTP/1.1", key = "dGhlIHNhbXBsZSBub25jZQ==";
    EXPECT_EQ(stands(get, "websocket", "Upgrade", key, "13"), Handshake::kGood);
    EXPECT_EQ(stands(get, "h2c, WebSocket", "keep-alive, Upgrade", key, "13"), Handshake::kGood);
    EXPECT_EQ(stands("POST /ws HTTP/1.1", "websocket", "Upgrade", key, "13"), Handshake::kBad);
    EXPECT_EQ(stands("GET /ws HTTP/1.0", "websocket", "Upgrade", key, "13"), Handshake::kBad);
    EXPECT_EQ(stands(get, "websockets", "Upgrade", key, "13"), Handshake::kBad);
    EXPECT_EQ(stands(get, "", "Upgrade", key, "13"), Handshake::kBad);
    EXPECT_EQ(stands(get, "websocket", "keep-alive", key, "13"), Handshake::kBad);
    for (const char* no_key : {"", "x", "dGhlIHNhbXBsZSBub25jZQ", "dGhlIHNhbXBsZSBub25jZQ=A",
                               "dGhlIHNhbXBsZSBub25j!Q==", "dGhlIHNhbXBsZSBub25jZWFhYQ=="})
        EXPECT_EQ(stands(get, "websocket", "Upgrade", no_key, "13"), Handshake::kBad) << no_key;
    EXPECT_EQ(stands(get, "websocket", "Upgrade", key, "8"), Handshake::kOtherVersion);
    EXPECT_EQ(stands(get, "websocket", "Upgrade", key, ""), Handshake::kOtherVersion);
}

TEST(Admission, LetsInTheOwnPageAlone) {
    const AdmissionRules rules;
    const auto upgrade = [&rules](const std::string& host, const std::string& origin) {
        const std::string head = "GET /ws HTTP/1.1\r\nHost: " + host + "\r\nOrigin: " + origin + "\r\n\r\n";
        return check_upgrade(asked(head), rules);
    };
    EXPECT_EQ(upgrade("127.0.0.1:8080", "http://127.0.0.1:8080"), Refusal::kNone);
    EXPECT_EQ(upgrade("localhost:8080", "http://localhost:8080"), Refusal::kNone);
    EXPECT_EQ(upgrade("[::1]:8080", "http://[::1]:8080"), Refusal::kNone);
    EXPECT_EQ(upgrade("127.0.0.1:8080", "http://evil.example"), Refusal::kOrigin);
    EXPECT_EQ(upgrade("127.0.0.1:8080", "http://127.0.0.1:8081"), Refusal::kOrigin);
    EXPECT_EQ(upgrade("127.0.0.1:8080", "null"), Refusal::kOrigin);
    // A name of theirs that leads here.
    EXPECT_EQ(upgrade("evil.example:8080", "http://evil.example:8080"), Refusal::kHost);
    const std::string no_origin = "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
    EXPECT_EQ(check_upgrade(asked(no_origin), rules), Refusal::kOrigin);
    const std::string no_host = "GET /ws HTTP/1.1\r\n\r\n";
    EXPECT_EQ(check_host(asked(no_host), rules), Refusal::kHost);
}

TEST(Admission, AsksForTheTokenAndKnowsTheProxysName) {
    const AdmissionRules far{false, "rather-secret", {}};
    const auto upgrade = [](const AdmissionRules& rules, const std::string& query) {
        const std::string head =
            "GET /ws" + query + " HTTP/1.1\r\nHost: sky.example\r\nOrigin: https://sky.example\r\n\r\n";
        return check_upgrade(asked(head), rules);
    };
    EXPECT_EQ(upgrade(far, "?token=rather-secret"), Refusal::kNone);
    EXPECT_EQ(upgrade(far, "?a=b&token=rather-secret"), Refusal::kNone);
    for (const char* wrong :
         {"", "?token=", "?token=rather-secre", "?token=rather-secret1", "?tokens=rather-secret"})
        EXPECT_EQ(upgrade(far, wrong), Refusal::kToken) << wrong;
    EXPECT_EQ(upgrade({true, "", {"sky.example"}}, ""), Refusal::kNone);
    EXPECT_EQ(upgrade({true, "", {"Sky.Example"}}, ""), Refusal::kNone);
    EXPECT_EQ(upgrade({true, "", {"other.example"}}, ""), Refusal::kHost);
}

}  // namespace
}  // namespace skyig::clients::instructor
