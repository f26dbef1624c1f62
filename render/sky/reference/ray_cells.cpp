#include "render/sky/reference/ray_cells.h"

#include <algorithm>
#include <cmath>

namespace skyig::render::sky::reference {

Triple Cell::column_m(double part) const noexcept {
    const double half = 0.5 * part * part;
    const double third = part * part * part / 3.0;
    return length_m * ((part - 3.0 * half + 2.0 * third) * from + (4.0 * half - 4.0 * third) * middle +
                       (-half + 2.0 * third) * to);
}

Triple Cell::density(double part) const noexcept {
    const double square = part * part;
    return (1.0 - 3.0 * part + 2.0 * square) * from + 4.0 * (part - square) * middle +
           (2.0 * square - part) * to;
}

RayCells::RayCells(const Medium& medium, double height_m, double cosine, int cells) noexcept
    : medium_(medium), height_m_(height_m), cosine_(cosine), cells_(cells), index_(0), last_(0) {
    const Shell& shell = medium.shell();
    if (!shell.inside(height_m, cosine, enter_m_, end_m_)) {
        end_m_ = 0.0;
        return;
    }
    const double r = shell.ground_radius_m + height_m;
    meets_ground_ = cosine < 0.0 && r * cosine * r * cosine >= shell.excess_m2(height_m);
    if (meets_ground_) end_m_ = shell.distance_to_ground_m(height_m, cosine);
    low_m_ = std::clamp(-r * cosine, enter_m_, end_m_);
    // Branches: down to the lowest point, and up from it; the boundaries are counted from it.
    index_ = low_m_ > enter_m_ ? -cells : 0;
    last_ = end_m_ > low_m_ ? cells : 0;
    density_ = densities_at(enter_m_);
}

Triple RayCells::densities_at(double along_m) const noexcept {
    return medium_.densities(medium_.shell().height_along_m(height_m_, cosine_, along_m));
}

double RayCells::boundary_m(int index) const noexcept {
    const double s = static_cast<double>(index) / cells_;
    return low_m_ + s * s * s * (index < 0 ? low_m_ - enter_m_ : end_m_ - low_m_);
}

bool RayCells::next(Cell& cell) noexcept {
    if (index_ >= last_) return false;
    cell.from_m = boundary_m(index_);
    cell.length_m = boundary_m(index_ + 1) - cell.from_m;
    ++index_;
    cell.before_m = column_m_;
    cell.from = density_;
    cell.middle = densities_at(cell.from_m + 0.5 * cell.length_m);
    cell.to = densities_at(cell.from_m + cell.length_m);
    density_ = cell.to;
    column_m_ = column_m_ + cell.column_m(1.0);
    return true;
}

Triple column_m(const Medium& medium, double height_m, double cosine, int cells) noexcept {
    RayCells ray(medium, height_m, cosine, cells);
    Triple sum;
    for (Cell cell; ray.next(cell);)
        sum = sum + cell.column_m(1.0);
    return sum;
}

}  // namespace skyig::render::sky::reference
