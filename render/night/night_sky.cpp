#include "render/night/night_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/geometry.h"
#include "render/night/airglow.h"
#include "render/night/natural_light.h"
#include "render/sky/staleness.h"

namespace skyig::render::night {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kFreshTurn_rad = 0.1 * kDegree;
constexpr double kLostTurn_rad = 3.0 * kDegree;
constexpr double kScatteredBack = 0.6;

// Transmittance falls to 0 over the Sun's disc about the horizon; a ray of the sky itself is whole.
constexpr double kWholeRay_rad = 0.3 * kDegree;

struct Place {
    std::size_t low;
    float share;
};

// Rows crowd at the horizon.
Place place_of_row(double from_horizon_rad, double range_rad, int rows) {
    const double row = std::sqrt(std::clamp(from_horizon_rad / range_rad, 0.0, 1.0)) * (rows - 1);
    const auto low = std::min(static_cast<std::size_t>(row), static_cast<std::size_t>(rows) - 2);
    return {low, static_cast<float>(row - static_cast<double>(low))};
}

double from_horizon_rad(int row, double range_rad, int rows) {
    const double share = static_cast<double>(row) / (rows - 1);
    return share * share * range_rad;
}

double sky_range_rad(double height_m) {
    return 0.5 * kPi - horizon_elevation_rad(height_m);
}

double ground_range_rad(double height_m) {
    return 0.5 * kPi + horizon_elevation_rad(height_m);
}

double largest_turn(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0.0;
    for (int i = 0; i < 3; ++i)
        largest = std::max(largest, glm::distance(a[i], b[i]));
    return largest;
}

glm::dvec3 passes_to(const sky::AirTables& air, double height_m, double elevation_rad) {
    return air.transmittance_rgb(height_m,
                                 std::max(elevation_rad, horizon_elevation_rad(height_m) + kWholeRay_rad));
}

}  // namespace

double night_share(double sun_elevation_rad) noexcept {
    return smooth_step(-3.0 * kDegree, -5.0 * kDegree, sun_elevation_rad);
}

NightSky::NightSky() : domes_(kMaxCities) {
    for (Table* table : {&front_, &back_}) {
        table->sky.resize(static_cast<std::size_t>(kSkyRows) * (kColumns + 1));
        table->passes.resize(kSkyRows);
        table->ground.resize(kGroundRows);
    }
}

NightSky::Fit NightSky::fit(const Table& table, const Made& wanted) noexcept {
    const Made& made = table.made;
    if (!table.valid || !(made.settings == wanted.settings)) return Fit::kLost;
    const double turn = std::max(largest_turn(made.enu_from_gcrs, wanted.enu_from_gcrs),
                                 glm::distance(made.sun_gcrs, wanted.sun_gcrs));
    if (turn > kLostTurn_rad ||
        std::abs(made.height_m - wanted.height_m) > 200.0 + 0.2 * std::abs(made.height_m))
        return Fit::kLost;
    if (turn > kFreshTurn_rad || made.air != wanted.air ||
        sky::height_is_stale(wanted.height_m, made.height_m))
        return Fit::kStale;
    // A degree is 111 km; near a town less of it shows.
    const double moved_m = 111e3 * std::hypot(made.latitude_deg - wanted.latitude_deg,
                                              made.longitude_deg - wanted.longitude_deg);
    for (std::size_t i = 0; i < made.settings.city_count; ++i) {
        if (moved_m > 0.02 * (table.towns[i].distance_m + made.settings.cities[i].radius_m))
            return Fit::kStale;
    }
    return Fit::kFresh;
}

NightSky::Made NightSky::made_for(const Scene& scene, const sky::AirTables& air) noexcept {
    return {air.share(),
            scene.night,
            scene.stars.enu_from_gcrs,
            glm::transpose(scene.stars.enu_from_gcrs) * scene.sun.direction_enu,
            std::max(scene.eye.height_m, 0.0),
            scene.eye.latitude_deg,
            scene.eye.longitude_deg};
}

bool NightSky::update(const Scene& scene, const sky::AirTables& air) noexcept {
    const Made wanted = made_for(scene, air);
    const Fit latest = fit(building_ ? back_ : front_, wanted);
    if (latest == Fit::kLost) front_.valid = false;
    if (latest == Fit::kLost || (latest == Fit::kStale && !building_)) {
        begin(wanted, air);
    } else if (building_) {
        build_slice(air);
    } else {
        return false;
    }
    const bool counts = night_share(horizontal_of(scene.sun.direction_enu).elevation_rad) > 0.0;
    if (counts && !front_.valid) build_all(air);
    if (!complete()) return false;
    take_over();
    return true;
}

