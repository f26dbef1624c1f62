// Seeded random numbers for paths, the same on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/mixed_bits.h"

namespace skyig::render::sky::reference {

/// SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) noexcept : state_(seed) {}

    std::uint64_t bits() noexcept {
        const std::uint64_t answer = mixed(state_);
        state_ += 0x9e3779b97f4a7c15U;
        return answer;
    }
    /// In [0, 1).
    double uniform() noexcept { return unit_of(bits()); }

  private:
    std::uint64_t state_;
};

/// The first numbers of each path are an additive recurrence with a random start, which fills the cube more
/// evenly than chance does (Roberts 2018: powers of the root of x^(d+1) = x + 1); the rest are random.
class Sampler {
  public:
    explicit Sampler(std::uint64_t seed) noexcept : random_(seed) {
        double root = 1.2;
        for (int pass = 0; pass < 60; ++pass)
            root = std::pow(1.0 + root, 1.0 / (kEven + 1.0));
        double power = 1.0;
        for (std::size_t i = 0; i < kEven; ++i) {
            power /= root;
            step_[i] = power;
            start_[i] = random_.uniform();
        }
    }

    void begin_path() noexcept {
        for (std::size_t i = 0; i < kEven; ++i) {
            start_[i] += step_[i];
            if (start_[i] >= 1.0) start_[i] -= 1.0;
        }
        used_ = 0;
    }
    double next() noexcept { return used_ < kEven ? start_[used_++] : random_.uniform(); }
    /// For how often something is tried, so that it does not shift what follows.
    double spare() noexcept { return random_.uniform(); }

  private:
    static constexpr std::size_t kEven = 5;

    Random random_;
    std::array<double, kEven> step_{};
    std::array<double, kEven> start_{};
    std::size_t used_ = 0;
};

}  // namespace skyig::render::sky::reference
