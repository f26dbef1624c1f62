// An endpoint in a log line: formatted only when the line is written, without an allocation.
#pragma once

#include <fmt/format.h>

#include "protocol/transport/endpoint.h"

template <>
struct fmt::formatter<skyig::protocol::transport::Endpoint> {
    static constexpr auto parse(fmt::format_parse_context& context) { return context.begin(); }

    template <class Context>
    auto format(const skyig::protocol::transport::Endpoint& endpoint, Context& context) const {
        const auto byte = [&](unsigned shift) { return (endpoint.address >> shift) & 0xFFU; };
        return fmt::format_to(context.out(), "{}.{}.{}.{}:{}", byte(24), byte(16), byte(8), byte(0),
                              endpoint.port);
    }
};
