#include "protocol/cigi/catalogue.h"

#include <algorithm>
#include <array>

namespace skyig::protocol::cigi {
namespace {

constexpr std::uint16_t kFirstUser33 = 201;
constexpr std::uint16_t kLastUser33 = 255;
constexpr std::uint16_t kFirstUser40 = 0x1000;
constexpr std::uint16_t kLastUser40 = 0xFFFE;

constexpr auto kListed = std::to_array<ListedPacket>({
    {"ig_control", Sender::kHost, {1, 24}, {0x0000, 24}},
    {"entity_control", Sender::kHost, {2, 48}, {0x0025, 16}},
    {"entity_position", Sender::kHost, {}, {0x0001, 48}},
    {"conformal_clamped", Sender::kHost, {3, 24}, {0x0002, 32}},
    {"component_control", Sender::kHost, {4, 32}, {0x0003, 40}},
    {"short_component_control", Sender::kHost, {5, 16}, {0x0004, 24}},
    {"articulated_part_control", Sender::kHost, {6, 32}, {0x0005, 32}},
    {"short_articulated_part_control", Sender::kHost, {7, 16}, {0x0006, 24}},
    {"rate_control", Sender::kHost, {8, 32}, {0x0007, 32}},
    {"celestial_sphere_control", Sender::kHost, {9, 16}, {0x0008, 24}},
    {"atmosphere_control", Sender::kHost, {10, 32}, {0x0009, 32}},
    {"env_region_control", Sender::kHost, {11, 48}, {0x000A, 48}},
    {"weather_control", Sender::kHost, {12, 56}, {0x000B, 72}},
    {"maritime_surface_control", Sender::kHost, {13, 24}, {0x000C, 24}},
    {"wave_control", Sender::kHost, {14, 32}, {0x000D, 32}},
    {"terrestrial_surface_control", Sender::kHost, {15, 8}, {0x000E, 16}},
    {"view_control", Sender::kHost, {16, 32}, {0x000F, 40}},
    {"sensor_control", Sender::kHost, {17, 24}, {0x0010, 32}},
    {"motion_tracker_control", Sender::kHost, {18, 8}, {0x0011, 16}},
    {"earth_model_definition", Sender::kHost, {19, 24}, {0x0012, 24}},
    {"trajectory_definition", Sender::kHost, {20, 24}, {}},
    {"acceleration_control", Sender::kHost, {}, {0x0013, 32}},
    {"view_definition", Sender::kHost, {21, 32}, {0x0014, 40}},
    {"collision_segment_definition", Sender::kHost, {22, 40}, {0x0015, 40}},
    {"collision_volume_definition", Sender::kHost, {23, 48}, {0x0016, 48}},
    {"hat_hot_request", Sender::kHost, {24, 32}, {0x0017, 40}},
    {"los_segment_request", Sender::kHost, {25, 64}, {0x0018, 72}},
    {"los_vector_request", Sender::kHost, {26, 56}, {0x0019, 64}},
    {"position_request", Sender::kHost, {27, 8}, {0x001A, 8}},
    {"env_conditions_request", Sender::kHost, {28, 32}, {0x001B, 32}},
    {"symbol_surface_definition", Sender::kHost, {29, 56}, {0x001C, 64}},
    {"symbol_text_definition", Sender::kHost, {30, 12, true}, {0x001D, 12, true}},
    {"symbol_circle_definition", Sender::kHost, {31, 16, true}, {0x001E, 24, true}},
    {"symbol_line_definition", Sender::kHost, {32, 16, true}, {}},
    {"symbol_polygon_definition", Sender::kHost, {}, {0x001F, 24, true}},
    {"symbol_clone", Sender::kHost, {33, 8}, {0x0020, 16}},
    {"symbol_control", Sender::kHost, {34, 40}, {0x0021, 48}},
    {"short_symbol_control", Sender::kHost, {35, 16}, {0x0022, 24}},
    {"symbol_textured_circle_definition", Sender::kHost, {}, {0x0023, 16, true}},
    {"symbol_textured_polygon_definition", Sender::kHost, {}, {0x0024, 16, true}},
    {"animation_control", Sender::kHost, {}, {0x0026, 16}},
    {"start_of_frame", Sender::kImageGenerator, {101, 24}, {0xFFFF, 24}},
    {"hat_hot_response", Sender::kImageGenerator, {102, 16}, {0x0FFF, 16}},
    {"hat_hot_extended_response", Sender::kImageGenerator, {103, 40}, {0x0FFE, 40}},
    {"los_response", Sender::kImageGenerator, {104, 16}, {0x0FFD, 24}},
    {"los_extended_response", Sender::kImageGenerator, {105, 56}, {0x0FFC, 64}},
    {"sensor_response", Sender::kImageGenerator, {106, 24}, {0x0FFB, 24}},
    {"sensor_extended_response", Sender::kImageGenerator, {107, 48}, {0x0FFA, 56}},
    {"position_response", Sender::kImageGenerator, {108, 48}, {0x0FF9, 48}},
    {"weather_conditions_response", Sender::kImageGenerator, {109, 32}, {0x0FF8, 32}},
    {"aerosol_response", Sender::kImageGenerator, {110, 8}, {0x0FF7, 16}},
    {"maritime_surface_response", Sender::kImageGenerator, {111, 16}, {0x0FF6, 24}},
    {"terrestrial_surface_response", Sender::kImageGenerator, {112, 8}, {0x0FF5, 16}},
    {"collision_segment_notification", Sender::kImageGenerator, {113, 16}, {0x0FF4, 24}},
    {"collision_volume_notification", Sender::kImageGenerator, {114, 16}, {0x0FF3, 16}},
    {"animation_stop_notification", Sender::kImageGenerator, {115, 8}, {0x0FF2, 8}},
    {"event_notification", Sender::kImageGenerator, {116, 16}, {0x0FF1, 24}},
    {"ig_message", Sender::kImageGenerator, {117, 4, true}, {0x0FF0, 8, true}},
});

}  // namespace

std::span<const ListedPacket> listed_packets() noexcept {
    return kListed;
}

std::string_view listed_packet_name(Version version, std::uint16_t id) noexcept {
    const auto found = std::find_if(kListed.begin(), kListed.end(), [version, id](const ListedPacket& each) {
        return each.shape(version).size > 0 && each.shape(version).id == id;
    });
    if (found != kListed.end()) return found->name;
    const bool user = version == Version::k33 ? id >= kFirstUser33 && id <= kLastUser33
                                              : id >= kFirstUser40 && id <= kLastUser40;
    return user ? "user_defined" : "unassigned";
}

}  // namespace skyig::protocol::cigi
