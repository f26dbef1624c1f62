// Zeros and extremes of smooth functions of time, found inside brackets: never leaves the bracket, always
// ends.
#pragma once

#include <cmath>

namespace skyig::server::ephemeris::events {

/// Where `f` is zero in [a, b], to `tolerance`; f(a) = fa and f(b) = fb have opposite signs (or one is 0).
/// Regula falsi with the Illinois weight, by halves where that creeps.
template <typename Function>
[[nodiscard]] double zero_between(const Function& f, double a, double fa, double b, double fb,
                                  double tolerance) {
    constexpr int kMostSteps = 160;
    int kept_end = 0;
    for (int step = 0; step < kMostSteps && std::abs(b - a) > tolerance; ++step) {
        if (fa == 0.0) return a;
        if (fb == 0.0) return b;
        // Every third step halves, so that a function that bends hard cannot hold an end for ever.
        const double secant = (a * fb - b * fa) / (fb - fa);
        const double x = step % 3 == 2 || !std::isfinite(secant) ? 0.5 * (a + b) : secant;
        const double fx = f(x);
        if (std::signbit(fx) == std::signbit(fa)) {
            a = x;
            fa = fx;
            if (kept_end == 1) fb *= 0.5;
            kept_end = 1;
        } else {
            b = x;
            fb = fx;
            if (kept_end == -1) fa *= 0.5;
            kept_end = -1;
        }
        if (fx == 0.0) return x;
    }
    return 0.5 * (a + b);
}

/// Where `f`, which has one minimum in [a, b], has it, to `tolerance` (golden section).
template <typename Function>
[[nodiscard]] double minimum_between(const Function& f, double a, double b, double tolerance) {
    constexpr double kGolden = 0.6180339887498949;
    double inner_a = b - kGolden * (b - a);
    double inner_b = a + kGolden * (b - a);
    double f_a = f(inner_a);
    double f_b = f(inner_b);
    while (b - a > tolerance) {
        if (f_a < f_b) {
            b = inner_b;
            inner_b = inner_a;
            f_b = f_a;
            inner_a = b - kGolden * (b - a);
            f_a = f(inner_a);
        } else {
            a = inner_a;
            inner_a = inner_b;
            f_a = f_b;
            inner_b = a + kGolden * (b - a);
            f_b = f(inner_b);
        }
    }
    return 0.5 * (a + b);
}

}  // namespace skyig::server::ephemeris::events
