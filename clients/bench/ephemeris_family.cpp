#include "clients/bench/ephemeris_family.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/bench/truth_table.h"
#include "clients/body_name.h"
#include "clients/row_time.h"
#include "server/ephemeris/earth_orientation.h"
#include "server/ephemeris/places.h"
#include "server/ephemeris/sky_clockwork.h"
#include "server/ephemeris/sky_state.h"
#include "server/ephemeris/theory/theory.h"

namespace skyig::clients::bench {

namespace {

using namespace server::ephemeris;

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
constexpr double kArcsecPerRad = 3600.0 / kRadPerDegree;
constexpr double kSecondsPerDay = 86400.0;

constexpr std::array<Model, 3> kModels{Model::kAlmanac, Model::kErfa, Model::kSeries};
constexpr std::array<const char*, 3> kWhat{
    "low-precision formulas of the Astronomical Almanac, planets on slowly turning Kepler ellipses",
    "the theories of the ERFA library: epv00, moon98, plan94",
    "epv00, ELP/MPP02 terms of at least 0.01 arcsec, VSOP87B terms of at least 1e-7 rad"};

constexpr const char* kWhole = "1900-2100";
constexpr const char* kInner = "1950-2050";
constexpr double kInnerFrom_jd = 2433282.5;
constexpr double kInnerTo_jd = 2469807.5;

/// What the row of a truth table asks, and its answer.
struct Case {
    Body body = Body::kSun;
    Instant instant;
    Geodetic eye;
    /// Topocentric cases east-north-up; geocentric ones in the true equator and equinox of date.
    bool topocentric = false;
    glm::dvec3 truth{0.0};
};

glm::dvec3 unit_vector(double longitude_deg, double latitude_deg) {
    const double longitude_rad = longitude_deg * kRadPerDegree;
    const double latitude_rad = latitude_deg * kRadPerDegree;
    return {std::cos(latitude_rad) * std::cos(longitude_rad),
            std::cos(latitude_rad) * std::sin(longitude_rad), std::sin(latitude_rad)};
}

/// Throws std::runtime_error when the field is none.
Body body_in(const TruthTable& table, std::size_t row) {
    const std::string& text = table.text(row, "body");
    if (const std::optional<Body> body = parse_body(text)) return *body;
    throw std::runtime_error(fmt::format("ephemeris truth: there is no body '{}'", text));
}

Instant instant_in(const TruthTable& table, std::size_t row, const char* column, TimeForm form,
                   const RowOffsets& offsets = {}) {
    const std::string& text = table.text(row, column);
    if (const std::optional<Instant> instant = parse_row_time(text, form, offsets)) return *instant;
    throw std::runtime_error(fmt::format("ephemeris truth: {} '{}' is no time", column, text));
}

void add_geocentric(std::vector<Case>& cases, const TruthTable& table) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Case asked;
        asked.body = body_in(table, row);
        asked.instant = instant_in(table, row, "jd_tt", TimeForm::kTtJulianDate);
        asked.truth = unit_vector(table.number(row, "ra_app_deg"), table.number(row, "dec_app_deg"));
        cases.push_back(asked);
    }
}

void add_topocentric(std::vector<Case>& cases, const TruthTable& table) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Case asked;
        asked.topocentric = true;
        asked.body = body_in(table, row);
        asked.instant = instant_in(table, row, "utc", TimeForm::kUtc,
                                   {.tt_minus_utc_s = table.number(row, "tt_minus_utc_s"),
                                    .ut1_minus_utc_s = table.number(row, "ut1_minus_utc_s")});
        asked.eye = {table.number(row, "lat_deg"), table.number(row, "lon_deg"), table.number(row, "h_m")};
        // Azimuth runs from north through east.
        asked.truth = unit_vector(90.0 - table.number(row, "az_deg"), table.number(row, "el_deg"));
        cases.push_back(asked);
    }
}

