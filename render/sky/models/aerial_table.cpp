#include "render/sky/models/aerial_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/sky/path.h"
#include "render/sky/phase.h"

namespace skyig::render::sky::models {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kLowestEyeM = 0.01;
constexpr double kFarthestEyeM = 1e9;
constexpr double kLeastKeptAway = 1e-12;

// How far things are followed: mountains beyond the horizon, some more for what is not on the ground.
constexpr double kBeyondHorizonM = 400e3;
constexpr double kMargin = 1.2;
// Height of the air that still counts, and depth below the model's ground that terrain may have.
constexpr double kAirM = 150e3;
constexpr double kDepthM = 1000.0;

glm::dvec3 rgb_of(const AirModel& model, const Lanes& transfer) {
    Spectrum part{};
    std::copy(std::begin(transfer.v), std::end(transfer.v), part.begin());
    return kRec709FromXyz * xyz_of_sunlight(model, part);
}

// Mean extinction of a surface in sunlight, from the optical depths up to a distance.
glm::dvec3 extinction_of(const AirModel& model, const glm::dvec3& white, const Lanes& depth,
                         double distance_m) {
    Lanes kept = depth;
    for (float& value : kept.v)
        value = -value;
    kernels().exponential(kept);
    Lanes away{};
    constexpr float kThin = 0.01F;
    for (int i = 0; i < kLanes; ++i) {
        const float x = depth.v[i];
        away.v[i] = x < kThin ? x * (1.0F - x * (0.5F - x * (1.0F / 6.0F))) : 1.0F - kept.v[i];
    }
    const glm::dvec3 part = glm::clamp(rgb_of(model, away) / white, 0.0, 1.0 - 1e-15);
    return {-std::log1p(-part.x) / distance_m, -std::log1p(-part.y) / distance_m,
            -std::log1p(-part.z) / distance_m};
}

glm::dvec3 kept_away(const glm::dvec3& extinction_per_m, double distance_m) {
    return {-std::expm1(-extinction_per_m.x * distance_m), -std::expm1(-extinction_per_m.y * distance_m),
            -std::expm1(-extinction_per_m.z * distance_m)};
}

AerialTable::Texel texel_of(const glm::dvec3& rgb) {
    return {static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z), 0.0F};
}

glm::dvec3 vector_of(const AerialTable::Texel& texel) {
    return {static_cast<double>(texel[0]), static_cast<double>(texel[1]), static_cast<double>(texel[2])};
}

// Of a coordinate 0..1 in `nodes`.
struct Between {
    int low;
    double part;

    Between(double coordinate, int nodes) {
        const double place = coordinate * (nodes - 1);
        low = std::clamp(static_cast<int>(place), 0, nodes - 2);
        part = place - low;
    }
};

double finite_or(double value, double otherwise) {
    return std::isfinite(value) ? value : otherwise;
}

double clean_height_m(double height_m) {
    return std::clamp(finite_or(height_m, kLowestEyeM), kLowestEyeM, kFarthestEyeM);
}

}  // namespace

AirBetween air_between(const SkySettings& settings, const AirTables& tables, const RayQuery& query) noexcept {
    if (settings.model == SkyModel::kWindlight) {
        WindlightSky sky;
        sky.begin(settings.windlight, tables, query.eye_height_m, query.source_elevation_rad);
        const WindlightBetween seen =
            sky.between(static_cast<float>(query.elevation_rad),
                        static_cast<float>(query.relative_azimuth_rad), static_cast<float>(query.distance_m));
        return {glm::dvec3(seen.passed_rgb), glm::dvec3(rec709_from_xyz(seen.added_xyz))};
    }
    RayQuery air = query;
    air.ground = false;
    const RayLight seen = ray_light(tables, air);
    const glm::dvec3 passed = glm::min(transmittance_rgb(tables.model(), seen.transmittance), 1.0);
    const glm::dvec3 marched = glm::min(transmittance_rgb(tables.model(), seen.diffuse_transmittance), 1.0);
    const glm::dvec3 share = (1.0 - passed) / glm::max(1.0 - marched, kLeastKeptAway);
    constexpr double kThin = 1e-5;
    const bool thin = glm::any(glm::lessThan(1.0 - marched, glm::dvec3(kThin)));
    return {passed, kRec709FromXyz * seen.xyz * (thin ? glm::dvec3(1.0) : share)};
}

