// The golden datagrams, for every test that needs real messages.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/wire.h"

namespace skyig::protocol::cigi {

struct GoldenDatagram {
    std::string name;
    Version version = Version::k33;
    ByteOrder order = ByteOrder::kLittle;
    bool from_host = true;
    std::vector<std::byte> bytes;
    /// Array of {packet, id, size, offset, fields}; packet null: to be skipped.
    nlohmann::json packets;
};

/// All of tests/data/cigi/cigi_golden.json; empty if it cannot be read.
[[nodiscard]] const std::vector<GoldenDatagram>& golden_datagrams();

}  // namespace skyig::protocol::cigi
