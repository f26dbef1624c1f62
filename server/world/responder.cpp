#include "server/world/responder.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/world/conditions.h"
#include "server/world/world.h"

namespace skyig::server::world {

namespace cigi = protocol::cigi;

namespace {

/// Request types of Environmental Conditions, to be added up.
constexpr unsigned kMaritime = 1;
constexpr unsigned kTerrestrial = 2;
constexpr unsigned kWeather = 4;
constexpr unsigned kAerosol = 8;

/// Object classes of a Position Request.
constexpr unsigned kEntity = 0;
constexpr unsigned kView = 2;
constexpr unsigned kViewGroup = 3;
/// Coordinate systems.
constexpr unsigned kParent = 1;

/// Offsets from an entity beyond this are none.
constexpr double kLongestOffset_m = 1e7;

glm::dquat parent_from_child(const ViewPose& pose) noexcept {
    return ned_from_body(pose.yaw_deg, pose.pitch_deg, pose.roll_deg);
}

const View* find_view(const Views& views, std::uint16_t view_id) noexcept {
    const auto all = views.all();
    const auto found =
        std::find_if(all.begin(), all.end(), [view_id](const View& view) { return view.view_id == view_id; });
    return found == all.end() ? nullptr : &*found;
}

bool has_members(const Views& views, std::uint16_t group_id) noexcept {
    const auto all = views.all();
    return group_id != 0 && std::any_of(all.begin(), all.end(),
                                        [group_id](const View& view) { return view.group_id == group_id; });
}

/// Along the ownship's axes.
struct OnOwnship {
    glm::dvec3 offset_m{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
};

/// The group is moved and turned first, then the view in it.
OnOwnship place_of(const Views& views, const View& view) noexcept {
    const ViewPose& group = views.group(view.group_id);
    const glm::dquat body_from_group = parent_from_child(group);
    return {group.offset_m + body_from_group * view.pose.offset_m,
            body_from_group * parent_from_child(view.pose)};
}

OnOwnship place_of(const World& world, const cigi::PositionRequest& request) noexcept {
    if (request.object_class == kView) {
        const View* view = find_view(world.views(), request.object_id);
        return view == nullptr ? OnOwnship{} : place_of(world.views(), *view);
    }
    if (request.object_class == kViewGroup) {
        const ViewPose& group = world.views().group(static_cast<std::uint8_t>(request.object_id));
        return {group.offset_m, parent_from_child(group)};
    }
    return {};
}

cigi::PositionResponse position_response(const cigi::PositionRequest& request, const glm::dvec3& place,
                                         const Pose& attitude) noexcept {
    cigi::PositionResponse response;
    response.object_id = request.object_id;
    response.part_id = request.part_id;
    response.object_class = request.object_class;
    response.lat_x = place.x;
    response.lon_y = place.y;
    response.alt_z = place.z;
    response.roll = static_cast<float>(std::remainder(attitude.roll_deg, 360.0));
    response.pitch = static_cast<float>(attitude.pitch_deg);
    const double yaw_deg = std::remainder(attitude.yaw_deg, 360.0);
    response.yaw = static_cast<float>(yaw_deg < 0.0 ? yaw_deg + 360.0 : yaw_deg);
    return response;
}

cigi::PositionResponse geodetic_response(const cigi::PositionRequest& request, const Pose& pose) noexcept {
    const auto& [latitude_deg, longitude_deg, height_m] = pose.position;
    return position_response(request, {latitude_deg, std::remainder(longitude_deg, 360.0), height_m}, pose);
}

void respond_with_entity(const World& world, const cigi::PositionRequest& request,
                         Responses& responses) noexcept {
    const Entity* entity = world.entity(request.object_id);
    if (request.coordinate_system == kParent && entity != nullptr && entity->attached) {
        cigi::PositionResponse response = position_response(request, entity->offset_m, entity->on_parent);
        response.coordinate_system = kParent;
        responses.add(response);
        return;
    }
    // What is attached to nothing has no parent's coordinates: the response says geodetic.
    if (const auto pose = world.entity_pose(request.object_id))
        responses.add(geodetic_response(request, *pose));
}

void respond_to(const World& world, const cigi::PositionRequest& request, Responses& responses) noexcept {
    // What it named when it was asked may be gone by now.
    if (!can_answer(world, request)) return;
    const Ownship& ownship = world.ownship();
    if (request.object_class == kEntity) {
        respond_with_entity(world, request, responses);
        return;
    }
    const OnOwnship on = place_of(world, request);
    if (request.coordinate_system == kParent) {
        Pose pose;
        set_attitude(pose, on.turn);
        cigi::PositionResponse response = position_response(request, on.offset_m, pose);
        response.coordinate_system = kParent;
        responses.add(response);
        return;
    }
    responses.add(geodetic_response(request, pose_on(ownship, on.offset_m, on.turn)));
}

std::uint8_t frame_lsn(const World& world) noexcept {
    return static_cast<std::uint8_t>(world.session().last_host_frame_number() & 0xFU);
}

/// Nothing for a point of which nothing can be said.
std::optional<ephemeris::Geodetic> point_of(const World& world, const cigi::HatHotRequest& request) noexcept {
    ephemeris::Geodetic point{request.lat_x, request.lon_y, request.alt_z};
    if (request.coordinate_system) {
        const glm::dvec3 offset_m{request.lat_x, request.lon_y, request.alt_z};
        const std::optional<Pose> carrier = world.entity_pose(request.entity_id);
        // Not a number is no offset either.
        if (!carrier || !(glm::length(offset_m) <= kLongestOffset_m)) return std::nullopt;
        point = pose_on(*carrier, offset_m, {1.0, 0.0, 0.0, 0.0}).position;
    }
    if (!ephemeris::is_valid(point)) return std::nullopt;
    return point;
}

void respond_to(const World& world, const cigi::HatHotRequest& request, Responses& responses) noexcept {
    const std::optional<ephemeris::Geodetic> point = point_of(world, request);
    const double ground_m = point ? sea_below(world.weather(), world.surfaces(), *point).height_m : 0.0;
    const double above_m = point ? point->height_m - ground_m : 0.0;
    const std::uint8_t frame = frame_lsn(world);
    if (request.request_type == cigi::HatHotType::kExtended) {
        cigi::HatHotExtendedResponse response;
        response.request_id = request.request_id;
        response.valid = point.has_value();
        response.host_frame_lsn = frame;
        response.hat = above_m;
        response.hot = ground_m;
        response.normal_elevation = 90.0F;
        responses.add(response);
        return;
    }
    const bool hot = request.request_type == cigi::HatHotType::kHot;
    responses.add(
        cigi::HatHotResponse{request.request_id, point.has_value(), hot, frame, hot ? ground_m : above_m});
}

/// One response, and that it says nothing.
template <class LosRequest>
void respond_to_sight(const World& world, const LosRequest& request, Responses& responses) noexcept {
    const auto blank = [&](auto response) {
        response.request_id = request.request_id;
        response.host_frame_lsn = frame_lsn(world);
        response.response_count = 1;
        responses.add(response);
    };
    if (request.request_type) {
        blank(cigi::LosExtendedResponse{});
    } else {
        blank(cigi::LosResponse{});
    }
}

void respond_to(const World& world, const cigi::LosSegmentRequest& request, Responses& responses) noexcept {
    respond_to_sight(world, request, responses);
}

void respond_to(const World& world, const cigi::LosVectorRequest& request, Responses& responses) noexcept {
    respond_to_sight(world, request, responses);
}

CarriedAt carried_to(const World& world, const ephemeris::Geodetic& point) noexcept {
    CarriedAt carried;
    const glm::dvec3 point_ecef_m = ecef_of(point);
    for (const cigi::WeatherControl& weather : world.weather().carried()) {
        if (!weather.weather_enable) continue;
        if (const auto carrier = world.entity_pose(weather.entity_region_id))
            carried.add(weather, glm::distance(ecef_of(carrier->position), point_ecef_m));
    }
    return carried;
}

cigi::WeatherConditionsResponse weather_response(std::uint8_t request_id, const AirState& air) noexcept {
    cigi::WeatherConditionsResponse response;
    response.request_id = request_id;
    response.humidity = static_cast<std::uint8_t>(std::lround(std::clamp(air.humidity_pct, 0.0, 100.0)));
    response.air_temperature = static_cast<float>(air.temperature_c);
    response.visibility = static_cast<float>(air.visibility_m);
    response.wind_horizontal = static_cast<float>(air.wind_horizontal_m_s);
    response.wind_vertical = static_cast<float>(air.wind_vertical_m_s);
    response.wind_direction = static_cast<float>(air.wind_from_deg);
    response.pressure = static_cast<float>(air.pressure_hpa);
    return response;
}

void respond_to(const World& world, const cigi::EnvConditionsRequest& request,
                Responses& responses) noexcept {
    const RegionsAt regions(world.weather(), GroundPoint(request.latitude, request.longitude));
    const std::uint8_t id = request.request_id;
    if ((request.request_type & kMaritime) != 0) {
        const SeaState sea = sea_at(world.surfaces(), regions);
        responses.add(cigi::MaritimeSurfaceResponse{id, static_cast<float>(sea.height_m),
                                                    static_cast<float>(sea.temperature_c),
                                                    static_cast<float>(sea.clarity_pct)});
    }
    if ((request.request_type & kTerrestrial) != 0) {
        for (const std::uint16_t condition : GroundConditions(world.surfaces(), regions))
            responses.add(cigi::TerrestrialSurfaceResponse{id, condition});
    }
    if ((request.request_type & kWeather) != 0) {
        const CarriedAt carried = carried_to(world, {request.latitude, request.longitude, request.altitude});
        responses.add(weather_response(
            id, air_at(world.air(), world.weather(), regions, request.altitude, carried.all())));
    }
    if ((request.request_type & kAerosol) != 0) {
        const Aerosols aerosols = aerosols_at(world.weather(), regions, request.altitude);
        for (std::size_t layer = 0; layer < aerosols.layers.size(); ++layer) {
            if (!aerosols.layers[layer].present) continue;
            responses.add(cigi::AerosolResponse{id, static_cast<std::uint8_t>(layer),
                                                static_cast<float>(aerosols.layers[layer].aerosol_g_m3)});
        }
    }
}

}  // namespace

bool can_answer(const World& world, const cigi::PositionRequest& request) noexcept {
    switch (request.object_class) {
        case kEntity:
            return world.entity_pose(request.object_id) && request.coordinate_system <= kParent;
        case kView:
            return find_view(world.views(), request.object_id) != nullptr &&
                   request.coordinate_system <= kParent;
        case kViewGroup:
            return has_members(world.views(), request.object_id) && request.coordinate_system <= kParent;
        default:
            return false;
    }
}

bool searches_regions(const World& world, const Request& request) noexcept {
    if (std::holds_alternative<cigi::HatHotRequest>(request)) return world.surfaces().has_regional_sea();
    return std::holds_alternative<cigi::EnvConditionsRequest>(request);
}

void respond(const World& world, const Request& request, Responses& responses) noexcept {
    std::visit([&](const auto& asked) { respond_to(world, asked, responses); }, request);
}

}  // namespace skyig::server::world
