#include "render/sky/sea_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/shaders/shared.h"

namespace skyig::render::sky {
namespace {

constexpr double kPi = std::numbers::pi;

double finite_or_zero(double value) {
    return std::isfinite(value) ? value : 0.0;
}

// Smith's integral: what hiding adds to the projected area of a Gaussian surface, times `up`, so that it
// stays finite on the horizon. \param slope  rms towards the direction
double hidden_up(double up, double slope) {
    const double level = std::sqrt(std::max(0.0, (1.0 - up) * (1.0 + up)));
    const double spread = std::numbers::sqrt2 * slope * level;
    if (spread <= 1e-9) return 0.0;
    const double nu = up / spread;
    return 0.5 * (spread * std::exp(-nu * nu) * std::numbers::inv_sqrtpi - up * std::erfc(nu));
}

double rms_along(const SlopeVariance& variance, double east, double north) {
    return std::sqrt(std::max(0.0, variance.east_east * east * east + variance.north_north * north * north +
                                       2.0 * variance.east_north * east * north));
}

// Gauss-Legendre of eight nodes on -1..1, and Gauss-Hermite of three for a normal distribution.
constexpr std::array<double, 8> kLegendreNode = {
    -0.9602898564975363, -0.7966664774136267, -0.5255324099163290, -0.1834346424956498,
    0.1834346424956498,  0.5255324099163290,  0.7966664774136267,  0.9602898564975363};
constexpr std::array<double, 8> kLegendreWeight = {0.1012285362903763, 0.2223810344533745, 0.3137066458778873,
                                                   0.3626837833783620, 0.3626837833783620, 0.3137066458778873,
                                                   0.2223810344533745, 0.1012285362903763};
constexpr std::array<double, 3> kHermiteNode = {-1.7320508075688772, 0.0, 1.7320508075688772};
constexpr std::array<double, 3> kHermiteWeight = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
static_assert(kLegendreNode.size() * kHermiteNode.size() == SeaSurface::kFacets);

// A source below the level counts as on it.
constexpr double kLowestSource = 1e-5;

// Rise away from the eye and to its right of the facet that mirrors a source into the eye.
glm::dvec2 mirroring_slope(double view_up, const glm::dvec3& source) {
    const double up = std::clamp(view_up, 0.0, 1.0);
    const double sum_up = std::max(up + std::max(source.z, kLowestSource), kLowestSource);
    return {-(source.x - std::sqrt((1.0 - up) * (1.0 + up))) / sum_up, -source.y / sum_up};
}

// Beyond this many standard deviations no facet counts.
constexpr double kSteepest = 4.0;

}  // namespace

double fresnel_reflectance(double cosine) noexcept {
    return shaders64::fresnel_reflectance(std::clamp(cosine, 0.0, 1.0), kSeaIndex);
}

double wave_slope(const Wave& wave) noexcept {
    constexpr double kBreaks = 0.142;
    return wave.length_m > 0.0 ? kPi * std::clamp(finite_or_zero(wave.height_m / wave.length_m), 0.0, kBreaks)
                               : 0.0;
}

SlopeVariance slope_variance(const Ground& ground, std::span<const Wave> waves) noexcept {
    const double wind_m_s = std::clamp(finite_or_zero(ground.wind_m_s), 0.0, 25.0);
    // A breeze too light for the two lines to tell apart has no direction.
    const double half = 0.5 * (0.003 + 0.00508 * wind_m_s);
    const double along = std::max(0.00316 * wind_m_s, half);
    const double across = std::min(0.003 + 0.00192 * wind_m_s, half);
    const auto lay = [](double first, double second, double azimuth_rad) {
        const double e = std::sin(azimuth_rad);
        const double n = std::cos(azimuth_rad);
        return SlopeVariance{first * e * e + second * n * n, first * n * n + second * e * e,
                             (first - second) * e * n};
    };
    SlopeVariance sum = lay(along, across, finite_or_zero(ground.wind_from_rad));
    for (const Wave& wave : waves) {
        const double slope = wave_slope(wave);
        const SlopeVariance of_wave = lay(0.5 * slope * slope, 0.0, finite_or_zero(wave.direction_rad));
        sum.east_east += of_wave.east_east;
        sum.north_north += of_wave.north_north;
        sum.east_north += of_wave.east_north;
    }
    return sum;
}

SlopeVariance roughened(const SlopeVariance& variance) noexcept {
    const double least = shaders64::least_slope_variance();
    return {variance.east_east + least, variance.north_north + least, variance.east_north};
}

SeaSurface::SeaSurface(const SlopeVariance& variance) noexcept : variance_(roughened(variance)) {
    determinant_ = variance_.east_east * variance_.north_north - variance_.east_north * variance_.east_north;
    std::array<double, kNodes> from_below{};
    for (std::size_t k = 0; k < kNodes; ++k) {
        const double up = up_of(k);
        for (const Facet& facet : facets(up))
            reflectance_[k] += facet.share;
        for (const Facet& facet : facets(-up))
            from_below[k] += facet.share;
    }
    const double slope = facet_slope();
    for (std::size_t k = 0; k < kNodes; ++k) {
        const double source_up = up_of(std::max<std::size_t>(k, 1));
        const double shadowed = 1.0 + hidden_up(source_up, slope) / source_up;
        for (const Facet& facet : facets(source_up)) {
            const double up = facet.mirrored_up;
            const double leaves = up > 0.0 ? shadowed / (shadowed + hidden_up(up, slope) / up) : 0.0;
            const double second = at_root(up > 0.0 ? from_below : reflectance_, std::abs(up));
            sent_on_[k] += facet.share * (1.0 - leaves) * second;
        }
    }
}

double SeaSurface::sent_on(double source_up) const noexcept {
    return at_root(sent_on_, source_up);
}

SeaSurface::Mirror SeaSurface::mirror(double view_up, double view_azimuth_rad,
                                      const glm::dvec3& source) const noexcept {
    const glm::dvec2 slope = mirroring_slope(view_up, source);
    return {density(view_azimuth_rad, slope), per_density(view_up, view_azimuth_rad, source, slope)};
}

// 0 where it no longer counts.
double SeaSurface::density(double view_azimuth_rad, const glm::dvec2& slope) const noexcept {
    const double away_east = std::sin(view_azimuth_rad);
    const double away_north = std::cos(view_azimuth_rad);
    const double east = slope.x * away_east + slope.y * away_north;
    const double north = slope.x * away_north - slope.y * away_east;
    const double exponent = 0.5 *
                            (variance_.north_north * east * east + variance_.east_east * north * north -
                             2.0 * variance_.east_north * east * north) /
                            determinant_;
    return exponent < 40.0 ? std::exp(-exponent) / (2.0 * kPi * std::sqrt(determinant_)) : 0.0;
}

double SeaSurface::per_density(double view_up, double view_azimuth_rad, const glm::dvec3& source,
                               const glm::dvec2& slope) const noexcept {
    const double up = std::clamp(view_up, 0.0, 1.0);
    const double source_up = std::max(source.z, kLowestSource);
    const double view_level = std::sqrt((1.0 - up) * (1.0 + up));
    const double upright2 = 1.0 / (1.0 + glm::dot(slope, slope));
    const double between = source_up * up - source.x * view_level;
    const double incidence = std::sqrt(std::clamp(0.5 * (1.0 + between), 0.0, 1.0));

    const double away_east = std::sin(view_azimuth_rad);
    const double away_north = std::cos(view_azimuth_rad);
    const double seen = up + hidden_up(up, rms_along(variance_, away_east, away_north));
    const double source_level = std::max(std::hypot(source.x, source.y), 1e-12);
    const double lit_east = (source.x * away_east + source.y * away_north) / source_level;
    const double lit_north = (source.x * away_north - source.y * away_east) / source_level;
    const double shadowed = hidden_up(source_up, rms_along(variance_, lit_east, lit_north)) / source_up;
    return fresnel_reflectance(incidence) / (4.0 * upright2 * upright2 * (seen + up * shadowed));
}

double SeaSurface::glitter_per_sr(double view_up, double view_azimuth_rad,
                                  const glm::dvec3& source) const noexcept {
    const glm::dvec2 slope = mirroring_slope(view_up, source);
    const double found = density(view_azimuth_rad, slope);
    const double first = found > 0.0 ? found * per_density(view_up, view_azimuth_rad, source, slope) : 0.0;
    const double source_up = std::max(source.z, kLowestSource);
    const double onwards = 1.0 + source.x / std::max(std::hypot(source.x, source.y), 1e-12);
    return first + source_up * sent_on(source_up) * onwards / kPi;
}

SeaSurface::Facets SeaSurface::facets(double view_up) const noexcept {
    const double up = std::clamp(view_up, -1.0, 1.0);
    const double level = std::sqrt((1.0 - up) * (1.0 + up));
    const double slope = facet_slope();
    // The eye sees those that do not rise away from it too steeply.
    const double steepest_away = level > 0.0 ? up / (level * slope) : std::copysign(kSteepest, up);
    const double from = -std::clamp(steepest_away, -kSteepest, kSteepest);
    const double middle = 0.5 * (kSteepest + from);
    const double half = 0.5 * (kSteepest - from);
    const glm::dvec3 view{-level, 0.0, up};
    Facets all;
    double seen = 0.0;
    std::size_t out = 0;
    for (std::size_t i = 0; i < kLegendreNode.size(); ++i) {
        const double x = middle + half * kLegendreNode[i];
        const double along = half * kLegendreWeight[i] * std::exp(-0.5 * x * x) / std::sqrt(2.0 * kPi);
        for (std::size_t j = 0; j < kHermiteNode.size(); ++j) {
            const glm::dvec3 normal = glm::normalize(glm::dvec3{-slope * x, -slope * kHermiteNode[j], 1.0});
            const double incidence = std::max(0.0, glm::dot(normal, view));
            const double area = along * kHermiteWeight[j] * incidence / normal.z;
            glm::dvec3 reflected = 2.0 * incidence * normal - view;
            const double mirrored_up = reflected.z;
            reflected.z = std::abs(reflected.z);
            seen += area;
            all[out++] = {
                reflected, area * fresnel_reflectance(incidence), mirrored_up, {x, kHermiteNode[j]}};
        }
    }
    for (Facet& facet : all)
        facet.share /= std::max(seen, 1e-300);
    return all;
}

double SeaSurface::mean_reflectance(double view_up) const noexcept {
    return at_root(reflectance_, view_up);
}

double SeaSurface::up_of(std::size_t node) noexcept {
    const double root = static_cast<double>(node) / (kNodes - 1);
    return root * root;
}

double SeaSurface::at_root(const std::array<double, kNodes>& nodes, double up) noexcept {
    const double place = std::sqrt(std::clamp(up, 0.0, 1.0)) * (kNodes - 1);
    const auto low = std::min(static_cast<std::size_t>(place), kNodes - 2);
    const double part = place - static_cast<double>(low);
    return nodes[low] + part * (nodes[low + 1] - nodes[low]);
}

}  // namespace skyig::render::sky
