#include "render/sky/reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "render/sky/phase.h"
#include "render/sky/reference/ray_cells.h"

namespace skyig::render::sky::reference {
namespace {

// Cells a branch of a ray: with 20, columns of molecules and aerosol err by 2e-4 and transmittances by 1e-3
// at worst, below the noise of a path; what is done once a view affords more.
constexpr int kFirstOrderCells = 400;
constexpr int kFineCells = 64;
constexpr int kPathCells = 20;

Place place_along(const Shell& shell, const Place& start, const glm::dvec3& direction, double along_m) {
    const double cosine = glm::dot(start.up, direction);
    const double height_m =
        std::clamp(shell.height_along_m(start.height_m, cosine, along_m), 0.0, shell.top_height_m);
    return {height_m,
            glm::normalize((shell.ground_radius_m + start.height_m) * start.up + along_m * direction)};
}

glm::dvec3 turned(const glm::dvec3& axis, double cosine, double azimuth_rad) {
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, axis));
    const glm::dvec3 y = glm::cross(axis, x);
    const double sine = std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine)));
    return glm::normalize(cosine * axis + sine * (std::cos(azimuth_rad) * x + std::sin(azimuth_rad) * y));
}

// Inverse of the distribution of the cosine.
double rayleigh_cosine(double random) {
    const double a = 4.0 * random - 2.0;
    const double root = std::sqrt(a * a + 1.0);
    return std::clamp(std::cbrt(a + root) + std::cbrt(a - root), -1.0, 1.0);
}

double henyey_greenstein_cosine(double g, double random) {
    if (std::abs(g) < 1e-3) return 2.0 * random - 1.0;
    const double root = (1.0 - g * g) / (1.0 - g + 2.0 * g * random);
    return std::clamp((1.0 + g * g - root * root) / (2.0 * g), -1.0, 1.0);
}

double hero_extinction(const Medium& medium, const Cell& cell, std::size_t hero, double part) {
    return medium.extinction(cell.before_m + cell.column_m(part), hero);
}

// Part of the cell at which the hero's depth is `depth`; Newton's steps, kept inside by bisection.
double part_at_depth(const Medium& medium, const Cell& cell, std::size_t hero, double depth) {
    double low = 0.0;
    double high = 1.0;
    double part = 0.5;
    for (int pass = 0; pass < 40 && high - low > 1e-14; ++pass) {
        const double excess = hero_extinction(medium, cell, hero, part) - depth;
        (excess > 0.0 ? high : low) = part;
        const double slope = cell.length_m * medium.extinction(cell.density(part), hero);
        const double step = slope > 0.0 ? excess / slope : 2.0;
        const double next = part - step;
        if (std::abs(step) < 1e-13) break;
        part = next > low && next < high ? next : 0.5 * (low + high);
    }
    return part;
}

Triple not_negative(const Triple& density) {
    return {std::max(0.0, density.molecules), std::max(0.0, density.aerosol), std::max(0.0, density.ozone)};
}

}  // namespace

PathTracer::PathTracer(const Medium& medium, const glm::dvec3& sun) : medium_(medium), sun_(sun) {
    for (std::size_t i = 0; i < kSampleCount; ++i)
        importance_[i] = (kObserverX[i] + kObserverY[i] + kObserverZ[i]) * medium.sunlight_w_m2_nm()[i];
    const double sum = std::accumulate(importance_.begin(), importance_.end(), 0.0);
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        importance_[i] /= sum;
        hero_share_[i] = 0.5 * importance_[i] + 0.5 / kSampleCount;
    }
}

Samples PathTracer::sunlight(const Place& place) const {
    return sunlight(place, kFineCells);
}

Samples PathTracer::sunlight(const Place& place, int cells) const {
    const double cosine = glm::dot(place.up, sun_);
    if (RayCells(medium_, place.height_m, cosine, cells).meets_ground()) return {};
    return medium_.transmittance(column_m(medium_, place.height_m, cosine, cells));
}

