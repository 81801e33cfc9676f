// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// Stretching of an isotropic surface along two perpendicular directions: its correlation length ℓ
/// becomes along·ℓ in the first direction and across·ℓ in the second.
struct Anisotropy {
  double along = 1;   ///< factor > 0 of the first direction
  double across = 1;  ///< factor > 0 of the second direction
  double angle = 0;   ///< angle from the x axis to the direction of `along`, rad

  /// Peklenik's number γ, the ratio along/across of the correlation lengths: 1 for an isotropic
  /// surface, > 1 if the lay is in the first direction, < 1 if it is in the second direction.
  double peklenik() const { return along / across; }
};

constexpr void describe(auto&& visit, std::type_identity<Anisotropy>) {
  using enum Dimension;
  using S = Anisotropy;
  visit(&S::along,
        Quantity{"stretch_along", dimensionless, "stretch of the spectrum along the lay"});
  visit(&S::across,
        Quantity{"stretch_across", dimensionless, "stretch of the spectrum across the lay"});
  visit(&S::angle, Quantity{"lay_angle", Dimension::angle, "direction of the lay against x"});
  visit(&S::peklenik,
        Quantity{"peklenik", dimensionless, "correlation length along x over that along y"});
}

/// Spectrum C of an isotropic surface with the spectrum C_iso that is stretched along two
/// perpendicular directions e₁, e₂ (Anisotropy) at constant rms height:
///     const AnisotropicSpectrum spectrum(isotropic, {.along = 4, .across = 1});
///     C(q) = along·across·C_iso(|(along·q₁, across·q₂)|),  q_i = q·e_i.
class AnisotropicSpectrum final : public Spectrum {
 public:
  /// Throws InvalidInput unless the factors are > 0 and the angle finite.
  AnisotropicSpectrum(std::shared_ptr<const IsotropicSpectrum> isotropic,
                      const Anisotropy& anisotropy);

  double density(double qx, double qy) const override;
  double highest_wavenumber() const override;
  SpectralMoments moments() const override;  ///< closed form from the moments of the isotropic
                                             ///< spectrum
  std::string description() const override;

  const Anisotropy& anisotropy() const { return anisotropy_; }

 private:
  std::shared_ptr<const IsotropicSpectrum> isotropic_;
  Anisotropy anisotropy_;
  double cosine_, sine_;
};

}  // namespace salebra
