// The packets a host sends: id and size, place and range of every field, in both versions.
#pragma once

#include <string_view>
#include <tuple>

#include "protocol/cigi/layout.h"
#include "protocol/cigi/packets.h"

namespace skyig::protocol::cigi {

template <>
struct Layout<IgControl> {
    static constexpr std::string_view kName = "ig_control";
    static constexpr Shape k33{1, 24};
    static constexpr Shape k40{0x0000, 24};
    static constexpr auto kFields = std::make_tuple(
        field("major_version", &IgControl::major_version, at(2), at(4)),
        field("database_number", &IgControl::database_number, at(3), at(5)).not_negative(),
        field("ig_mode", &IgControl::ig_mode, bits(4, 0, 2), bits(7, 0, 2)).up_to(2),
        field("timestamp_valid", &IgControl::timestamp_valid, bits(4, 2, 1), bits(7, 2, 1)),
        field("extrapolation_enable", &IgControl::extrapolation_enable, bits(4, 3, 1), bits(7, 3, 1)),
        field("minor_version", &IgControl::minor_version, bits(4, 4, 4), bits(7, 4, 4)),
        field("byte_swap", &IgControl::byte_swap, at(6), kAbsent),
        field("host_frame_number", &IgControl::host_frame_number, at(8), at(8)),
        field("timestamp", &IgControl::timestamp, at(12), at(16)),
        field("last_ig_frame_number", &IgControl::last_ig_frame_number, at(16), at(12)),
        field("entity_type_substitution_enable", &IgControl::entity_type_substitution_enable, kAbsent,
              bits(6, 0, 1)));
};

template <>
struct Layout<EntityControl> {
    static constexpr std::string_view kName = "entity_control";
    static constexpr Shape k33{2, 48};
    static constexpr Shape k40{0x0025, 16};
    /// A host that destroys may leave the rest empty.
    static constexpr bool kept(const EntityControl& p) noexcept {
        return p.entity_state != EntityState::kDestroyed;
    }
    static constexpr auto kFields = std::make_tuple(
        field("entity_id", &EntityControl::entity_id, at(2), at(6)),
        field("entity_state", &EntityControl::entity_state, bits(4, 0, 2), bits(4, 0, 2)).up_to(2),
        field("attach_state", &EntityControl::attach_state, bits(4, 2, 1), kAbsent),
        field("collision_detect", &EntityControl::collision_detect, bits(4, 3, 1), bits(4, 2, 1)),
        field("inherit_alpha", &EntityControl::inherit_alpha, bits(4, 4, 1), bits(4, 3, 1)),
        field("ground_clamp", &EntityControl::ground_clamp, bits(4, 5, 2), kAbsent).up_to(2),
        field("animation_direction", &EntityControl::animation_direction, bits(5, 0, 1), kAbsent),
        field("animation_loop", &EntityControl::animation_loop, bits(5, 1, 1), kAbsent),
        field("animation_state", &EntityControl::animation_state, bits(5, 2, 2), kAbsent),
        field("extrapolation_enable", &EntityControl::extrapolation_enable, bits(5, 4, 1), bits(4, 4, 1)),
        field("alpha", &EntityControl::alpha, at(6), at(5)),
        field("entity_type", &EntityControl::entity_type, at(8), kAbsent),
        field("parent_id", &EntityControl::parent_id, at(10), kAbsent),
        field("roll", &EntityControl::roll, at(12), kAbsent).half_turn().when(kept),
        field("pitch", &EntityControl::pitch, at(16), kAbsent).half_turn().when(kept),
        field("yaw", &EntityControl::yaw, at(20), kAbsent).full_turn().when(kept),
        field("lat_x", &EntityControl::lat_x, at(24), kAbsent).when(kept),
        field("lon_y", &EntityControl::lon_y, at(32), kAbsent).when(kept),
        field("alt_z", &EntityControl::alt_z, at(40), kAbsent).when(kept),
        field("extended_entity_type", &EntityControl::extended_entity_type, kAbsent, bits(4, 5, 1)),
        field("entity_kind", &EntityControl::entity_kind, kAbsent, at(8)),
        field("entity_domain", &EntityControl::entity_domain, kAbsent, at(9)),
        field("entity_type_or_country", &EntityControl::entity_type_or_country, kAbsent, at(10)),
        field("entity_category", &EntityControl::entity_category, kAbsent, at(12)),
        field("entity_subcategory", &EntityControl::entity_subcategory, kAbsent, at(13)),
        field("entity_specific", &EntityControl::entity_specific, kAbsent, at(14)),
        field("entity_extra", &EntityControl::entity_extra, kAbsent, at(15)));
};

template <>
struct Layout<EntityPosition> {
    static constexpr std::string_view kName = "entity_position";
    static constexpr Shape k33{};
    static constexpr Shape k40{0x0001, 48};
    static constexpr auto kFields =
        std::make_tuple(field("attach_state", &EntityPosition::attach_state, kAbsent, bits(4, 0, 1)),
                        field("ground_clamp", &EntityPosition::ground_clamp, kAbsent, bits(4, 1, 2)).up_to(2),
                        field("entity_id", &EntityPosition::entity_id, kAbsent, at(6)),
                        field("parent_id", &EntityPosition::parent_id, kAbsent, at(8)),
                        field("roll", &EntityPosition::roll, kAbsent, at(12)).half_turn(),
                        field("pitch", &EntityPosition::pitch, kAbsent, at(16)).half_turn(),
                        field("yaw", &EntityPosition::yaw, kAbsent, at(20)).full_turn(),
                        field("lat_x", &EntityPosition::lat_x, kAbsent, at(24)),
                        field("lon_y", &EntityPosition::lon_y, kAbsent, at(32)),
                        field("alt_z", &EntityPosition::alt_z, kAbsent, at(40)));
};

template <>
struct Layout<ConformalClamped> {
    static constexpr std::string_view kName = "conformal_clamped";
    static constexpr Shape k33{3, 24};
    static constexpr Shape k40{0x0002, 32};
    static constexpr auto kFields =
        std::make_tuple(field("entity_id", &ConformalClamped::entity_id, at(2), at(4)),
                        field("yaw", &ConformalClamped::yaw, at(4), at(8)).full_turn(),
                        field("latitude", &ConformalClamped::latitude, at(8), at(16)).latitude(),
                        field("longitude", &ConformalClamped::longitude, at(16), at(24)).half_turn());
};

template <>
struct Layout<RateControl> {
    static constexpr std::string_view kName = "rate_control";
    static constexpr Shape k33{8, 32};
    static constexpr Shape k40{0x0007, 32};
    static constexpr auto kFields = std::make_tuple(
        field("entity_id", &RateControl::entity_id, at(2), at(4)),
        field("part_id", &RateControl::part_id, at(4), at(6)),
        field("apply_to_part", &RateControl::apply_to_part, bits(5, 0, 1), bits(7, 0, 1)),
        field("coordinate_system", &RateControl::coordinate_system, bits(5, 1, 1), bits(7, 1, 1)),
        field("x_rate", &RateControl::x_rate, at(8), at(8)),
        field("y_rate", &RateControl::y_rate, at(12), at(12)),
        field("z_rate", &RateControl::z_rate, at(16), at(16)),
        field("roll_rate", &RateControl::roll_rate, at(20), at(20)),
        field("pitch_rate", &RateControl::pitch_rate, at(24), at(24)),
        field("yaw_rate", &RateControl::yaw_rate, at(28), at(28)));
};

template <>
struct Layout<AccelerationControl> {
    static constexpr std::string_view kName = "acceleration_control";
    static constexpr Shape k33{};
    static constexpr Shape k40{0x0013, 32};
    static constexpr auto kFields = std::make_tuple(
        field("entity_id", &AccelerationControl::entity_id, kAbsent, at(4)),
        field("part_id", &AccelerationControl::part_id, kAbsent, at(6)),
        field("apply_to_part", &AccelerationControl::apply_to_part, kAbsent, bits(7, 0, 1)),
        field("coordinate_system", &AccelerationControl::coordinate_system, kAbsent, bits(7, 1, 1)),
        field("x_acceleration", &AccelerationControl::x_acceleration, kAbsent, at(8)),
        field("y_acceleration", &AccelerationControl::y_acceleration, kAbsent, at(12)),
        field("z_acceleration", &AccelerationControl::z_acceleration, kAbsent, at(16)),
        field("roll_acceleration", &AccelerationControl::roll_acceleration, kAbsent, at(20)),
        field("pitch_acceleration", &AccelerationControl::pitch_acceleration, kAbsent, at(24)),
        field("yaw_acceleration", &AccelerationControl::yaw_acceleration, kAbsent, at(28)));
};

template <>
struct Layout<ComponentControl> {
    static constexpr std::string_view kName = "component_control";
    static constexpr Shape k33{4, 32};
    static constexpr Shape k40{0x0003, 40};
    static constexpr auto kFields = std::make_tuple(
        field("component_id", &ComponentControl::component_id, at(2), at(4)),
        field("instance_id", &ComponentControl::instance_id, at(4), at(8)),
        field("component_class", &ComponentControl::component_class, bits(6, 0, 6), bits(6, 0, 6)).up_to(15),
        field("component_state", &ComponentControl::component_state, at(7), at(7)),
        field("data_1", &ComponentControl::data_1, at(8), at(16)),
        field("data_2", &ComponentControl::data_2, at(12), at(20)),
        field("data_3", &ComponentControl::data_3, at(16), at(24)),
        field("data_4", &ComponentControl::data_4, at(20), at(28)),
        field("data_5", &ComponentControl::data_5, at(24), at(32)),
        field("data_6", &ComponentControl::data_6, at(28), at(36)));
};

template <>
struct Layout<ShortComponentControl> {
    static constexpr std::string_view kName = "short_component_control";
    static constexpr Shape k33{5, 16};
    static constexpr Shape k40{0x0004, 24};
    static constexpr auto kFields = std::make_tuple(
        field("component_id", &ShortComponentControl::component_id, at(2), at(4)),
        field("instance_id", &ShortComponentControl::instance_id, at(4), at(8)),
        field("component_class", &ShortComponentControl::component_class, bits(6, 0, 6), bits(6, 0, 6))
            .up_to(15),
        field("component_state", &ShortComponentControl::component_state, at(7), at(7)),
        field("data_1", &ShortComponentControl::data_1, at(8), at(16)),
        field("data_2", &ShortComponentControl::data_2, at(12), at(20)));
};

template <>
struct Layout<CelestialSphereControl> {
    static constexpr std::string_view kName = "celestial_sphere_control";
    static constexpr Shape k33{9, 16};
    static constexpr Shape k40{0x0008, 24};
    static constexpr auto kFields = std::make_tuple(
        field("hour", &CelestialSphereControl::hour, at(2), at(6))
            .up_to(23)
            .enabled_by<&CelestialSphereControl::date_time_valid>(),
        field("minute", &CelestialSphereControl::minute, at(3), at(7))
            .up_to(59)
            .enabled_by<&CelestialSphereControl::date_time_valid>(),
        field("ephemeris_enable", &CelestialSphereControl::ephemeris_enable, bits(4, 0, 1), bits(4, 0, 1)),
        field("sun_enable", &CelestialSphereControl::sun_enable, bits(4, 1, 1), bits(4, 1, 1)),
        field("moon_enable", &CelestialSphereControl::moon_enable, bits(4, 2, 1), bits(4, 2, 1)),
        field("star_enable", &CelestialSphereControl::star_enable, bits(4, 3, 1), bits(4, 3, 1)),
        field("date_time_valid", &CelestialSphereControl::date_time_valid, bits(4, 4, 1), bits(4, 4, 1)),
        field("date", &CelestialSphereControl::date, at(8), at(12))
            .enabled_by<&CelestialSphereControl::date_time_valid>(),
        field("star_intensity", &CelestialSphereControl::star_intensity, at(12), at(16)).percent(),
        field("seconds", &CelestialSphereControl::seconds, kAbsent, at(8))
            .below(60.0)
            .enabled_by<&CelestialSphereControl::date_time_valid>());
};

template <>
struct Layout<AtmosphereControl> {
    static constexpr std::string_view kName = "atmosphere_control";
    static constexpr Shape k33{10, 32};
    static constexpr Shape k40{0x0009, 32};
    static constexpr auto kFields = std::make_tuple(
        field("model_enable", &AtmosphereControl::model_enable, bits(2, 0, 1), bits(4, 7, 1)),
        field("humidity", &AtmosphereControl::humidity, at(3), bits(4, 0, 7)).percent(),
        field("air_temperature", &AtmosphereControl::air_temperature, at(4), at(8)),
        field("visibility", &AtmosphereControl::visibility, at(8), at(12)).not_negative(),
        field("wind_horizontal", &AtmosphereControl::wind_horizontal, at(12), at(16)).not_negative(),
        field("wind_vertical", &AtmosphereControl::wind_vertical, at(16), at(20)),
        field("wind_direction", &AtmosphereControl::wind_direction, at(20), at(24)).full_turn(),
        field("pressure", &AtmosphereControl::pressure, at(24), at(28)).not_negative());
};

template <>
struct Layout<EnvRegionControl> {
    static constexpr std::string_view kName = "env_region_control";
    static constexpr Shape k33{11, 48};
    static constexpr Shape k40{0x000A, 48};
    /// A host that destroys may leave the rest empty.
    static constexpr bool kept(const EnvRegionControl& p) noexcept {
        return p.region_state != RegionState::kDestroyed;
    }
    static constexpr auto kFields = std::make_tuple(
        field("region_id", &EnvRegionControl::region_id, at(2), at(6)),
        field("region_state", &EnvRegionControl::region_state, bits(4, 0, 2), bits(4, 0, 2)).up_to(2),
        field("merge_weather", &EnvRegionControl::merge_weather, bits(4, 2, 1), bits(4, 2, 1)),
        field("merge_aerosol", &EnvRegionControl::merge_aerosol, bits(4, 3, 1), bits(4, 3, 1)),
        field("merge_maritime", &EnvRegionControl::merge_maritime, bits(4, 4, 1), bits(4, 4, 1)),
        field("merge_terrestrial", &EnvRegionControl::merge_terrestrial, bits(4, 5, 1), bits(4, 5, 1)),
        field("latitude", &EnvRegionControl::latitude, at(8), at(8)).latitude().when(kept),
        field("longitude", &EnvRegionControl::longitude, at(16), at(16)).half_turn().when(kept),
        field("size_x", &EnvRegionControl::size_x, at(24), at(24)).positive().when(kept),
        field("size_y", &EnvRegionControl::size_y, at(28), at(28)).positive().when(kept),
        field("corner_radius", &EnvRegionControl::corner_radius, at(32), at(32)).not_negative().when(kept),
        field("rotation", &EnvRegionControl::rotation, at(36), at(36)).half_turn().when(kept),
        field("transition_perimeter", &EnvRegionControl::transition_perimeter, at(40), at(40))
            .not_negative()
            .when(kept));
};

template <>
struct Layout<WeatherControl> {
    static constexpr std::string_view kName = "weather_control";
    static constexpr Shape k33{12, 56};
    static constexpr Shape k40{0x000B, 72};
    /// Weather of an entity has no base and no thickness.
    static constexpr bool is_layer(const WeatherControl& p) noexcept {
        return p.scope != WeatherScope::kEntity;
    }
    static constexpr auto kFields = std::make_tuple(
        field("entity_region_id", &WeatherControl::entity_region_id, at(2), at(8)),
        field("layer_id", &WeatherControl::layer_id, at(4), at(4)),
        field("humidity", &WeatherControl::humidity, at(5), at(5)).percent(),
        field("weather_enable", &WeatherControl::weather_enable, bits(6, 0, 1), bits(6, 0, 1)),
        field("scud_enable", &WeatherControl::scud_enable, bits(6, 1, 1), bits(6, 1, 1)),
        field("random_winds", &WeatherControl::random_winds, bits(6, 2, 1), bits(6, 2, 1)),
        field("random_lightning", &WeatherControl::random_lightning, bits(6, 3, 1), bits(6, 3, 1)),
        field("cloud_type", &WeatherControl::cloud_type, bits(6, 4, 4), bits(6, 4, 4)),
        field("scope", &WeatherControl::scope, bits(7, 0, 2), bits(7, 0, 2)).up_to(2),
        field("severity", &WeatherControl::severity, bits(7, 2, 3), bits(7, 2, 3)).up_to(5),
        field("air_temperature", &WeatherControl::air_temperature, at(8), at(12)),
        field("visibility", &WeatherControl::visibility, at(12), at(16)).not_negative(),
        field("scud_frequency", &WeatherControl::scud_frequency, at(16), at(20))
            .percent()
            .enabled_by<&WeatherControl::scud_enable>(),
        field("coverage", &WeatherControl::coverage, at(20), at(24)).percent(),
        field("base_elevation", &WeatherControl::base_elevation, at(24), at(28)).when(is_layer),
        field("thickness", &WeatherControl::thickness, at(28), at(32)).not_negative().when(is_layer),
        field("transition_band", &WeatherControl::transition_band, at(32), at(36)).not_negative(),
        field("wind_horizontal", &WeatherControl::wind_horizontal, at(36), at(40)).not_negative(),
        field("wind_vertical", &WeatherControl::wind_vertical, at(40), at(44)),
        field("wind_direction", &WeatherControl::wind_direction, at(44), at(48)).full_turn(),
        field("pressure", &WeatherControl::pressure, at(48), at(52)).not_negative(),
        field("aerosol", &WeatherControl::aerosol, at(52), at(56)).not_negative(),
        field("top_scud_enable", &WeatherControl::top_scud_enable, kAbsent, bits(7, 5, 1)),
        field("top_scud_frequency", &WeatherControl::top_scud_frequency, kAbsent, at(60))
            .percent()
            .enabled_by<&WeatherControl::top_scud_enable>(),
        field("top_transition_band", &WeatherControl::top_transition_band, kAbsent, at(64)).not_negative());
};

template <>
struct Layout<MaritimeSurfaceControl> {
    static constexpr std::string_view kName = "maritime_surface_control";
    static constexpr Shape k33{13, 24};
    static constexpr Shape k40{0x000C, 24};
    /// One sender of 4.0 puts entity_region_id at byte 5. That cannot be told from a reserved byte left
    /// dirty, so it is not mended.
    static constexpr auto kFields = std::make_tuple(
        field("entity_region_id", &MaritimeSurfaceControl::entity_region_id, at(2), at(6)),
        field("enable", &MaritimeSurfaceControl::enable, bits(4, 0, 1), bits(4, 0, 1)),
        field("whitecap_enable", &MaritimeSurfaceControl::whitecap_enable, bits(4, 1, 1), bits(4, 1, 1)),
        field("scope", &MaritimeSurfaceControl::scope, bits(4, 2, 2), bits(4, 2, 2)).up_to(2),
        field("sea_surface_height", &MaritimeSurfaceControl::sea_surface_height, at(8), at(8)),
        field("water_temperature", &MaritimeSurfaceControl::water_temperature, at(12), at(12)),
        field("clarity", &MaritimeSurfaceControl::clarity, at(16), at(16)).percent());
};

template <>
struct Layout<WaveControl> {
    static constexpr std::string_view kName = "wave_control";
    static constexpr Shape k33{14, 32};
    static constexpr Shape k40{0x000D, 32};
    static constexpr auto kFields = std::make_tuple(
        field("entity_region_id", &WaveControl::entity_region_id, at(2), at(6)),
        field("wave_id", &WaveControl::wave_id, at(4), at(4)),
        field("wave_enable", &WaveControl::wave_enable, bits(5, 0, 1), bits(5, 0, 1)),
        field("scope", &WaveControl::scope, bits(5, 1, 2), bits(5, 1, 2)).up_to(2),
        field("breaker_type", &WaveControl::breaker_type, bits(5, 3, 2), bits(5, 3, 2)).up_to(2),
        field("height", &WaveControl::height, at(8), at(8)).not_negative(),
        field("wavelength", &WaveControl::wavelength, at(12), at(12)).not_negative(),
        field("period", &WaveControl::period, at(16), at(16)).not_negative(),
        field("direction", &WaveControl::direction, at(20), at(20)).full_turn(),
        field("phase_offset", &WaveControl::phase_offset, at(24), at(24)).two_turns(),
        field("leading", &WaveControl::leading, at(28), at(28)).half_turn());
};

template <>
struct Layout<TerrestrialSurfaceControl> {
    static constexpr std::string_view kName = "terrestrial_surface_control";
    static constexpr Shape k33{15, 8};
    static constexpr Shape k40{0x000E, 16};
    static constexpr auto kFields = std::make_tuple(
        field("entity_region_id", &TerrestrialSurfaceControl::entity_region_id, at(2), at(4)),
        field("condition_id", &TerrestrialSurfaceControl::condition_id, at(4), at(8)),
        field("enable", &TerrestrialSurfaceControl::enable, bits(6, 0, 1), bits(6, 0, 1)),
        field("scope", &TerrestrialSurfaceControl::scope, bits(6, 1, 2), bits(6, 1, 2)).up_to(2),
        field("severity", &TerrestrialSurfaceControl::severity, bits(6, 3, 5), bits(6, 3, 5)),
        field("coverage", &TerrestrialSurfaceControl::coverage, at(7), at(7)).percent());
};

template <>
struct Layout<ViewControl> {
    static constexpr std::string_view kName = "view_control";
    static constexpr Shape k33{16, 32};
    static constexpr Shape k40{0x000F, 40};
    static constexpr auto kFields = std::make_tuple(
        field("view_id", &ViewControl::view_id, at(2), at(6)),
        field("group_id", &ViewControl::group_id, at(4), at(4)),
        field("x_enable", &ViewControl::x_enable, bits(5, 0, 1), bits(5, 0, 1)),
        field("y_enable", &ViewControl::y_enable, bits(5, 1, 1), bits(5, 1, 1)),
        field("z_enable", &ViewControl::z_enable, bits(5, 2, 1), bits(5, 2, 1)),
        field("roll_enable", &ViewControl::roll_enable, bits(5, 3, 1), bits(5, 3, 1)),
        field("pitch_enable", &ViewControl::pitch_enable, bits(5, 4, 1), bits(5, 4, 1)),
        field("yaw_enable", &ViewControl::yaw_enable, bits(5, 5, 1), bits(5, 5, 1)),
        field("entity_id", &ViewControl::entity_id, at(6), at(8)),
        field("x_offset", &ViewControl::x_offset, at(8), at(12)).enabled_by<&ViewControl::x_enable>(),
        field("y_offset", &ViewControl::y_offset, at(12), at(16)).enabled_by<&ViewControl::y_enable>(),
        field("z_offset", &ViewControl::z_offset, at(16), at(20)).enabled_by<&ViewControl::z_enable>(),
        field("roll", &ViewControl::roll, at(20), at(24)).half_turn().enabled_by<&ViewControl::roll_enable>(),
        field("pitch", &ViewControl::pitch, at(24), at(28))
            .half_turn()
            .enabled_by<&ViewControl::pitch_enable>(),
        field("yaw", &ViewControl::yaw, at(28), at(32)).full_turn().enabled_by<&ViewControl::yaw_enable>());
};

template <>
struct Layout<ViewDefinition> {
    static constexpr std::string_view kName = "view_definition";
    static constexpr Shape k33{21, 32};
    static constexpr Shape k40{0x0014, 40};
    static constexpr auto kFields = std::make_tuple(
        field("view_id", &ViewDefinition::view_id, at(2), at(4)),
        field("group_id", &ViewDefinition::group_id, at(4), at(6)),
        field("near_enable", &ViewDefinition::near_enable, bits(5, 0, 1), bits(7, 0, 1)),
        field("far_enable", &ViewDefinition::far_enable, bits(5, 1, 1), bits(7, 1, 1)),
        field("left_enable", &ViewDefinition::left_enable, bits(5, 2, 1), bits(7, 2, 1)),
        field("right_enable", &ViewDefinition::right_enable, bits(5, 3, 1), bits(7, 3, 1)),
        field("top_enable", &ViewDefinition::top_enable, bits(5, 4, 1), bits(7, 4, 1)),
        field("bottom_enable", &ViewDefinition::bottom_enable, bits(5, 5, 1), bits(7, 5, 1)),
        field("mirror_mode", &ViewDefinition::mirror_mode, bits(5, 6, 2), bits(7, 6, 2)),
        field("pixel_replication", &ViewDefinition::pixel_replication, bits(6, 0, 3), bits(8, 0, 3)),
        field("projection_type", &ViewDefinition::projection_type, bits(6, 3, 1), bits(8, 3, 1)),
        field("reorder", &ViewDefinition::reorder, bits(6, 4, 1), bits(8, 4, 1)),
        field("view_type", &ViewDefinition::view_type, bits(6, 5, 3), bits(8, 5, 3)),
        field("near", &ViewDefinition::near, at(8), at(12))
            .positive()
            .enabled_by<&ViewDefinition::near_enable>(),
        field("far", &ViewDefinition::far, at(12), at(16))
            .positive()
            .enabled_by<&ViewDefinition::far_enable>(),
        field("left", &ViewDefinition::left, at(16), at(20))
            .between(-90.0, 90.0)
            .enabled_by<&ViewDefinition::left_enable>(),
        field("right", &ViewDefinition::right, at(20), at(24))
            .between(-90.0, 90.0)
            .enabled_by<&ViewDefinition::right_enable>(),
        field("top", &ViewDefinition::top, at(24), at(28))
            .between(-90.0, 90.0)
            .enabled_by<&ViewDefinition::top_enable>(),
        field("bottom", &ViewDefinition::bottom, at(28), at(32))
            .between(-90.0, 90.0)
            .enabled_by<&ViewDefinition::bottom_enable>());
};

template <>
struct Layout<EarthModelDefinition> {
    static constexpr std::string_view kName = "earth_model_definition";
    static constexpr Shape k33{19, 24};
    static constexpr Shape k40{0x0012, 24};
    static constexpr auto kFields = std::make_tuple(
        field("custom_enable", &EarthModelDefinition::custom_enable, bits(2, 0, 1), bits(4, 0, 1)),
        field("equatorial_radius", &EarthModelDefinition::equatorial_radius, at(8), at(8))
            .positive()
            .enabled_by<&EarthModelDefinition::custom_enable>(),
        field("flattening", &EarthModelDefinition::flattening, at(16), at(16))
            .below(1.0)
            .enabled_by<&EarthModelDefinition::custom_enable>());
};

template <>
struct Layout<HatHotRequest> {
    static constexpr std::string_view kName = "hat_hot_request";
    static constexpr Shape k33{24, 32};
    static constexpr Shape k40{0x0017, 40};
    static constexpr auto kFields = std::make_tuple(
        field("request_id", &HatHotRequest::request_id, at(2), at(4)),
        field("request_type", &HatHotRequest::request_type, bits(4, 0, 2), bits(8, 0, 2)).up_to(2),
        field("coordinate_system", &HatHotRequest::coordinate_system, bits(4, 2, 1), bits(8, 2, 1)),
        field("update_period", &HatHotRequest::update_period, at(5), at(9)),
        field("entity_id", &HatHotRequest::entity_id, at(6), at(6)),
        field("lat_x", &HatHotRequest::lat_x, at(8), at(16)),
        field("lon_y", &HatHotRequest::lon_y, at(16), at(24)),
        field("alt_z", &HatHotRequest::alt_z, at(24), at(32)));
};

template <>
struct Layout<EnvConditionsRequest> {
    static constexpr std::string_view kName = "env_conditions_request";
    static constexpr Shape k33{28, 32};
    static constexpr Shape k40{0x001B, 32};
    /// The altitude counts for weather (4) and aerosol (8) only.
    static constexpr bool has_height(const EnvConditionsRequest& p) noexcept {
        return (p.request_type & 12U) != 0;
    }
    static constexpr auto kFields = std::make_tuple(
        field("request_type", &EnvConditionsRequest::request_type, bits(2, 0, 4), bits(4, 0, 4))
            .between(1, 15),
        field("request_id", &EnvConditionsRequest::request_id, at(3), at(5)),
        field("latitude", &EnvConditionsRequest::latitude, at(8), at(8)).latitude(),
        field("longitude", &EnvConditionsRequest::longitude, at(16), at(16)).half_turn(),
        field("altitude", &EnvConditionsRequest::altitude, at(24), at(24)).when(has_height));
};

template <>
struct Layout<PositionRequest> {
    static constexpr std::string_view kName = "position_request";
    static constexpr Shape k33{27, 8};
    static constexpr Shape k40{0x001A, 8};
    static constexpr auto kFields = std::make_tuple(
        field("object_id", &PositionRequest::object_id, at(2), at(6)),
        field("part_id", &PositionRequest::part_id, at(4), at(4)),
        field("update_mode", &PositionRequest::update_mode, bits(5, 0, 1), bits(5, 0, 1)),
        field("object_class", &PositionRequest::object_class, bits(5, 1, 3), bits(5, 1, 3)).up_to(4),
        field("coordinate_system", &PositionRequest::coordinate_system, bits(5, 4, 2), bits(5, 4, 2))
            .up_to(2));
};

}  // namespace skyig::protocol::cigi
