#include "render/sky/sea_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/colour.h"
#include "render/geometry.h"
#include "render/sky/air_data.h"
#include "render/sky/azimuth.h"
#include "render/sky/direction_grid.h"
#include "render/sky/path.h"
#include "render/sky/ray_light.h"
#include "render/sky/sea_sky.h"

namespace skyig::render::sky {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kLowestEye_m = 0.01;
constexpr double kFarthestEye_m = 1e9;
constexpr int kSteps = 32;

// Where a ray meets the surface, and how that is turned against the eye.
struct Meeting {
    double view_up = 0.0;  // sine of the eye's elevation there
    double turn_sine = 0.0;
    double turn_cosine = 1.0;

    Meeting() = default;
    Meeting(const Shell& shell, double eye_height_m, double sine, double cosine) noexcept {
        const double r = shell.ground_radius_m + eye_height_m;
        view_up =
            std::min(1.0, std::sqrt(std::max(0.0, r * r * sine * sine - shell.excess_m2(eye_height_m))) /
                              shell.ground_radius_m);
        const double along_m = shell.distance_to_ground_m(eye_height_m, sine);
        turn_sine = along_m * cosine / shell.ground_radius_m;
        turn_cosine = (r + along_m * sine) / shell.ground_radius_m;
    }

    // From x along the view and z up at the eye to the same at the surface.
    [[nodiscard]] glm::dvec3 turned(const glm::dvec3& at_eye) const noexcept {
        return {turn_cosine * at_eye.x - turn_sine * at_eye.z, at_eye.y,
                turn_sine * at_eye.x + turn_cosine * at_eye.z};
    }
};

glm::dvec3 source_at_eye(double sine, double level, double relative_azimuth_rad) {
    return {level * std::cos(relative_azimuth_rad), level * std::sin(relative_azimuth_rad), sine};
}

}  // namespace

// The reflected sky's series in slopes away from the eye (first) and to the source's side (second).
struct SlopeNode {
    glm::vec3 first_xyz{0.0F};
    glm::vec3 second_xyz{0.0F};
    glm::vec3 bend{0.0F};  // first-first, second-second, first-second
};

SlopeNode mix(const SlopeNode& a, const SlopeNode& b, float t) {
    return {glm::mix(a.first_xyz, b.first_xyz, t), glm::mix(a.second_xyz, b.second_xyz, t),
            glm::mix(a.bend, b.bend, t)};
}

struct SeaView::State {
    // The air between eye and water.
    struct Between {
        Spectrum passes{};
        glm::dvec3 passes_rgb{1.0};
        [[nodiscard]] glm::dvec3 dimmed(const glm::dvec3& xyz) const noexcept {
            return kXyzFromRec709 * (passes_rgb * (kRec709FromXyz * xyz));
        }
    };
    void build_row(int row) noexcept;
    void build_node(int row, int column, const SeaSurface::Facets& facets, const glm::dvec3& source,
                    const Between& air) noexcept;
    // Of a direction, in the tables and on the water.
    struct Place {
        float row = 0.0F;
        float column = 0.0F;
        double relative_rad = 0.0;
        Meeting meeting;
        glm::dvec3 source{0.0, 0.0, 1.0};
    };
    /// \return false before the table is complete, or for what is not finite
    [[nodiscard]] bool place(double elevation_rad, double azimuth_rad, double source_azimuth_rad,
                             Place& out) const noexcept;
    [[nodiscard]] SlopeNode& slopes(int row, int column) noexcept {
        return slope_nodes[static_cast<std::size_t>(row * kColumns + column)];
    }
    [[nodiscard]] double row_elevation_rad(int row) const noexcept {
        return horizon_rad - rows.angle_rad(static_cast<double>(row) / (kRows - 1));
    }

    // X, Y, Z of the reflected sky, then of the source on a plane facing it, both through the air to the eye.
    Grid grid{kRows, kColumns};
    std::array<SlopeNode, static_cast<std::size_t>(kRows) * kColumns> slope_nodes{};
    std::array<PathStep, kSteps> steps{};
    std::optional<AirTables> tables;
    SeaSurface surface;
    Progression rows{};
    double eye_height_m = kLowestEye_m;
    double source_sine = 0.0;
    double source_level = 1.0;
    double horizon_rad = 0.0;
    int rows_done = 0;
};

