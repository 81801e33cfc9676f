// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/profile_law.hpp>

namespace salebra {

PowerLaw profile_law(double coefficient, double exponent, const Material& material) {
  require_positive(coefficient, "coefficient");
  require_positive(exponent, "exponent");
  require_positive(material.contact_modulus, "contact_modulus");
  const double n = exponent;
  const double kappa =
      std::sqrt(std::numbers::pi) * n / 2 * std::tgamma(n / 2) / std::tgamma((n + 1) / 2);
  const double radius_at_unit_indentation = std::pow(kappa * coefficient, -1 / n);
  return PowerLaw(2 * material.contact_modulus * n / (n + 1) * radius_at_unit_indentation,
                  1 + 1 / n, material.modulus_ratio());
}

}  // namespace salebra
