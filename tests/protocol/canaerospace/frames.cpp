#include "tests/protocol/canaerospace/frames.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <sstream>

#include "protocol/recording/candump.h"

namespace skyig::protocol::canaerospace {

CanFrame frame(std::string_view text, std::int64_t after_ns) {
    const std::string line = "(0000000000.000000) can0 " + std::string(text);
    const auto parsed = recording::parse_candump(line);
    if (!parsed) {
        ADD_FAILURE() << recording::describe(parsed.error(), text, 1);
        return {};
    }
    CanFrame out = parsed->frame;
    out.received_ns = kStart + after_ns;
    return out;
}

CanFrame float_frame(std::uint32_t id, std::uint8_t message_code, float value, std::int64_t after_ns,
                     std::uint16_t channel, std::uint8_t service_code) {
    CanFrame out;
    out.received_ns = kStart + after_ns;
    out.id = id | static_cast<std::uint32_t>(channel) << 16;
    out.extended = channel > 0;
    out.length = 8;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    out.data = {1, 2, service_code, message_code};
    for (std::size_t i = 0; i < 4; ++i)
        out.data[4 + i] = static_cast<std::uint8_t>(bits >> (24 - 8 * i));
    return out;
}

std::string read_data(const std::string& name) {
    std::ifstream file(std::string(SKYIG_TEST_DATA) + "/canaerospace/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return text.str();
}

}  // namespace skyig::protocol::canaerospace
