// The packets of CIGI 3.3 and 4.0 as plain structs, one for both versions: a field that a version lacks keeps
// its default when read and is left out when written (marked [3.3] or [4.0] below).
//
// Units are the wire's: degrees, metres, seconds, m/s, degC, hPa, percent, g/m3. Geodetic positions are WGS
// 84, latitude north +, longitude east +. Angles: yaw clockwise from true north, pitch nose up +, roll right
// wing down +; offsets along body axes X forward, Y right, Z down. Wind direction is where it blows FROM.
// Field names are those of the interface tables, so they carry no unit suffix.
#pragma once

#include <cstdint>
#include <string_view>

namespace skyig::protocol::cigi {

inline constexpr std::uint16_t kByteSwapMagic = 0x8000;

enum class IgMode : std::uint8_t { kStandby = 0, kOperate = 1, kDebug = 2, kOfflineMaintenance = 3 };
enum class EntityState : std::uint8_t { kInactive = 0, kActive = 1, kDestroyed = 2 };
enum class GroundClamp : std::uint8_t { kNone = 0, kNonConformal = 1, kConformal = 2 };
enum class RegionState : std::uint8_t { kInactive = 0, kActive = 1, kDestroyed = 2 };
enum class WeatherScope : std::uint8_t { kGlobal = 0, kRegional = 1, kEntity = 2 };
enum class BreakerType : std::uint8_t { kPlunging = 0, kSpilling = 1, kSurging = 2 };
enum class HatHotType : std::uint8_t { kHat = 0, kHot = 1, kExtended = 2 };

/// 11..15 are the image generator's own.
enum class CloudType : std::uint8_t {
    kNone = 0,
    kAltocumulus = 1,
    kAltostratus = 2,
    kCirrocumulus = 3,
    kCirrostratus = 4,
    kCirrus = 5,
    kCumulonimbus = 6,
    kCumulus = 7,
    kNimbostratus = 8,
    kStratocumulus = 9,
    kStratus = 10
};

enum class ComponentClass : std::uint8_t {
    kEntity = 0,
    kView = 1,
    kViewGroup = 2,
    kSensor = 3,
    kRegionalSeaSurface = 4,
    kRegionalTerrainSurface = 5,
    kRegionalLayeredWeather = 6,
    kGlobalSeaSurface = 7,
    kGlobalTerrainSurface = 8,
    kGlobalLayeredWeather = 9,
    kAtmosphere = 10,
    kCelestialSphere = 11,
    kEvent = 12,
    kSystem = 13,
    kSymbolSurface = 14,
    kSymbol = 15
};

// ---- Host to image generator

struct IgControl {
    /// 0: the writer fills in its own version. Another value is written only if it is the writer's major
    /// version.
    std::uint8_t major_version = 0;
    std::uint8_t minor_version = 0;
    std::int8_t database_number = 0;
    IgMode ig_mode = IgMode::kStandby;
    bool timestamp_valid = false;
    bool extrapolation_enable = false;
    bool entity_type_substitution_enable = false;  // [4.0]
    std::uint16_t byte_swap = kByteSwapMagic;      // [3.3]
    std::uint32_t host_frame_number = 0;
    std::uint32_t timestamp = 0;  // ticks of 10 us
    std::uint32_t last_ig_frame_number = 0;
};

/// Existence and look of an entity; in 3.3 its place and attitude too.
struct EntityControl {
    std::uint16_t entity_id = 0;  // 0: ownship
    EntityState entity_state = EntityState::kInactive;
    bool attach_state = false;  // [3.3] true: attached, lat_x lon_y alt_z are offsets in metres
    bool collision_detect = false;
    bool inherit_alpha = false;
    GroundClamp ground_clamp = GroundClamp::kNone;  // [3.3]
    bool animation_direction = false;               // [3.3] true: backward
    bool animation_loop = false;                    // [3.3]
    std::uint8_t animation_state = 0;               // [3.3] 0 stop, 1 pause, 2 play, 3 continue
    bool extrapolation_enable = false;
    bool extended_entity_type = false;  // [4.0]
    std::uint8_t alpha = 255;
    std::uint16_t entity_type = 0;  // [3.3]
    std::uint16_t parent_id = 0;    // [3.3]
    float roll = 0.0F;              // [3.3]
    float pitch = 0.0F;             // [3.3]
    float yaw = 0.0F;               // [3.3]
    double lat_x = 0.0;             // [3.3]
    double lon_y = 0.0;             // [3.3]
    double alt_z = 0.0;             // [3.3]
    std::uint8_t entity_kind = 0;   // [4.0] and the rest
    std::uint8_t entity_domain = 0;
    std::uint16_t entity_type_or_country = 0;
    std::uint8_t entity_category = 0;
    std::uint8_t entity_subcategory = 0;
    std::uint8_t entity_specific = 0;
    std::uint8_t entity_extra = 0;
};

/// [4.0] Place and attitude of an entity.
struct EntityPosition {
    bool attach_state = false;
    GroundClamp ground_clamp = GroundClamp::kNone;
    std::uint16_t entity_id = 0;
    std::uint16_t parent_id = 0;
    float roll = 0.0F;
    float pitch = 0.0F;
    float yaw = 0.0F;
    double lat_x = 0.0;
    double lon_y = 0.0;
    double alt_z = 0.0;
};

/// Place of an entity that follows the terrain by itself: height, pitch and roll are the image generator's.
struct ConformalClamped {
    std::uint16_t entity_id = 0;
    float yaw = 0.0F;
    double latitude = 0.0;
    double longitude = 0.0;
};

/// Velocities by which the image generator extrapolates (Velocity Control in 4.0); they stay until replaced.
struct RateControl {
    std::uint16_t entity_id = 0;
    std::uint8_t part_id = 0;
    bool apply_to_part = false;      // false: to the entity as a whole
    bool coordinate_system = false;  // true: the entity's own axes; false: north-east-down or the parent's
    float x_rate = 0.0F;             // m/s
    float y_rate = 0.0F;
    float z_rate = 0.0F;
    float roll_rate = 0.0F;  // deg/s
    float pitch_rate = 0.0F;
    float yaw_rate = 0.0F;
};

/// [4.0] Accelerations that change those velocities; they stay until replaced.
struct AccelerationControl {
    std::uint16_t entity_id = 0;
    std::uint8_t part_id = 0;
    bool apply_to_part = false;
    bool coordinate_system = false;  // as in RateControl, and of its own
    float x_acceleration = 0.0F;     // m/s2
    float y_acceleration = 0.0F;
    float z_acceleration = 0.0F;
    float roll_acceleration = 0.0F;  // deg/s2
    float pitch_acceleration = 0.0F;
    float yaw_acceleration = 0.0F;
};

struct ComponentControl {
    std::uint16_t component_id = 0;
    std::uint16_t instance_id = 0;
    ComponentClass component_class = ComponentClass::kEntity;
    std::uint8_t component_state = 0;
    std::uint32_t data_1 = 0;
    std::uint32_t data_2 = 0;
    std::uint32_t data_3 = 0;
    std::uint32_t data_4 = 0;
    std::uint32_t data_5 = 0;
    std::uint32_t data_6 = 0;
};

struct ShortComponentControl {
    std::uint16_t component_id = 0;
    std::uint16_t instance_id = 0;
    ComponentClass component_class = ComponentClass::kEntity;
    std::uint8_t component_state = 0;
    std::uint32_t data_1 = 0;
    std::uint32_t data_2 = 0;
};

/// Date and time are UTC; they count only while `date_time_valid`.
struct CelestialSphereControl {
    std::uint8_t hour = 0;
    std::uint8_t minute = 0;
    float seconds = 0.0F;  // [4.0]
    bool ephemeris_enable = false;
    bool sun_enable = false;
    bool moon_enable = false;
    bool star_enable = false;
    bool date_time_valid = false;
    std::uint32_t date = 0;  // month * 1000000 + day * 10000 + year
    float star_intensity = 0.0F;
};

struct AtmosphereControl {
    bool model_enable = false;
    std::uint8_t humidity = 0;
    float air_temperature = 0.0F;
    float visibility = 0.0F;
    float wind_horizontal = 0.0F;
    float wind_vertical = 0.0F;
    float wind_direction = 0.0F;
    float pressure = 0.0F;
};

/// Rounded rectangle; sizes are full lengths, the transition perimeter lies outside.
struct EnvRegionControl {
    std::uint16_t region_id = 0;
    RegionState region_state = RegionState::kInactive;
    bool merge_weather = false;
    bool merge_aerosol = false;
    bool merge_maritime = false;
    bool merge_terrestrial = false;
    double latitude = 0.0;
    double longitude = 0.0;
    float size_x = 0.0F;
    float size_y = 0.0F;
    float corner_radius = 0.0F;
    float rotation = 0.0F;
    float transition_perimeter = 0.0F;
};

/// The transition bands lie outside base_elevation .. base_elevation + thickness.
struct WeatherControl {
    std::uint16_t entity_region_id = 0;
    std::uint8_t layer_id =
        0;  // 0 fog, 1..3 cloud, 4 rain, 5 snow, 6 sleet, 7 hail, 8 sand, 9 dust, others own
    std::uint8_t humidity = 0;
    bool weather_enable = false;
    bool scud_enable = false;
    bool random_winds = false;
    bool random_lightning = false;
    CloudType cloud_type = CloudType::kNone;
    WeatherScope scope = WeatherScope::kGlobal;
    std::uint8_t severity = 0;     // 0..5
    bool top_scud_enable = false;  // [4.0]
    float air_temperature = 0.0F;
    float visibility = 0.0F;
    float scud_frequency = 0.0F;
    float coverage = 0.0F;
    float base_elevation = 0.0F;
    float thickness = 0.0F;
    float transition_band = 0.0F;
    float wind_horizontal = 0.0F;
    float wind_vertical = 0.0F;
    float wind_direction = 0.0F;
    float pressure = 0.0F;
    float aerosol = 0.0F;
    /// The next two and top_scud_enable: a validated 3.3 packet carries the bottom's values here, since its
    /// one band stands for both sides.
    float top_scud_frequency = 0.0F;   // [4.0]
    float top_transition_band = 0.0F;  // [4.0]
};

struct MaritimeSurfaceControl {
    std::uint16_t entity_region_id = 0;
    bool enable = false;
    bool whitecap_enable = false;
    WeatherScope scope = WeatherScope::kGlobal;
    float sea_surface_height = 0.0F;
    float water_temperature = 0.0F;
    float clarity = 0.0F;
};

struct WaveControl {
    std::uint16_t entity_region_id = 0;
    std::uint8_t wave_id = 0;
    bool wave_enable = false;
    WeatherScope scope = WeatherScope::kGlobal;
    BreakerType breaker_type = BreakerType::kPlunging;
    float height = 0.0F;
    float wavelength = 0.0F;
    float period = 0.0F;
    float direction = 0.0F;
    float phase_offset = 0.0F;
    float leading = 0.0F;
};

struct TerrestrialSurfaceControl {
    std::uint16_t entity_region_id = 0;
    std::uint16_t condition_id = 0;  // 0 dry, others own
    bool enable = false;
    WeatherScope scope = WeatherScope::kGlobal;
    std::uint8_t severity = 0;  // 0..31
    std::uint8_t coverage = 0;
};

struct ViewControl {
    std::uint16_t view_id = 0;  // ignored when group_id != 0
    std::uint8_t group_id = 0;
    bool x_enable = false;
    bool y_enable = false;
    bool z_enable = false;
    bool roll_enable = false;
    bool pitch_enable = false;
    bool yaw_enable = false;
    std::uint16_t entity_id = 0;
    float x_offset = 0.0F;
    float y_offset = 0.0F;
    float z_offset = 0.0F;
    float roll = 0.0F;
    float pitch = 0.0F;
    float yaw = 0.0F;
};

/// Half angles from the view axis: left and bottom normally negative.
struct ViewDefinition {
    std::uint16_t view_id = 0;
    std::uint8_t group_id = 0;
    bool near_enable = false;
    bool far_enable = false;
    bool left_enable = false;
    bool right_enable = false;
    bool top_enable = false;
    bool bottom_enable = false;
    std::uint8_t mirror_mode = 0;        // 0 none, 1 horizontal, 2 vertical, 3 both
    std::uint8_t pixel_replication = 0;  // 0 none, 1 1x2, 2 2x1, 3 2x2, 4..7 own
    bool projection_type = false;        // true: orthographic parallel
    bool reorder = false;
    std::uint8_t view_type = 0;
    float near = 0.0F;
    float far = 0.0F;
    float left = 0.0F;
    float right = 0.0F;
    float top = 0.0F;
    float bottom = 0.0F;
};

/// The values count only while `custom_enable`; else the Earth is WGS 84.
struct EarthModelDefinition {
    bool custom_enable = false;
    double equatorial_radius = 6378137.0;
    double flattening = 1.0 / 298.257223563;  // (a - b) / a
};

struct HatHotRequest {
    std::uint16_t request_id = 0;
    HatHotType request_type = HatHotType::kHat;
    bool coordinate_system = false;  // true: offsets from the entity
    std::uint8_t update_period = 0;  // frames; 0: once
    std::uint16_t entity_id = 0;
    double lat_x = 0.0;
    double lon_y = 0.0;
    double alt_z = 0.0;
};

struct PositionRequest {
    std::uint16_t object_id = 0;
    std::uint8_t part_id = 0;
    bool update_mode = false;            // true: every frame until cancelled
    std::uint8_t object_class = 0;       // 0 entity, 1 part, 2 view, 3 view group, 4 motion tracker
    std::uint8_t coordinate_system = 0;  // 0 geodetic, 1 parent entity, 2 submodel
};

struct EnvConditionsRequest {
    std::uint8_t request_type = 0;  // sum of 1 maritime, 2 terrestrial, 4 weather, 8 aerosol
    std::uint8_t request_id = 0;
    double latitude = 0.0;
    double longitude = 0.0;
    double altitude = 0.0;
};

// ---- Image generator to host

struct StartOfFrame {
    std::uint8_t major_version = 0;  // as in IgControl
    std::uint8_t minor_version = 0;
    std::int8_t database_number = 0;  // -n: loading, n: loaded, -128: not available
    std::uint8_t ig_status = 0;       // [3.3]
    IgMode ig_mode = IgMode::kStandby;
    bool timestamp_valid = false;
    bool earth_model = false;                  // true: host defined
    std::uint16_t byte_swap = kByteSwapMagic;  // [3.3]
    std::uint32_t ig_frame_number = 0;
    std::uint32_t timestamp = 0;  // ticks of 10 us
    std::uint32_t last_host_frame_number = 0;
    bool overframing = false;           // [4.0]
    bool paging = false;                // [4.0]
    bool excess_variable_data = false;  // [4.0]
};

struct HatHotResponse {
    std::uint16_t request_id = 0;
    bool valid = false;
    bool response_type = false;       // true: HOT
    std::uint8_t host_frame_lsn = 0;  // low 4 bits of the host frame number
    double height = 0.0;
};

struct HatHotExtendedResponse {
    std::uint16_t request_id = 0;
    bool valid = false;
    std::uint8_t host_frame_lsn = 0;
    double hat = 0.0;
    double hot = 0.0;
    std::uint32_t material_code = 0;
    float normal_azimuth = 0.0F;
    float normal_elevation = 0.0F;
};

struct PositionResponse {
    std::uint16_t object_id = 0;
    std::uint8_t part_id = 0;
    std::uint8_t object_class = 0;
    std::uint8_t coordinate_system = 0;
    double lat_x = 0.0;
    double lon_y = 0.0;
    double alt_z = 0.0;
    float roll = 0.0F;
    float pitch = 0.0F;
    float yaw = 0.0F;
};

struct WeatherConditionsResponse {
    std::uint8_t request_id = 0;
    std::uint8_t humidity = 0;
    float air_temperature = 0.0F;
    float visibility = 0.0F;
    float wind_horizontal = 0.0F;
    float wind_vertical = 0.0F;
    float wind_direction = 0.0F;
    float pressure = 0.0F;
};

struct AerosolResponse {
    std::uint8_t request_id = 0;
    std::uint8_t layer_id = 0;
    float aerosol = 0.0F;
};

struct MaritimeSurfaceResponse {
    std::uint8_t request_id = 0;
    float sea_surface_height = 0.0F;
    float water_temperature = 0.0F;
    float clarity = 0.0F;
};

struct TerrestrialSurfaceResponse {
    std::uint8_t request_id = 0;
    std::uint32_t condition_id = 0;
};

struct EventNotification {
    std::uint16_t event_id = 0;
    std::uint32_t data_1 = 0;
    std::uint32_t data_2 = 0;
    std::uint32_t data_3 = 0;
};

/// The text of a packet that was read lies in the datagram: it lives as long as those bytes do. A text that
/// is written is cut to what the packet can hold (99 octets in 3.3), its NUL and padding are added.
struct IgMessage {
    std::uint16_t message_id = 0;
    std::string_view text;
};

}  // namespace skyig::protocol::cigi
