// The tables behind AirTables, shared by the files of this folder.
#pragma once

#include <cstddef>
#include <vector>

#include "render/sky/air_model.h"
#include "render/sky/geometry.h"
#include "render/sky/kernels.h"

namespace skyig::render::sky {

struct Densities {
    float molecules = 0.0F;
    float aerosol = 0.0F;
    float ozone = 0.0F;
};

/// Node counts of the tables and quadrature of their building.
inline constexpr int kColumnRows = 64;
inline constexpr int kColumnAngles = 128;
inline constexpr std::size_t kColumnFloats = 4;
inline constexpr int kMomentRows = 16;
inline constexpr std::size_t kMomentNodes = std::size_t{kMomentRows} * std::size_t{kSineNodes};
inline constexpr int kProfileCells = 480;

struct AirData {
    Medium medium{};
    Shell shell;
    /// ln density of the molecules at even heights: cheaper than a search for the knot.
    std::vector<float> log_molecules;
    /// Columns of light as it arrives, and of the same light by where its source stands without air: there
    /// the first row is of level ground, the others are of heights.
    std::vector<float> seen_columns;
    std::vector<float> source_columns;
    /// Sine of the horizon's dip, by row of heights: as seen, and of a source that is seen there.
    std::vector<double> seen_dip_sine;
    std::vector<double> source_dip_sine;
    std::vector<float> moments;
    std::vector<float> log_ground;
    /// Sky over the sea (sea_sky.h); none over land.
    std::vector<float> sea_sky;
    AirModel model;

    [[nodiscard]] Densities densities(double height_m) const noexcept;
    [[nodiscard]] ColumnTable seen_table() const noexcept {
        return {seen_columns.data(), kColumnRows, kColumnAngles, 0.0F, 1.0F};
    }
    [[nodiscard]] ColumnTable source_table() const noexcept;
    [[nodiscard]] MomentTable moment_table() const noexcept {
        return {moments.data(), log_ground.data(), kMomentRows, kSineNodes};
    }
    /// Places in the tables, in nodes.
    [[nodiscard]] double seen_row(double height_m) const noexcept;
    [[nodiscard]] double source_row(double height_m) const noexcept { return 1.0 + seen_row(height_m); }
    /// One of the two lists of sines.
    [[nodiscard]] double dip_sine(const std::vector<double>& sines, double height_m) const noexcept;
    [[nodiscard]] double moment_row(double height_m) const noexcept;
    [[nodiscard]] double moment_row_height_m(int row) const noexcept;
};

/// Index of a node of the moment table.
[[nodiscard]] inline std::size_t moment_node(int row, int sine) noexcept {
    return static_cast<std::size_t>(row) * std::size_t{kSineNodes} + static_cast<std::size_t>(sine);
}

/// Sine of the source's elevation at a node of the moment table.
[[nodiscard]] double moment_sine(int node) noexcept;

/// Everything but the moments.
void build_medium(const AirModel& model, AirData& data);
void build_columns(AirData& data);
/// Where no higher order brings back what the forward peak of the aerosol takes out of a ray, that counts as
/// lost.
void keep_forward_peak(AirData& data) noexcept;
/// Needs the rest.
void build_moments(AirData& data);
/// After the moments: the ground that is seen does not show what it mirrors.
void leave_mirror_out(AirData& data) noexcept;

}  // namespace skyig::render::sky
