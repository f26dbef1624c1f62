#include "render/sky/sky_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "render/sky/azimuth.h"
#include "render/sky/direction_grid.h"
#include "render/sky/path.h"
#include "render/sky/phase.h"

namespace skyig::render::sky {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kLowestEyeM = 0.01;

// From high up the air ends at an edge above the horizon: rows up to `edge_w` lie between the two, quadratic
// at both, since paths grow with the root of the angle from the edge as well; the rest lies above it.
struct EdgedRows {
    double edge_rad = 1.0;
    double edge_w = 1.0;
    Progression above{};

    [[nodiscard]] double angle_rad(double w) const noexcept {
        if (w > edge_w) return edge_rad + above.angle_rad((w - edge_w) / (1.0 - edge_w));
        const double sine = std::sin(kHalfPi * w / edge_w);
        return edge_rad * sine * sine;
    }
    [[nodiscard]] float w(float angle_rad) const noexcept {
        const auto edge = static_cast<float>(edge_rad);
        const auto w_there = static_cast<float>(edge_w);
        if (angle_rad > edge) return w_there + (1.0F - w_there) * above.w(angle_rad - edge);
        return w_there * std::asin(std::sqrt(angle_rad / edge)) / static_cast<float>(kHalfPi);
    }
};

// One turns into the other as the eye climbs, so that nowhere a metre of height moves the rows.
struct RowMap {
    Progression low{};
    EdgedRows high{};
    double high_share = 0.0;

    [[nodiscard]] double range_rad() const noexcept { return low.range_rad; }
    [[nodiscard]] double angle_rad(double w) const noexcept {
        if (high_share <= 0.0) return low.angle_rad(w);
        return (1.0 - high_share) * low.angle_rad(w) + high_share * high.angle_rad(w);
    }
    [[nodiscard]] float w(float angle_rad) const noexcept {
        if (high_share <= 0.0) return low.w(angle_rad);
        if (high_share >= 1.0) return high.w(angle_rad);
        double below = 0.0;
        double above = 1.0;
        for (int i = 0; i < 20; ++i) {
            const double middle = 0.5 * (below + above);
            (this->angle_rad(middle) < static_cast<double>(angle_rad) ? below : above) = middle;
        }
        const double first = this->angle_rad(below);
        const double step = this->angle_rad(above) - first;
        const double part =
            step > 0.0 ? std::clamp((static_cast<double>(angle_rad) - first) / step, 0.0, 1.0) : 0.0;
        return static_cast<float>(below + part * (above - below));
    }
};

// Where light breaks off, at a limb in the Earth's shadow, the cubic swings below nothing in one component
// and not in another: no colour any more. It gives way to the straight lines just so far that each component
// keeps a quarter of theirs.
glm::vec3 without_undershoot(const glm::vec3& cubic, const glm::vec3& linear) noexcept {
    constexpr float kKept = 0.25F;
    float share = 1.0F;
    for (int k = 0; k < 3; ++k) {
        const float least = kKept * linear[k];
        if (cubic[k] < least) share = std::min(share, (linear[k] - least) / (linear[k] - cubic[k]));
    }
    return glm::max(linear + share * (cubic - linear), glm::vec3(0.0F));
}

SkyParts parts_of(const Grid::Sample& sample) noexcept {
    const auto triple = [](const Node& node, std::size_t first) {
        return glm::vec3(node[first], node[first + 1], node[first + 2]);
    };
    const auto part = [&](std::size_t first) {
        return without_undershoot(triple(sample.cubic, first),
                                  glm::max(triple(sample.linear, first), glm::vec3(0.0F)));
    };
    return {part(0), part(4)};
}

}  // namespace

struct SkyView::State {
    explicit State(const SkyViewSize& wanted)
        : size(wanted),
          sky(size.sky_rows, size.columns),
          ground(size.ground_rows, size.columns),
          steps(static_cast<std::size_t>(size.steps)) {}

