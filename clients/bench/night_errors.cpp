#include "clients/bench/night_errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "clients/bench/truth_table.h"
#include "render/eye/point_threshold.h"
#include "render/geometry.h"
#include "render/night/airglow.h"
#include "render/night/milky_way_map.h"
#include "render/night/moon_light.h"
#include "render/night/star_colour.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"
#include "render/still_light.h"

namespace skyig::clients::bench {

namespace {

namespace night = render::night;
using render::NightModel;
using render::Scene;
using render::StillLight;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr const char* kMoonless = "moonless night";
/// The Moon's tables leave its brightening in opposition out.
constexpr double kSurge_deg = 7.0;

double magnitudes(double ours, double known) {
    return -2.5 * std::log10(ours / known);
}

glm::dvec3 towards(double elevation_deg) {
    return render::direction_of({elevation_deg * kDegree, 0.0});
}

/// Rows are added to one vector, table by table; what has not the unit "mag" is compared as a ratio.
class Rows {
  public:
    explicit Rows(std::filesystem::path folder) : folder_(std::move(folder)) {}

    struct Values {
        const char* unit;
        double known;
        double ours;
    };
    void add(std::string_view model, std::string_view cases, std::string_view row, const Values& values) {
        const double off_mag = std::string_view(values.unit) == "mag" ? values.ours - values.known
                                                                      : magnitudes(values.ours, values.known);
        rows_.push_back({std::string(model), std::string(cases), std::string(row), values.unit, values.known,
                         values.ours, off_mag});
    }
    [[nodiscard]] TruthTable table(const char* name) const { return TruthTable(folder_ / name); }
    [[nodiscard]] std::vector<NightRow> take() { return std::move(rows_); }

  private:
    std::filesystem::path folder_;
    std::vector<NightRow> rows_;
};

/// A site without Sun or Moon; the dark sky at its means.
Scene mean_night() {
    Scene scene;
    scene.sun.direction_enu = towards(-40.0);
    scene.moon.direction_enu = towards(-40.0);
    scene.night.model = NightModel::kMean;
    return scene;
}

double anchor(const TruthTable& table, std::string_view name) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.text(row, "case") == name) return table.number(row, "luminance_cd_m2_or_lux");
    }
    throw std::runtime_error(fmt::format("natural_night.csv: no case '{}'", name));
}

void add_sources(const TruthTable& known, Rows& rows) {
    const auto add = [&](std::string_view model, std::string_view name, double ours_cd_m2) {
        rows.add(model, kMoonless, name, {"cd/m2", anchor(known, name), ours_cd_m2});
    };
    add("airglow", "airglow zenith solar minimum",
        night::kS10_cd_m2 * night::airglow_zenith_s10(0.0) * night::airglow_path(0.5 * kPi, 0.0, false).far);
    const auto zodiacal = [](double longitude_deg, double latitude_deg) {
        return night::kS10_cd_m2 * night::zodiacal_s10(longitude_deg * kDegree, latitude_deg * kDegree);
    };
    add("zodiacal", "ecliptic pole zodiacal only", zodiacal(90.0, 90.0));
    add("zodiacal", "gegenschein zodiacal only", zodiacal(180.0, 0.0));
    add("zodiacal", "zodiacal cone 45 deg from the Sun on the ecliptic", zodiacal(45.0, 0.0));
    const night::Starlight pole = night::starlight_s10(0.0, 0.5 * kPi);
    add("starlight", "galactic pole starlight only", night::kS10_cd_m2 * (pole.even + pole.belt));
    night::MilkyWayMap map;
    map.begin(1.0, 1);
    map.build_rows(night::MilkyWayMap::kHeight);
    // The measurements' resolution is about 2 deg.
    add("milky-way", "Milky Way l=0 b=-4",
        night::mean_starlight_cd_m2(map, 0.0, -4.0 * kDegree, 2.0 * kDegree));
}

/// The eye stands in the middle of the town.
void add_towns(const TruthTable& known, StillLight& light, Rows& rows) {
    Scene scene = mean_night();
    light.settle(scene);
    const double natural_cd_m2 = light.zenith_cd_m2();
    scene.night.city_count = 1;
    for (const char* name : {"Bortle 4 rural zenith", "Bortle 6 suburban zenith", "Bortle 8 city zenith"}) {
        const double known_cd_m2 = anchor(known, name);
        scene.night.cities[0].zenith_cd_m2 = known_cd_m2 - natural_cd_m2;
        light.settle(scene);
        rows.add("towns", "zenith of towns", name, {"cd/m2", known_cd_m2, light.zenith_cd_m2()});
    }
}

