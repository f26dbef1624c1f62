// Sums of sines with polynomial phases, which lunar and planetary theories consist of, and their time
// derivatives: two terms at a time in the two-double vectors that every x86-64 and AArch64 has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace skyig::server::ephemeris::theory {

inline constexpr std::size_t kLanes = 2;

/// Two terms amplitude * sin(phase[0] + phase[1] t + phase[2] t^2 ...), phases in rad, side by side. The
/// tables are made of these by generator/series_table.cpp.
template <std::size_t kPhases>
struct TermPair {
    std::array<double, kLanes> amplitude;
    std::array<std::array<double, kLanes>, kPhases> phase;
};

/// Where the terms of one sum lie in a table of pairs.
struct TermRange {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
};

/// A quantity and its derivative by the time argument of its series.
struct Varying {
    double value = 0.0;
    double rate = 0.0;
};

namespace detail {

// Arithmetic on these is lane by lane: an extension that gcc and clang share. The compilers' own vectorisers
// take 1.3 to 2 times as long for the same loop.
using Doubles [[gnu::vector_size(kLanes * sizeof(double))]] = double;
using Words [[gnu::vector_size(kLanes * sizeof(double))]] = std::uint64_t;

[[nodiscard]] inline Doubles load(const std::array<double, kLanes>& lanes) noexcept {
    Doubles out;
    std::memcpy(&out, lanes.data(), sizeof out);
    return out;
}

[[nodiscard]] constexpr double one_over_factorial(int n) noexcept {
    double factorial = 1.0;
    for (int i = 2; i <= n; ++i)
        factorial *= i;
    return 1.0 / factorial;
}

struct SineCosine {
    Doubles sine;
    Doubles cosine;
};

/// Taylor polynomials for |angle| <= pi/2: sine within 3e-16, cosine within 6e-13.
[[nodiscard]] inline SineCosine sine_cosine(Doubles angle) noexcept {
    const Doubles square = angle * angle;
    Doubles sine = one_over_factorial(17) - square * one_over_factorial(19);
    sine = sine * square - one_over_factorial(15);
    sine = sine * square + one_over_factorial(13);
    sine = sine * square - one_over_factorial(11);
    sine = sine * square + one_over_factorial(9);
    sine = sine * square - one_over_factorial(7);
    sine = sine * square + one_over_factorial(5);
    sine = sine * square - one_over_factorial(3);
    Doubles cosine = square * one_over_factorial(16) - one_over_factorial(14);
    cosine = cosine * square + one_over_factorial(12);
    cosine = cosine * square - one_over_factorial(10);
    cosine = cosine * square + one_over_factorial(8);
    cosine = cosine * square - one_over_factorial(6);
    cosine = cosine * square + one_over_factorial(4);
    cosine = cosine * square - 0.5;
    return {.sine = sine * square * angle + angle, .cosine = cosine * square + 1.0};
}

}  // namespace detail

/// The sum of `terms` at `t`, added in their order (small ones come first in the tables), and its derivative.
/// Error: rounding of the phases, 1e-16 |phase|. |phase| <= 1e9 rad (beyond, the result is bounded noise);
/// not-a-number in, not-a-number out.
template <std::size_t kPhases>
[[nodiscard]] Varying sum_of_sines(std::span<const TermPair<kPhases>> terms, double t) noexcept {
    using detail::Doubles;
    using detail::Words;
    constexpr double kHalfTurnsPerRadian = 0.318309886183790672;
    // pi in two parts; the first has 33 bits, so that its multiples up to a million are exact.
    constexpr double kHalfTurnHigh_rad = 0x1.921fb544p+1;
    constexpr double kHalfTurnLow_rad = 0x1.0b4611a626331p-33;
    // Adding this rounds to a whole number, whose lowest bit then is the lowest of the sum.
    constexpr double kRounder = 0x1.8p52;

    Doubles value{};
    Doubles rate{};
    for (const TermPair<kPhases>& pair : terms) {
        Doubles phase = detail::load(pair.phase[kPhases - 1]);
        Doubles phase_rate{};
        for (std::size_t i = kPhases - 1; i-- > 0;) {
            phase_rate = phase_rate * t + phase;
            phase = phase * t + detail::load(pair.phase[i]);
        }
        const Doubles rounded = phase * kHalfTurnsPerRadian + kRounder;
        const Doubles half_turns = rounded - kRounder;
        const detail::SineCosine at =
            detail::sine_cosine((phase - half_turns * kHalfTurnHigh_rad) - half_turns * kHalfTurnLow_rad);
        // An odd number of half turns changes the sign of both.
        const Words sign = reinterpret_cast<Words>(rounded) << 63;
        const Doubles amplitude =
            reinterpret_cast<Doubles>(reinterpret_cast<Words>(detail::load(pair.amplitude)) ^ sign);
        value += amplitude * at.sine;
        rate += amplitude * at.cosine * phase_rate;
    }
    return {.value = value[0] + value[1], .rate = rate[0] + rate[1]};
}

/// A polynomial in `t`, lowest power first, and its derivative.
[[nodiscard]] constexpr Varying polynomial(std::span<const double> coefficients, double t) noexcept {
    Varying out;
    for (std::size_t i = coefficients.size(); i-- > 0;) {
        out.rate = out.rate * t + out.value;
        out.value = out.value * t + coefficients[i];
    }
    return out;
}

/// Poisson series: the sum over powers p of t^p times the sum of sines that `powers[p]` is in `table`.
template <std::size_t kPhases>
[[nodiscard]] Varying poisson_series(std::span<const TermPair<kPhases>> table,
                                     std::span<const TermRange> powers, double t) noexcept {
    Varying out;
    for (std::size_t power = powers.size(); power-- > 0;) {
        out.rate = out.rate * t + out.value;
        out.value *= t;
        const Varying sum = sum_of_sines(table.subspan(powers[power].first, powers[power].count), t);
        out.value += sum.value;
        out.rate += sum.rate;
    }
    return out;
}

}  // namespace skyig::server::ephemeris::theory