struct AerialTable::March {
    std::array<PathStep, kDepths - 1> steps{};
    std::array<double, kDepths> boundaries_m{};
    std::array<glm::dvec3, kDepths> away{};  // part of light that the march has lost up to each
    std::array<Lanes, kColumns> light{};
    std::array<Lanes, kColumns> haze{};
};

AerialTable::AerialTable() : extinction_(std::size_t{kDepths} * kRows), march_(std::make_unique<March>()) {
    for (Colours& colours : colours_) {
        colours.rest.resize(std::size_t{kColumns} * kRows * kSlices);
        colours.haze.resize(colours.rest.size());
    }
}
AerialTable::~AerialTable() = default;
AerialTable::AerialTable(AerialTable&&) noexcept = default;
AerialTable& AerialTable::operator=(AerialTable&&) noexcept = default;

void AerialTable::begin(const SkySettings& settings, const AirTables& tables, double eye_height_m,
                        std::span<const double> source_elevations_rad) noexcept {
    air_ = tables.share();
    by_windlight_ = settings.model == SkyModel::kWindlight;
    eye_height_m_ = clean_height_m(eye_height_m);
    haze_g_ = air_->model.aerosol_g;
    light_count_ = std::min(source_elevations_rad.size(), kMaxLights);
    // The first light also gives `windlight` its extinction.
    for (std::size_t i = 0; i < std::max<std::size_t>(light_count_, 1); ++i) {
        Light& light = lights_[i];
        const double elevation = i < light_count_ ? source_elevations_rad[i] : -kHalfPi;
        light.elevation_rad = std::clamp(finite_or(elevation, -kHalfPi), -kHalfPi, kHalfPi);
        light.sine = std::sin(light.elevation_rad);
        light.cosine = std::cos(light.elevation_rad);
        if (by_windlight_)
            light.windlight.begin(settings.windlight, tables, eye_height_m_, light.elevation_rad);
    }
    lay_map();
    rows_done_ = 0;
}

void AerialTable::lay_map() noexcept {
    const Shell& shell = air_->shell;
    const double inside_m = std::min(eye_height_m_, shell.top_height_m);
    const double over_m = eye_height_m_ - inside_m;
    const double horizon_m = std::sqrt(shell.excess_m2(inside_m));
    map_.eye_radius_m = shell.ground_radius_m + eye_height_m_;
    map_.inside_radius_m = shell.ground_radius_m + inside_m;
    map_.outside_m2 = over_m * (map_.eye_radius_m + map_.inside_radius_m);
    map_.horizon_sine = -shell.dip_sine(inside_m);
    map_.scale = std::clamp(3000.0 / std::max(horizon_m, 1.0), 0.002, 0.01);
    map_.rise_m = kAirM;
    map_.fall_m = 2.0 * (inside_m + kDepthM);
    map_.longest_m = kMargin * (horizon_m + kBeyondHorizonM);
}

double AerialTable::row_sine(int row) const noexcept {
    const double place = 2.0 * row / (kRows - 1) - 1.0;
    const double range = place < 0.0 ? 1.0 + map_.horizon_sine : 1.0 - map_.horizon_sine;
    const double from = map_.scale * (std::exp2(std::abs(place) * std::log2(1.0 + range / map_.scale)) - 1.0);
    const double sine = std::clamp(map_.horizon_sine + (place < 0.0 ? -from : from), -1.0, 1.0);
    return map_.outside_m2 > 0.0 ? std::min(sine, 0.0) : sine;
}

double AerialTable::eye_sine(double sine) const noexcept {
    if (map_.outside_m2 <= 0.0) return sine;
    const double fall_m = map_.inside_radius_m * sine;
    return -std::min(1.0, std::sqrt(map_.outside_m2 + fall_m * fall_m) / map_.eye_radius_m);
}

bool AerialTable::build_rows(int max_rows) noexcept {
    if (!air_) return false;
    const int last = std::min(kRows, rows_done_ + std::max(0, max_rows));
    for (; rows_done_ < last; ++rows_done_)
        build_row(rows_done_);
    return rows_done_ == kRows;
}

void AerialTable::build_row(int row) noexcept {
    const double sine = row_sine(row);
    const double view_sine = eye_sine(sine);
    const double near_m = shaders64::aerial_place(view_sine, map_).near_m;
    const double far_m = shaders64::aerial_far_m(sine, map_);
    if (by_windlight_) {
        windlight_row(row, far_m, view_sine);
    } else {
        march_row(row, near_m, far_m, view_sine);
    }
}

