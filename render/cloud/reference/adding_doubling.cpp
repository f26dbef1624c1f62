#include "render/cloud/reference/adding_doubling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace skyig::render::cloud::reference {

namespace {

constexpr double kPi = std::numbers::pi;

// Abscissas and weights of Gauss and Legendre over 0..1.
void add_gauss(std::size_t count, std::vector<double>& mu, std::vector<double>& weights) {
    const auto n = static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        double x = std::cos(kPi * (static_cast<double>(i) + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int round = 0; round < 100; ++round) {
            double last = 1.0;
            double now = x;
            for (std::size_t l = 2; l <= count; ++l) {
                const auto degree = static_cast<double>(l);
                last = std::exchange(now, ((2.0 * degree - 1.0) * x * now - (degree - 1.0) * last) / degree);
            }
            slope = n * (x * now - last) / (x * x - 1.0);
            const double step = now / slope;
            x -= step;
            if (std::abs(step) < 1e-15) break;
        }
        mu.push_back(0.5 * (1.0 - x));
        weights.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
}

// Associated Legendre functions of order `mode`, times sqrt((l - m)! / (l + m)!), for l = 0 .. count - 1.
std::vector<double> legendre(int mode, std::size_t count, double mu) {
    std::vector<double> values(count, 0.0);
    const auto m = static_cast<std::size_t>(mode);
    if (m >= count) return values;
    double first = 1.0;
    for (std::size_t k = 1; k <= m; ++k) {
        const auto order = static_cast<double>(k);
        first *= std::sqrt((2.0 * order - 1.0) / (2.0 * order) * (1.0 - mu * mu));
    }
    values[m] = first;
    const auto order = static_cast<double>(mode);
    for (std::size_t l = m; l + 1 < count; ++l) {
        const auto degree = static_cast<double>(l);
        const double before = l > m ? values[l - 1] : 0.0;
        values[l + 1] =
            ((2.0 * degree + 1.0) * mu * values[l] - std::sqrt(degree * degree - order * order) * before) /
            std::sqrt((degree + 1.0) * (degree + 1.0) - order * order);
    }
    return values;
}

// Solves a x = b for all columns of b, which turns into x.
void solve(Matrix& a, Matrix& b) {
    const std::size_t n = a.size;
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < n; ++row) {
            if (std::abs(a(row, column)) > std::abs(a(pivot, column))) pivot = row;
        }
        for (std::size_t k = 0; pivot != column && k < n; ++k) {
            std::swap(a(pivot, k), a(column, k));
            std::swap(b(pivot, k), b(column, k));
        }
        for (std::size_t row = 0; row < n; ++row) {
            if (row == column) continue;
            const double factor = a(row, column) / a(column, column);
            if (factor == 0.0) continue;
            for (std::size_t k = column; k < n; ++k)
                a(row, k) -= factor * a(column, k);
            for (std::size_t k = 0; k < n; ++k)
                b(row, k) -= factor * b(column, k);
        }
    }
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t k = 0; k < n; ++k)
            b(row, k) /= a(row, row);
    }
}

}  // namespace

AddingDoubling::AddingDoubling(const Medium& medium, int mode, std::size_t streams,
                               std::span<const double> asked_mu)
    : medium_(medium), asked_(asked_mu.size()) {
    add_gauss(streams, mu_, weights_);
    mu_.insert(mu_.end(), asked_mu.begin(), asked_mu.end());
    weights_.resize(mu_.size(), 0.0);
    const std::size_t moments = 2 * streams;
    const double peak = std::pow(medium.g, static_cast<double>(moments));
    share_ = 1.0 - medium.albedo * peak;
    medium_.albedo = medium.albedo * (1.0 - peak) / share_;
    std::vector<std::vector<double>> functions;
    for (const double mu : mu_)
        functions.push_back(legendre(mode, moments, mu));
    phase_same_ = Matrix(mu_.size());
    phase_turned_ = Matrix(mu_.size());
    for (std::size_t to = 0; to < mu_.size(); ++to) {
        for (std::size_t from = 0; from < mu_.size(); ++from) {
            double power = 1.0;
            for (std::size_t l = 0; l < moments; ++l, power *= medium.g) {
                const double moment = (2.0 * static_cast<double>(l) + 1.0) * (power - peak) / (1.0 - peak);
                const double term = moment * functions[to][l] * functions[from][l];
                phase_same_(to, from) += term;
                phase_turned_(to, from) += (l + static_cast<std::size_t>(mode)) % 2 == 0 ? term : -term;
            }
        }
    }
}