Samples PathTracer::first_order(const ViewRay& ray) const {
    const double between = glm::dot(ray.direction, sun_);
    const double by_air = rayleigh_phase(between);
    const double by_haze = cornette_shanks_phase(medium_.aerosol_g(), between);
    RayCells cells(medium_, ray.eye.height_m, glm::dot(ray.eye.up, ray.direction), kFirstOrderCells);
    Samples light{};
    Triple passed_m;
    for (Cell cell; cells.next(cell);) {
        const Triple column_m = cell.column_m(1.0);
        passed_m = cell.before_m + column_m;
        const Place middle =
            place_along(medium_.shell(), ray.eye, ray.direction, cell.from_m + 0.5 * cell.length_m);
        const Samples sun = sunlight(middle);
        for (std::size_t i = 0; i < kSampleCount; ++i) {
            const double depth = medium_.extinction(column_m, i);
            const double share = depth > 1e-9 ? -std::expm1(-depth) / depth : 1.0;
            const double scattered = by_air * medium_.rayleigh_per_m()[i] * column_m.molecules +
                                     by_haze * medium_.aerosol_scattering_per_m()[i] * column_m.aerosol;
            light[i] += sun[i] * std::exp(-medium_.extinction(cell.before_m, i)) * share * scattered;
        }
    }
    if (!cells.meets_ground()) return light;
    const Place ground = place_along(medium_.shell(), ray.eye, ray.direction, cells.end_m());
    const Samples sun = sunlight({0.0, ground.up});
    const double cosine = std::max(0.0, glm::dot(ground.up, sun_));
    const Samples through = medium_.transmittance(passed_m);
    for (std::size_t i = 0; i < kSampleCount; ++i)
        light[i] += through[i] * medium_.ground_albedo()[i] * std::numbers::inv_pi * cosine * sun[i];
    return light;
}

Samples PathTracer::later_orders(const ViewRay& ray, Sampler& sampler) const {
    Samples light{};
    const double cosine = glm::dot(ray.eye.up, ray.direction);
    const RayCells cells(medium_, ray.eye.height_m, cosine, kPathCells);
    if (cells.end_m() <= 0.0) return light;
    Walk walk = start(ray, sampler);
    Event event = Event::kGone;
    if (cells.meets_ground()) {
        event = advance(walk, sampler.next(), nullptr);
    } else {
        const Triple whole_m = column_m(medium_, ray.eye.height_m, cosine, kPathCells);
        event = advance(walk, sampler.next(), &whole_m);
    }
    follow(walk, event, true, sampler, light);
    return light;
}

Samples PathTracer::sky_on_ground(Sampler& sampler) const {
    Samples light{};
    Walk walk = start({}, sampler);
    turn_at_ground(walk, sampler);
    const Event event = advance(walk, sampler.next(), nullptr);
    follow(walk, event, false, sampler, light);
    return light;
}

PathTracer::Walk PathTracer::start(const ViewRay& ray, Sampler& sampler) const {
    Walk walk;
    walk.place = ray.eye;
    walk.direction = ray.direction;
    walk.value.fill(1.0);
    walk.drawn.fill(1.0);
    sampler.begin_path();
    double left = sampler.next();
    while (walk.hero + 1 < kSampleCount && left >= hero_share_[walk.hero])
        left -= hero_share_[walk.hero++];
    return walk;
}

PathTracer::Event PathTracer::advance(Walk& walk, double random, const Triple* whole_m) const {
    const double reach = whole_m ? -std::expm1(-medium_.extinction(*whole_m, walk.hero)) : 1.0;
    const double depth = -std::log1p(-random * reach);
    RayCells cells(medium_, walk.place.height_m, glm::dot(walk.place.up, walk.direction), kPathCells);
    Cell cell;
    bool collides = false;
    while (!collides && cells.next(cell))
        collides = hero_extinction(medium_, cell, walk.hero, 1.0) > depth;
    collides = collides || whole_m;
    if (!collides && !cells.meets_ground()) return Event::kGone;

    const double part = collides ? part_at_depth(medium_, cell, walk.hero, depth) : 1.0;
    const Samples through = medium_.transmittance(cell.before_m + cell.column_m(part));
    walk.density = not_negative(cell.density(part));
    double all = 0.0;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        walk.value[i] *= through[i];
        walk.drawn[i] *= through[i];
        if (collides) walk.drawn[i] *= medium_.extinction(walk.density, i);
        if (whole_m) walk.drawn[i] /= -std::expm1(-medium_.extinction(*whole_m, i));
        all += hero_share_[i] * walk.drawn[i];
    }
    if (!(all > 0.0)) return Event::kGone;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        walk.value[i] /= all;
        walk.drawn[i] /= all;
    }
    const double along_m = collides ? cell.from_m + part * cell.length_m : cells.end_m();
    walk.place = place_along(medium_.shell(), walk.place, walk.direction, along_m);
    if (!collides) walk.place.height_m = 0.0;
    return collides ? Event::kAir : Event::kGround;
}