/// Hours of nights through the year from both hemispheres, for the zenith those with the Milky Way away from
/// it: a typical sky is not that of midnights alone, which all have the gegenschein up. Of the models without
/// places they are all alike.
void add_whole_skies(const TruthTable& known, StillLight& light, Rows& rows) {
    constexpr int kNights = 12;
    constexpr std::array kHours{-3.0, 0.0, 3.0};  // from midnight
    constexpr int kSkies = kNights * static_cast<int>(kHours.size());
    const double zenith_cd_m2 = anchor(known, "natural zenith dark site typical");
    const double ground_lux = anchor(known, "horizontal illuminance clear moonless natural");
    for (const NightModel model : {NightModel::kSeed, NightModel::kMean, NightModel::kSources}) {
        const int skies = model == NightModel::kSources ? kSkies : 1;
        double zenith_mag = 0.0;
        double ground_mag = 0.0;
        int zeniths = 0;
        for (int i = 0; i < skies; ++i) {
            const int night = i % kNights;
            Scene scene = dark_hour((night % 2 == 0 ? 30.0 : -30.0) * kDegree, 2.0 * kPi * night / kNights,
                                    kHours[static_cast<std::size_t>(i / kNights)]);
            scene.night.model = model;
            light.settle(scene);
            ground_mag += magnitudes(light.sky_lux(), ground_lux) / skies;
            const glm::dvec3 galactic =
                night::galactic_from_gcrs() * glm::transpose(scene.stars.enu_from_gcrs)[2];
            if (model == NightModel::kSources && std::abs(galactic.z) < std::sin(night::kBelt_rad)) continue;
            zenith_mag += magnitudes(light.zenith_cd_m2(), zenith_cd_m2);
            ++zeniths;
        }
        const std::string_view name = render::kNightModelNames[static_cast<std::size_t>(model)];
        const auto mean = [](double level, double off_mag) { return level * std::pow(10.0, -0.4 * off_mag); };
        rows.add(name, "moonless zenith", "mean",
                 {"cd/m2", zenith_cd_m2, mean(zenith_cd_m2, zenith_mag / zeniths)});
        rows.add(name, "ground, moonless", "mean", {"lux", ground_lux, mean(ground_lux, ground_mag)});
    }
}

void add_zodiacal_map(Rows& rows) {
    const TruthTable table = rows.table("zodiacal_s10.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double longitude_rad = table.number(row, "dlon_deg") * kDegree;
        for (const int b_deg : {0, 5, 10, 15, 20, 25, 30, 45, 60, 75, 90}) {
            const std::string column = fmt::format("b{}", b_deg);
            if (table.text(row, column).empty()) continue;  // too near to the Sun to be measured
            rows.add("zodiacal", "map of the zodiacal light", "",
                     {"S10", table.number(row, column), night::zodiacal_s10(longitude_rad, b_deg * kDegree)});
        }
    }
}

void add_starlight_map(const std::filesystem::path& path, Rows& rows) {
    if (!std::filesystem::exists(path)) return;
    const TruthTable table(path);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        for (int l_deg = 0; l_deg < 360; l_deg += 10) {
            const night::Starlight light =
                night::starlight_s10(l_deg * kDegree, table.number(row, "b_deg") * kDegree);
            rows.add("starlight", "maps of Pioneer 10 and 11", "",
                     {"S10", table.number(row, fmt::format("l{}", l_deg)), light.even + light.belt});
        }
    }
}

void add_limiting_magnitudes(Rows& rows) {
    const TruthTable table = rows.table("limiting_magnitude.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double background_cd_m2 = table.number(row, "background_cd_m2");
        rows.add(
            "stars", "limiting magnitude", fmt::format("before {:.3g} cd/m2", background_cd_m2),
            {"mag", table.number(row, "limit_V_mag"),
             magnitudes(render::eye::threshold_lux(background_cd_m2), night::star_illuminance_lux(0.0))});
    }
}

void add_moon_magnitudes(const TruthTable& table, Rows& rows) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double phase_deg = table.number(row, "phase_angle_deg");
        const auto lux = [phase_rad = phase_deg * kDegree](double side) {
            return night::moon_illuminance_lux(phase_rad, 384400.0, side * phase_rad);
        };
        const double ours_mag = magnitudes(0.5 * (lux(1.0) + lux(-1.0)), night::star_illuminance_lux(0.0));
        const std::string phase = fmt::format("phase {:g} deg", phase_deg);
        if (phase_deg >= kSurge_deg && phase_deg <= 150.0)
            rows.add("moon", "magnitude by Allen, 7..150 deg", phase,
                     {"mag", table.number(row, "V_allen"), ours_mag});
        // Where the law was measured.
        if (phase_deg <= 97.0)
            rows.add("moon", "magnitude by ROLO, 0..97 deg", phase,
                     {"mag", table.number(row, "V_rolo550"), ours_mag});
    }
}

std::string moon_row(const TruthTable& table, std::size_t row) {
    return fmt::format("phase {} deg, Moon at {} deg", table.text(row, "phase_angle_deg"),
                       table.text(row, "moon_alt_deg"));
}

