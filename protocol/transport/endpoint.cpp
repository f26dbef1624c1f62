#include "protocol/transport/endpoint.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace skyig::protocol::transport {
namespace {

/// A decimal number 0..largest without sign or leading zero.
std::optional<std::uint32_t> parse_number(std::string_view text, std::uint32_t largest) {
    if (text.empty() || text.size() > 5 || (text.size() > 1 && text.front() == '0')) return std::nullopt;
    std::uint32_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || number > largest) return std::nullopt;
    return number;
}

}  // namespace

Result<Ipv4, std::string> parse_ipv4(std::string_view text) {
    const auto bad = [text] {
        return Error{
            fmt::format("\"{}\" is no IPv4 address; write four numbers 0..255, as in 127.0.0.1", text)};
    };
    Ipv4 address = 0;
    std::string_view rest = text;
    for (int part = 0; part < 4; ++part) {
        const std::size_t dot = part < 3 ? rest.find('.') : rest.size();
        if (dot == std::string_view::npos) return bad();
        const std::optional<std::uint32_t> number = parse_number(rest.substr(0, dot), 255);
        if (!number) return bad();
        address = (address << 8U) | *number;
        rest.remove_prefix(part < 3 ? dot + 1 : dot);
    }
    return address;
}

Result<Endpoint, std::string> parse_endpoint(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) {
        return Error{fmt::format("\"{}\" has no port; write address:port, as in 127.0.0.1:8004", text)};
    }
    auto address = parse_ipv4(text.substr(0, colon));
    if (!address) return Error{address.error()};
    const std::optional<std::uint32_t> port = parse_number(text.substr(colon + 1), 65535);
    if (!port) {
        return Error{
            fmt::format("\"{}\": the port is no number 0..65535; write 127.0.0.1:8004, for example", text)};
    }
    return Endpoint{*address, static_cast<std::uint16_t>(*port)};
}

std::string to_string(Ipv4 address) {
    return fmt::format("{}.{}.{}.{}", address >> 24U, (address >> 16U) & 255U, (address >> 8U) & 255U,
                       address & 255U);
}

std::string to_string(const Endpoint& endpoint) {
    return fmt::format("{}:{}", to_string(endpoint.address), endpoint.port);
}

}  // namespace skyig::protocol::transport