void SeaView::State::build_node(int row, int column, const SeaSurface::Facets& facets,
                                const glm::dvec3& source, const Between& air) noexcept {
    const SeaSky sky(tables->data(), source.z);
    const double source_level_there = std::max(std::hypot(source.x, source.y), 1e-9);
    glm::dvec3 reflected{0.0}, first{0.0}, second{0.0};
    glm::dvec3 bend{0.0};
    for (const SeaSurface::Facet& facet : facets) {
        const glm::dvec3& r = facet.reflected;
        const double level = std::max(std::hypot(r.x, r.y), 1e-9);
        const double cosine = (r.x * source.x + r.y * source.y) / (level * source_level_there);
        const glm::dvec3 xyz =
            facet.share * glm::dvec3(sky.xyz(static_cast<float>(r.z), static_cast<float>(cosine)));
        const glm::dvec2& d = facet.deviation;
        reflected += xyz;
        first += xyz * d.x;
        second += xyz * d.y;
        bend += xyz.y * glm::dvec3{d.x * d.x - 1.0, d.y * d.y - 1.0, d.x * d.y};
    }
    const double slope = surface.facet_slope();
    const double dims = air.dimmed(reflected).y / std::max(reflected.y, 1e-300);
    slopes(row, column) = {glm::vec3{air.dimmed(first) / slope}, glm::vec3{air.dimmed(second) / slope},
                           glm::vec3{bend * (0.5 * dims / (slope * slope))}};
    reflected = glm::max(air.dimmed(reflected), glm::dvec3(0.0));
    Spectrum both = tables->transmittance(0.0, std::asin(std::clamp(source.z, -1.0, 1.0)));
    for (std::size_t i = 0; i < both.size(); ++i)
        both[i] *= air.passes[i];
    const glm::dvec3 sun = xyz_of_sunlight(tables->model(), both);
    Node& node = grid.at(row, column);
    for (int k = 0; k < 3; ++k) {
        node[static_cast<std::size_t>(k)] = static_cast<float>(reflected[k]);
        node[static_cast<std::size_t>(k) + 4] = static_cast<float>(sun[k]);
    }
}

void SeaView::State::build_row(int row) noexcept {
    const AirData& data = tables->data();
    const double elevation = row_elevation_rad(row);
    const double sine = row == 0 ? -data.shell.dip_sine(eye_height_m) : std::sin(elevation);
    const Meeting at(data.shell, eye_height_m, sine, std::cos(elevation));
    Path path{};
    path.steps = steps.data();
    lay_path(data, eye_height_m, sine, Side::kGround, kSteps, path);
    kernels().weigh(data.medium, path);
    Between air;
    std::copy(std::begin(path.transmittance.v), std::end(path.transmittance.v), air.passes.begin());
    air.passes_rgb = transmittance_rgb(data.model, air.passes);
    const SeaSurface::Facets facets = surface.facets(at.view_up);
    for (int column = 0; column < kColumns; ++column) {
        const double azimuth = std::numbers::pi * column / (kColumns - 1);
        const glm::dvec3 source = at.turned(source_at_eye(source_sine, source_level, azimuth));
        build_node(row, column, facets, source, air);
    }
    grid.close_row(row);
}

SeaView::SeaView() : state_(std::make_unique<State>()) {}
SeaView::~SeaView() = default;
SeaView::SeaView(SeaView&&) noexcept = default;
SeaView& SeaView::operator=(SeaView&&) noexcept = default;

void SeaView::begin(const AirTables& tables, const SeaSurface& surface, double eye_height_m,
                    double source_elevation_rad) noexcept {
    State& s = *state_;
    s.tables = tables;
    s.surface = surface;
    s.eye_height_m =
        std::isfinite(eye_height_m) ? std::clamp(eye_height_m, kLowestEye_m, kFarthestEye_m) : kLowestEye_m;
    const double source_rad =
        std::isfinite(source_elevation_rad) ? std::clamp(source_elevation_rad, -kHalfPi, kHalfPi) : -kHalfPi;
    s.source_sine = std::sin(source_rad);
    s.source_level = std::cos(source_rad);
    const double dip_rad = tables.data().shell.dip_rad(s.eye_height_m);
    s.horizon_rad = -dip_rad;
    const double range_rad = kHalfPi - dip_rad;
    s.rows = Progression::over(range_rad, std::clamp(0.5 * dip_rad, 2e-4, 0.1 * range_rad));
    s.rows_done = 0;
}

bool SeaView::build_rows(int max_rows) noexcept {
    State& s = *state_;
    if (!s.tables) return false;
    if (s.rows_done == kRows) return true;
    const int last = std::min(kRows, s.rows_done + std::max(0, max_rows));
    for (; s.rows_done < last; ++s.rows_done)
        s.build_row(s.rows_done);
    if (s.rows_done < kRows) return false;
    s.grid.close(false);
    return true;
}

