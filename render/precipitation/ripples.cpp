#include "render/precipitation/ripples.h"

#include <algorithm>
#include <cmath>

#include "render/mixed_bits.h"

namespace skyig::render::precipitation {

namespace {

constexpr int kMostSteps = 16;
constexpr std::size_t kCellCount = std::size_t{Ripples::kCells} * Ripples::kCells;

}  // namespace

Ripples::Ripples()
    : now_(kCellCount), before_(kCellCount), slopes_(std::size_t{kCells + 1} * (kCells + 1) * 4) {}

void Ripples::push(int column, int row, float height) noexcept {
    now_[index(column, row)] += height;
    before_[index(column, row)] += height;
    for (const auto& [x, y] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        now_[index(column + x, row + y)] += 0.5F * height;
        before_[index(column + x, row + y)] += 0.5F * height;
    }
}

void Ripples::step() noexcept {
    constexpr float kShare = kRatio * kRatio;
    for (int row = 0; row < kCells; ++row) {
        const float* south = &now_[index(0, row - 1)];
        const float* here = &now_[index(0, row)];
        const float* north = &now_[index(0, row + 1)];
        float* next = &before_[index(0, row)];
        const auto at = [&](int column, float west, float east) {
            next[column] =
                kDamping * (2.0F * here[column] - next[column] +
                            kShare * (west + east + south[column] + north[column] - 4.0F * here[column]));
        };
        at(0, here[kCells - 1], here[1]);
        for (int column = 1; column + 1 < kCells; ++column)
            at(column, here[column - 1], here[column + 1]);
        at(kCells - 1, here[kCells - 2], here[0]);
    }
    std::swap(now_, before_);
}

// More drops in harder rain, as their number above a size goes: with the rate to about 0.6.
void Ripples::drop(double rate_mm_h) noexcept {
    constexpr double kOfOneMm = 0.5;
    constexpr double kMost = 8.0;
    constexpr float kDepth = -0.01F;
    const double mean = std::min(kOfOneMm * std::pow(std::max(rate_mm_h, 0.0), 0.6), kMost);
    const std::uint64_t bits = mixed(steps_);
    const int count = static_cast<int>(mean + unit_of(bits));
    for (int i = 0; i < count; ++i) {
        const std::uint64_t place = mixed(bits + static_cast<std::uint64_t>(i));
        push(static_cast<int>(place & 0x7fU), static_cast<int>((place >> 8U) & 0x7fU), kDepth);
    }
}

void Ripples::take_slopes() noexcept {
    constexpr float kPerCell = static_cast<float>(kCells / kSide_m);
    std::size_t out = 0;
    for (int row = 0; row <= kCells; ++row) {
        for (int column = 0; column <= kCells; ++column, out += 4) {
            slopes_[out] = 0.5F * kPerCell * (height(column + 1, row) - height(column - 1, row));
            slopes_[out + 1] = 0.5F * kPerCell * (height(column, row + 1) - height(column, row - 1));
        }
    }
}

bool Ripples::advance(double time_s, double rate_mm_h) noexcept {
    const double due = std::floor((time_s - time_s_) / kStep_s + 1e-6);
    if (!started_ || !(due >= 0.0) || due > kMostSteps) {
        time_s_ = time_s;
        started_ = true;
        return false;
    }
    const int steps = static_cast<int>(due);
    for (int i = 0; i < steps; ++i) {
        drop(rate_mm_h);
        step();
        ++steps_;
    }
    time_s_ += steps * kStep_s;
    if (steps > 0) take_slopes();
    return steps > 0;
}

}  // namespace skyig::render::precipitation
