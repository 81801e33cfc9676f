// SPDX-License-Identifier: GPL-3.0-or-later
// Anisotropic spectrum: an isotropic spectrum stretched along a lay by Peklenik's number, a ratio
// of correlation lengths.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <sstream>
#include <utility>

namespace salebra {

AnisotropicSpectrum::AnisotropicSpectrum(std::shared_ptr<const IsotropicSpectrum> isotropic,
                                         const Anisotropy& anisotropy)
    : isotropic_(std::move(isotropic)),
      anisotropy_(anisotropy),
      cosine_(std::cos(anisotropy.angle)),
      sine_(std::sin(anisotropy.angle)) {
  require(isotropic_ != nullptr, "isotropic", "none", "is not given; give a spectrum");
  require_positive(anisotropy.along, "along");
  require_positive(anisotropy.across, "across");
  require(std::isfinite(anisotropy.angle), "angle", anisotropy.angle, "must be finite (rad)");
}

double AnisotropicSpectrum::density(double qx, double qy) const {
  const double q1 = anisotropy_.along * (cosine_ * qx + sine_ * qy);
  const double q2 = anisotropy_.across * (cosine_ * qy - sine_ * qx);
  return anisotropy_.along * anisotropy_.across *
         isotropic_->radial_density(std::sqrt(q1 * q1 + q2 * q2));
}

double AnisotropicSpectrum::highest_wavenumber() const {
  return isotropic_->highest_wavenumber() / std::min(anisotropy_.along, anisotropy_.across);
}

SpectralMoments AnisotropicSpectrum::moments() const {
  const SpectralMoments isotropic = isotropic_->moments();
  // With the wave vector q = (q₁, q₂) along and across the lay, the isotropic spectrum is taken at
  // q' = (along·q₁, across·q₂). For a unit vector e, q·e = q'·v with v = (e₁/along, e₂/across), and
  // for an isotropic spectrum the moment ∫(q'·v)ⁿ is proportional to |v|ⁿ.
  const auto square = [&](double e1, double e2) {
    return std::pow(e1 / anisotropy_.along, 2) + std::pow(e2 / anisotropy_.across, 2);
  };
  const double x = square(cosine_, sine_), y = square(sine_, cosine_);
  return {isotropic.moment0, isotropic.moment2_x * x, isotropic.moment2_x * y,
          isotropic.moment4_x * x * x, isotropic.moment4_x * y * y};
}

std::string AnisotropicSpectrum::description() const {
  std::ostringstream text;
  text.precision(12);
  text << isotropic_->description() << ", stretched along=" << anisotropy_.along
       << " across=" << anisotropy_.across << " angle=" << anisotropy_.angle;
  return text.str();
}

}  // namespace salebra
