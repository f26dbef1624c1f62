// Turns the Moon's features into its albedo map, bytes in rows from the south, and into the means of the map
// at the Moon's phases.
//   moon_map MAP_OUTPUT MEANS_OUTPUT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/night/generator/moon_features.h"
#include "render/night/moon_map.h"
#include "render/shaders/shared.h"

namespace {

using namespace skyig::render;
using namespace skyig::render::night;
using glm::dvec3;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kKmPerDegree = 30.3;

double smooth(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double hashed(std::int64_t x, std::int64_t y, std::int64_t z) {
    auto h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^
             static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU ^
             static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U;
    h ^= h >> 31U;
    h *= 0xD6E8FEB86659FD93U;
    h ^= h >> 29U;
    return static_cast<double>(h >> 11U) * 0x1p-53 * 2.0 - 1.0;
}

// Value noise of the sphere's points, -1..1, cells of about `cell_deg`.
double noise(const dvec3& p, double cell_deg, std::int64_t seed) {
    const dvec3 q = p / (cell_deg * kDegree);
    const dvec3 low = glm::floor(q);
    const dvec3 t = (q - low) * (q - low) * (3.0 - 2.0 * (q - low));
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const double weight = (i ? t.x : 1.0 - t.x) * (j ? t.y : 1.0 - t.y) * (k ? t.z : 1.0 - t.z);
        sum += weight * hashed(static_cast<std::int64_t>(low.x) + i + 1009 * seed,
                               static_cast<std::int64_t>(low.y) + j, static_cast<std::int64_t>(low.z) + k);
    }
    return sum;
}

double rough(const dvec3& p, double cell_deg, std::int64_t seed) {
    return 0.57 * noise(p, cell_deg, seed) + 0.29 * noise(p, 0.5 * cell_deg, seed + 1) +
           0.14 * noise(p, 0.25 * cell_deg, seed + 2);
}

dvec3 point(double latitude_deg, double longitude_deg) {
    const double level = std::cos(latitude_deg * kDegree);
    return {level * std::cos(longitude_deg * kDegree), level * std::sin(longitude_deg * kDegree),
            std::sin(latitude_deg * kDegree)};
}

// Where a point lies from a centre: degrees along a bearing and to its right, as on an equidistant map.
struct Offset {
    double along_deg, across_deg;
    [[nodiscard]] double distance_deg() const { return std::hypot(along_deg, across_deg); }
};

class Frame {
  public:
    Frame(double latitude_deg, double longitude_deg, double bearing_deg)
        : centre_(point(latitude_deg, longitude_deg)) {
        const dvec3 east{-std::sin(longitude_deg * kDegree), std::cos(longitude_deg * kDegree), 0.0};
        const dvec3 north = glm::cross(centre_, east);
        const double c = std::cos(bearing_deg * kDegree), s = std::sin(bearing_deg * kDegree);
        along_ = c * north + s * east;
        across_ = c * east - s * north;
    }
    [[nodiscard]] bool within(const dvec3& p, double reach_deg) const {
        return glm::dot(p, centre_) > std::cos(std::min(reach_deg, 180.0) * kDegree);
    }
    [[nodiscard]] Offset of(const dvec3& p) const {
        const double x = glm::dot(p, along_), y = glm::dot(p, across_);
        const double sine = std::hypot(x, y);
        const double scale = std::atan2(sine, glm::dot(p, centre_)) / (kDegree * std::max(sine, 1e-12));
        return {x * scale, y * scale};
    }

