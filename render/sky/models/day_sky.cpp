#include "render/sky/models/day_sky.h"

#include <limits>

#include "render/sky/models/cie_sky.h"
#include "render/sky/models/day_cycle.h"
#include "render/sky/models/preetham_sky.h"
#include "render/sky/models/windlight_sky.h"

namespace skyig::render::sky::models {

Orders orders_of(SkyModel model) noexcept {
    return model == SkyModel::kSingle || model == SkyModel::kDayCycle ? Orders::kFirst : Orders::kAll;
}

struct DaySky::State {
    explicit State(const SkyViewSize& size) : view(size), day_cycle(size) {}

    SkyView view;  // `multi` and `single`
    DayCycle day_cycle;
    CieSky cie;
    PreethamSky preetham;
    WindlightSky windlight;
    SkyModel model = SkyModel::kMulti;
    const SkyRadiance* shown = &view;
};

DaySky::DaySky(const SkyViewSize& size) : state_(std::make_unique<State>(size)) {}
DaySky::~DaySky() = default;
DaySky::DaySky(DaySky&&) noexcept = default;
DaySky& DaySky::operator=(DaySky&&) noexcept = default;

void DaySky::begin(const SkySettings& settings, const AirTables& tables, double eye_height_m,
                   double source_elevation_rad, bool by_sun) noexcept {
    State& s = *state_;
    s.model = settings.model;
    switch (settings.model) {
        case SkyModel::kMulti:
        case SkyModel::kSingle:
            s.view.begin(tables, eye_height_m, source_elevation_rad);
            s.shown = &s.view;
            break;
        case SkyModel::kDayCycle:
            s.day_cycle.begin(settings.day_cycle, tables, eye_height_m, source_elevation_rad);
            s.shown = &s.day_cycle;
            break;
        case SkyModel::kCie:
            s.cie.begin(settings.cie, tables, eye_height_m, source_elevation_rad, by_sun);
            s.shown = &s.cie;
            break;
        case SkyModel::kPreetham:
            s.preetham.begin(settings.preetham, tables, eye_height_m, source_elevation_rad);
            s.shown = &s.preetham;
            break;
        case SkyModel::kWindlight:
            s.windlight.begin(settings.windlight, tables, eye_height_m, source_elevation_rad);
            s.shown = &s.windlight;
            break;
    }
}

bool DaySky::build_rows(int max_rows) noexcept {
    State& s = *state_;
    if (s.shown == &s.view) return s.view.build_rows(max_rows);
    if (s.shown == &s.day_cycle) return s.day_cycle.build_rows(max_rows);
    return true;
}

void DaySky::build_all() noexcept {
    while (!build_rows(std::numeric_limits<int>::max() / 2)) {
    }
}

glm::vec3 DaySky::xyz_above(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->shown->xyz_above(elevation_rad, relative_azimuth_rad);
}
glm::vec3 DaySky::xyz_below(float elevation_rad, float relative_azimuth_rad) const noexcept {
    return state_->shown->xyz_below(elevation_rad, relative_azimuth_rad);
}
double DaySky::horizon_elevation_rad() const noexcept {
    return state_->shown->horizon_elevation_rad();
}

}  // namespace skyig::render::sky::models