    void place_rows() noexcept;
    void build_row(int row) noexcept;
    [[nodiscard]] double elevation_rad(Side side, int row) const noexcept;
    void march(const Path& path, int count) noexcept;
    [[nodiscard]] Node node_of(const Lanes& all, const Lanes& hazy) const noexcept;
    [[nodiscard]] Grid::Sample sample(Side side, float elevation_rad, float azimuth_rad) const noexcept;
    [[nodiscard]] SkyParts parts(Side side, float elevation_rad, float azimuth_rad) const noexcept {
        return parts_of(sample(side, elevation_rad, azimuth_rad));
    }
    [[nodiscard]] glm::vec3 look_up(Side side, float elevation_rad, float azimuth_rad) const noexcept;

    SkyViewSize size;
    Grid sky;
    Grid ground;
    std::vector<PathStep> steps;
    std::array<Source, kMaxSources> sources{};
    std::array<Lanes, kMaxSources> light{};
    std::array<Lanes, kMaxSources> aerosol{};
    std::shared_ptr<const AirData> air;
    double eye_height_m = kLowestEyeM;
    double source_elevation_rad = 0.0;
    double source_sine = 0.0;
    double source_cosine = 1.0;
    double horizon_rad = 0.0;
    double highest_rad = kHalfPi;  // beyond it there is no air to see
    RowMap sky_map;
    RowMap ground_map;
    int rows_done = 0;
};

// The sky bends within a few scale heights of tangent height above the horizon: near the ground within about
// 2 deg, from high up within that height over the distance of the horizon. The ground bends within about its
// dip.
void SkyView::State::place_rows() noexcept {
    const Shell& shell = air->shell;
    const double dip_rad = shell.dip_rad(eye_height_m);
    horizon_rad = -dip_rad;
    highest_rad = kHalfPi;
    const double top_radius_m = shell.ground_radius_m + shell.top_height_m;
    const double over_m = eye_height_m - shell.top_height_m;
    const auto limb_rad = [top_radius_m](double above_m) {
        return -std::atan2(std::sqrt(above_m * (2.0 * top_radius_m + above_m)), top_radius_m);
    };
    if (over_m > 0.0) highest_rad = limb_rad(over_m);
    // At the lid the true edge starts with the root of the height; that of the rows goes through smoothly.
    const double softness_m = 0.15 * shell.top_height_m;
    const double edge_rad = limb_rad(0.5 * (over_m + std::hypot(over_m, softness_m)));
    const double horizon_m = std::sqrt(shell.excess_m2(eye_height_m));
    constexpr double kBendM = 8000.0;
    const double sky_range = kHalfPi + dip_rad;
    sky_map.low =
        Progression::over(sky_range, std::min({0.035, kBendM / std::max(horizon_m, 1.0), 0.1 * sky_range}));
    // Whole rows to the edge, which then has one of its own.
    const int last = size.sky_rows - 1;
    sky_map.high.edge_rad = edge_rad - horizon_rad;
    sky_map.high.edge_w = static_cast<double>(std::clamp(last * 7 / 10, 1, last - 1)) / last;
    sky_map.high.above = Progression::over(kHalfPi - edge_rad, 0.03);
    const double part = std::clamp((eye_height_m / shell.top_height_m - 0.4) / 0.55, 0.0, 1.0);
    sky_map.high_share = part * part * (3.0 - 2.0 * part);
    const double ground_range = kHalfPi - dip_rad;
    ground_map.low = Progression::over(ground_range, std::clamp(0.5 * dip_rad, 2e-4, 0.1 * ground_range));
}

double SkyView::State::elevation_rad(Side side, int row) const noexcept {
    const RowMap& map = side == Side::kSky ? sky_map : ground_map;
    const int last = (side == Side::kSky ? size.sky_rows : size.ground_rows) - 1;
    const double angle_rad = map.angle_rad(static_cast<double>(row) / last);
    return horizon_rad + (side == Side::kSky ? angle_rad : -angle_rad);
}

