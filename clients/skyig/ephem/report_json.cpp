#include <nlohmann/json.hpp>

#include "clients/skyig/ephem/report.h"
#include "clients/skyig/ephem/told_event.h"

namespace skyig::clients::ephem {

using namespace server::ephemeris;
using Json = nlohmann::ordered_json;

namespace {

void add_horizontal(Json& json, const std::optional<BodyPlace::Horizontal>& place, double seen_deg) {
    if (!place) return;
    json["azimuth_deg"] = place->azimuth_deg;
    json["elevation_deg"] = place->elevation_deg;
    json["elevation_refracted_deg"] = seen_deg;
}

Json body_json(const Report& report, std::size_t index) {
    const BodyPlace& place = report.bodies[index];
    Json json{{"body", name_of(place.body)},
              {"right_ascension_deg", place.right_ascension_deg},
              {"declination_deg", place.declination_deg}};
    add_horizontal(json, place.horizontal, place.horizontal ? report.refracted_elevations_deg[index] : 0.0);
    json["range_km"] = place.range_km;
    json["semidiameter_arcsec"] = place.semidiameter_arcsec;
    json["phase_angle_deg"] = place.phase_angle_deg;
    json["illuminated_fraction"] = place.illuminated_fraction;
    if (place.bright_limb_deg) json["bright_limb_deg"] = *place.bright_limb_deg;
    json["magnitude"] = place.magnitude;
    if (place.moon_face) {
        json["subearth_longitude_deg"] = place.moon_face->subearth_longitude_deg;
        json["subearth_latitude_deg"] = place.moon_face->subearth_latitude_deg;
        json["subsolar_longitude_deg"] = place.moon_face->subsolar_longitude_deg;
        json["subsolar_latitude_deg"] = place.moon_face->subsolar_latitude_deg;
        json["axis_position_angle_deg"] = place.moon_face->axis_position_angle_deg;
    }
    return json;
}

Json star_json(const StarPlace& place) {
    Json json{{"hr", place.star.hr},
              {"name", place.star.name},
              {"right_ascension_deg", place.right_ascension_deg},
              {"declination_deg", place.declination_deg}};
    add_horizontal(json, place.horizontal, place.refracted_elevation_deg.value_or(0.0));
    json["magnitude"] = place.magnitude;
    return json;
}

}  // namespace

std::string to_json(const Report& report) {
    const ReportRequest& request = report.request;
    Json json{{"utc", to_iso(request.utc, 3)},
              {"model", kModelNames[static_cast<std::size_t>(request.model)]},
              {"tt_minus_utc_s", report.offsets.tt_minus_utc_s},
              {"ut1_minus_utc_s", report.offsets.ut1_minus_utc_s}};
    json["site"] = nullptr;
    if (request.site) {
        json["site"] = {{"latitude_deg", request.site->latitude_deg},
                        {"longitude_deg", request.site->longitude_deg},
                        {"height_m", request.site->height_m}};
    }
    json["bodies"] = Json::array();
    for (std::size_t i = 0; i < report.bodies.size(); ++i)
        json["bodies"].push_back(body_json(report, i));
    json["stars"] = Json::array();
    for (const StarPlace& place : report.stars)
        json["stars"].push_back(star_json(place));
    json["sun_obscured"] = report.sun_obscured;
    json["moon_sunlit"] = report.moon_sunlit;
    json["next"] = Json::array();
    for (const events::Event& event : report.next)
        json["next"].push_back(event_json(event));
    return json.dump(2) + '\n';
}

}  // namespace skyig::clients::ephem