void PathTracer::follow(Walk& walk, Event event, bool skip_first, Sampler& sampler, Samples& light) const {
    for (bool skip = skip_first; event != Event::kGone; skip = false) {
        if (!skip) add_sunlight(walk, event, light);
        if (event == Event::kGround) {
            for (std::size_t i = 0; i < kSampleCount; ++i)
                walk.value[i] *= medium_.ground_albedo()[i];
            turn_at_ground(walk, sampler);
        } else {
            turn_in_air(walk, sampler);
        }
        if (!survives(walk, sampler)) return;
        event = advance(walk, sampler.next(), nullptr);
    }
}

void PathTracer::add_sunlight(const Walk& walk, Event event, Samples& light) const {
    const double up = glm::dot(walk.place.up, sun_);
    if (event == Event::kGround && up <= 0.0) return;
    const Samples sun = sunlight(walk.place, kPathCells);
    const double between = glm::dot(walk.direction, sun_);
    const double by_air = rayleigh_phase(between) * walk.density.molecules;
    const double by_haze = cornette_shanks_phase(medium_.aerosol_g(), between) * walk.density.aerosol;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        const double turned_here =
            event == Event::kGround
                ? medium_.ground_albedo()[i] * std::numbers::inv_pi * up
                : by_air * medium_.rayleigh_per_m()[i] + by_haze * medium_.aerosol_scattering_per_m()[i];
        light[i] += walk.value[i] * turned_here * sun[i];
    }
}

void PathTracer::turn_in_air(Walk& walk, Sampler& sampler) const {
    const Samples& rayleigh = medium_.rayleigh_per_m();
    const Samples& aerosol = medium_.aerosol_scattering_per_m();
    const double by_air = rayleigh[walk.hero] * walk.density.molecules;
    const double by_haze = aerosol[walk.hero] * walk.density.aerosol;
    const bool in_haze = sampler.next() * (by_air + by_haze) < by_haze;
    const double cosine = in_haze ? aerosol_cosine(sampler) : rayleigh_cosine(sampler.next());
    walk.direction = turned(walk.direction, cosine, 2.0 * std::numbers::pi * sampler.next());

    const double air_phase = rayleigh_phase(cosine) * walk.density.molecules;
    const double haze_phase = cornette_shanks_phase(medium_.aerosol_g(), cosine) * walk.density.aerosol;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        const double turned_here = air_phase * rayleigh[i] + haze_phase * aerosol[i];
        walk.value[i] *= turned_here;
        walk.drawn[i] *=
            turned_here / (rayleigh[i] * walk.density.molecules + aerosol[i] * walk.density.aerosol);
    }
}

void PathTracer::turn_at_ground(Walk& walk, Sampler& sampler) {
    const double cosine = std::sqrt(1.0 - sampler.next());
    walk.direction = turned(walk.place.up, cosine, 2.0 * std::numbers::pi * sampler.next());
}

bool PathTracer::survives(Walk& walk, Sampler& sampler) const {
    double worth = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
        worth += importance_[i] * walk.value[i];
        all += hero_share_[i] * walk.drawn[i];
    }
    worth /= all;
    constexpr double kKept = 0.25;  // of what the path was worth at its first event
    if (walk.least_worth < 0.0) walk.least_worth = kKept * worth;
    if (worth >= walk.least_worth) return true;
    if (sampler.spare() * walk.least_worth >= worth) return false;
    for (double& value : walk.value)
        value *= walk.least_worth / worth;
    return true;
}

double PathTracer::aerosol_cosine(Sampler& sampler) const {
    // Rejection: Cornette-Shanks is Henyey-Greenstein times 1.5 (1 + c^2) / (2 + g^2).
    const double g = medium_.aerosol_g();
    for (double random = sampler.next();; random = sampler.spare()) {
        const double cosine = henyey_greenstein_cosine(g, random);
        if (2.0 * sampler.spare() < 1.0 + cosine * cosine) return cosine;
    }
}

}  // namespace skyig::render::sky::reference
