#include "render/sky/sea_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/sky/path.h"
#include "render/sky/phase.h"

namespace skyig::render::sky {
namespace {

constexpr int kRows = 16;     // over the sine of elevation, quadratic at the horizon
constexpr int kColumns = 17;  // over the azimuth from the source's, half a circle
constexpr int kNight = 12;    // over the source's sine, quadratic at its horizon on both sides
constexpr int kDay = 14;
constexpr int kSources = kNight + 1 + kDay;
constexpr double kDarkestSine = 0.4;
constexpr int kSteps = 32;
constexpr int kParts = 6;  // logarithms of X, Y, Z but for the aureole, then of that without phase function
constexpr double kHeight_m = 0.01;
constexpr double kDark_cd_m2 = 1e-9;

double source_sine_at(int node) {
    const double part = node < kNight ? static_cast<double>(kNight - node) / kNight
                                      : static_cast<double>(node - kNight) / kDay;
    return (node < kNight ? -kDarkestSine : 1.0) * part * part;
}

double source_place(double sine) {
    return sine < 0.0 ? kNight * (1.0 - std::min(1.0, std::sqrt(-sine / kDarkestSine)))
                      : kNight + kDay * std::min(1.0, std::sqrt(sine));
}

std::size_t index_of(int source, int row, int column) {
    return static_cast<std::size_t>(((source * kRows + row) * kColumns + column) * kParts);
}

float log_of(double luminance) {
    return static_cast<float>(std::log(std::max(luminance, 0.0) + kDark_cd_m2));
}

void store(const AirModel& model, const Lanes& light, const Lanes& aerosol, float* node) {
    Spectrum all{};
    Spectrum hazy{};
    std::copy(std::begin(light.v), std::end(light.v), all.begin());
    std::copy(std::begin(aerosol.v), std::end(aerosol.v), hazy.begin());
    const glm::dvec3 rest = xyz_of_sunlight(model, all);
    const glm::dvec3 haze = xyz_of_sunlight(model, hazy);
    for (int k = 0; k < 3; ++k) {
        node[k] = log_of(rest[k]);
        node[k + 3] = log_of(haze[k]);
    }
}

}  // namespace

void build_sea_sky(AirData& data) {
    data.sea_sky.assign(index_of(kSources, 0, 0), 0.0F);
    std::array<PathStep, kSteps> steps;  // NOLINT: laid before it is read
    std::array<Source, kColumns> sources{};
    Path path{};
    path.steps = steps.data();
    for (int row = 0; row < kRows; ++row) {
        const double sine = std::pow(static_cast<double>(row) / (kRows - 1), 2.0);
        const double level = std::sqrt((1.0 - sine) * (1.0 + sine));
        lay_path(data, kHeight_m, sine, Side::kSky, kSteps, path);
        kernels().weigh(data.medium, path);
        for (int node = 0; node < kSources; ++node) {
            const double up = source_sine_at(node);
            const double source_level = std::sqrt((1.0 - up) * (1.0 + up));
            std::array<Lanes, kColumns> light{};
            std::array<Lanes, kColumns> aerosol{};
            for (std::size_t j = 0; j < kColumns; ++j) {
                const double azimuth = std::numbers::pi * static_cast<double>(j) / (kColumns - 1);
                const double between =
                    std::clamp(sine * up + level * source_level * std::cos(azimuth), -1.0, 1.0);
                sources[j] = {up, between, static_cast<float>(rayleigh_phase(between))};
                kernels().add_first_order(data.medium, data.source_table(), path, sources[j], light[j],
                                          aerosol[j]);
            }
            if (!data.moments.empty())
                kernels().add_higher_orders(data.medium, data.moment_table(), path, sources.data(), kColumns,
                                            light.data());
            for (int j = 0; j < kColumns; ++j) {
                const auto slot = static_cast<std::size_t>(j);
                store(data.model, light[slot], aerosol[slot], &data.sea_sky[index_of(node, row, j)]);
            }
        }
    }
}

SeaSky::SeaSky(const AirData& data, double source_sine) noexcept
    : data_(data),
      source_sine_(static_cast<float>(std::clamp(source_sine, -1.0, 1.0))),
      source_level_(std::sqrt(1.0F - source_sine_ * source_sine_)) {
    const double place = source_place(static_cast<double>(source_sine_));
    low_ = std::min(static_cast<int>(place), kSources - 2);
    part_ = static_cast<float>(place - low_);
}

glm::vec3 SeaSky::xyz(float sine, float azimuth_cosine) const noexcept {
    const float up = std::clamp(sine, 0.0F, 1.0F);
    const float cosine = std::clamp(azimuth_cosine, -1.0F, 1.0F);
    const float row = std::sqrt(up) * static_cast<float>(kRows - 1);
    const float column = std::acos(cosine) * std::numbers::inv_pi_v<float> * static_cast<float>(kColumns - 1);
    const int i = std::min(static_cast<int>(row), kRows - 2);
    const int j = std::min(static_cast<int>(column), kColumns - 2);
    const float a = row - static_cast<float>(i);
    const float b = column - static_cast<float>(j);
    std::array<float, kParts> sum{};
    for (int s = 0; s < 2; ++s) {
        const float by_source = s == 0 ? 1.0F - part_ : part_;
        for (int r = 0; r < 2; ++r) {
            const float by_row = by_source * (r == 0 ? 1.0F - a : a);
            const float* node = &data_.sea_sky[index_of(low_ + s, i + r, j)];
            for (std::size_t k = 0; k < kParts; ++k)
                sum[k] += by_row * ((1.0F - b) * node[k] + b * node[k + kParts]);
        }
    }
    const float between = up * source_sine_ + std::sqrt(1.0F - up * up) * source_level_ * cosine;
    const float phase =
        cornette_shanks_phase(static_cast<float>(data_.model.aerosol_g), std::clamp(between, -1.0F, 1.0F));
    return {std::exp(sum[0]) + phase * std::exp(sum[3]), std::exp(sum[1]) + phase * std::exp(sum[4]),
            std::exp(sum[2]) + phase * std::exp(sum[5])};
}

}  // namespace skyig::render::sky
