// The layouts against the interface tables as they were written down for people: every packet, field, byte,
// bit, type and range of `cigi.md`, where this clone has it.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cigi/catalogue.h"
#include "tests/protocol/cigi/random_packet.h"

namespace skyig::protocol::cigi {
namespace {

struct Field {
    std::string place;
    std::string name;
    std::string type;
};

struct Table {
    unsigned long id = 0;
    unsigned long size = 0;  // 0: varies
    std::vector<Field> rows;
};

/// By packet name and version.
using Tables = std::map<std::pair<std::string, Version>, Table>;

std::string trimmed(std::string_view text) {
    while (text.starts_with(' '))
        text.remove_prefix(1);
    while (text.ends_with(' '))
        text.remove_suffix(1);
    return std::string(text);
}

/// What stands between the bars of a line of a table.
std::vector<std::string> cells(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> out;
    std::string cell;
    std::getline(in, cell, '|');
    while (std::getline(in, cell, '|'))
        out.push_back(trimmed(cell));
    return out;
}

Tables read_tables(std::ifstream& file) {
    static const std::regex kHeading(R"(^### .*\(`(\w+)`\)$)");
    static const std::regex kShape(R"(^CIGI (\d)\.\d: id (\w+), size (\w+)$)");
    Tables tables;
    std::string packet;
    Table* table = nullptr;
    std::string line;
    while (std::getline(file, line)) {
        std::smatch match;
        if (line.starts_with("#")) table = nullptr;
        if (std::regex_match(line, match, kHeading)) {
            packet = match[1];
        } else if (std::regex_match(line, match, kShape)) {
            table = &tables[{packet, match[1] == "3" ? Version::k33 : Version::k40}];
            table->id = std::stoul(match[2], nullptr, 0);
            table->size = match[3] == "variable" ? 0 : std::stoul(match[3]);
        } else if (table != nullptr && line.starts_with("| ") && std::isdigit(line[2]) != 0) {
            const std::vector<std::string> row = cells(line);
            table->rows.push_back({row.at(0), row.at(1), row.at(2)});
        }
    }
    return tables;
}

std::string place_text(const Place& place) {
    std::ostringstream text;
    text << place.byte;
    if (place.bits > 0) text << ":b" << int{place.bit};
    if (place.bits > 1) text << "-" << place.bit + place.bits - 1;
    return text.str();
}

template <class T>
std::string type_text(const Place& place) {
    if (place.bits > 0) return std::to_string(place.bits) + (place.bits == 1 ? " bit" : " bits");
    if constexpr (std::is_same_v<T, std::string_view>) {
        return "text";
    } else {
        using Number = typename Raw<T>::Type;
        const char kind = std::is_floating_point_v<Number> ? 'f' : std::is_signed_v<Number> ? 'i' : 'u';
        return std::string(1, kind).append(std::to_string(8 * sizeof(T)));
    }
}

class Reference : public testing::Test {
  protected:
    void SetUp() override {
        std::ifstream file(SKYIG_REFERENCE "/cigi.md");
        if (!file) GTEST_SKIP() << "the interface tables (cigi.md) are not beside this clone";
        tables = read_tables(file);
    }
    Tables tables;
};

/// Told in a sentence, or by id and size alone.
template <class P>
constexpr bool told_without_table =
    std::is_same_v<P, RateControl> || std::is_same_v<P, AccelerationControl> ||
    std::is_same_v<P, LosSegmentRequest> || std::is_same_v<P, LosVectorRequest> ||
    std::is_same_v<P, LosResponse> || std::is_same_v<P, LosExtendedResponse>;

template <class P>
std::size_t compare(const Table& table, Version version) {
    const Shape shape = shape_of<P>(version);
    EXPECT_EQ(shape.id, table.id) << Layout<P>::kName;
    EXPECT_EQ(has_text<P>() ? 0U : shape.size, table.size) << Layout<P>::kName;
    std::map<std::string, std::pair<std::string, std::string>> ours;
    for_each_field<P>([&](const auto& field) {
        using Value = typename std::decay_t<decltype(field)>::Value;
        const Place place = field.place(version);
        if (place.present) ours[std::string(field.name)] = {place_text(place), type_text<Value>(place)};
    });
    EXPECT_EQ(ours.size(), table.rows.size()) << Layout<P>::kName;
    for (const Field& row : table.rows) {
        EXPECT_EQ(ours[row.name].first, row.place) << Layout<P>::kName << "." << row.name;
        EXPECT_EQ(ours[row.name].second, row.type) << Layout<P>::kName << "." << row.name;
    }
    return table.rows.size();
}

TEST_F(Reference, EveryFieldLiesWhereTheTablesSay) {
    std::size_t fields = 0;
    for (const Version version : {Version::k33, Version::k40}) {
        for_each_packet([&]<class P>() {
            if (told_without_table<P>) return;
            const auto table = tables.find({std::string(Layout<P>::kName), version});
            ASSERT_EQ(table == tables.end(), shape_of<P>(version).size == 0) << Layout<P>::kName;
            if (table == tables.end()) return;
            fields += compare<P>(table->second, version);
            tables.erase(table);
        });
    }
    for (const auto& [key, table] : tables)
        ADD_FAILURE() << key.first << " is in the tables but not read";
    std::printf("%zu fields compared\n", fields);
    EXPECT_GT(fields, 400U);
}

TEST_F(Reference, EveryListedIdAndSizeIsInTheCatalogue) {
    std::ifstream file(SKYIG_REFERENCE "/cigi.md");
    std::string line;
    Version version = Version::k33;
    std::size_t compared = 0;
    static const std::regex kSize(R"(^\d+)");
    while (std::getline(file, line)) {
        if (line.starts_with("### CIGI 4.0 (size")) version = Version::k40;
        const std::vector<std::string> row =
            line.starts_with("| ") ? cells(line) : std::vector<std::string>{};
        for (std::size_t i = 0; row.size() == 6 && i < 6; i += 3) {
            std::smatch size;
            if (row[i].empty() || std::isdigit(row[i][0]) == 0 || row[i].find("..") != std::string::npos ||
                row[i + 2].empty() || !std::regex_search(row[i + 1], size, kSize) ||
                row[i + 2].find(' ') == std::string::npos)
                continue;
            const auto id = static_cast<std::uint16_t>(std::stoul(row[i], nullptr, 0));
            const std::string_view name = listed_packet_name(version, id);
            EXPECT_NE(name, "unassigned") << line;
            for (const ListedPacket& listed : listed_packets()) {
                // The message's own row gives the whole packet's least size, the catalogue its text's offset.
                if (listed.name != name || name == "ig_message") continue;
                EXPECT_EQ(listed.shape(version).size, std::stoul(size.str())) << line;
                EXPECT_EQ(listed.shape(version).varies, row[i + 1] != size.str()) << line;
                ++compared;
            }
        }
    }
    std::printf("%zu ids compared\n", compared);
    EXPECT_EQ(compared, 51U + 55U);
}

}  // namespace
}  // namespace skyig::protocol::cigi
