// The page of protocols has every parameter of the map, and no other.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>

#include "protocol/canaerospace/identifier_map.h"

namespace skyig::protocol::canaerospace {
namespace {

std::string section(const std::string& heading) {
    std::ifstream file(SKYIG_SOURCE_DIR "/docs/protocols.md");
    std::ostringstream text;
    text << file.rdbuf();
    const std::string page = text.str();
    const std::size_t begin = page.find("## " + heading + "\n");
    if (begin == std::string::npos) return {};
    return page.substr(begin, page.find("\n## ", begin) - begin);
}

TEST(Documentation, ListsTheParametersOfTheMap) {
    const std::string told = section("What a bus says");
    std::size_t rows = 0;
    for (std::size_t at = told.find("\n| "); at != std::string::npos; at = told.find("\n| ", at + 1))
        ++rows;
    EXPECT_EQ(rows, kParameters + 1) << "one row a parameter, and the head";
    for (const MapEntry& entry : default_identifier_map().entries) {
        const std::string unit(entry.unit.empty() ? "-" : entry.unit);
        const std::string row =
            "\n| " + std::to_string(entry.id) + " | " + std::string(entry.name) + " | " + unit + " |\n";
        EXPECT_NE(told.find(row), std::string::npos) << row;
    }
}

}  // namespace
}  // namespace skyig::protocol::canaerospace
