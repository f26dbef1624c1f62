#include "render/dome.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/eye/tone_curve.h"

namespace skyig::render {

namespace {

constexpr double kPi = std::numbers::pi;

// Of the error that the picture may have, what columns that are left out may add.
constexpr double kThinningShare = 0.4;

// Where a value lies among rising nodes: the lower one and the share of the next.
struct Place {
    std::size_t low = 0;
    float share = 0.0F;
};

Place place_in(std::span<const double> nodes, double value) {
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
    const auto low = static_cast<std::size_t>(above - nodes.begin()) - 1;
    const double share = (value - nodes[low]) / std::max(nodes[low + 1] - nodes[low], 1e-12);
    return {low, static_cast<float>(std::clamp(share, 0.0, 1.0))};
}

// What linear interpolation misses half-way to the neighbours.
glm::vec3 missed(const glm::vec3& before, const glm::vec3& here, const glm::vec3& after, double step_before,
                 double step_after) {
    const auto low = static_cast<float>(0.25 * step_after / (step_before + step_after));
    const auto high = static_cast<float>(0.25 * step_before / (step_before + step_after));
    return low * (before - here) + high * (after - here);
}

float largest_of(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

DomeLayout dome_layout(const SkyLight& light, double edge_rad, double adaptation_cd_m2,
                       std::uint64_t air) noexcept {
    DomeLayout layout;
    layout.horizon_elevation_rad = light.horizon_elevation_rad;
    layout.edge_rad = edge_rad;
    layout.adaptation_cd_m2 = adaptation_cd_m2;
    layout.air = air;
    layout.sea = light.sea != nullptr;
    const bool sun = light.sun.view != nullptr;
    const bool moon = light.moon.view != nullptr;
    const LitAir& first = sun ? light.sun : light.moon;
    layout.first_lights = sun || moon;
    if (layout.first_lights) {
        layout.azimuth_rad = first.source.azimuth_rad;
        layout.first_elevation_rad = first.source.elevation_rad;
    }
    layout.second_lights = sun && moon;
    if (layout.second_lights) {
        layout.second_elevation_rad = light.moon.source.elevation_rad;
        layout.second_azimuth_rad =
            std::remainder(light.moon.source.azimuth_rad - light.sun.source.azimuth_rad, 2.0 * kPi);
    }
    return layout;
}

bool still_serves(const DomeLayout& held, const DomeLayout& wanted) noexcept {
    constexpr double kSourceStep_rad = 0.005;
    const auto near = [](double a, double b) {
        return std::abs(std::remainder(a - b, 2.0 * kPi)) < kSourceStep_rad;
    };
    return held.edge_rad == wanted.edge_rad && held.first_lights == wanted.first_lights &&
           held.second_lights == wanted.second_lights &&
           std::abs(held.horizon_elevation_rad - wanted.horizon_elevation_rad) <
               1e-4 + 0.1 * std::abs(held.horizon_elevation_rad) &&
           near(held.first_elevation_rad, wanted.first_elevation_rad) &&
           near(held.second_elevation_rad, wanted.second_elevation_rad) &&
           near(held.second_azimuth_rad, wanted.second_azimuth_rad);
}

bool still_fits(const DomeLayout& held, const DomeLayout& wanted) noexcept {
    return held.air == wanted.air && held.sea == wanted.sea && held.veil == wanted.veil &&
           std::abs(held.adaptation_cd_m2 - wanted.adaptation_cd_m2) < 0.1 * held.adaptation_cd_m2;
}

Dome::Dome(std::size_t screens)
    : vertices_(screens),
      from_codes_(screens),
      patches_(static_cast<std::uint32_t>(DomeBend::kMost.rows()),
               static_cast<std::uint32_t>(DomeBend::kMost.columns)) {
    for (auto* rows : {&rows_, &old_rows_})
        rows->reserve(static_cast<std::size_t>(DomeBend::kMost.rows() + 1));
    for (auto* columns : {&azimuths_rad_, &old_azimuths_rad_})
        columns->reserve(static_cast<std::size_t>(DomeBend::kMost.columns + 1));
    for (auto& vertices : vertices_)
        vertices.reserve(kMaxVertices);
    for (auto& codes : from_codes_)
        codes.reserve(kMaxVertices);
    for (auto* each : {&directions_, &from_, &to_, &codes_})
        each->reserve(kMaxVertices);
}

// The two rows at the horizon stand where its softness ends, one quad apart.
void Dome::place_rows(const DomeBend& bend) {
    constexpr auto kMostRows =
        static_cast<std::size_t>(std::max(DomeBend::kMost.sky_rows, DomeBend::kMost.ground_rows));
    std::array<double, kMostRows + 1> nodes{};
    rows_.clear();
    const std::span<double> ground = std::span{nodes}.first(static_cast<std::size_t>(size_.ground_rows) + 1);
    bend.place_ground(ground);
    for (const double above : ground)
        rows_.push_back({above, Side::kGround});
    const std::span<double> sky = std::span{nodes}.first(static_cast<std::size_t>(size_.sky_rows) + 1);
    bend.place_sky(sky);
    for (const double above : sky)
        rows_.push_back({above, Side::kSky});
    azimuths_rad_.resize(static_cast<std::size_t>(size_.columns) + 1);
    bend.place_columns(azimuths_rad_);
}

void Dome::lay_out(const DomeLayout& layout, const DomeBend& bend, const DomeSize& size) {
    settle_mix();
    laid_ = true;
    std::swap(rows_, old_rows_);
    std::swap(azimuths_rad_, old_azimuths_rad_);
    const double turn_rad = layout.azimuth_rad - layout_.azimuth_rad;
    const bool same_size = !old_rows_.empty() && size == size_;
    layout_ = layout;
    size_ = size;
    place_rows(bend);
    const std::size_t count = rows_.size() * stride();
    for (auto& vertices : vertices_)
        carry_codes(vertices, count, turn_rad);
    directions_.resize(count);
    from_.resize(count);
    const double horizon = layout_.horizon_elevation_rad;
    std::size_t out = 0;
    for (const Row& row : rows_) {
        for (const double azimuth : azimuths_rad_) {
            directions_[out] = glm::vec3{direction_of({horizon + row.above_horizon_rad, azimuth})};
            for (auto& vertices : vertices_)
                vertices[out].direction = directions_[out];
            ++out;
        }
    }
    if (!same_size)
        patches_.resize(static_cast<std::uint32_t>(size.rows()), static_cast<std::uint32_t>(size.columns));
    patches_.bound(directions_);
    if (!old_rows_.empty())
        carry_over(to_, turn_rad, [&](std::size_t i, const glm::vec3& light) { from_[i] = light; });
    std::swap(from_, to_);
    from_.resize(count);
    to_.resize(count);
    codes_.resize(count);
}

void Dome::carry_codes(std::vector<DomeVertex>& vertices, std::size_t count, double turn_rad) {
    codes_.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        codes_[i] = vertices[i].to;
    vertices.resize(count);
    if (old_rows_.empty()) return;
    carry_over(codes_, turn_rad, [&](std::size_t i, const glm::vec3& code) { vertices[i].from = code; });
}

void Dome::settle_mix() noexcept {
    if (share_ >= 1.0) return;
    const auto share = static_cast<float>(share_);
    for (std::size_t i = 0; i < to_.size(); ++i)
        to_[i] = glm::mix(from_[i], to_[i], share);
    for (auto& vertices : vertices_) {
        for (DomeVertex& vertex : vertices)
            vertex.to = glm::mix(vertex.from, vertex.to, share);
    }
    share_ = 1.0;
}

// From old vertices to new ones, so that they show what was shown there.
template <class Keep>
void Dome::carry_over(std::span<const glm::vec3> values, double turn_rad, const Keep& keep) const {
    const std::size_t old_stride = old_azimuths_rad_.size();
    const auto first_sky = std::find_if(old_rows_.begin(), old_rows_.end(),
                                        [](const Row& row) { return row.side == Side::kSky; });
    std::size_t out = 0;
    for (const Row& row : rows_) {
        const auto begin = row.side == Side::kSky ? first_sky : old_rows_.begin();
        const auto end = row.side == Side::kSky ? old_rows_.end() : first_sky;
        const auto above = std::upper_bound(begin + 1, end - 1, row.above_horizon_rad,
                                            [](double a, const Row& r) { return a < r.above_horizon_rad; });
        const Row& low = *(above - 1);
        const double gap = above->above_horizon_rad - low.above_horizon_rad;
        const auto up = static_cast<float>(
            std::clamp((row.above_horizon_rad - low.above_horizon_rad) / std::max(gap, 1e-12), 0.0, 1.0));
        const glm::vec3* lower =
            &values[static_cast<std::size_t>(above - 1 - old_rows_.begin()) * old_stride];
        const glm::vec3* upper = lower + old_stride;
        for (const double azimuth : azimuths_rad_) {
            const Place at = place_in(old_azimuths_rad_, std::remainder(azimuth + turn_rad, 2.0 * kPi));
            keep(out++, glm::mix(glm::mix(lower[at.low], lower[at.low + 1], at.share),
                                 glm::mix(upper[at.low], upper[at.low + 1], at.share), up));
        }
    }
}

void Dome::look_up(const SkyLight& light, double azimuth_rad, Change change) {
    if (change == Change::kReplaced) {
        settle_mix();
        std::swap(from_, to_);
        share_ = 0.0;
        replaced_ = true;
    } else if (change == Change::kAtOnce) {
        share_ = 1.0;
    }
    const bool shift = change == Change::kScaled && share_ < 1.0;
    std::size_t out = 0;
    for (const Row& row : rows_) {
        const double elevation = light.horizon_elevation_rad + row.above_horizon_rad;
        for (const double azimuth : azimuths_rad_) {
            const glm::vec3 rgb = light.smooth_rgb_cd_m2(elevation, azimuth_rad + azimuth, row.side);
            if (shift) from_[out] += rgb - to_[out];
            to_[out++] = rgb;
        }
    }
}

glm::vec3 Dome::bend_at(std::size_t row, std::size_t column) const noexcept {
    constexpr float kMost = 1.0F / 255.0F;
    const glm::vec3* here = &codes_[row * stride() + column];
    glm::vec3 sum{0.0F};
    if (row > 0 && row + 1 < rows_.size() && rows_[row - 1].side == rows_[row + 1].side) {
        sum += missed(*(here - stride()), *here, *(here + stride()),
                      rows_[row].above_horizon_rad - rows_[row - 1].above_horizon_rad,
                      rows_[row + 1].above_horizon_rad - rows_[row].above_horizon_rad);
    }
    // The first and the last column are the same meridian.
    const std::size_t last = stride() - 1;
    const bool ends = column == 0 || column == last;
    const glm::vec3* row_begin = &codes_[row * stride()];
    sum += missed(
        ends ? row_begin[last - 1] : *(here - 1), *here, ends ? row_begin[1] : *(here + 1),
        ends ? azimuths_rad_[last] - azimuths_rad_[last - 1]
             : azimuths_rad_[column] - azimuths_rad_[column - 1],
        ends ? azimuths_rad_[1] - azimuths_rad_[0] : azimuths_rad_[column + 1] - azimuths_rad_[column]);
    return glm::clamp(sum, -kMost, kMost);
}

// Between vertices of a curved colour interpolation errs to one side; vertices moved half of that to the
// other halve the largest error.
template <class Keep>
void Dome::encode_one(const std::vector<glm::vec3>& light, const shaders32::ToneParameters& tone,
                      const Keep& keep) {
    for (std::size_t i = 0; i < light.size(); ++i)
        codes_[i] = shaders32::shown(light[i], tone);
    if (shaders32::stores_luminance(tone)) {
        for (std::size_t i = 0; i < light.size(); ++i)
            keep(i, codes_[i]);
        return;
    }
    std::size_t i = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        for (std::size_t column = 0; column < stride(); ++column, ++i)
            keep(i, glm::clamp(codes_[i] - 0.5F * bend_at(row, column), 0.0F, 1.0F));
    }
}

// A fade begins with what is on the screen, which is not quite what `from_` shows: mixed light is not mixed
// codes. Later tones change it by as much as they change that.
void Dome::encode_before(const shaders32::ToneParameters& tone, std::size_t screen) {
    std::vector<DomeVertex>& vertices = vertices_[screen];
    std::vector<glm::vec3>& shown = from_codes_[screen];
    if (!replaced_) {
        encode_one(from_, tone, [&](std::size_t i, const glm::vec3& code) {
            vertices[i].from = glm::clamp(vertices[i].from + code - shown[i], 0.0F, 1.0F);
            shown[i] = code;
        });
        return;
    }
    shown.resize(from_.size());
    encode_one(from_, tone, [&](std::size_t i, const glm::vec3& code) { shown[i] = code; });
    if (laid_) return;
    for (DomeVertex& vertex : vertices)
        vertex.from = vertex.to;
}

void Dome::encode(std::span<const shaders64::ToneParameters> tones) {
    // The first screen comes last: its codes stay for triangulate().
    for (std::size_t screen = vertices_.size(); screen-- > 0;) {
        const auto tone32 = eye::single_precision(tones[screen]);
        std::vector<DomeVertex>& vertices = vertices_[screen];
        if (share_ < 1.0) encode_before(tone32, screen);
        encode_one(to_, tone32, [&](std::size_t i, const glm::vec3& code) { vertices[i].to = code; });
    }
    if (replaced_) begin_fade();
    replaced_ = laid_ = false;
    if (share_ < 1.0) return;
    for (auto& vertices : vertices_) {
        for (DomeVertex& vertex : vertices)
            vertex.from = vertex.to;
    }
}

// What is missed at the vertices of one row that a wider step leaves out, of 1. Between two kept ones the
// triangle's edge is a great circle: away from the level it runs nearer to the pole than the row.
float Dome::thinning_error(std::size_t row, std::size_t column, std::size_t columns,
                           std::size_t step) const noexcept {
    const double elevation = layout_.horizon_elevation_rad + rows_[row].above_horizon_rad;
    const std::size_t last = rows_.size() - 1;
    const std::size_t beside =
        elevation > 0.0 ? std::min(row + 1, last) : row - std::min<std::size_t>(row, 1);
    const double apart = rows_[beside].above_horizon_rad - rows_[row].above_horizon_rad;
    const double leaves = 0.5 * std::sin(elevation) * std::cos(elevation);
    const glm::vec3* codes = &codes_[row * stride()];
    const glm::vec3* poleward = &codes_[beside * stride()];
    float largest = 0.0F;
    for (std::size_t left = column; left < column + columns; left += step) {
        const std::size_t right = left + step;
        for (std::size_t at = left + 1; at < right; ++at) {
            const double before = azimuths_rad_[at] - azimuths_rad_[left];
            const double after = azimuths_rad_[right] - azimuths_rad_[at];
            const auto share = static_cast<float>(before / (before + after));
            const auto risen = apart != 0.0 ? static_cast<float>(leaves * before * after / apart) : 0.0F;
            const glm::vec3 wanted = codes[at] + risen * (poleward[at] - codes[at]);
            largest =
                std::max(largest, largest_of(glm::abs(glm::mix(codes[left], codes[right], share) - wanted)));
        }
    }
    return largest;
}

float Dome::thinning_error(const DomePatches::Quad& corner, std::uint32_t rows,
                           std::uint32_t columns) const noexcept {
    float largest = 0.0F;
    for (std::size_t row = corner.row; row <= corner.row + rows; ++row)
        largest = std::max(largest, thinning_error(row, corner.column, columns, corner.step));
    for (std::uint32_t row = corner.row; row < corner.row + rows; ++row) {
        if (rows_[row].side != rows_[row + 1].side) continue;
        for (std::uint32_t column = corner.column; column < corner.column + columns; column += corner.step) {
            const std::size_t middle = row * stride() + column + corner.step / 2;
            const DiagonalErrors missed = diagonal_errors(
                {row, column, corner.step}, 0.5F * (codes_[middle] + codes_[middle + stride()]));
            largest = std::max(largest, std::min(missed.rising, missed.falling));
        }
    }
    return largest;
}

Dome::DiagonalErrors Dome::diagonal_errors(const DomePatches::Quad& quad,
                                           const glm::vec3& middle) const noexcept {
    const glm::vec3* low = &codes_[quad.row * stride() + quad.column];
    const glm::vec3* high = low + stride();
    return {largest_of(glm::abs(0.5F * (low[0] + high[quad.step]) - middle)),
            largest_of(glm::abs(0.5F * (low[quad.step] + high[0]) - middle))};
}

double Dome::triangulate(const SkyLight& light, double azimuth_rad, const shaders64::ToneParameters& tone,
                         double error_codes) {
    const auto tone32 = eye::single_precision(tone);
    const auto most_missed = static_cast<float>(kThinningShare * error_codes / 255.0);
    float largest = 0.0F;
    const auto may_thin = [&](const DomePatches::Quad& corner, std::uint32_t rows, std::uint32_t columns) {
        return thinning_error(corner, rows, columns) < most_missed;
    };
    const auto rising = [&](const DomePatches::Quad& quad) {
        const Row& low = rows_[quad.row];
        const Row& high = rows_[quad.row + 1];
        if (low.side != high.side) return false;
        if (quad.step > 1) {
            const std::size_t middle = quad.row * stride() + quad.column + quad.step / 2;
            const DiagonalErrors wide =
                diagonal_errors(quad, 0.5F * (codes_[middle] + codes_[middle + stride()]));
            return wide.rising < wide.falling;
        }
        const double elevation =
            light.horizon_elevation_rad + 0.5 * (low.above_horizon_rad + high.above_horizon_rad);
        const double azimuth =
            azimuth_rad + 0.5 * (azimuths_rad_[quad.column] + azimuths_rad_[quad.column + 1]);
        const DiagonalErrors missed = diagonal_errors(
            quad, shaders32::shown(light.smooth_rgb_cd_m2(elevation, azimuth, low.side), tone32));
        largest = std::max(largest, std::min(missed.rising, missed.falling));
        return missed.rising < missed.falling;
    };
    patches_.triangulate(may_thin, rising);
    return 0.5 * 255.0 * static_cast<double>(largest);
}

void Dome::begin_fade() noexcept {
    float largest = 0.0F;
    for (const auto& vertices : vertices_) {
        for (const DomeVertex& vertex : vertices)
            largest = std::max(largest, largest_of(glm::abs(vertex.to - vertex.from)));
    }
    const double frames = std::ceil(255.0 * static_cast<double>(largest) / kFadeStep_codes);
    const int gap = std::max({frames_since_replaced_, earlier_gaps_[0], earlier_gaps_[1]});
    const int longest = std::clamp(2 * gap, kHurriedFade, kLongestFade);
    fade_step_ = 1.0 / std::clamp(frames, 1.0, static_cast<double>(longest));
    earlier_gaps_ = {earlier_gaps_[1], frames_since_replaced_};
    frames_since_replaced_ = 0;
}

void Dome::step() noexcept {
    frames_since_replaced_ = std::min(frames_since_replaced_ + 1, kLongestFade);
    share_ = std::min(1.0, share_ + fade_step_);
    if (share_ > 1.0 - 1e-9) share_ = 1.0;
}

glm::dmat4 Dome::enu_from_mesh(double azimuth_rad, double horizon_rad) const noexcept {
    const double c = std::cos(azimuth_rad);
    const double s = std::sin(azimuth_rad);
    const double shift = std::sin(horizon_rad - layout_.horizon_elevation_rad) / std::cos(horizon_rad);
    return {glm::dvec4{c, -s, 0.0, 0.0}, glm::dvec4{s, c, 0.0, 0.0}, glm::dvec4{0.0, 0.0, 1.0, 0.0},
            glm::dvec4{0.0, 0.0, shift, 0.0}};
}

}  // namespace skyig::render