// X, Y, Z of everything but aerosol single scattering, then of that without its phase function: the aureole
// is put together at look-up, so the nodes need not resolve it.
Node SkyView::State::node_of(const Lanes& all, const Lanes& hazy) const noexcept {
    Node node{};
    for (std::size_t row = 0; row < 3; ++row) {
        const Spectrum& weight = air->model.sunlight_xyz_lux[row];
        for (std::size_t i = 0; i < weight.size(); ++i) {
            node[row] += weight[i] * all.v[i];
            node[row + 4] += weight[i] * hazy.v[i];
        }
    }
    return node;
}

void SkyView::State::march(const Path& path, int count) noexcept {
    const AirData& data = *air;
    light.fill(Lanes{});
    aerosol.fill(Lanes{});
    for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        kernels().add_first_order(data.medium, data.source_table(), path, sources[j], light[j], aerosol[j]);
    }
    if (data.moments.empty()) return;
    kernels().add_higher_orders(data.medium, data.moment_table(), path, sources.data(), count, light.data());
}

void SkyView::State::build_row(int row) noexcept {
    const Side side = row < size.sky_rows ? Side::kSky : Side::kGround;
    const int line = side == Side::kSky ? row : row - size.sky_rows;
    Grid& grid = side == Side::kSky ? sky : ground;
    const AirData& data = *air;
    const double elevation = elevation_rad(side, line);
    const double sine = line == 0 ? -data.shell.dip_sine(eye_height_m) : std::sin(elevation);
    const double cosine = std::cos(elevation);

    Path path{};
    path.steps = steps.data();
    lay_path(data, eye_height_m, sine, side, size.steps, path);
    kernels().weigh(data.medium, path);
    for (int first = 0; first < size.columns; first += kMaxSources) {
        const int count = std::min(kMaxSources, size.columns - first);
        for (int j = 0; j < count; ++j) {
            const double azimuth = std::numbers::pi * (first + j) / (size.columns - 1);
            const double between =
                std::clamp(sine * source_sine + cosine * source_cosine * std::cos(azimuth), -1.0, 1.0);
            sources[static_cast<std::size_t>(j)] = {source_sine, between,
                                                    static_cast<float>(rayleigh_phase(between))};
        }
        march(path, count);
        for (int j = 0; j < count; ++j) {
            const auto slot = static_cast<std::size_t>(j);
            grid.at(line, first + j) = node_of(light[slot], aerosol[slot]);
        }
    }
    grid.close_row(line);
}

Grid::Sample SkyView::State::sample(Side side, float elevation_rad, float azimuth_rad) const noexcept {
    if (air == nullptr || !std::isfinite(elevation_rad) || !std::isfinite(azimuth_rad)) return {};
    const auto horizon = static_cast<float>(horizon_rad);
    const float angle = side == Side::kSky ? elevation_rad - horizon : horizon - elevation_rad;
    const RowMap& map = side == Side::kSky ? sky_map : ground_map;
    const auto range = static_cast<float>(map.range_rad());
    if (side == Side::kSky && highest_rad < kHalfPi && elevation_rad >= static_cast<float>(highest_rad))
        return {};
    const Grid& grid = side == Side::kSky ? sky : ground;
    return grid.sample(
        map.w(std::clamp(angle, 0.0F, range)) * static_cast<float>(grid.rows() - 1),
        folded_azimuth(azimuth_rad) * std::numbers::inv_pi_v<float> * static_cast<float>(size.columns - 1));
}

