// The recorded packets of tests/data/flights/fg_netfdm_packets.json.
#pragma once

#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::protocol::flightgear {

struct Sample {
    std::vector<std::byte> bytes;
    nlohmann::json fields;
};

inline std::vector<std::byte> bytes_of_hex(std::string_view hex) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::byte>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    return bytes;
}

inline std::vector<Sample> samples() {
    std::ifstream file(std::string(SKYIG_TEST_DATA) + "/flights/fg_netfdm_packets.json");
    std::vector<Sample> all;
    const nlohmann::json document = nlohmann::json::parse(file);
    for (const auto& packet : document.at("packets"))
        all.push_back({bytes_of_hex(packet.at("hex").get<std::string>()), packet.at("fields")});
    return all;
}

}  // namespace skyig::protocol::flightgear
