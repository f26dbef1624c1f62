// The truth of light in a plane, homogeneous slab of Henyey-Greenstein scatterers over black ground, by
// adding and doubling layers (van de Hulst, Multiple Light Scattering, 1980, ch. 4; Hansen & Travis, Space
// Sci. Rev. 16 (1974) 527), one azimuthal mode at a time, in double. Radiances are pi L / (mu0 F0).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace skyig::render::cloud::reference {

/// Square, row by row: [direction of leaving light][direction of arriving light].
struct Matrix {
    std::size_t size = 0;
    std::vector<double> values;

    explicit Matrix(std::size_t n = 0) : size(n), values(n * n) {}
    [[nodiscard]] double& operator()(std::size_t to, std::size_t from) { return values[to * size + from]; }
    [[nodiscard]] double operator()(std::size_t to, std::size_t from) const {
        return values[to * size + from];
    }
};

struct Medium {
    double g = 0.85;
    double albedo = 1.0;
};

/// Scattered light that a layer sends back and lets through, and its direct transmission by direction.
struct Layer {
    Matrix reflected;
    Matrix transmitted;
    std::vector<double> direct;
};

/// Scattered light in the joint of two layers, for light that arrives on the upper one's top.
struct Joint {
    Matrix up;
    Matrix down;
};

/// One mode cos(m azimuth) of one medium.
class AddingDoubling {
  public:
    /// \param streams  Gauss points a hemisphere \param asked_mu  directions (0..1] that answers are wanted
    /// for, beside the Gauss points
    AddingDoubling(const Medium& medium, int mode, std::size_t streams, std::span<const double> asked_mu);

    [[nodiscard]] Layer layer(double optical_depth) const;
    [[nodiscard]] Joint joint(const Layer& upper, const Layer& lower) const;

    /// Source function at a joint, pi S / (mu0 F0), towards all directions up (`up`) or down, the beam's own
    /// light with it. The forward peak that a few streams cannot hold is not in it (g^(2 streams)).
    [[nodiscard]] Matrix source(const Joint& joint, const Layer& upper, bool up) const;
    /// Mode of the phase function between two directions, by its numbers; `turned`: one up, one down.
    [[nodiscard]] double phase(std::size_t to, std::size_t from, bool turned) const {
        return turned ? phase_turned_(to, from) : phase_same_(to, from);
    }

    /// All directions: Gauss points, then those asked for.
    [[nodiscard]] std::span<const double> mu() const { return mu_; }
    [[nodiscard]] std::size_t first_asked() const { return mu_.size() - asked_; }
    /// Weights of an even integral over mu from 0 to 1, 0 for those asked for.
    [[nodiscard]] std::span<const double> weights() const { return weights_; }
    /// Of a beam from direction `from`: what leaves, by flux.
    [[nodiscard]] double flux(const Matrix& radiance, std::size_t from) const;

  private:
    [[nodiscard]] Matrix folded(const Matrix& a, const Matrix& b) const;

    Medium medium_;  // its forward peak cut
    double share_ = 1.0;
    std::size_t asked_ = 0;
    std::vector<double> mu_;
    std::vector<double> weights_;
    Matrix phase_same_;
    Matrix phase_turned_;
};

/// Mode of Henyey & Greenstein's phase function itself, by quadrature over azimuth.
[[nodiscard]] double henyey_greenstein_mode(double g, int mode, double mu, double mu0, bool turned);

}  // namespace skyig::render::cloud::reference