glm::vec3 SkyView::State::look_up(Side side, float elevation_rad, float azimuth_rad) const noexcept {
    const SkyParts seen = parts(side, elevation_rad, azimuth_rad);
    if (seen.haze == glm::vec3(0.0F) && seen.rest == glm::vec3(0.0F)) return glm::vec3(0.0F);
    const auto horizon = static_cast<float>(horizon_rad);
    constexpr auto kQuarterTurn = static_cast<float>(kHalfPi);
    const float elevation = side == Side::kSky ? std::clamp(elevation_rad, horizon, kQuarterTurn)
                                               : std::clamp(elevation_rad, -kQuarterTurn, horizon);
    const float sine = std::sin(elevation);
    const float level = std::sqrt(std::max(0.0F, 1.0F - sine * sine));
    const float cosine = sine * static_cast<float>(source_sine) +
                         level * static_cast<float>(source_cosine) * std::cos(folded_azimuth(azimuth_rad));
    const float phase =
        cornette_shanks_phase(static_cast<float>(air->model.aerosol_g), std::clamp(cosine, -1.0F, 1.0F));
    return seen.rest + phase * seen.haze;
}

SkyView::SkyView(const SkyViewSize& size) {
    SkyViewSize least = size;
    least.sky_rows = std::max(size.sky_rows, 4);
    least.ground_rows = std::max(size.ground_rows, 4);
    least.columns = std::max(size.columns, 4);
    least.steps = std::max(size.steps, 4);
    state_ = std::make_unique<State>(least);
}
SkyView::~SkyView() = default;
SkyView::SkyView(SkyView&&) noexcept = default;
SkyView& SkyView::operator=(SkyView&&) noexcept = default;

void SkyView::begin(const AirTables& tables, double eye_height_m, double source_elevation_rad) noexcept {
    State& state = *state_;
    constexpr double kFarthestEyeM = 1e9;
    state.air = tables.share();
    state.eye_height_m =
        std::isfinite(eye_height_m) ? std::clamp(eye_height_m, kLowestEyeM, kFarthestEyeM) : kLowestEyeM;
    state.source_elevation_rad =
        std::isfinite(source_elevation_rad) ? std::clamp(source_elevation_rad, -kHalfPi, kHalfPi) : -kHalfPi;
    state.source_sine = std::sin(state.source_elevation_rad);
    state.source_cosine = std::cos(state.source_elevation_rad);
    state.place_rows();
    state.rows_done = 0;
}

bool SkyView::build_rows(int max_rows) noexcept {
    State& state = *state_;
    if (!state.air) return false;
    const int all = state.size.sky_rows + state.size.ground_rows;
    if (state.rows_done == all) return true;
    const int last = std::min(all, state.rows_done + std::max(0, max_rows));
    for (; state.rows_done < last; ++state.rows_done)
        state.build_row(state.rows_done);
    if (state.rows_done < all) return false;
    state.sky.close(true);
    state.ground.close(false);
    return true;
}

void SkyView::build_all() noexcept {
    build_rows(state_->size.sky_rows + state_->size.ground_rows);
}

bool SkyView::complete() const noexcept {
    return state_->air != nullptr && state_->rows_done == state_->size.sky_rows + state_->size.ground_rows;
}

glm::vec3 SkyView::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->look_up(Side::kSky, elevation_rad, relative_azimuth_rad);
}

glm::vec3 SkyView::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->look_up(Side::kGround, elevation_rad, relative_azimuth_rad);
}

SkyParts SkyView::parts_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->parts(Side::kSky, elevation_rad, relative_azimuth_rad);
}

SkyParts SkyView::parts_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->parts(Side::kGround, elevation_rad, relative_azimuth_rad);
}

double SkyView::horizon_elevation_rad() const noexcept {
    return state_->horizon_rad;
}
double SkyView::eye_height_m() const noexcept {
    return state_->eye_height_m;
}
double SkyView::source_elevation_rad() const noexcept {
    return state_->source_elevation_rad;
}
const SkyViewSize& SkyView::size() const noexcept {
    return state_->size;
}

double SkyView::sky_row_elevation_rad(int row) const noexcept {
    return state_->elevation_rad(Side::kSky, row);
}

double SkyView::ground_row_elevation_rad(int row) const noexcept {
    return state_->elevation_rad(Side::kGround, row);
}

}  // namespace skyig::render::sky
