// The air as the reference solver sees it: densities by height and extinction of columns, in double precision
// at forty wavelengths, without tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/sky/air_law.h"
#include "render/sky/geometry.h"
#include "render/sky/spectra.h"

namespace skyig::render::sky::reference {

/// One number each for molecules, aerosol and ozone.
struct Triple {
    double molecules = 0.0;
    double aerosol = 0.0;
    double ozone = 0.0;

    friend Triple operator+(const Triple& a, const Triple& b) noexcept {
        return {a.molecules + b.molecules, a.aerosol + b.aerosol, a.ozone + b.ozone};
    }
    friend Triple operator*(double factor, const Triple& a) noexcept {
        return {factor * a.molecules, factor * a.aerosol, factor * a.ozone};
    }
};

class Medium {
  public:
    explicit Medium(const AirLaw& law);

    [[nodiscard]] const Shell& shell() const noexcept { return shell_; }
    [[nodiscard]] double aerosol_g() const noexcept { return shape_.aerosol_g; }
    /// Relative to those at height 0 (ozone: at its peak); heights below 0 count as 0.
    [[nodiscard]] Triple densities(double height_m) const noexcept;
    /// Extinction of a column in metres at density 1, or extinction per metre of a density.
    [[nodiscard]] double extinction(const Triple& amount, std::size_t wavelength) const noexcept {
        return rayleigh_[wavelength] * amount.molecules + aerosol_extinction_[wavelength] * amount.aerosol +
               ozone_[wavelength] * amount.ozone;
    }
    [[nodiscard]] Samples transmittance(const Triple& column_m) const noexcept;

    [[nodiscard]] const Samples& rayleigh_per_m() const noexcept { return rayleigh_; }
    [[nodiscard]] const Samples& aerosol_scattering_per_m() const noexcept { return aerosol_scattering_; }
    [[nodiscard]] const Samples& ground_albedo() const noexcept { return ground_albedo_; }
    [[nodiscard]] const Samples& sunlight_w_m2_nm() const noexcept { return sunlight_; }

  private:
    static constexpr std::size_t kBins = 240;

    AirShape shape_;
    Shell shell_;
    /// Knot at or below the foot of each of kBins even layers.
    std::array<std::uint8_t, kBins> first_knot_{};
    Samples rayleigh_{};
    Samples aerosol_extinction_{};
    Samples aerosol_scattering_{};
    Samples ozone_{};
    Samples ground_albedo_{};
    Samples sunlight_{};
};

}  // namespace skyig::render::sky::reference