void NightSky::build(const Scene& scene, const sky::AirTables& air) noexcept {
    for (LightDome& dome : domes_)
        dome = {};
    begin(made_for(scene, air), air);
    build_all(air);
    take_over();
}

void NightSky::begin(const Made& wanted, const sky::AirTables& air) noexcept {
    back_.made = wanted;
    back_.valid = true;
    building_ = true;
    next_row_ = 0;
    aim_at_towns(back_, air);
    light_evenly(back_, air);
}

void NightSky::build_slice(const sky::AirTables& air) noexcept {
    for (std::size_t i = 0; i < back_.made.settings.city_count; ++i) {
        if (domes_[i].complete()) continue;
        domes_[i].build_rows(kTownRowsAFrame);
        return;
    }
    for (int i = 0; i < kRowsAFrame && !complete(); ++i)
        build_row(next_row_++, air);
}

void NightSky::build_all(const sky::AirTables& air) noexcept {
    while (!complete())
        build_slice(air);
}

void NightSky::take_over() noexcept {
    std::swap(front_, back_);
    building_ = false;
}

// What all the sky sends to the ground, and its mean.
void NightSky::light_evenly(Table& table, const sky::AirTables& air) noexcept {
    constexpr int kRings = 8;
    constexpr int kAround = 16;
    const Made& made = table.made;
    const glm::dmat3 gcrs_from_enu = glm::transpose(made.enu_from_gcrs);
    const double airglow = airglow_zenith_cd_m2(made.settings);
    glm::dvec3 mean{0.0};
    glm::dvec3 lux{0.0};
    glm::dvec3 lost{0.0};
    for (int ring = 0; ring < kRings; ++ring) {
        const double sine = (ring + 0.5) / kRings;
        const double elevation_rad = std::asin(sine);
        const glm::dvec3 passes = passes_to(air, 0.0, elevation_rad);
        const glm::dvec3 glow =
            natural_colours().airglow * (airglow * airglow_path(elevation_rad, 0.0, false).far);
        for (int i = 0; i < kAround; ++i) {
            const glm::dvec3 direction = direction_of({elevation_rad, 2.0 * kPi * (i + 0.5) / kAround});
            const glm::dvec3 outside =
                glow + whole_beyond_air_cd_m2(made.settings, gcrs_from_enu * direction, made.sun_gcrs);
            mean += outside / double{kRings * kAround};
            lux += outside * passes * (2.0 * kPi * sine / (kRings * kAround));
        }
        lost += (1.0 - passes) * (2.0 * kPi * sine / kRings);
    }
    table.scattered = kScatteredBack * mean;
    table.ground_lux = lux + table.scattered * lost;
}

void NightSky::aim_at_towns(Table& table, const sky::AirTables& air) noexcept {
    constexpr std::size_t kGreen = 8;  // 558 nm
    const TownAir town_air{static_cast<double>(air.model().rayleigh_per_m[kGreen]),
                           static_cast<double>(air.model().aerosol_extinction_per_m[kGreen])};
    const Made& made = table.made;
    for (std::size_t i = 0; i < made.settings.city_count; ++i) {
        const City& city = made.settings.cities[i];
        const double north = city.latitude_deg * kDegree;
        const double here = made.latitude_deg * kDegree;
        const double east = (city.longitude_deg - made.longitude_deg) * kDegree;
        // Great circle on the sphere.
        const double right = std::cos(north) * std::sin(east);
        const double ahead =
            std::cos(here) * std::sin(north) - std::sin(here) * std::cos(north) * std::cos(east);
        const double up =
            std::sin(here) * std::sin(north) + std::cos(here) * std::cos(north) * std::cos(east);
        TownAt& town = table.towns[i];
        town = {std::atan2(right, ahead), kEarthRadius_m * std::atan2(std::hypot(right, ahead), up)};
        domes_[i].aim(city, town_air, town.distance_m, made.height_m);
    }
}

void NightSky::build_row(int row, const sky::AirTables& air) noexcept {
    if (row < kSkyRows) {
        build_sky_row(row, air);
    } else {
        build_ground_row(row - kSkyRows, air);
    }
}

