#include "clients/bench/sky_models.h"

#include <array>

namespace skyig::clients::bench {

namespace {

using render::SkyModel;

constexpr std::array<SkyContestant, 6> kContestants{{
    {SkyModel::kCie, "ISO 15469 type 12, zenith of multi"},
    {SkyModel::kPreetham, "the printed formulas, turbidity from the air"},
    {SkyModel::kWindlight, "attenuation and convergence colour, default parameters"},
    {SkyModel::kSingle, "the first order alone, sixteen wavelengths, a table of 60 x 33 directions", true},
    {SkyModel::kDayCycle, "tables of the first order along the Sun's path, mixed"},
    {SkyModel::kMulti, "all orders by angular moments, sixteen wavelengths, a table of 60 x 33 directions",
     true},
}};

}  // namespace

std::span<const SkyContestant> sky_contestants() noexcept {
    return kContestants;
}

void MeasuredSky::place(double eye_height_m, double source_elevation_rad) {
    sky_.begin(settings_, *air_, eye_height_m, source_elevation_rad, true);
    sky_.build_all();
}

}  // namespace skyig::clients::bench
