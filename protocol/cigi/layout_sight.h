// Line of sight, asked and answered: id and size, place and range of every field, in both versions.
#pragma once

#include <string_view>
#include <tuple>

#include "protocol/cigi/layout.h"
#include "protocol/cigi/packets_sight.h"

namespace skyig::protocol::cigi {

template <>
struct Layout<LosSegmentRequest> {
    using P = LosSegmentRequest;
    static constexpr std::string_view kName = "los_segment_request";
    static constexpr Shape k33{25, 64};
    static constexpr Shape k40{0x0018, 72};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &P::request_id, at(2), at(4)),
        field("request_type", &P::request_type, bits(4, 0, 1), bits(8, 0, 1)),
        field("source_coordinate_system", &P::source_coordinate_system, bits(4, 1, 1), bits(8, 1, 1)),
        field("destination_coordinate_system", &P::destination_coordinate_system, bits(4, 2, 1),
              bits(8, 2, 1)),
        field("response_coordinate_system", &P::response_coordinate_system, bits(4, 3, 1), bits(8, 3, 1)),
        field("destination_entity_id_valid", &P::destination_entity_id_valid, bits(4, 4, 1), bits(8, 4, 1)),
        field("alpha_threshold", &P::alpha_threshold, at(5), at(9)),
        field("update_period", &P::update_period, at(60), at(12)),
        field("entity_id", &P::entity_id, at(6), at(6)),
        field("destination_entity_id", &P::destination_entity_id, at(62), at(10)),
        field("material_mask", &P::material_mask, at(56), at(64)),
        field("source_lat_x", &P::source_lat_x, at(8), at(16)),
        field("source_lon_y", &P::source_lon_y, at(16), at(24)),
        field("source_alt_z", &P::source_alt_z, at(24), at(32)),
        field("destination_lat_x", &P::destination_lat_x, at(32), at(40)),
        field("destination_lon_y", &P::destination_lon_y, at(40), at(48)),
        field("destination_alt_z", &P::destination_alt_z, at(48), at(56)));
};

template <>
struct Layout<LosVectorRequest> {
    using P = LosVectorRequest;
    static constexpr std::string_view kName = "los_vector_request";
    static constexpr Shape k33{26, 56};
    static constexpr Shape k40{0x0019, 64};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &P::request_id, at(2), at(4)),
        field("request_type", &P::request_type, bits(4, 0, 1), bits(8, 0, 1)),
        field("source_coordinate_system", &P::source_coordinate_system, bits(4, 1, 1), bits(8, 1, 1)),
        field("response_coordinate_system", &P::response_coordinate_system, bits(4, 2, 1), bits(8, 2, 1)),
        field("alpha_threshold", &P::alpha_threshold, at(5), at(9)),
        field("update_period", &P::update_period, at(52), at(10)),
        field("entity_id", &P::entity_id, at(6), at(6)),
        field("azimuth", &P::azimuth, at(8), at(16)).half_turn(),
        field("elevation", &P::elevation, at(12), at(20)).between(-90.0, 90.0),
        field("min_range", &P::min_range, at(16), at(24)).not_negative(),
        field("max_range", &P::max_range, at(20), at(28)).not_negative(),
        field("material_mask", &P::material_mask, at(48), at(56)),
        field("source_lat_x", &P::source_lat_x, at(24), at(32)),
        field("source_lon_y", &P::source_lon_y, at(32), at(40)),
        field("source_alt_z", &P::source_alt_z, at(40), at(48)));
};

template <>
struct Layout<LosResponse> {
    using P = LosResponse;
    static constexpr std::string_view kName = "los_response";
    static constexpr Shape k33{104, 16};
    static constexpr Shape k40{0x0FFD, 24};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &P::request_id, at(2), at(4)),
        field("valid", &P::valid, bits(4, 0, 1), bits(8, 0, 1)),
        field("entity_id_valid", &P::entity_id_valid, bits(4, 1, 1), bits(8, 1, 1)),
        field("visible", &P::visible, bits(4, 2, 1), bits(8, 2, 1)),
        field("host_frame_lsn", &P::host_frame_lsn, bits(4, 4, 4), bits(8, 4, 4)),
        field("response_count", &P::response_count, at(5), at(9)),
        field("entity_id", &P::entity_id, at(6), at(6)), field("range", &P::range, at(8), at(16)));
};

template <>
struct Layout<LosExtendedResponse> {
    using P = LosExtendedResponse;
    static constexpr std::string_view kName = "los_extended_response";
    static constexpr Shape k33{105, 56};
    static constexpr Shape k40{0x0FFC, 64};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &P::request_id, at(2), at(4)),
        field("valid", &P::valid, bits(4, 0, 1), bits(8, 0, 1)),
        field("entity_id_valid", &P::entity_id_valid, bits(4, 1, 1), bits(8, 1, 1)),
        field("range_valid", &P::range_valid, bits(4, 2, 1), bits(8, 2, 1)),
        field("visible", &P::visible, bits(4, 3, 1), bits(8, 3, 1)),
        field("host_frame_lsn", &P::host_frame_lsn, bits(4, 4, 4), bits(8, 4, 4)),
        field("response_count", &P::response_count, at(5), at(9)),
        field("entity_id", &P::entity_id, at(6), at(6)), field("range", &P::range, at(8), at(16)),
        field("lat_x", &P::lat_x, at(16), at(24)), field("lon_y", &P::lon_y, at(24), at(32)),
        field("alt_z", &P::alt_z, at(32), at(40)), field("red", &P::red, at(40), at(48)),
        field("green", &P::green, at(41), at(49)), field("blue", &P::blue, at(42), at(50)),
        field("alpha", &P::alpha, at(43), at(51)), field("material_code", &P::material_code, at(44), at(52)),
        field("normal_azimuth", &P::normal_azimuth, at(48), at(56)),
        field("normal_elevation", &P::normal_elevation, at(52), at(60)));
};

}  // namespace skyig::protocol::cigi