bool SeaView::State::place(double elevation_rad, double azimuth_rad, double source_azimuth_rad,
                           Place& out) const noexcept {
    if (rows_done < kRows || !std::isfinite(elevation_rad) || !std::isfinite(azimuth_rad) ||
        !std::isfinite(source_azimuth_rad))
        return false;
    const double elevation = std::clamp(elevation_rad, -kHalfPi, horizon_rad);
    out.relative_rad = source_azimuth_rad - azimuth_rad;
    const auto angle = static_cast<float>(std::min(horizon_rad - elevation, rows.range_rad));
    out.row = rows.w(angle) * static_cast<float>(kRows - 1);
    out.column = folded_azimuth(static_cast<float>(out.relative_rad)) * std::numbers::inv_pi_v<float> *
                 static_cast<float>(kColumns - 1);
    out.meeting = Meeting(tables->data().shell, eye_height_m, std::sin(elevation), std::cos(elevation));
    out.source = out.meeting.turned(source_at_eye(source_sine, source_level, out.relative_rad));
    return true;
}

glm::vec3 SeaView::xyz(double elevation_rad, double azimuth_rad, double source_azimuth_rad) const noexcept {
    const State& s = *state_;
    State::Place at;
    if (!s.place(elevation_rad, azimuth_rad, source_azimuth_rad, at)) return glm::vec3(0.0F);
    const Node node = s.grid.sample(at.row, at.column).cubic;
    const auto glitter =
        static_cast<float>(s.surface.glitter_per_sr(at.meeting.view_up, azimuth_rad, at.source));
    const glm::vec3 seen{node[0] + glitter * node[4], node[1] + glitter * node[5],
                         node[2] + glitter * node[6]};
    return glm::max(seen, glm::vec3(0.0F));
}

SeaView::OfSlopes SeaView::of_slopes(double elevation_rad, double azimuth_rad,
                                     double source_azimuth_rad) const noexcept {
    const State& s = *state_;
    State::Place at;
    if (!s.place(elevation_rad, azimuth_rad, source_azimuth_rad, at)) return {};
    const auto row = std::min(static_cast<std::size_t>(at.row), std::size_t{kRows - 2});
    const auto column = std::min(static_cast<std::size_t>(at.column), std::size_t{kColumns - 2});
    const float up = at.row - static_cast<float>(row);
    const float aside = at.column - static_cast<float>(column);
    const SlopeNode* node = &s.slope_nodes[row * kColumns + column];
    SlopeNode found = mix(mix(node[0], node[1], aside), mix(node[kColumns], node[kColumns + 1], aside), up);
    // Nodes have the source to the right.
    if (std::sin(at.relative_rad) < 0.0) {
        found.second_xyz = -found.second_xyz;
        found.bend.z = -found.bend.z;
    }
    const auto e = static_cast<float>(std::sin(azimuth_rad));
    const auto n = static_cast<float>(std::cos(azimuth_rad));
    const glm::vec3& b = found.bend;
    const Node light = s.grid.sample(at.row, at.column).cubic;
    const SeaSurface::Mirror mirror = s.surface.mirror(at.meeting.view_up, azimuth_rad, at.source);
    const auto per_density = static_cast<float>(mirror.per_density);
    return {e * found.first_xyz + n * found.second_xyz,
            n * found.first_xyz - e * found.second_xyz,
            {e * e * b.x + n * n * b.y + 2.0F * e * n * b.z, n * n * b.x + e * e * b.y - 2.0F * e * n * b.z,
             e * n * (b.x - b.y) + (n * n - e * e) * b.z},
            glm::max(per_density * glm::vec3{light[4], light[5], light[6]}, glm::vec3(0.0F)),
            static_cast<float>(mirror.density)};
}

double SeaView::horizon_elevation_rad() const noexcept {
    return state_->horizon_rad;
}

double mirror_elevation_rad(double eye_height_m, double source_elevation_rad) noexcept {
    const Shell shell{kEarthRadius_m, 0.0};
    const double eye_m = std::clamp(eye_height_m, kLowestEye_m, kFarthestEye_m);
    double low = -kHalfPi;
    double high = -shell.dip_rad(eye_m);
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const Meeting at(shell, eye_m, std::sin(middle), std::cos(middle));
        const bool below =
            std::asin(at.view_up) > source_elevation_rad + std::atan2(at.turn_sine, at.turn_cosine);
        (below ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace skyig::render::sky
