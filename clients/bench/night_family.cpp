#include "clients/bench/night_family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "clients/bench/directions.h"
#include "clients/bench/night_errors.h"
#include "render/display.h"
#include "render/geometry.h"
#include "render/night/airglow.h"
#include "render/night/light_dome.h"
#include "render/night/milky_way_map.h"
#include "render/night/moon_light.h"
#include "render/night/night_sky.h"
#include "render/night/star_catalogue.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"
#include "render/sky_frame.h"
#include "render/star_field.h"
#include "render/still_light.h"

namespace skyig::clients::bench {

namespace {

namespace night = render::night;
using render::NightModel;
using render::Scene;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
/// The error and the cost that every model has.
constexpr const char* kLight = "light";
constexpr const char* kAllRows = "all its rows";
/// Maps that are not this project's to carry.
constexpr const char* kReference = "../shared/reference";

struct NightModelText {
    const char* name;
    const char* what;
};
constexpr std::array<NightModelText, 11> kModels{
    {{"seed", "the whole moonless sky by four constants"},
     {"mean", "the whole moonless sky, zodiacal light and starlight everywhere as at a dark zenith"},
     {"sources", "the whole moonless sky, each source by its own law; the default"},
     {"airglow", "a layer at 90 km, van Rhijn's law"},
     {"zodiacal", "the table of Leinert et al. 1998"},
     {"starlight", "a fit to the maps of Pioneer 10 and 11, with the light that dust scatters"},
     {"milky-way", "the belt's map with clouds and dust lanes"},
     {"towns", "light scattered once, after Garstang 1986"},
     {"stars", "points, seen from a threshold after Knoll, Tousey and Hulburt 1946"},
     {"moon", "the law of the phase, and the sky of a small Sun in its place"},
     {"sun", "all orders of scattering, to the end of twilight"}}};

std::vector<ErrorEntry> entries_of(const std::string& model, const std::vector<NightRow>& rows) {
    std::vector<std::pair<std::string, ErrorSamples>> sets{{kAllRows, {}}};
    for (const NightRow& row : rows) {
        if (row.model != model) continue;
        sets.front().second.add(row.off_mag);
        const auto known =
            std::find_if(sets.begin(), sets.end(), [&](const auto& set) { return set.first == row.cases; });
        auto& samples = known == sets.end() ? sets.emplace_back(row.cases, ErrorSamples{}) : *known;
        samples.second.add(row.off_mag);
    }
    std::vector<ErrorEntry> entries;
    for (const auto& [cases, samples] : sets)
        entries.push_back({kLight, cases, "mag", samples.figures()});
    return entries;
}

/// Those of the short tables.
std::vector<RowEntry> listed(const std::string& model, const std::vector<NightRow>& rows) {
    std::vector<RowEntry> list;
    for (const NightRow& row : rows) {
        if (row.model == model && !row.row.empty())
            list.push_back({row.cases, row.row, row.unit, row.known, row.ours, row.off_mag});
    }
    return list;
}

/// Unit vectors, even over the sphere.
using Vectors = std::array<glm::dvec3, kDirections>;

std::shared_ptr<const Vectors> vectors() {
    auto made = std::make_shared<Vectors>();
    const auto asked = directions();
    for (std::size_t i = 0; i < kDirections; ++i)
        (*made)[i] = render::direction_of({(*asked)[i].x, (*asked)[i].y});
    return made;
}

/// One direction over the horizon. `owner` keeps what `light` points into.
template <class Owner>
Work look_up_work(Owner owner, const render::SkyLight& light) {
    return repeat([owner = std::move(owner), light, asked = directions()](std::uint64_t i) {
        const glm::vec2& direction = (*asked)[i % kDirections];
        const double above_rad = std::abs(static_cast<double>(direction.x));
        return static_cast<double>(
            light.rgb_cd_m2(above_rad, static_cast<double>(direction.y), render::Side::kSky).y);
    });
}

Scene june_night() {
    return dark_hour(-40.0 * kDegree, 0.5 * kPi, 0.0);
}

/// After so many calls, of a sky that turns by 0.02 deg a call (5 s).
glm::dmat3 turned(const glm::dmat3& enu_from_gcrs, std::uint64_t calls) {
    const double angle_rad = 0.02 * kDegree * static_cast<double>(calls);
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return enu_from_gcrs * glm::dmat3{{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}};
}

/// Every light of one sky with the Sun just down and the Moon up.
std::shared_ptr<render::StillLight> every_light() {
    Scene scene = june_night();
    scene.sun.direction_enu = render::direction_of({-8.0 * kDegree, 0.0});
    scene.moon.direction_enu = render::direction_of({40.0 * kDegree, 3.0});
    auto still = std::make_shared<render::StillLight>();
    still->settle(scene);
    return still;
}

void add_whole_skies(const std::shared_ptr<const render::StillLight>& still,
                     std::vector<Contender>& contenders) {
    for (const NightModel model : {NightModel::kSeed, NightModel::kMean, NightModel::kSources}) {
        Scene scene = june_night();
        scene.night.model = model;
        const auto sky = std::make_shared<night::NightSky>();
        sky->build(scene, still->air());
        render::SkyLight light = still->light();
        light.sun = light.moon = {};
        light.night = sky.get();
        if (model != NightModel::kSources) light.milky_way = {};
        const std::string name(render::kNightModelNames[static_cast<std::size_t>(model)]);
        contenders.push_back({name, kLight, look_up_work(std::pair{still, sky}, light)});
        // The table of a sky that turns, some rows a call.
        Work rows = repeat([still, scene, first = scene.stars.enu_from_gcrs,
                            turning = std::make_shared<night::NightSky>()](std::uint64_t i) mutable {
            scene.stars.enu_from_gcrs = turned(first, i);
            turning->update(scene, still->air());
            return static_cast<double>(turning->ground_rgb_lux().y);
        });
        contenders.push_back({name, "row", std::move(rows), {}, 32, night::NightSky::kRowsAFrame});
    }
}

void add_diffuse_sources(std::vector<Contender>& contenders) {
    contenders.push_back({"airglow", kLight, repeat([asked = directions()](std::uint64_t i) {
                              const double above_rad =
                                  std::abs(static_cast<double>((*asked)[i % kDirections].x));
                              return night::airglow_path(above_rad, 0.0, false).far;
                          })});
    const Scene scene = june_night();
    const glm::dvec3 sun_gcrs = glm::transpose(scene.stars.enu_from_gcrs) * scene.sun.direction_enu;
    contenders.push_back({"zodiacal", kLight, repeat([sun_gcrs, asked = vectors()](std::uint64_t i) {
                              return night::zodiacal_s10((*asked)[i % kDirections], sun_gcrs);
                          })});
    contenders.push_back({"starlight", kLight, repeat([asked = directions()](std::uint64_t i) {
                              const glm::vec2& place = (*asked)[i % kDirections];
                              const night::Starlight light = night::starlight_s10(
                                  static_cast<double>(place.y), static_cast<double>(place.x));
                              return light.even + light.belt;
                          })});
}

void add_milky_way(std::vector<Contender>& contenders) {
    const auto map = std::make_shared<night::MilkyWayMap>();
    map->begin(1.0, 1);
    map->build_rows(night::MilkyWayMap::kHeight);
    // Within the belt: a third of the latitude.
    auto within = std::make_shared<Vectors>();
    const auto asked = directions();
    for (std::size_t i = 0; i < kDirections; ++i) {
        const double longitude_rad = (*asked)[i].y;
        const double latitude_rad = static_cast<double>((*asked)[i].x) / 3.0;
        (*within)[i] = {std::cos(latitude_rad) * std::cos(longitude_rad),
                        std::cos(latitude_rad) * std::sin(longitude_rad), std::sin(latitude_rad)};
    }
    contenders.push_back({"milky-way", kLight, repeat([map, within](std::uint64_t i) {
                              return map->luminance_cd_m2((*within)[i % kDirections]);
                          })});
    contenders.push_back({"milky-way",
                          "map",
                          repeat([](std::uint64_t i) {
                              night::MilkyWayMap made;
                              made.begin(1.0, static_cast<std::uint32_t>(i));
                              made.build_rows(night::MilkyWayMap::kHeight);
                              return static_cast<double>(made.texels().front());
                          }),
                          {},
                          1});
}

void add_towns(std::vector<Contender>& contenders) {
    const render::City city{.radius_m = 8000.0, .population = 2e5};
    const auto dome = std::make_shared<night::LightDome>();
    dome->aim(city, {}, 30e3, 600.0);
    dome->build_rows(night::LightDome::kRows);
    contenders.push_back({"towns", kLight, repeat([dome, asked = directions()](std::uint64_t i) {
                              const glm::vec2& direction = (*asked)[i % kDirections];
                              return dome->luminance_cd_m2(std::abs(static_cast<double>(direction.x)),
                                                           static_cast<double>(direction.y));
                          })});
    contenders.push_back({"towns",
                          "dome",
                          repeat([city](std::uint64_t i) {
                              night::LightDome made;
                              made.aim(city, {}, 10e3 + 10.0 * static_cast<double>(i % 4096), 600.0);
                              made.build_rows(night::LightDome::kRows);
                              return made.luminance_cd_m2(0.1, 0.0);
                          }),
                          {},
                          4});
}

/// All stars and planets worked out anew, since the sky has turned.
Contender star_contender() {
    Scene scene = june_night();
    constexpr double kPixel_rad = 8e-4;
    const auto frame = std::make_shared<render::SkyFrame>(render::DisplaySettings{}, render::Quality{});
    frame->prepare(scene, kPixel_rad);
    const auto field = std::make_shared<render::StarField>();
    Work work = repeat([frame, field, scene, first = scene.stars.enu_from_gcrs](std::uint64_t i) mutable {
        scene.stars.enu_from_gcrs = turned(first, i);
        field->update(scene, *frame, kPixel_rad);
        return static_cast<double>(field->stars().size());
    });
    return {"stars", kLight, std::move(work), {}, 8, field->capacity()};
}

void add_moon_and_sun(const std::shared_ptr<const render::StillLight>& still,
                      std::vector<Contender>& contenders) {
    render::SkyLight by_moon = still->light();
    by_moon.night = nullptr;
    by_moon.milky_way = {};
    render::SkyLight by_sun = by_moon;
    by_moon.sun = by_sun.moon = {};
    contenders.push_back({"moon", kLight, look_up_work(still, by_moon)});
    contenders.push_back({"moon", "phase", repeat([](std::uint64_t i) {
                              const double phase_rad = 0.003 * static_cast<double>(i % 1000);
                              return night::moon_illuminance_lux(phase_rad, 384400.0, phase_rad);
                          })});
    contenders.push_back({"sun", kLight, look_up_work(still, by_sun)});
}

}  // namespace

Report measure_night_errors(const std::filesystem::path& truth) {
    Report report;
    report.family = "night";
    report.title = "Light of the night sky";
    report.cases =
        "every row of the night's tables, asked for through the light that is drawn, in magnitudes (0.33 is "
        "a factor of 1.35, 0.51 one of 1.6; `off` > 0 where we are too dark, of the limiting magnitude where "
        "we see more). `sources`: geometric means of 36 moonless skies, at 21, 0 and 3 h of twelve nights of "
        "a year, 30 deg north and south, the zenith's without those that have the Milky Way there (its table "
        "tells a typical dark site; at midnight alone the gegenschein is always up). Measured twilights "
        "differ by up to 0.9 mag between sites; the tables of the ground are for an average clear sky "
        "(visibility 40 km; 80 km is a scene's default) and, like the moonlit zenith's, without the Moon's "
        "brightening in opposition: at phase 0 theirs is of magnitude -12.73, ours -13.00";
    report.truth =
        "tests/data/night and tests/data/moon; the maps of starlight where `../shared/reference` has them";
    report.costs =
        "`light` is that of one direction, in shuffled order: of `seed`, `mean` and `sources` (with the "
        "belt), of `moon` and `sun` at the eye, from their tables; of the others outside the air, by their "
        "laws; of `stars` it is one star or planet worked out anew, when the sky has turned. `row` is one "
        "of the 56 rows of the night's table, four of which a frame makes while the sky turns; `map` the "
        "whole map of the belt; `dome` the glow of one town for one eye; `phase` the Moon's light by its "
        "phase.";
    report.floor = "a sky of one colour, looked up in the same directions";
    report.headline = {kLight, kAllRows, kLight};
    report.plots = {{"sources", "Light", kAllRows, {{"of one direction or star", kLight, kLight}}}};
    const std::vector<NightRow> rows = night_rows(truth, kReference);
    for (const NightModelText& model : kModels)
        report.models.push_back(
            {model.name, model.what, entries_of(model.name, rows), {}, {}, listed(model.name, rows)});
    return report;
}

std::vector<Contender> night_contenders() {
    std::vector<Contender> contenders;
    const auto still = every_light();
    add_whole_skies(still, contenders);
    add_diffuse_sources(contenders);
    add_milky_way(contenders);
    add_towns(contenders);
    contenders.push_back(star_contender());
    add_moon_and_sun(still, contenders);
    return contenders;
}

Work night_floor() {
    return one_colour_floor();
}

}  // namespace skyig::clients::bench
