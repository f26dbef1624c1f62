// The packets an image generator sends: id and size, place and range of every field, in both versions.
#pragma once

#include <string_view>
#include <tuple>

#include "protocol/cigi/layout.h"
#include "protocol/cigi/packets.h"

namespace skyig::protocol::cigi {

template <>
struct Layout<StartOfFrame> {
    static constexpr std::string_view kName = "start_of_frame";
    static constexpr Shape k33{101, 24};
    static constexpr Shape k40{0xFFFF, 24};
    static constexpr auto kFields = std::make_tuple(
        field("major_version", &StartOfFrame::major_version, at(2), at(4)),
        field("database_number", &StartOfFrame::database_number, at(3), at(5)),
        field("ig_status", &StartOfFrame::ig_status, at(4), kAbsent),
        field("ig_mode", &StartOfFrame::ig_mode, bits(5, 0, 2), bits(7, 0, 2)),
        field("timestamp_valid", &StartOfFrame::timestamp_valid, bits(5, 2, 1), bits(7, 2, 1)),
        field("earth_model", &StartOfFrame::earth_model, bits(5, 3, 1), bits(7, 3, 1)),
        field("minor_version", &StartOfFrame::minor_version, bits(5, 4, 4), bits(7, 4, 4)),
        field("byte_swap", &StartOfFrame::byte_swap, at(6), kAbsent),
        field("ig_frame_number", &StartOfFrame::ig_frame_number, at(8), at(8)),
        field("timestamp", &StartOfFrame::timestamp, at(12), at(12)),
        field("last_host_frame_number", &StartOfFrame::last_host_frame_number, at(16), at(16)),
        field("overframing", &StartOfFrame::overframing, kAbsent, bits(21, 0, 1)),
        field("paging", &StartOfFrame::paging, kAbsent, bits(21, 1, 1)),
        field("excess_variable_data", &StartOfFrame::excess_variable_data, kAbsent, bits(21, 2, 1)));
};

template <>
struct Layout<HatHotResponse> {
    static constexpr std::string_view kName = "hat_hot_response";
    static constexpr Shape k33{102, 16};
    static constexpr Shape k40{0x0FFF, 16};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &HatHotResponse::request_id, at(2), at(6)),
        field("valid", &HatHotResponse::valid, bits(4, 0, 1), bits(4, 0, 1)),
        field("response_type", &HatHotResponse::response_type, bits(4, 1, 1), bits(4, 1, 1)),
        field("host_frame_lsn", &HatHotResponse::host_frame_lsn, bits(4, 4, 4), bits(4, 4, 4)),
        field("height", &HatHotResponse::height, at(8), at(8)).enabled_by<&HatHotResponse::valid>());
};

template <>
struct Layout<HatHotExtendedResponse> {
    static constexpr std::string_view kName = "hat_hot_extended_response";
    static constexpr Shape k33{103, 40};
    static constexpr Shape k40{0x0FFE, 40};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &HatHotExtendedResponse::request_id, at(2), at(6)),
        field("valid", &HatHotExtendedResponse::valid, bits(4, 0, 1), bits(4, 0, 1)),
        field("host_frame_lsn", &HatHotExtendedResponse::host_frame_lsn, bits(4, 4, 4), bits(4, 4, 4)),
        field("hat", &HatHotExtendedResponse::hat, at(8), at(8)).enabled_by<&HatHotExtendedResponse::valid>(),
        field("hot", &HatHotExtendedResponse::hot, at(16), at(16))
            .enabled_by<&HatHotExtendedResponse::valid>(),
        field("material_code", &HatHotExtendedResponse::material_code, at(24), at(24)),
        field("normal_azimuth", &HatHotExtendedResponse::normal_azimuth, at(28), at(28))
            .half_turn()
            .enabled_by<&HatHotExtendedResponse::valid>(),
        field("normal_elevation", &HatHotExtendedResponse::normal_elevation, at(32), at(32))
            .between(-90.0, 90.0)
            .enabled_by<&HatHotExtendedResponse::valid>());
};

