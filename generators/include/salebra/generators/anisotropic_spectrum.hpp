// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// How an isotropic surface is stretched. With an isotropic correlation length ℓ, the stretched
/// surface has the correlation lengths along·ℓ and across·ℓ.
struct Anisotropy {
  double along = 1;   ///< > 0
  double across = 1;  ///< > 0
  double angle = 0;   ///< from the x axis to the direction of `along`, rad

  /// Peklenik's number γ, the ratio of the correlation lengths along and across the lay: 1
  /// isotropic, > 1 lay in the direction of `along`.
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

/// The spectrum of an isotropic surface stretched along two perpendicular directions e₁, e₂, with
/// its rms height kept:
///     C(q) = along·across·C_iso(|(along·q₁, across·q₂)|),  q_i = q·e_i.
class AnisotropicSpectrum final : public Spectrum {
 public:
  /// Throws InvalidInput unless the factors are > 0 and the angle finite.
  AnisotropicSpectrum(std::shared_ptr<const IsotropicSpectrum> isotropic,
                      const Anisotropy& anisotropy);

  double density(double qx, double qy) const override;
  double highest_wavenumber() const override;
  SpectralMoments moments() const override;  ///< closed form from those of the isotropic spectrum
  std::string description() const override;

  const Anisotropy& anisotropy() const { return anisotropy_; }

 private:
  std::shared_ptr<const IsotropicSpectrum> isotropic_;
  Anisotropy anisotropy_;
  double cosine_, sine_;
};

}  // namespace salebra
