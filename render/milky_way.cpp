#include "render/milky_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"
#include "render/night/natural_light.h"
#include "render/night/starlight.h"
#include "render/night/zodiacal_light.h"

namespace skyig::render {

namespace {

constexpr double kBrightest_cd_m2 = 7e-4;
// The detail's peaks stand about so far above the belt's mean.
constexpr double kPeak = 2.0;
constexpr double kFaintest_cd_m2 = 3e-5;

}  // namespace

MilkyWay::MilkyWay(std::size_t screens) : vertices_(screens), patches_(kRows, kColumns) {
    constexpr double kTurn_rad = 2.0 * std::numbers::pi;
    std::vector<glm::vec3> directions;
    for (int row = 0; row <= kRows; ++row) {
        const double latitude_rad = night::kBelt_rad * (2.0 * row / kRows - 1.0);
        for (int column = 0; column <= kColumns; ++column) {
            const double longitude_rad = kTurn_rad * column / kColumns;
            const glm::dvec3 direction{std::cos(latitude_rad) * std::cos(longitude_rad),
                                       std::cos(latitude_rad) * std::sin(longitude_rad),
                                       std::sin(latitude_rad)};
            directions.emplace_back(direction);
            for (auto& vertices : vertices_)
                vertices.push_back({glm::vec3{direction},
                                    glm::vec2{night::MilkyWayMap::place(longitude_rad, latitude_rad)},
                                    glm::vec3{0.0F}, 0.0F});
            const double belt = night::starlight_s10(longitude_rad, latitude_rad).belt;
            brightest_.push_back(std::max(kPeak * night::kS10_cd_m2 * belt, kFaintest_cd_m2));
        }
    }
    patches_.bound(directions);
}

bool MilkyWay::make_map(const NightSettings& settings, bool at_once) noexcept {
    if (settings.structure != structure_ || settings.seed != seed_) {
        map_.begin(settings.structure, settings.seed);
        structure_ = settings.structure;
        seed_ = settings.seed;
    }
    if (map_.complete()) return true;
    if (!map_.build_rows(at_once ? night::MilkyWayMap::kHeight : night::MilkyWayMap::kRowsAFrame))
        return false;
    ++map_revision_;
    return true;
}

namespace {

// What a luminance adds to the display before that light, as a vertex has it.
void shade_vertex(MilkyWayVertex& vertex, const glm::vec3& behind, const glm::vec3& passes, double most_cd_m2,
                  const shaders32::ToneParameters& tone) {
    const glm::vec3 code = shaders32::shown(behind, tone);
    const double t = night::MilkyWayMap::warped(most_cd_m2);
    const auto added = [&](double share) {
        const auto luminance = static_cast<float>(night::MilkyWayMap::unwarped(share * t));
        return shaders32::shown(behind + luminance * passes, tone) - code;
    };
    const glm::vec3 half = added(0.5);
    const glm::vec3 whole = added(1.0);
    // The channels are one grey before the night's tint: one bend serves all.
    const float sum_half = half.x + half.y + half.z;
    const float sum_whole = whole.x + whole.y + whole.z;
    const float straight = 4.0F * sum_half - sum_whole;
    const float bend = straight > 0.0F ? 2.0F * (sum_whole - 2.0F * sum_half) / straight : 0.0F;
    const auto t32 = static_cast<float>(t);
    vertex.bend = bend / t32;
    vertex.colour = whole / (t32 * (1.0F + bend));
}

}  // namespace

void MilkyWay::shade(const SkyLight& light, std::span<const shaders64::ToneParameters> tones,
                     bool at_once) noexcept {
    const glm::dmat3 enu_from_galactic = glm::transpose(light.milky_way.galactic_from_enu);
    const std::size_t count = at_once ? brightest_.size() : brightest_.size() / kFramesARound + 1;
    for (std::size_t i = 0; i < count; ++i) {
        Horizontal at = horizontal_of(enu_from_galactic * glm::dvec3{vertices_.front()[next_].direction});
        // Below the horizon the strip goes on as at its end, for the triangles that cross it.
        at.elevation_rad = std::max(at.elevation_rad, light.horizon_elevation_rad);
        const glm::vec3 behind = light.smooth_rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kSky);
        const glm::vec3 passes = light.belt_passes(at.elevation_rad);
        for (std::size_t screen = 0; screen < vertices_.size(); ++screen)
            shade_vertex(vertices_[screen][next_], behind, passes, brightest_[next_],
                         eye::single_precision(tones[screen]));
        next_ = (next_ + 1) % brightest_.size();
    }
}

double milky_way_most_codes(double background_cd_m2, const shaders64::ToneParameters& tone) noexcept {
    const auto code = [&](double luminance) {
        return 255.0 * shaders64::shown(glm::dvec3{luminance}, tone).y;
    };
    return code(background_cd_m2 + kBrightest_cd_m2) - code(background_cd_m2);
}

}  // namespace skyig::render