void NightSky::build_sky_row(int row, const sky::AirTables& air) noexcept {
    const Made& made = back_.made;
    const double elevation_rad =
        horizon_elevation_rad(made.height_m) + from_horizon_rad(row, sky_range_rad(made.height_m), kSkyRows);
    const glm::dvec3 passes = passes_to(air, made.height_m, elevation_rad);
    const AirglowPath path = airglow_path(elevation_rad, made.height_m, false);
    const glm::dvec3 airglow = natural_colours().airglow * airglow_zenith_cd_m2(made.settings);
    const glm::dvec3 even = airglow * (path.near + path.far * passes) + back_.scattered * (1.0 - passes);
    const glm::dmat3 gcrs_from_enu = glm::transpose(made.enu_from_gcrs);
    back_.passes[static_cast<std::size_t>(row)] = glm::vec3{passes};
    glm::vec3* out = &back_.sky[static_cast<std::size_t>(row) * (kColumns + 1)];
    for (int column = 0; column <= kColumns; ++column) {
        const double azimuth_rad = 2.0 * kPi * column / kColumns;
        const glm::dvec3 direction = gcrs_from_enu * direction_of({elevation_rad, azimuth_rad});
        double towns = 0.0;
        for (std::size_t i = 0; i < made.settings.city_count; ++i)
            towns += domes_[i].luminance_cd_m2(elevation_rad, azimuth_rad - back_.towns[i].azimuth_rad);
        out[column] = glm::vec3{even + beyond_air_cd_m2(made.settings, direction, made.sun_gcrs) * passes +
                                natural_colours().town * towns};
    }
}

void NightSky::build_ground_row(int row, const sky::AirTables& air) noexcept {
    const Made& made = back_.made;
    const double below_rad = from_horizon_rad(row, ground_range_rad(made.height_m), kGroundRows);
    const double elevation_rad = horizon_elevation_rad(made.height_m) - below_rad;
    // Up the ray from the ground: all the air less what is above the eye.
    const double cosine = std::cos(elevation_rad) * (1.0 + made.height_m / kEarthRadius_m);
    const double rises_rad = std::acos(std::clamp(cosine, 0.0, 1.0)) + kWholeRay_rad;
    const glm::dvec3 all = air.transmittance_rgb(0.0, std::min(rises_rad, 0.5 * kPi));
    const glm::dvec3 above =
        air.transmittance_rgb(made.height_m, std::min(kWholeRay_rad - elevation_rad, 0.5 * kPi));
    const glm::dvec3 passes = glm::min(all / glm::max(above, glm::dvec3{1e-6}), glm::dvec3{1.0});
    const AirglowPath path = airglow_path(elevation_rad, made.height_m, true);
    const glm::dvec3 airglow = natural_colours().airglow * airglow_zenith_cd_m2(made.settings);
    back_.ground[static_cast<std::size_t>(row)] = {
        glm::vec3{passes}, glm::vec3{back_.scattered * (1.0 - passes) + airglow * path.near}};
}

glm::vec3 NightSky::sky_rgb(double above_rad, double azimuth_rad) const noexcept {
    const Place row = place_of_row(above_rad, sky_range_rad(front_.made.height_m), kSkyRows);
    const double turns = azimuth_rad / (2.0 * kPi);
    const double column = (turns - std::floor(turns)) * kColumns;
    const auto low = std::min(static_cast<std::size_t>(column), static_cast<std::size_t>(kColumns) - 1);
    const auto share = static_cast<float>(column - static_cast<double>(low));
    const glm::vec3* at = &front_.sky[row.low * (kColumns + 1) + low];
    return glm::mix(glm::mix(at[0], at[1], share), glm::mix(at[kColumns + 1], at[kColumns + 2], share),
                    row.share);
}

glm::vec3 NightSky::before_ground(const glm::vec3& ground_rgb_cd_m2, double above_rad) const noexcept {
    const Place row = place_of_row(-above_rad, ground_range_rad(front_.made.height_m), kGroundRows);
    const GroundRow& low = front_.ground[row.low];
    const GroundRow& high = front_.ground[row.low + 1];
    return glm::mix(low.passes, high.passes, row.share) * ground_rgb_cd_m2 +
           glm::mix(low.added, high.added, row.share);
}

glm::vec3 NightSky::horizon_rgb() const noexcept {
    glm::vec3 sum{0.0F};
    const double level_rad = std::max(0.0, -horizon_elevation_rad(front_.made.height_m));
    for (int i = 0; i < 12; ++i)
        sum += sky_rgb(level_rad, i * kPi / 6.0);
    return sum / 12.0F;
}

glm::vec3 NightSky::transmittance(double above_rad) const noexcept {
    const Place row = place_of_row(above_rad, sky_range_rad(front_.made.height_m), kSkyRows);
    return glm::mix(front_.passes[row.low], front_.passes[row.low + 1], row.share);
}

}  // namespace skyig::render::night