void AerialTable::set_colour(std::size_t light, int row, int column, int slice, const glm::dvec3& rest_rgb,
                             const glm::dvec3& haze_rgb) noexcept {
    const auto at = static_cast<std::size_t>((slice * kRows + row) * kColumns + column);
    colours_[light].rest[at] = texel_of(rest_rgb);
    colours_[light].haze[at] = texel_of(haze_rgb);
}

const AerialTable::Texel& AerialTable::extinction_at(int row, int depth) const noexcept {
    return extinction_[static_cast<std::size_t>(row * kDepths + depth)];
}

void AerialTable::extinction_row(int row, double near_m) noexcept {
    const AirModel& model = air_->model;
    const Medium& medium = air_->medium;
    Lanes whole{};
    std::fill(std::begin(whole.v), std::end(whole.v), 1.0F);
    const glm::dvec3 white = rgb_of(model, whole);
    Lanes sharp{};
    Lanes diffuse{};
    for (int k = 0; k < kDepths - 1; ++k) {
        const PathStep& step = march_->steps[static_cast<std::size_t>(k)];
        for (int i = 0; i < kLanes; ++i) {
            const float clean = medium.rayleigh.v[i] * step.molecules + medium.ozone.v[i] * step.ozone;
            sharp.v[i] += step.length_m * (clean + medium.aerosol_extinction.v[i] * step.aerosol);
            diffuse.v[i] += step.length_m * (clean + medium.aerosol_diffuse_extinction.v[i] * step.aerosol);
        }
        const auto next = static_cast<std::size_t>(k) + 1;
        const double along_m = march_->boundaries_m[next] - near_m;
        extinction_[static_cast<std::size_t>(row * kDepths) + next] =
            texel_of(extinction_of(model, white, sharp, along_m));
        march_->away[next] = kept_away(extinction_of(model, white, diffuse, along_m), along_m);
    }
    extinction_[static_cast<std::size_t>(row * kDepths)] = extinction_at(row, 1);
}

void AerialTable::march_row(int row, double near_m, double far_m, double view_sine) noexcept {
    March& march = *march_;
    for (int i = 0; i < kDepths; ++i) {
        const double part = static_cast<double>(i) / (kDepths - 1);
        march.boundaries_m[static_cast<std::size_t>(i)] = near_m + far_m * part * part;
    }
    Path path{};
    path.steps = march.steps.data();
    lay_steps_between(*air_, eye_height_m_, view_sine, march.boundaries_m, path);
    kernels().weigh(air_->medium, path);
    extinction_row(row, near_m);

    const double level = std::sqrt(std::max(0.0, 1.0 - view_sine * view_sine));
    for (std::size_t light = 0; light < light_count_; ++light) {
        std::array<Source, kColumns> sources;  // NOLINT: filled at once
        for (int column = 0; column < kColumns; ++column) {
            const double half = static_cast<double>(column) / (kColumns - 1);
            const double cosine = std::clamp(
                view_sine * lights_[light].sine + level * lights_[light].cosine * (1.0 - 2.0 * half * half),
                -1.0, 1.0);
            sources[static_cast<std::size_t>(column)] = {lights_[light].sine, cosine,
                                                         static_cast<float>(rayleigh_phase(cosine))};
        }
        march.light.fill(Lanes{});
        march.haze.fill(Lanes{});
        march_to(path, 0, 1, sources);
        keep_slice(light, row, 0, 1);
        for (int slice = 1; slice < kSlices; ++slice) {
            march_to(path, std::max(1, (slice - 1) * kStepsASlice), slice * kStepsASlice, sources);
            keep_slice(light, row, slice, slice * kStepsASlice);
        }
    }
}

void AerialTable::march_to(const Path& path, int first_step, int last_step,
                           const std::array<Source, kColumns>& sources) noexcept {
    March& march = *march_;
    Path part = path;
    part.steps += first_step;
    part.count = last_step - first_step;
    for (std::size_t j = 0; j < kColumns; ++j) {
        kernels().add_first_order(air_->medium, air_->source_table(), part, sources[j], march.light[j],
                                  march.haze[j]);
    }
    if (air_->moments.empty()) return;
    kernels().add_higher_orders(air_->medium, air_->moment_table(), part, sources.data(), kColumns,
                                march.light.data());
}