glm::dvec3 answer(const Case& asked, Model model) {
    if (asked.topocentric)
        return apparent_place(compute_sky_state(asked.instant, asked.eye, model), asked.body).direction;
    return compute_geocentric(asked.instant.tt, model).of(asked.body).direction;
}

/// Errors of each body and of all together, over both spans.
std::vector<ErrorEntry> errors_of(const std::vector<Case>& cases, Model model) {
    std::array<std::array<ErrorSamples, kBodyCount + 1>, 2> samples;
    for (const Case& asked : cases) {
        const double error_arcsec = kArcsecPerRad * angle_between_rad(answer(asked, model), asked.truth);
        const double jd = asked.instant.tt.day + asked.instant.tt.fraction;
        const std::size_t spans = jd >= kInnerFrom_jd && jd < kInnerTo_jd ? 2 : 1;
        for (std::size_t span = 0; span < spans; ++span) {
            samples[span][index_of(asked.body)].add(error_arcsec);
            samples[span][kBodyCount].add(error_arcsec);
        }
    }
    std::vector<ErrorEntry> entries;
    for (std::size_t span = 0; span < 2; ++span) {
        for (std::size_t i = 0; i <= kBodyCount; ++i) {
            const std::string quantity = i < kBodyCount ? std::string(kBodyNames[i]) : "all bodies";
            entries.push_back({quantity, span == 0 ? kWhole : kInner, "arcsec", samples[span][i].figures()});
        }
    }
    return entries;
}

constexpr std::size_t kInstants = 256;

/// What a picture is asked for: the clock's UTC and the eye. `instants` for who is asked for theories alone.
struct Frames {
    std::array<UtcClockTime, kInstants> utcs;
    std::array<Instant, kInstants> instants;
    std::array<Geodetic, kInstants> eyes;
};

