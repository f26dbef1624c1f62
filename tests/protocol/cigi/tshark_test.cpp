// A foreign reader's opinion: Wireshark's dissector shows every field of every 3.3 packet as it was written.
// It knows no CIGI 4.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "protocol/cigi/message.h"
#include "tests/protocol/cigi/random_packet.h"

namespace skyig::protocol::cigi {
namespace {

template <class T>
void append(std::vector<std::byte>& out, T value, ByteOrder order) {
    const std::size_t end = out.size();
    out.resize(end + sizeof(T));
    store(out.data() + end, order, value);
}

void append_u16(std::vector<std::byte>& out, unsigned value, ByteOrder order) {
    append(out, static_cast<std::uint16_t>(value), order);
}

void append_u32(std::vector<std::byte>& out, std::uint32_t value, ByteOrder order) {
    append(out, value, order);
}

/// A capture file of UDP datagrams in raw IPv4 (link type 101).
std::vector<std::byte> capture_of(const std::vector<std::vector<std::byte>>& payloads) {
    constexpr ByteOrder kFile = ByteOrder::kLittle;
    constexpr ByteOrder kNet = ByteOrder::kBig;
    constexpr std::uint32_t kIpAndUdp = 28;
    constexpr std::uint32_t kLoopback = 0x7F000001;
    std::vector<std::byte> file;
    append_u32(file, 0xA1B2C3D4U, kFile);
    append_u16(file, 2, kFile);
    append_u16(file, 4, kFile);
    for (const std::uint32_t word : {0U, 0U, 65535U, 101U})
        append_u32(file, word, kFile);
    for (const std::vector<std::byte>& payload : payloads) {
        const auto length = static_cast<std::uint32_t>(payload.size());
        for (const std::uint32_t word : {0U, 0U, length + kIpAndUdp, length + kIpAndUdp})
            append_u32(file, word, kFile);
        append_u16(file, 0x4500, kNet);
        append_u16(file, length + kIpAndUdp, kNet);
        append_u32(file, 0, kNet);
        append_u32(file, 0x40110000U, kNet);  // time to live 64, UDP, checksum not computed
        append_u32(file, kLoopback, kNet);
        append_u32(file, kLoopback, kNet);
        append_u16(file, 8005, kNet);
        append_u16(file, 8005, kNet);
        append_u16(file, length + 8, kNet);
        append_u16(file, 0, kNet);
        file.insert(file.end(), payload.begin(), payload.end());
    }
    return file;
}

std::string output_of(const std::string& command) {
    std::string output;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return output;
    std::array<char, 4096> part{};
    while (std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
        output.append(part.data(), count);
    ::pclose(pipe);
    return output;
}

/// What Wireshark calls a packet, and those of its fields that it calls otherwise than we do.
struct ForeignNames {
    std::string prefix;
    std::map<std::string, std::string> fields;
};

const std::map<std::string, ForeignNames>& foreign_names() {
    static const std::map<std::string, std::string> kPlaceNames{{"lat_x", "lat_xoff"},
                                                                {"lon_y", "lon_yoff"},
                                                                {"alt_z", "alt_zoff"},
                                                                {"request_type", "type"},
                                                                {"request_id", "hat_hot_id"}};
    static const std::map<std::string, std::string> kSeaNames{{"enable", "surface_conditions_enable"},
                                                              {"water_temperature", "surface_water_temp"},
                                                              {"clarity", "surface_clarity"}};
    static const std::map<std::string, ForeignNames> kNames{
        {"ig_control", {"ig_control", {{"database_number", "db_number"}}}},
        {"start_of_frame",
         {"sof", {{"database_number", "db_number"}, {"earth_model", "earth_reference_model"}}}},
        {"entity_control",
         {"entity_control",
          {{"collision_detect", "coll_det_request"},
           {"ground_clamp", "ground_ocean_clamp"},
           {"animation_direction", "animation_dir"},
           {"animation_loop", "animation_loop_mode"},
           {"lat_x", "lat_xoff"},
           {"lon_y", "lon_yoff"},
           {"alt_z", "alt_zoff"}}}},
        {"conformal_clamped",
         {"conformal_clamped_entity_control", {{"latitude", "lat"}, {"longitude", "lon"}}}},
        {"atmosphere_control",
         {"atmosphere_control",
          {{"model_enable", "atmospheric_model_enable"},
           {"air_temperature", "air_temp"},
           {"visibility", "visibility_range"},
           {"wind_horizontal", "horiz_wind"},
           {"wind_vertical", "vert_wind"},
           {"pressure", "barometric_pressure"}}}},
        {"env_region_control", {"env_region_control", {{"latitude", "lat"}, {"longitude", "lon"}}}},
        {"weather_control",
         {"weather_control",
          {{"random_winds", "random_winds_enable"},
           {"random_lightning", "random_lightning_enable"},
           {"air_temperature", "air_temp"},
           {"visibility", "visibility_range"},
           {"wind_horizontal", "horiz_wind"},
           {"wind_vertical", "vert_wind"},
           {"pressure", "barometric_pressure"},
           {"aerosol", "aerosol_concentration"}}}},
        {"maritime_surface_control", {"maritime_surface_conditions_control", kSeaNames}},
        {"maritime_surface_response", {"maritime_surface_conditions_response", kSeaNames}},
        {"terrestrial_surface_control",
         {"terrestrial_surface_conditions_control",
          {{"condition_id", "surface_condition_id"}, {"enable", "surface_condition_enable"}}}},
        {"terrestrial_surface_response", {"terr_surface_cond_response", {{"condition_id", "surface_id"}}}},
        {"view_control",
         {"view_control",
          {{"x_enable", "xoff_enable"},
           {"y_enable", "yoff_enable"},
           {"z_enable", "zoff_enable"},
           {"x_offset", "xoff"},
           {"y_offset", "yoff"},
           {"z_offset", "zoff"}}}},
        {"view_definition", {"view_def", {}}},
        {"earth_model_definition", {"earth_ref_model_def", {{"custom_enable", "erm_enable"}}}},
        {"hat_hot_request", {"hat_hot_request", kPlaceNames}},
        {"hat_hot_response",
         {"hat_hot_response",
          {{"request_id", "hat_hot_id"},
           {"response_type", "type"},
           {"host_frame_lsn", "host_frame_number_lsn"}}}},
        {"hat_hot_extended_response",
         {"hat_hot_ext_response",
          {{"request_id", "hat_hot_id"},
           {"host_frame_lsn", "host_frame_number_lsn"},
           {"normal_azimuth", "normal_vector_azimuth"},
           {"normal_elevation", "normal_vector_elevation"}}}},
        {"los_segment_request",
         {"los_segment_request",
          {{"request_id", "los_id"},
           {"request_type", "type"},
           {"source_coordinate_system", "source_coord"},
           {"destination_coordinate_system", "destination_coord"},
           {"response_coordinate_system", "response_coord"},
           {"source_lat_x", "source_lat_xoff"},
           {"source_lon_y", "source_lon_yoff"},
           {"source_alt_z", "source_alt_zoff"},
           {"destination_lat_x", "destination_lat_xoff"},
           {"destination_lon_y", "destination_lon_yoff"},
           {"destination_alt_z", "destination_alt_zoff"}}}},
        {"los_vector_request",
         {"los_vector_request",
          {{"request_id", "los_id"},
           {"request_type", "type"},
           {"source_coordinate_system", "source_coord"},
           {"response_coordinate_system", "response_coord"},
           {"alpha_threshold", "alpha"},
           {"source_lat_x", "source_lat_xoff"},
           {"source_lon_y", "source_lon_yoff"},
           {"source_alt_z", "source_alt_zoff"}}}},
        {"los_response",
         {"los_response",
          {{"request_id", "los_id"},
           {"response_count", "count"},
           {"host_frame_lsn", "host_frame_number_lsn"}}}},
        {"los_extended_response",
         {"3_2_los_ext_response",
          {{"request_id", "los_id"},
           {"host_frame_lsn", "host_frame_number_lsn"},
           {"lat_x", "lat_xoff"},
           {"lon_y", "lon_yoff"},
           {"alt_z", "alt_zoff"},
           {"normal_azimuth", "normal_vector_azimuth"},
           {"normal_elevation", "normal_vector_elevation"}}}},
        {"env_conditions_request",
         {"env_cond_request",
          {{"request_type", "type"},
           {"request_id", "id"},
           {"latitude", "lat"},
           {"longitude", "lon"},
           {"altitude", "alt"}}}},
        {"position_request", {"pos_request", {{"coordinate_system", "coord_system"}}}},
        {"position_response",
         {"pos_response",
          {{"coordinate_system", "coord_system"},
           {"lat_x", "lat_xoff"},
           {"lon_y", "lon_yoff"},
           {"alt_z", "alt_zoff"}}}},
        {"weather_conditions_response",
         {"wea_cond_response",
          {{"air_temperature", "air_temp"},
           {"visibility", "visibility_range"},
           {"wind_horizontal", "horiz_speed"},
           {"wind_vertical", "vert_speed"},
           {"pressure", "barometric_pressure"}}}},
        {"aerosol_response", {"aerosol_concentration_response", {{"aerosol", "aerosol_concentration"}}}},
        {"ig_message", {"image_generator_message", {{"text", "message"}}}},
    };
    return kNames;
}

/// "cigi.sof.db_number": Wireshark's name of our `field` of `packet`.
std::string foreign_name(const std::string& packet, const std::string& field) {
    if (field == "major_version") return "cigi.version";
    if (field == "byte_swap") return "cigi.byte_swap";
    const auto named = foreign_names().find(packet);
    if (named == foreign_names().end()) return "cigi." + packet + "." + field;
    const auto renamed = named->second.fields.find(field);
    return "cigi." + named->second.prefix + "." +
           (renamed == named->second.fields.end() ? field : renamed->second);
}

/// What one field must be shown as.
struct Expected {
    std::string name;  // ours
    std::string foreign;
    std::variant<double, std::string> value;
};

struct Message {
    std::string packet;
    std::vector<std::byte> bytes;
    std::vector<Expected> fields;
};

/// Words are shown as the bytes that stand on the wire.
std::string hex_of(std::uint32_t word, ByteOrder order) {
    std::array<std::byte, 4> bytes{};
    store(bytes.data(), order, word);
    std::array<char, 9> text{};
    std::snprintf(text.data(), text.size(), "%02x%02x%02x%02x", std::to_integer<unsigned>(bytes[0]),
                  std::to_integer<unsigned>(bytes[1]), std::to_integer<unsigned>(bytes[2]),
                  std::to_integer<unsigned>(bytes[3]));
    return text.data();
}

template <class P>
Message random_message(RandomPackets& random, ByteOrder order) {
    constexpr bool kFirst = std::is_same_v<P, IgControl> || std::is_same_v<P, StartOfFrame>;
    constexpr bool kFromHost = kPacketKind<P> < kHostPacketKinds;
    std::array<std::byte, 256> buffer{};
    MessageWriter writer(buffer, Version::k33, order);
    std::string text;
    P packet = random.next<P>(Version::k33, text);
    if constexpr (kFirst) packet.minor_version = 3;  // smoothing bits are shown for it only
    bool written = true;
    if constexpr (!kFirst && kFromHost) {
        written = writer.add(IgControl{.major_version = 3, .minor_version = 3});
    } else if constexpr (!kFirst) {
        written = writer.add(StartOfFrame{.major_version = 3, .minor_version = 3});
    }
    EXPECT_TRUE(written && writer.add(packet));
    Message message{std::string(Layout<P>::kName), {writer.bytes().begin(), writer.bytes().end()}, {}};
    visit_fields(packet, Version::k33, [&](std::string_view name, const auto& value) {
        Expected expected{std::string(name), foreign_name(message.packet, std::string(name)), 0.0};
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string_view>) {
            expected.value = std::string(value);
        } else if (name.starts_with("data_")) {
            expected.value = hex_of(static_cast<std::uint32_t>(value), order);
        } else if (name == "byte_swap") {
            expected.value = order == ByteOrder::kBig ? 32768.0 : 128.0;  // shown raw, in network order
        } else {
            expected.value = static_cast<double>(value);
        }
        message.fields.push_back(std::move(expected));
    });
    return message;
}

/// What tshark shows of every message: one line each, values of `columns` between tabs.
std::vector<std::string> tshark_lines(const std::vector<Message>& messages,
                                      const std::vector<std::string>& columns) {
    const auto path =
        std::filesystem::temp_directory_path() / ("skyig_cigi_" + std::to_string(::getpid()) + ".pcap");
    std::vector<std::vector<std::byte>> payloads;
    for (const Message& message : messages)
        payloads.push_back(message.bytes);
    const std::vector<std::byte> capture = capture_of(payloads);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(capture.data()), static_cast<std::streamsize>(capture.size()));
    std::string command = "tshark -n -r " + path.string() + " -d udp.port==8005,cigi -T fields";
    for (const std::string& column : columns)
        command += " -e " + column;
    std::istringstream output(output_of(command + " 2>&1"));
    std::filesystem::remove(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(output, line);) {
        // As root tshark warns before its work.
        if (line.find('\t') != std::string::npos) lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> values(1);
    for (const char c : line) {
        if (c == '\t') {
            values.emplace_back();
        } else {
            values.back() += c;
        }
    }
    return values;
}

bool shows(const std::string& shown, const Expected& expected) {
    if (const auto* text = std::get_if<std::string>(&expected.value)) return shown == *text;
    // First of several: the version stands in the first packet only, so nothing else repeats. Floats are
    // shown with six digits.
    const double value = std::get<double>(expected.value);
    if (shown.empty()) return false;
    return std::abs(std::strtod(shown.c_str(), nullptr) - value) <= 5e-6 * std::abs(value);
}

std::vector<Message> random_messages(std::uint64_t seed, int rounds) {
    RandomPackets random(seed);
    std::vector<Message> messages;
    for (int round = 0; round < rounds; ++round) {
        for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
            for_each_packet([&]<class P>() {
                if (shape_of<P>(Version::k33).size > 0) messages.push_back(random_message<P>(random, order));
            });
        }
    }
    return messages;
}

TEST(Tshark, ReadsEveryFieldOfEveryPacketAsWritten) {
    if (output_of("tshark --version 2>/dev/null").empty()) GTEST_SKIP() << "tshark is not installed";
    constexpr int kRounds = 4;
    const std::uint64_t seed = std::random_device{}();
    RecordProperty("seed", std::to_string(seed));
    const std::vector<Message> messages = random_messages(seed, kRounds);
    std::map<std::string, std::size_t> column_of;
    for (const Message& message : messages)
        for (const Expected& field : message.fields)
            column_of.emplace(field.foreign, 0);
    std::vector<std::string> columns;
    for (auto& [name, index] : column_of) {
        index = columns.size();
        columns.push_back(name);
    }
    const std::vector<std::string> lines = tshark_lines(messages, columns);
    ASSERT_EQ(lines.size(), messages.size());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < messages.size(); ++i) {
        const std::vector<std::string> shown = split(lines[i]);
        ASSERT_EQ(shown.size(), columns.size());
        for (const Expected& field : messages[i].fields) {
            EXPECT_TRUE(shows(shown[column_of.at(field.foreign)], field))
                << messages[i].packet << "." << field.name << ": shown as '"
                << shown[column_of.at(field.foreign)] << "', seed " << seed;
            ++compared;
        }
    }
    std::printf("%zu messages, %zu fields compared, seed %llu\n", messages.size(), compared,
                static_cast<unsigned long long>(seed));
    EXPECT_GT(compared, 1'500U);
}

}  // namespace
}  // namespace skyig::protocol::cigi