void AerialTable::keep_slice(std::size_t light, int row, int slice, int depth) noexcept {
    const glm::dvec3 away = glm::max(march_->away[static_cast<std::size_t>(depth)], kLeastKeptAway);
    for (int column = 0; column < kColumns; ++column) {
        const auto j = static_cast<std::size_t>(column);
        set_colour(light, row, column, slice, rgb_of(air_->model, march_->light[j]) / away,
                   rgb_of(air_->model, march_->haze[j]) / away);
    }
}

void AerialTable::windlight_row(int row, double far_m, double view_sine) noexcept {
    const auto elevation = static_cast<float>(std::asin(std::clamp(view_sine, -1.0, 1.0)));
    for (int depth = 0; depth < kDepths; ++depth) {
        const double part = static_cast<double>(std::max(depth, 1)) / (kDepths - 1);
        const double along_m = far_m * part * part;
        const glm::dvec3 passed(
            lights_[0].windlight.between(elevation, 0.0F, static_cast<float>(along_m)).passed_rgb);
        extinction_[static_cast<std::size_t>(row * kDepths + depth)] =
            texel_of(-glm::log(glm::max(passed, 1e-30)) / along_m);
    }
    for (std::size_t light = 0; light < light_count_; ++light) {
        for (int column = 0; column < kColumns; ++column) {
            const double azimuth = 2.0 * std::asin(static_cast<double>(column) / (kColumns - 1));
            const WindlightBetween whole = lights_[light].windlight.between(
                elevation, static_cast<float>(azimuth), static_cast<float>(far_m));
            const glm::dvec3 away = glm::max(1.0 - glm::dvec3(whole.passed_rgb), kLeastKeptAway);
            const glm::dvec3 colour = glm::dvec3(rec709_from_xyz(whole.added_xyz)) / away;
            for (int slice = 0; slice < kSlices; ++slice)
                set_colour(light, row, column, slice, colour, glm::dvec3(0.0));
        }
    }
}

AirBetween AerialTable::between(double elevation_rad, double relative_azimuth_rad, double distance_m,
                                std::size_t light) const noexcept {
    if (!air_ || !std::isfinite(elevation_rad) || !std::isfinite(relative_azimuth_rad) ||
        !(distance_m > 0.0)) {
        return {};
    }
    const double elevation = std::clamp(elevation_rad, -kHalfPi, kHalfPi);
    const double view_sine = std::sin(elevation);
    const shaders64::AerialPlace place = shaders64::aerial_place(view_sine, map_);
    if (!place.meets_air || distance_m <= place.near_m) return {};
    const double far_m = shaders64::aerial_far_m(place.sine, map_);
    const double along_m = std::min(distance_m - place.near_m, far_m);
    const double azimuth_cosine = std::cos(relative_azimuth_rad);
    const double slice = shaders64::aerial_slice(along_m, far_m);
    const Between row(shaders64::aerial_row(place.sine, map_), kRows);
    const Between depth(slice, kDepths);
    const Between column(shaders64::aerial_column(azimuth_cosine), kColumns);
    const Between layer(slice, kSlices);

    glm::dvec3 extinction(0.0);
    glm::dvec3 rest(0.0);
    glm::dvec3 haze(0.0);
    for (int r = 0; r < 2; ++r) {
        const double by_row = r == 0 ? 1.0 - row.part : row.part;
        for (int d = 0; d < 2; ++d) {
            extinction += by_row * (d == 0 ? 1.0 - depth.part : depth.part) *
                          vector_of(extinction_at(row.low + r, depth.low + d));
            for (int c = 0; light < light_count_ && c < 2; ++c) {
                const double weight = by_row * (d == 0 ? 1.0 - layer.part : layer.part) *
                                      (c == 0 ? 1.0 - column.part : column.part);
                const auto at = static_cast<std::size_t>(((layer.low + d) * kRows + row.low + r) * kColumns +
                                                         column.low + c);
                rest += weight * vector_of(colours_[light].rest[at]);
                haze += weight * vector_of(colours_[light].haze[at]);
            }
        }
    }
    const glm::dvec3 away = kept_away(extinction, along_m);
    if (light >= light_count_) return {1.0 - away, glm::dvec3(0.0)};
    const double cosine =
        view_sine * lights_[light].sine + std::cos(elevation) * lights_[light].cosine * azimuth_cosine;
    const double phase = shaders64::aerial_haze_phase(haze_g_, std::clamp(cosine, -1.0, 1.0));
    return {1.0 - away, away * (rest + phase * haze)};
}

}  // namespace skyig::render::sky::models