/// Random times of 1900-2100.
std::shared_ptr<const Frames> random_frames() {
    constexpr double kFirstDay_unix = -25'567.0;
    constexpr double kDays = 73'400.0;
    std::mt19937 random(1900);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    auto frames = std::make_shared<Frames>();
    for (std::size_t i = 0; i < kInstants; ++i) {
        const double days = kFirstDay_unix + kDays * part(random);
        frames->utcs[i] = UtcClockTime::from_unix(static_cast<std::int64_t>(days * kSecondsPerDay));
        frames->utcs[i].advance(part(random));
        frames->instants[i] = make_instant(frames->utcs[i]);
        frames->eyes[i] = {180.0 * part(random) - 90.0, 360.0 * part(random) - 180.0,
                           12'000.0 * part(random)};
    }
    return frames;
}

/// Four seconds of frames at 60 Hz, all within one interval of knots, above an aircraft that moves on.
std::shared_ptr<const Frames> steady_frames() {
    auto frames = std::make_shared<Frames>();
    for (std::size_t i = 0; i < kInstants; ++i) {
        const double time_s = static_cast<double>(i) / 60.0;
        frames->utcs[i] = parse_utc("2024-01-01T00:00:00Z").value();
        frames->utcs[i].advance(time_s);
        frames->instants[i] = make_instant(frames->utcs[i]);
        frames->eyes[i] = {64.0 + 2e-3 * time_s, -22.0, 11'000.0};
    }
    return frames;
}

/// How far the clockwork's states are from those without knots, all bodies.
ErrorEntry cache_error(Model model) {
    const auto frames = random_frames();
    SkyClockwork clockwork(model);
    ErrorSamples samples;
    for (std::size_t i = 0; i < kInstants; ++i) {
        const SkyState cached = clockwork.state(frames->instants[i], frames->eyes[i]);
        const SkyState exact = compute_sky_state(frames->instants[i], frames->eyes[i], model);
        for (const Body body : kBodies)
            samples.add(kArcsecPerRad * angle_between_rad(apparent_place(cached, body).direction,
                                                          apparent_place(exact, body).direction));
    }
    return {"added by knots", "random times of 1900-2100", "arcsec", samples.figures()};
}

double sum_of(const SkyState& state) {
    double sum = state.sun.direction_enu.x + state.moon.direction_enu.x + state.enu_from_gcrs[0].x;
    for (const PlanetState& planet : state.planets)
        sum += planet.direction_enu.x;
    return sum;
}

/// As many days of Earth orientation as the IERS has published since 1973, smooth ones.
EarthOrientation measured_days() {
    constexpr int kDays = 19'000;
    constexpr double kFirst_mjd = 41'684.0;
    std::vector<EarthOrientationRow> rows;
    for (int day = 0; day < kDays; ++day) {
        const double mjd = kFirst_mjd + day;
        rows.push_back({.mjd = mjd,
                        .ut1_minus_utc_s = 0.3 * std::sin(0.001 * mjd),
                        .x_arcsec = 0.2 * std::cos(0.0145 * mjd),
                        .y_arcsec = 0.3});
    }
    return EarthOrientation(rows);
}

/// What the daemon does once a picture: time scales, Earth orientation, state.
Work state_work(Model model, std::shared_ptr<const Frames> frames) {
    return repeat([frames = std::move(frames), orientation = measured_days(), offsets = OffsetsOfDay(),
                   clockwork = SkyClockwork(model)](std::uint64_t i) mutable {
        const std::size_t frame = i % kInstants;
        const UtcClockTime& utc = frames->utcs[frame];
        const KnownOffsets known = offsets.at(utc);
        const Instant instant = make_instant(utc, known, orientation.at(utc, known));
        return sum_of(clockwork.state(instant, frames->eyes[frame]));
    });
}

template <class Theory>
Work theory_work(const std::shared_ptr<const Frames>& frames, Theory theory) {
    return repeat([frames, theory](std::uint64_t i) {
        return theory(frames->instants[i % kInstants].tt).position_km.x;
    });
}

Work sun_theory(Model model, const std::shared_ptr<const Frames>& frames) {
    if (model == Model::kAlmanac)
        return theory_work(frames,
                           [](const JulianDate& tt) { return theory::earth_almanac(tt).heliocentric; });
    return theory_work(frames, [](const JulianDate& tt) { return theory::earth_epv00(tt).heliocentric; });
}

Work moon_theory(Model model, const std::shared_ptr<const Frames>& frames) {
    switch (model) {
        case Model::kAlmanac:
            return theory_work(frames, theory::moon_almanac);
        case Model::kErfa:
            return theory_work(frames, theory::moon_moon98);
        case Model::kSeries:
            break;
    }
    return theory_work(frames, theory::moon_elpmpp02);
}

Work planet_theory(Model model, Body planet, const std::shared_ptr<const Frames>& frames) {
    switch (model) {
        case Model::kAlmanac:
            return theory_work(
                frames, [planet](const JulianDate& tt) { return theory::planet_elements(planet, tt); });
        case Model::kErfa:
            return theory_work(frames,
                               [planet](const JulianDate& tt) { return theory::planet_plan94(planet, tt); });
        case Model::kSeries:
            break;
    }
    return theory_work(frames, [planet](const JulianDate& tt) { return theory::planet_vsop87(planet, tt); });
}

Work theory_of(Model model, Body body, const std::shared_ptr<const Frames>& frames) {
    if (body == Body::kSun) return sun_theory(model, frames);
    if (body == Body::kMoon) return moon_theory(model, frames);
    return planet_theory(model, body, frames);
}

/// z - x - z rotation of three angles.
glm::dmat3 rotation(const glm::dvec3& angles_rad) {
    const glm::dvec3 c = glm::cos(angles_rad);
    const glm::dvec3 s = glm::sin(angles_rad);
    const glm::dmat3 first{c.x, -s.x, 0.0, s.x, c.x, 0.0, 0.0, 0.0, 1.0};
    const glm::dmat3 second{1.0, 0.0, 0.0, 0.0, c.y, -s.y, 0.0, s.y, c.y};
    const glm::dmat3 third{c.z, -s.z, 0.0, s.z, c.z, 0.0, 0.0, 0.0, 1.0};
    return third * second * first;
}

}  // namespace

Report measure_ephemeris_errors(const std::filesystem::path& truth) {
    std::vector<Case> cases;
    add_geocentric(cases, TruthTable(truth / "ephemeris" / "geo_truth.csv"));
    add_topocentric(cases, TruthTable(truth / "ephemeris" / "topo_truth.csv"));
    Report report;
    report.family = "ephemeris";
    report.title = "Places of Sun, Moon and planets";
    report.cases =
        "apparent places, geocentric at random times and topocentric at sites from pole to pole, from -430 m "
        "to FL600; angles on the sky between the model's direction and the truth's, without refraction. "
        "`added by "
        "knots` is the angle between states with and without interpolation, all bodies";
    report.truth =
        "`geo_truth.csv` and `topo_truth.csv` of tests/data/ephemeris: DE441 through ERFA with IAU "
        "2006/2000A, "
        "0.001 arcsec class";
    report.costs =
        "`frame` is a picture's whole state in steady state, from the clock's UTC through half a century of "
        "daily Earth orientation to all bodies and the star matrix, another time and place each time, "
        "between "
        "two knots. `jump` is the same at a time unlike the one before: the two "
        "knots "
        "around it are evaluated anew. A body's name stands for its theory alone, position and velocity; the "
        "Sun's gives the Earth's motion for all bodies.";
    report.floor =
        "a sky that only turns: three angles from memory, the matrix of their rotations, seven vectors "
        "turned "
        "by it";
    report.headline = {"all bodies", kWhole, "frame", "jump"};
    Plot theories{"theories", "Theories", kWhole, {}};
    for (const std::string_view body : kBodyNames)
        theories.series.push_back({std::string(body), std::string(body), std::string(body)});
    Plot states{"states",
                "Whole state",
                kWhole,
                {{"frame, all bodies", "all bodies", "frame"},
                 {"jump, all bodies", "all bodies", "jump"},
                 {"jump, sun", "sun", "jump"},
                 {"jump, moon", "moon", "jump"}}};
    report.plots = {std::move(theories), std::move(states)};
    for (const Model model : kModels) {
        const auto i = static_cast<std::size_t>(model);
        report.models.push_back({std::string(kModelNames[i]), kWhat[i], errors_of(cases, model), {}});
        report.models.back().errors.push_back(cache_error(model));
    }
    return report;
}

std::vector<Contender> ephemeris_contenders() {
    const auto random = random_frames();
    const auto steady = steady_frames();
    std::vector<Contender> contenders;
    for (const Model model : kModels) {
        const std::string name(kModelNames[static_cast<std::size_t>(model)]);
        contenders.push_back({name, "frame", state_work(model, steady)});
        contenders.push_back({name, "jump", state_work(model, random)});
        for (const Body body : kBodies)
            contenders.push_back({name, std::string(name_of(body)), theory_of(model, body, random)});
    }
    return contenders;
}

Work ephemeris_floor() {
    constexpr std::size_t kAngles = 64;
    std::array<glm::dvec3, kAngles> angles_rad;
    std::array<glm::dvec3, kBodyCount> directions;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0.0, 2.0 * std::numbers::pi);
    for (glm::dvec3& angle_rad : angles_rad)
        angle_rad = {part(random), part(random), part(random)};
    for (glm::dvec3& direction : directions)
        direction = glm::normalize(glm::dvec3(part(random), part(random), part(random)));
    return repeat([angles_rad, directions](std::uint64_t i) {
        const glm::dmat3 turned_from_fixed = rotation(angles_rad[i % kAngles]);
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& direction : directions)
            sum += turned_from_fixed * direction;
        return sum.x + sum.y + sum.z;
    });
}

}  // namespace skyig::clients::bench
