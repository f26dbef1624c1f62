// A ray through the shell, cut into cells over which each density is a parabola of the distance (Simpson), so
// that columns are cubics and a free path can be found exactly.
#pragma once

#include "render/sky/reference/medium.h"

namespace skyig::render::sky::reference {

struct Cell {
    double from_m = 0.0;  // distance from the ray's start
    double length_m = 0.0;
    Triple before_m;  // column between the ray's start and the cell
    Triple from;      // densities at its ends and its middle
    Triple middle;
    Triple to;

    /// `part` of the way along the cell, 0..1.
    [[nodiscard]] Triple column_m(double part) const noexcept;
    [[nodiscard]] Triple density(double part) const noexcept;
};

/// The cells of one ray in turn, from its start to the ground or the lid. They crowd (as the cube) at its
/// lowest point, where the air bends most.
class RayCells {
  public:
    /// \param height_m  of the start, >= 0, also above the lid: the ray then starts where it enters
    /// \param cosine    to the local vertical there
    /// \param cells     a branch; a ray that passes its lowest point has two branches
    RayCells(const Medium& medium, double height_m, double cosine, int cells) noexcept;

    [[nodiscard]] bool meets_ground() const noexcept { return meets_ground_; }
    /// Distance of the ground or the lid, where the last cell ends; 0 for a ray that misses the air.
    [[nodiscard]] double end_m() const noexcept { return end_m_; }
    /// False after the last.
    bool next(Cell& cell) noexcept;

  private:
    [[nodiscard]] Triple densities_at(double along_m) const noexcept;
    [[nodiscard]] double boundary_m(int index) const noexcept;

    const Medium& medium_;
    double height_m_;
    double cosine_;
    double enter_m_ = 0.0;
    double low_m_ = 0.0;
    double end_m_ = 0.0;
    bool meets_ground_ = false;
    int cells_;
    int index_;
    int last_;
    Triple density_;
    Triple column_m_;
};

/// The whole column of a ray; see RayCells.
[[nodiscard]] Triple column_m(const Medium& medium, double height_m, double cosine, int cells) noexcept;

}  // namespace skyig::render::sky::reference
