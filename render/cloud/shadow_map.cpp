#include "render/cloud/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "render/cloud/snapshot.h"

namespace skyig::render::cloud {

namespace {

constexpr int kCells = ShadowMap::kCells;
constexpr int kRows = ShadowMap::kLevels * kCells;
constexpr std::size_t kSquare = std::size_t{kCells} * kCells;

// The eye may go this part of the smallest square's side before there is a new map.
constexpr double kAway_m = 0.125 * kCells * ShadowMap::kCell_m[0];

constexpr double kSourceStep = 1e-4;
/// Of the beam: a mean that moves by less shows nowhere.
constexpr float kMeanStep = 5e-4F;

// Shapes that have moved by less against the lattice, or are older by less, cast the same shadows: an eighth
// of the smallest cell.
constexpr double kShift_m = 0.125 * ShadowMap::kCell_m[0];
constexpr double kAge_s = 8.0;

// How wide the edge of a shadow is on the ground: of the layers' bases, by what they cover.
double penumbra_of(const ShadowFrame& frame) noexcept {
    double covered = 0.0;
    double height_m = 0.0;
    for (const CloudLayer& cloud : frame.moment.scene.weather.all_clouds()) {
        covered += cloud.coverage;
        height_m += cloud.coverage * std::max(cloud.base_m + 0.5 * cloud.thickness_m, 0.0);
    }
    const double sine = std::max(frame.source_enu.z, 0.02);
    // Across the beam it is as wide as the disc, along it longer; the mean of both.
    const double across = covered > 0.0 ? frame.source_diameter_rad * height_m / covered / sine : 0.0;
    return 0.5 * across * (1.0 + 1.0 / sine);
}

const CloudLayer* layer_of(const Weather& weather, std::uint32_t seed) noexcept {
    const auto clouds = weather.all_clouds();
    const auto found =
        std::ranges::find_if(clouds, [seed](const CloudLayer& layer) { return layer.seed == seed; });
    return found == clouds.end() ? nullptr : &*found;
}

// Whether the clouds would cast the same shadows on a lattice that drifts with the layer of that seed.
bool same_shadows(const Weather& made, const Weather& now, std::uint32_t seed) noexcept {
    const CloudLayer* then = layer_of(made, seed);
    const CloudLayer* lead = layer_of(now, seed);
    const bool led = then != nullptr && lead != nullptr;
    const glm::dvec2 drifted_m = led ? lead->drift_m - then->drift_m : glm::dvec2{0.0};
    return std::ranges::equal(made.all_clouds(), now.all_clouds(),
                              [&](const CloudLayer& before, const CloudLayer& after) {
                                  if (glm::distance(after.drift_m - before.drift_m, drifted_m) > kShift_m ||
                                      std::abs(after.age_s - before.age_s) > kAge_s)
                                      return false;
                                  CloudLayer moved = before;
                                  moved.drift_m = after.drift_m;
                                  moved.age_s = after.age_s;
                                  return moved == after;
                              });
}

// Of an edge this wide in cells, what a cell takes from each neighbour: the variance is that of a disc's
// edge.
float neighbour_share(double penumbra_cells) noexcept {
    return static_cast<float>(std::min(penumbra_cells * penumbra_cells / 24.0, 0.25));
}

}  // namespace

void ShadowMap::stop() noexcept {
    if (!shown_) return;
    shown_ = making_ = false;
    last_eye_.reset();
    contrast_ = 0.0F;
    ++revision_;
}

void ShadowMap::reserve() {
    cells_.reserve(kLevels * kSquare);
    for (Grid& grid : grids_)
        grid.passed.resize(kLevels * kSquare);
}

bool ShadowMap::stands_still(const ShadowFrame& frame) const noexcept {
    const glm::dvec2 away_m{eye_offset_m(made_eye_, frame.moment.eye)};
    return glm::dot(away_m, away_m) < kAway_m * kAway_m &&
           glm::distance(made_source_enu_, frame.source_enu) < kSourceStep &&
           same_shadows(made_weather_, frame.moment.scene.weather, seed_);
}

// The lattice lies still under the eye but for the drift of the layer that it was begun with.
void ShadowMap::follow(const ShadowFrame& frame) noexcept {
    const Weather& weather = frame.moment.scene.weather;
    const CloudLayer* layer = layer_of(weather, seed_);
    if (last_eye_) {
        origin_m_ -= glm::dvec2{eye_offset_m(*last_eye_, frame.moment.eye)};
        if (layer != nullptr) origin_m_ += layer->drift_m - last_drift_m_;
    }
    if (layer == nullptr && weather.cloud_count > 0) layer = &weather.clouds[0];
    if (layer != nullptr) {
        seed_ = layer->seed;
        last_drift_m_ = layer->drift_m;
    }
    last_eye_ = frame.moment.eye;
}

// Where the cells lie round the eye.
void ShadowMap::lay(Grid& grid) const noexcept {
    for (std::size_t k = 0; k < kLevels; ++k) {
        const glm::dvec2 middle = -origin_m_ / static_cast<double>(kCell_m[k]);
        grid.low[k] = glm::ivec2{glm::round(middle)} - kCells / 2;
    }
}

// No shadows yet: the mean everywhere, from which the first map comes in.
void ShadowMap::begin_plain() noexcept {
    Grid& grid = grids_[new_];
    lay(grid);
    std::fill(grid.passed.begin(), grid.passed.end(), mean_);
}

void ShadowMap::begin(CloudMaker& maker, const ShadowFrame& frame) {
    lay(grids_[next_]);
    source_ = &maker.freeze(CloudMaker::kShadowSlot, frame.moment);
    beam_ = {glm::vec3{frame.source_enu}, static_cast<float>(frame.source_diameter_rad)};
    penumbra_m_ = penumbra_of(frame);
    made_origin_m_ = origin_m_;
    made_weather_ = frame.moment.scene.weather;
    made_source_enu_ = frame.source_enu;
    made_eye_ = frame.moment.eye;
    rows_ = 0;
    making_ = true;
}

void ShadowMap::make_rows(int count) noexcept {
    // Of a cell: finer would only be met by chance.
    constexpr float kGrain = 0.5F;
    Grid& grid = grids_[next_];
    std::array<glm::vec2, kCells> places_m;
    for (const int end = std::min(rows_ + count, kRows); rows_ < end; ++rows_) {
        const auto k = static_cast<std::size_t>(rows_ / kCells);
        const auto cell_m = static_cast<double>(kCell_m[k]);
        for (int i = 0; i < kCells; ++i) {
            const glm::dvec2 cell = glm::dvec2{grid.low[k] + glm::ivec2{i, rows_ % kCells}} + 0.5;
            places_m[static_cast<std::size_t>(i)] = glm::vec2{made_origin_m_ + cell * cell_m};
        }
        source_->shadow(beam_, kGrain * kCell_m[k], places_m,
                        std::span{grid.passed}.subspan(static_cast<std::size_t>(rows_) * kCells, kCells));
    }
}

// The disc of the source has a width: rows first, then columns.
void ShadowMap::blur(Grid& grid) const noexcept {
    for (std::size_t k = 0; k < kLevels; ++k) {
        double cells = penumbra_m_ / static_cast<double>(kCell_m[k]);
        const std::span<float> square = std::span{grid.passed}.subspan(k * kSquare, kSquare);
        const auto pass = [&](std::size_t step, std::size_t across, float share) {
            for (std::size_t line = 0; line < kCells; ++line) {
                float* at = &square[line * across];
                float before = at[0];
                for (std::size_t i = 0; i < kCells; ++i, at += step) {
                    const float own = *at;
                    const float after = i + 1 < kCells ? at[step] : own;
                    *at = own + share * (before + after - 2.0F * own);
                    before = own;
                }
            }
        };
        // Each turn widens the edge by as much as it can: the squares of widths add up.
        constexpr int kMostTurns = 12;
        for (int turn = 0; turn < kMostTurns && cells > 0.2; ++turn) {
            const float share = neighbour_share(cells);
            pass(1, kCells, share);
            pass(kCells, 1, share);
            cells = std::sqrt(std::max(cells * cells - 24.0 * static_cast<double>(share), 0.0));
        }
    }
}

// From the old one to the new one, where it was made; the old one's rim shows the new one.
void ShadowMap::show(double share) noexcept {
    const Grid& old = grids_[old_];
    const Grid& made = grids_[new_];
    low_ = made.low;
    cells_ = made.passed;
    if (share >= 1.0) return;
    const auto kept = static_cast<float>(1.0 - share);
    for (std::size_t k = 0; k < kLevels; ++k) {
        const glm::ivec2 shift = made.low[k] - old.low[k];
        for (int row = std::max(0, -shift.y); row < std::min(kCells, kCells - shift.y); ++row) {
            const int first = std::max(0, -shift.x);
            const int last = std::min(kCells, kCells - shift.x);
            float* to = &cells_[k * kSquare + static_cast<std::size_t>(row * kCells)];
            const float* from = &old.passed[k * kSquare];
            for (int i = first; i < last; ++i)
                to[i] += kept * (from[(row + shift.y) * kCells + i + shift.x] - to[i]);
        }
    }
}

// Brings the mean over the largest square to that of the area: where clouds cast more shadow than their share
// of the sky, as seen along a low beam, shadows are lightened; where less, gaps are dimmed.
void ShadowMap::level() noexcept {
    const std::span<const float> largest = std::span{cells_}.subspan((kLevels - 1) * kSquare);
    double sum = 0.0;
    for (const float passed : largest)
        sum += static_cast<double>(passed);
    const auto found = static_cast<float>(sum / static_cast<double>(kSquare));
    float scale = 1.0F;
    float lift = 0.0F;
    if (found < mean_ && found < 1.0F) {
        scale = 1.0F + levelled_ * ((1.0F - mean_) / (1.0F - found) - 1.0F);
        lift = 1.0F - scale;
    } else if (found > mean_) {
        scale = 1.0F + levelled_ * (mean_ / found - 1.0F);
    }
    double squares = 0.0;
    for (float& passed : cells_) {
        passed = scale * passed + lift;
        squares += static_cast<double>((passed - mean_) * (passed - mean_));
    }
    contrast_ = static_cast<float>(std::sqrt(squares / static_cast<double>(cells_.size())));
}

// Weather that ends somewhere has no mean to be brought to. \return whether it has gone on
bool ShadowMap::lead_level(const Weather& weather, bool at_once) noexcept {
    constexpr float kStep = 1.0F / kFrames;
    const auto clouds = weather.all_clouds();
    const bool ends =
        std::ranges::any_of(clouds, [](const CloudLayer& cloud) { return cloud.area.has_value(); });
    const float before = levelled_;
    const float wanted = ends ? 0.0F : 1.0F;
    levelled_ = at_once ? wanted : std::clamp(wanted, before - kStep, before + kStep);
    return levelled_ != before;
}

void ShadowMap::update(CloudMaker& maker, const ShadowFrame& frame) {
    const bool at_once = frame.jumped || (last_eye_ && has_leapt(*last_eye_, frame.moment.eye));
    const bool first = !shown_ || at_once;
    if (first) {
        reserve();
        last_eye_.reset();
        origin_m_ = {};
        seed_ = 0;
    }
    follow(frame);
    const auto mean = static_cast<float>(frame.mean);
    bool changed =
        lead_level(frame.moment.scene.weather, first) || first || std::abs(mean - mean_) > kMeanStep;
    if (changed) mean_ = mean;
    if (first) {
        if (at_once) {
            begin(maker, frame);
            make_rows(kRows);
            blur(grids_[next_]);
            std::swap(new_, next_);
            making_ = false;
        } else {
            begin_plain();
            begin(maker, frame);
        }
        blend_ = kRows;
        shown_ = changed = true;
    } else {
        if (blend_ < kRows) {
            blend_ = std::min(blend_ + kRowsAFrame, kRows);
            changed = true;
        }
        if (making_) make_rows(kRowsAFrame);
        if (making_ && rows_ == kRows && blend_ == kRows) {
            blur(grids_[next_]);
            const std::size_t free = old_;
            old_ = new_;
            new_ = next_;
            next_ = free;
            blend_ = 0;
            making_ = false;
        }
        if (!making_ && !stands_still(frame)) begin(maker, frame);
    }
    if (changed) {
        show(static_cast<double>(blend_) / kRows);
        level();
        ++revision_;
        if (first) begun_ = revision_;
    }
    for (std::size_t k = 0; k < kLevels; ++k)
        corners_m_[k] = glm::vec2{origin_m_ + glm::dvec2{low_[k]} * static_cast<double>(kCell_m[k])};
}

ShadowCells ShadowMap::as_cells() const noexcept {
    ShadowCells cells{};
    cells.passed = cells_.data();
    for (std::size_t k = 0; k < kLevels; ++k) {
        cells.corner_m[k][0] = corners_m_[k].x;
        cells.corner_m[k][1] = corners_m_[k].y;
        cells.inverse_cell_m[k] = 1.0F / kCell_m[k];
    }
    cells.least_cell_m = kCell_m[0];
    cells.mean = mean_;
    cells.reach_m = kReach_m;
    return cells;
}

float ShadowMap::at(const glm::vec2& ground_m) const noexcept {
    float sum = 0.0F;
    float left = 1.0F;
    for (std::size_t k = 0; k < kLevels && left > 0.0F; ++k) {
        const glm::vec2 place = (ground_m - corners_m_[k]) * (1.0F / kCell_m[k]) - 0.5F;
        constexpr auto last = static_cast<float>(kCells - 1);
        const float inside =
            std::min({place.x, place.y, last - place.x, last - place.y}) * (1.0F / (kShadowFade * last));
        if (!(inside > 0.0F)) continue;
        const float share = left * std::min(inside, 1.0F);
        const int column = std::min(static_cast<int>(place.x), kCells - 2);
        const int row = std::min(static_cast<int>(place.y), kCells - 2);
        const float right = place.x - static_cast<float>(column);
        const float up = place.y - static_cast<float>(row);
        const float* low = &cells_[k * kSquare + static_cast<std::size_t>(row * kCells + column)];
        const float* high = low + kCells;
        const float below = low[0] + right * (low[1] - low[0]);
        const float above = high[0] + right * (high[1] - high[0]);
        sum += share * (below + up * (above - below));
        left -= share;
    }
    return sum + left * mean_;
}

float ShadowMap::along(const glm::vec2& middle_m, const glm::vec2& half_m) const noexcept {
    const float apart_m = std::max(kCell_m[0], kShadowApart * glm::length(middle_m));
    const int count = std::clamp(static_cast<int>(2.0F * glm::length(half_m) / apart_m), 1, kShadowLooks);
    float sum = 0.0F;
    for (int i = 0; i < count; ++i) {
        const float place = (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count) - 1.0F;
        sum += at(middle_m + place * half_m);
    }
    return sum / static_cast<float>(count);
}

}  // namespace skyig::render::cloud