// a W b: light that goes on from one layer to the next in all directions.
Matrix AddingDoubling::folded(const Matrix& a, const Matrix& b) const {
    Matrix product(a.size);
    for (std::size_t to = 0; to < a.size; ++to) {
        for (std::size_t k = 0; k < first_asked(); ++k) {
            const double factor = a(to, k) * 2.0 * mu_[k] * weights_[k];
            for (std::size_t from = 0; from < a.size; ++from)
                product(to, from) += factor * b(k, from);
        }
    }
    return product;
}

Joint AddingDoubling::joint(const Layer& upper, const Layer& lower) const {
    const std::size_t n = mu_.size();
    Joint joint{Matrix(n), upper.transmitted};
    const Matrix twice = folded(upper.reflected, lower.reflected);
    Matrix left(n);
    for (std::size_t to = 0; to < n; ++to) {
        for (std::size_t from = 0; from < n; ++from) {
            left(to, from) = (to == from ? 1.0 : 0.0) - twice(to, from) * 2.0 * mu_[from] * weights_[from];
            joint.down(to, from) += twice(to, from) * upper.direct[from];
        }
    }
    solve(left, joint.down);
    joint.up = folded(lower.reflected, joint.down);
    for (std::size_t to = 0; to < n; ++to) {
        for (std::size_t from = 0; from < n; ++from)
            joint.up(to, from) += lower.reflected(to, from) * upper.direct[from];
    }
    return joint;
}

Layer AddingDoubling::layer(double optical_depth) const {
    constexpr double kThinnest = 1e-9;
    const std::size_t n = mu_.size();
    const double whole = share_ * optical_depth;
    const int doublings = std::max(0, static_cast<int>(std::ceil(std::log2(whole / kThinnest))));
    double depth = std::ldexp(whole, -doublings);
    Layer layer{Matrix(n), Matrix(n), std::vector<double>(n)};
    for (std::size_t to = 0; to < n; ++to) {
        for (std::size_t from = 0; from < n; ++from) {
            const double once = medium_.albedo * depth / (4.0 * mu_[to] * mu_[from]);
            layer.reflected(to, from) = once * phase_turned_(to, from);
            layer.transmitted(to, from) = once * phase_same_(to, from);
        }
        layer.direct[to] = std::exp(-depth / mu_[to]);
    }
    for (int round = 0; round < doublings; ++round) {
        const Joint middle = joint(layer, layer);
        Layer both{folded(layer.transmitted, middle.up), folded(layer.transmitted, middle.down),
                   std::vector<double>(n)};
        depth *= 2.0;
        for (std::size_t to = 0; to < n; ++to) {
            for (std::size_t from = 0; from < n; ++from) {
                both.reflected(to, from) +=
                    layer.reflected(to, from) + layer.direct[to] * middle.up(to, from);
                both.transmitted(to, from) += layer.direct[to] * middle.down(to, from) +
                                              layer.transmitted(to, from) * layer.direct[from];
            }
            both.direct[to] = std::exp(-depth / mu_[to]);
        }
        layer = std::move(both);
    }
    return layer;
}

Matrix AddingDoubling::source(const Joint& joint, const Layer& upper, bool up) const {
    const std::size_t n = mu_.size();
    const Matrix& same = up ? joint.up : joint.down;
    const Matrix& turned = up ? joint.down : joint.up;
    Matrix source(n);
    for (std::size_t to = 0; to < n; ++to) {
        for (std::size_t from = 0; from < n; ++from) {
            double sum = phase(to, from, up) * upper.direct[from] / (4.0 * mu_[from]);
            for (std::size_t k = 0; k < first_asked(); ++k) {
                sum += 0.5 * weights_[k] *
                       (phase_same_(to, k) * same(k, from) + phase_turned_(to, k) * turned(k, from));
            }
            source(to, from) = medium_.albedo * sum;
        }
    }
    return source;
}

double AddingDoubling::flux(const Matrix& radiance, std::size_t from) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < first_asked(); ++k)
        sum += 2.0 * mu_[k] * weights_[k] * radiance(k, from);
    return sum;
}

double henyey_greenstein_mode(double g, int mode, double mu, double mu0, bool turned) {
    constexpr int kSteps = 512;
    const double cosines = turned ? -mu * mu0 : mu * mu0;
    const double sines = std::sqrt((1.0 - mu * mu) * (1.0 - mu0 * mu0));
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double azimuth = kPi * (static_cast<double>(i) + 0.5) / kSteps;
        const double base = 1.0 + g * g - 2.0 * g * (cosines + sines * std::cos(azimuth));
        sum += (1.0 - g * g) / (base * std::sqrt(base)) * std::cos(mode * azimuth);
    }
    return sum / kSteps;
}

}  // namespace skyig::render::cloud::reference
