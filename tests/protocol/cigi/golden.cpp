#include "tests/protocol/cigi/golden.h"

#include <fstream>

namespace skyig::protocol::cigi {
namespace {

std::vector<std::byte> from_hex(const std::string& hex) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    }
    return bytes;
}

std::vector<GoldenDatagram> load_golden() {
    std::ifstream file(SKYIG_TEST_DATA "/cigi/cigi_golden.json");
    if (!file) return {};
    std::vector<GoldenDatagram> datagrams;
    const auto document = nlohmann::json::parse(file);
    for (const auto& row : document.at("datagrams")) {
        datagrams.push_back({row.at("name"), row.at("cigi") == "3.3" ? Version::k33 : Version::k40,
                             row.at("byte_order") == "little" ? ByteOrder::kLittle : ByteOrder::kBig,
                             row.at("direction") == "host_to_ig", from_hex(row.at("hex")),
                             row.at("packets")});
    }
    return datagrams;
}

}  // namespace

const std::vector<GoldenDatagram>& golden_datagrams() {
    static const std::vector<GoldenDatagram> datagrams = load_golden();
    return datagrams;
}

}  // namespace skyig::protocol::cigi