  private:
    dvec3 centre_, along_, across_;
};

// How far a point lies within a patch, 0..1 over its soft edge.
double coverage(const MoonPatch& patch, const dvec3& p, double edge_deg) {
    const Frame frame(patch.latitude_deg, patch.longitude_deg, patch.bearing_deg);
    if (!frame.within(p, 1.1 * std::max(patch.along_deg, patch.across_deg) + 2.0)) return 0.0;
    const Offset at = frame.of(p);
    const double inside = 1.0 - std::hypot(at.along_deg / patch.along_deg, at.across_deg / patch.across_deg);
    return smooth(-edge_deg, edge_deg, inside * std::min(patch.along_deg, patch.across_deg));
}

// Great circle strips that fade outwards, patchy along their way.
double ray(const MoonRay& ray, const dvec3& p, double begins_deg) {
    const Frame frame(ray.latitude_deg, ray.longitude_deg, ray.bearing_deg);
    if (!frame.within(p, ray.length_deg)) return 0.0;
    const Offset at = frame.of(p);
    if (at.along_deg <= 0.0) return 0.0;
    const double d = at.distance_deg();
    const double off_deg = std::asin(std::sin(d * kDegree) * at.across_deg / std::max(d, 1e-9)) / kDegree;
    const double width_deg = ray.width_deg * (0.6 + 0.6 * d / ray.length_deg);
    const double way =
        smooth(0.5 * begins_deg, begins_deg + 1.0, d) * (1.0 - smooth(0.3, 1.0, d / ray.length_deg));
    const double patchy = std::clamp(0.75 + 0.6 * rough(p, 3.0, 31), 0.1, 1.2);
    return ray.strength * way * patchy * std::exp(-off_deg * off_deg / (width_deg * width_deg));
}

double apron_and_rays(const MoonCrater& crater, std::int64_t number, const dvec3& p) {
    const Frame frame(crater.latitude_deg, crater.longitude_deg, 0.0);
    const double radius_deg = 0.5 * crater.diameter_km / kKmPerDegree;
    if (crater.ray_deg <= 0.0 || !frame.within(p, crater.ray_deg + 1.0)) return 0.0;
    const double d = frame.of(p).distance_deg();
    const double apron_deg = 0.12 * crater.ray_deg + radius_deg;
    double light = crater.ray_strength * std::exp(-d / apron_deg) * (1.0 + 0.4 * rough(p, 1.5, 47));
    constexpr std::int64_t kRays = 13;
    for (std::int64_t i = 0; i < kRays; ++i) {
        const double turn = (static_cast<double>(i) + 0.45 * hashed(number, i, 1)) * 360.0 / kRays;
        const double length_deg = crater.ray_deg * (0.65 + 0.35 * hashed(number, i, 2));
        const double width_deg = std::max(0.18, 0.035 * crater.ray_deg) * (1.0 + 0.4 * hashed(number, i, 3));
        const double strength = crater.ray_strength * (0.6 + 0.3 * hashed(number, i, 4));
        light += ray({crater.latitude_deg, crater.longitude_deg, turn, length_deg, width_deg, strength}, p,
                     radius_deg);
    }
    return light;
}

// Normal albedo of a point.
double albedo(const dvec3& p) {
    const dvec3 shift{rough(p, 9.0, 3), rough(p, 9.0, 7), rough(p, 9.0, 11)};
    const dvec3 bay{rough(p, 2.4, 61), rough(p, 2.4, 67), rough(p, 2.4, 71)};
    const dvec3 shore = glm::normalize(p + kDegree * (3.0 * shift + 1.3 * bay));
    const dvec3 fine = glm::normalize(p + 0.5 * kDegree * shift);
    double value = kHighlandAlbedo * (1.0 + 0.06 * rough(p, 12.0, 17) + 0.07 * rough(p, 2.6, 23));
    const double mare_mottle = 1.0 + 0.10 * rough(p, 10.0, 41) + 0.04 * rough(p, 2.0, 43);
    for (const MoonPatch& mare : kMaria) {
        const bool large = mare.across_deg > 3.0;
        const double share = coverage(mare, large ? shore : fine, large ? 0.9 : 0.35);
        value += share * (mare.albedo * mare_mottle - value);
    }
    for (const MoonPatch& land : kLands)
        value += coverage(land, fine, 0.45) * (land.albedo * (1.0 + 0.10 * rough(p, 1.6, 53)) - value);
    double fresh = 0.0;
    for (std::size_t i = 0; i < kCraters.size(); ++i)
        fresh += apron_and_rays(kCraters[i], static_cast<std::int64_t>(i), p);
    for (const MoonRay& one : kLongRays)
        fresh += ray(one, p, 1.5);
    value += (1.0 - std::exp(-fresh)) * std::max(0.0, kFreshAlbedo - value);
    for (const MoonCrater& crater : kCraters) {
        const double radius_deg = 0.5 * crater.diameter_km / kKmPerDegree;
        const MoonPatch floor{
            crater.name, crater.latitude_deg, crater.longitude_deg, 0.0, radius_deg, radius_deg, 0.0};
        value += coverage(floor, p, 0.35) * (crater.albedo - value);
    }
    // The dark collar of melted rock round Tycho.
    const double from_tycho_deg = Frame(-43.3, -11.4, 0.0).of(p).distance_deg();
    return value * (1.0 - 0.22 * std::exp(-std::pow((from_tycho_deg - 2.3) / 0.6, 2.0)));
}

std::vector<double> albedo_map() {
    std::vector<double> map;
    for (int row = 0; row < kMoonMapSize; ++row) {
        for (int column = 0; column < kMoonMapSize; ++column) {
            const double scale = 2.0 * shaders64::kMoonMapReach / kMoonMapSize;
            const double y = (column + 0.5) * scale - shaders64::kMoonMapReach;
            const double z = (row + 0.5) * scale - shaders64::kMoonMapReach;
            // Beyond the whole sphere the corners repeat its far side.
            const double rr = std::min(y * y + z * z, 3.99);
            const double level = std::sqrt(1.0 - 0.25 * rr);
            map.push_back(albedo(glm::normalize(dvec3{1.0 - 0.5 * rr, y * level, z * level})));
        }
    }
    return map;
}

double nearest(const std::vector<double>& map, const dvec3& p) {
    const glm::dvec2 place = shaders64::moon_map_place(p) * static_cast<double>(kMoonMapSize);
    const auto column = static_cast<std::size_t>(std::clamp(place.x, 0.0, kMoonMapSize - 1.0));
    const auto row = static_cast<std::size_t>(std::clamp(place.y, 0.0, kMoonMapSize - 1.0));
    return map[row * kMoonMapSize + column];
}

// Mean over the disc without libration, weighted as it is lit by a Sun over that longitude.
double mean_under(const std::vector<double>& map, double sun_longitude_rad) {
    const dvec3 sun{std::cos(sun_longitude_rad), std::sin(sun_longitude_rad), 0.0};
    constexpr int kSteps = 700;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double y = (i + 0.5) * 2.0 / kSteps - 1.0, z = (j + 0.5) * 2.0 / kSteps - 1.0;
            const double xx = 1.0 - y * y - z * z;
            if (xx <= 0.0) continue;
            const dvec3 p{std::sqrt(xx), y, z};
            const double weight = shaders64::lommel_seeliger(glm::dot(p, sun), p.x);
            sum += weight * nearest(map, p);
            weights += weight;
        }
    }
    return sum / weights;
}

void write(const std::string& path, const std::string& text) {
    std::ofstream output(path);
    output << text;
    if (!output.flush()) throw std::runtime_error(path + ": cannot be written");
}

void write_tables(const std::string& map_path, const std::string& means_path) {
    std::vector<double> map = albedo_map();
    const double mean = mean_under(map, 0.0);
    for (double& value : map)
        value /= mean;
    std::string bytes;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const long byte = std::lround(std::clamp(map[i] * kMoonMapOne, 0.0, 255.0));
        bytes += fmt::format("{}{}", byte, (i + 1) % 32 == 0 ? ",\n" : ",");
    }
    write(map_path, bytes);
    std::string means;
    for (int i = 0; i < kMoonPhaseCount; ++i)
        means += fmt::format("{:.5f},\n", mean_under(map, moon_phase_longitude_rad(i)));
    write(means_path, means);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: moon_map MAP_OUTPUT MEANS_OUTPUT\n", stderr);
        return 2;
    }
    try {
        write_tables(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "moon_map: %s\n", error.what());
        return 1;
    }
    return 0;
}
