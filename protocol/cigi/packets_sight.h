// Line of sight: what a host asks and an image generator answers. Units and frames as in packets.h.
#pragma once

#include <cstdint>

namespace skyig::protocol::cigi {

/// Whether something stands between two points. A point is geodetic or, where its coordinate system is set,
/// offsets from an entity.
struct LosSegmentRequest {
    std::uint16_t request_id = 0;
    bool request_type = false;  // true: extended response
    bool source_coordinate_system = false;
    bool destination_coordinate_system = false;
    bool response_coordinate_system = false;
    bool destination_entity_id_valid = false;  // false: the destination's entity is the source's
    std::uint8_t alpha_threshold = 0;
    std::uint8_t update_period = 0;  // frames; 0: once
    std::uint16_t entity_id = 0;
    std::uint16_t destination_entity_id = 0;
    std::uint32_t material_mask = 0;
    double source_lat_x = 0.0;
    double source_lon_y = 0.0;
    double source_alt_z = 0.0;
    double destination_lat_x = 0.0;
    double destination_lon_y = 0.0;
    double destination_alt_z = 0.0;
};

/// What is met first in one direction from a point.
struct LosVectorRequest {
    std::uint16_t request_id = 0;
    bool request_type = false;  // true: extended response
    bool source_coordinate_system = false;
    bool response_coordinate_system = false;
    std::uint8_t alpha_threshold = 0;
    std::uint8_t update_period = 0;  // frames; 0: once
    std::uint16_t entity_id = 0;
    float azimuth = 0.0F;
    float elevation = 0.0F;
    float min_range = 0.0F;
    float max_range = 0.0F;
    std::uint32_t material_mask = 0;
    double source_lat_x = 0.0;
    double source_lon_y = 0.0;
    double source_alt_z = 0.0;
};

struct LosResponse {
    std::uint16_t request_id = 0;
    bool valid = false;
    bool entity_id_valid = false;
    bool visible = false;
    std::uint8_t host_frame_lsn = 0;
    std::uint8_t response_count = 0;  // responses to this request in all
    std::uint16_t entity_id = 0;
    double range = 0.0;
};

struct LosExtendedResponse {
    std::uint16_t request_id = 0;
    bool valid = false;
    bool entity_id_valid = false;
    bool range_valid = false;
    bool visible = false;
    std::uint8_t host_frame_lsn = 0;
    std::uint8_t response_count = 0;
    std::uint16_t entity_id = 0;
    double range = 0.0;
    double lat_x = 0.0;
    double lon_y = 0.0;
    double alt_z = 0.0;
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    std::uint8_t alpha = 0;
    std::uint32_t material_code = 0;
    float normal_azimuth = 0.0F;
    float normal_elevation = 0.0F;
};

}  // namespace skyig::protocol::cigi