void add_moonlit_zenith(StillLight& light, Rows& rows) {
    const TruthTable table = rows.table("moonlit_zenith_sky.csv");
    Scene scene = mean_night();
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double phase_deg = table.number(row, "phase_angle_deg");
        scene.moon.direction_enu = towards(table.number(row, "moon_alt_deg"));
        scene.moon.phase_angle_rad = phase_deg * kDegree;
        light.settle(scene);
        rows.add("moon", phase_deg < kSurge_deg ? "moonlit zenith, opposition" : "moonlit zenith",
                 moon_row(table, row), {"cd/m2", table.number(row, "total_cd_m2"), light.zenith_cd_m2()});
    }
}

void add_moonlit_ground(StillLight& light, Rows& rows) {
    const TruthTable table = rows.table("moon_ground_illuminance.csv");
    Scene scene = mean_night();
    scene.air.visibility_m = 40e3;
    scene.night.airglow = scene.night.zodiacal = false;
    scene.night.starlight = scene.night.galactic_light = false;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double phase_deg = table.number(row, "phase_angle_deg");
        if (phase_deg < kSurge_deg) continue;
        scene.moon.direction_enu = towards(table.number(row, "moon_alt_deg"));
        scene.moon.phase_angle_rad = phase_deg * kDegree;
        light.settle(scene);
        rows.add("moon", phase_deg > 120.0 ? "ground, Moon beyond 120 deg" : "ground, Moon of 7..120 deg",
                 moon_row(table, row),
                 {"lux", table.number(row, "E_h_lux"), light.sky_lux() + light.moon_lux()});
    }
}

void add_twilight(StillLight& light, Rows& rows) {
    const TruthTable table = rows.table("twilight_sky_luminance.csv");
    Scene scene = mean_night();
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double sun_deg = table.number(row, "sun_alt_deg");
        if (table.text(row, "view") != "zenith" || sun_deg > 0.0) continue;
        // "Paranal 2635 m 2005"
        const std::string& site = table.text(row, "site");
        const auto unit = site.find(" m ");
        const auto height = unit == std::string::npos ? unit : site.rfind(' ', unit - 1);
        if (height == std::string::npos)
            throw std::runtime_error(fmt::format("twilight_sky_luminance.csv: no height in '{}'", site));
        scene.eye.height_m = std::strtod(site.c_str() + height, nullptr);
        scene.sun.direction_enu = towards(sun_deg);
        light.settle(scene);
        rows.add("sun", "twilight zenith", fmt::format("Sun at {:g} deg, {}", sun_deg, site),
                 {"cd/m2", table.number(row, "luminance_cd_m2"), light.zenith_cd_m2()});
    }
}

void add_sunlit_ground(double visibility_m, StillLight& light, Rows& rows) {
    const TruthTable table = rows.table("sun_ground_illuminance.csv");
    Scene scene = mean_night();
    scene.air.visibility_m = visibility_m;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double sun_deg = table.number(row, "sun_alt_deg");
        scene.sun.direction_enu = towards(sun_deg);
        light.settle(scene);
        rows.add("sun",
                 fmt::format("ground, Sun {} -6 deg, visibility {:g} km", sun_deg >= -6.0 ? "above" : "below",
                             1e-3 * visibility_m),
                 fmt::format("Sun at {:g} deg", sun_deg),
                 {"lux", table.number(row, "E_h_lux"), light.sky_lux() + light.sun_lux()});
    }
}

}  // namespace

Scene dark_hour(double latitude_rad, double sun_longitude_rad, double from_midnight_h) {
    constexpr double kObliquity_rad = 23.44 * kDegree;
    const glm::dvec3 sun{std::cos(sun_longitude_rad), std::sin(sun_longitude_rad) * std::cos(kObliquity_rad),
                         std::sin(sun_longitude_rad) * std::sin(kObliquity_rad)};
    Scene scene;
    scene.eye.latitude_deg = latitude_rad / kDegree;
    scene.stars.enu_from_gcrs = render::enu_from_equatorial(
        latitude_rad, std::atan2(sun.y, sun.x) + kPi * (1.0 + from_midnight_h / 12.0));
    scene.sun.direction_enu = scene.stars.enu_from_gcrs * sun;
    return scene;
}

std::vector<NightRow> night_rows(const std::filesystem::path& truth, const std::filesystem::path& reference) {
    Rows rows(truth / "night");
    const TruthTable natural = rows.table("natural_night.csv");
    StillLight clear;
    add_whole_skies(natural, clear, rows);
    add_sources(natural, rows);
    add_zodiacal_map(rows);
    add_starlight_map(reference / "night" / "starlight_pioneer_s10.csv", rows);
    add_towns(natural, clear, rows);
    add_limiting_magnitudes(rows);
    add_moon_magnitudes(TruthTable(truth / "moon" / "moon_magnitude_phase.csv"), rows);
    add_moonlit_zenith(clear, rows);
    add_twilight(clear, rows);
    add_sunlit_ground(80e3, clear, rows);
    StillLight average;
    add_moonlit_ground(average, rows);
    add_sunlit_ground(40e3, average, rows);
    return rows.take();
}

}  // namespace skyig::clients::bench