template <>
struct Layout<PositionResponse> {
    static constexpr std::string_view kName = "position_response";
    static constexpr Shape k33{108, 48};
    static constexpr Shape k40{0x0FF9, 48};
    static constexpr auto kFields = std::make_tuple(
        field("object_id", &PositionResponse::object_id, at(2), at(6)),
        field("part_id", &PositionResponse::part_id, at(4), at(4)),
        field("object_class", &PositionResponse::object_class, bits(5, 0, 3), bits(5, 0, 3)).up_to(4),
        field("coordinate_system", &PositionResponse::coordinate_system, bits(5, 3, 2), bits(5, 3, 2))
            .up_to(2),
        field("lat_x", &PositionResponse::lat_x, at(8), at(8)),
        field("lon_y", &PositionResponse::lon_y, at(16), at(16)),
        field("alt_z", &PositionResponse::alt_z, at(24), at(24)),
        field("roll", &PositionResponse::roll, at(32), at(32)).half_turn(),
        field("pitch", &PositionResponse::pitch, at(36), at(36)).half_turn(),
        field("yaw", &PositionResponse::yaw, at(40), at(40)).full_turn());
};

template <>
struct Layout<WeatherConditionsResponse> {
    static constexpr std::string_view kName = "weather_conditions_response";
    static constexpr Shape k33{109, 32};
    static constexpr Shape k40{0x0FF8, 32};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &WeatherConditionsResponse::request_id, at(2), at(4)),
        field("humidity", &WeatherConditionsResponse::humidity, at(3), at(5)).percent(),
        field("air_temperature", &WeatherConditionsResponse::air_temperature, at(4), at(8)),
        field("visibility", &WeatherConditionsResponse::visibility, at(8), at(12)).not_negative(),
        field("wind_horizontal", &WeatherConditionsResponse::wind_horizontal, at(12), at(16)).not_negative(),
        field("wind_vertical", &WeatherConditionsResponse::wind_vertical, at(16), at(20)),
        field("wind_direction", &WeatherConditionsResponse::wind_direction, at(20), at(24)).full_turn(),
        field("pressure", &WeatherConditionsResponse::pressure, at(24), at(28)).not_negative());
};

template <>
struct Layout<AerosolResponse> {
    static constexpr std::string_view kName = "aerosol_response";
    static constexpr Shape k33{110, 8};
    static constexpr Shape k40{0x0FF7, 16};
    static constexpr auto kFields =
        std::make_tuple(field("request_id", &AerosolResponse::request_id, at(2), at(4)),
                        field("layer_id", &AerosolResponse::layer_id, at(3), at(5)),
                        field("aerosol", &AerosolResponse::aerosol, at(4), at(8)).not_negative());
};

template <>
struct Layout<MaritimeSurfaceResponse> {
    static constexpr std::string_view kName = "maritime_surface_response";
    static constexpr Shape k33{111, 16};
    static constexpr Shape k40{0x0FF6, 24};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &MaritimeSurfaceResponse::request_id, at(2), at(4)),
        field("sea_surface_height", &MaritimeSurfaceResponse::sea_surface_height, at(4), at(8)),
        field("water_temperature", &MaritimeSurfaceResponse::water_temperature, at(8), at(12)),
        field("clarity", &MaritimeSurfaceResponse::clarity, at(12), at(16)).percent());
};

template <>
struct Layout<TerrestrialSurfaceResponse> {
    static constexpr std::string_view kName = "terrestrial_surface_response";
    static constexpr Shape k33{112, 8};
    static constexpr Shape k40{0x0FF5, 16};
    static constexpr auto kFields =
        std::make_tuple(field("request_id", &TerrestrialSurfaceResponse::request_id, at(2), at(4)),
                        field("condition_id", &TerrestrialSurfaceResponse::condition_id, at(4), at(8)));
};

template <>
struct Layout<EventNotification> {
    static constexpr std::string_view kName = "event_notification";
    static constexpr Shape k33{116, 16};
    static constexpr Shape k40{0x0FF1, 24};
    static constexpr auto kFields =
        std::make_tuple(field("event_id", &EventNotification::event_id, at(2), at(4)),
                        field("data_1", &EventNotification::data_1, at(4), at(8)),
                        field("data_2", &EventNotification::data_2, at(8), at(12)),
                        field("data_3", &EventNotification::data_3, at(12), at(16)));
};

template <>
struct Layout<IgMessage> {
    static constexpr std::string_view kName = "ig_message";
    static constexpr Shape k33{117, 4};
    static constexpr Shape k40{0x0FF0, 8};
    static constexpr auto kFields = std::make_tuple(field("message_id", &IgMessage::message_id, at(2), at(4)),
                                                    field("text", &IgMessage::text, at(4), at(8)));
};

}  // namespace skyig::protocol::cigi
