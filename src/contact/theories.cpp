// SPDX-License-Identifier: GPL-3.0-or-later
// Bearing area, Bush-Gibson-Thomas and Persson theories: contact area, mean gap and stiffness.
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/theories.hpp>

#include "base/numerics/quadrature.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

const double root_pi = std::sqrt(pi);

/// The integrals ∫_x^∞ erf²(t) exp(−t²) t^{−n} dt for n = 1 (power1) and n = 2 (power2). The
/// integrand is smooth and vanishes after a few units of t, so one Gauss–Legendre rule gives the
/// integrals to 1e-13.
struct ErfSquareIntegrals {
  double power1, power2;
};

ErfSquareIntegrals erf_square_integrals(double x) {
  using Table =
      std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)>;
  constexpr std::size_t nodes = 64;
  static const Table table(gsl_integration_glfixed_table_alloc(nodes),
                           &gsl_integration_glfixed_table_free);
  const double end = std::sqrt(x * x + 45);
  ErfSquareIntegrals sum{0, 0};
  for (std::size_t i = 0; i < nodes; ++i) {
    double t, weight;
    gsl_integration_glfixed_point(x, end, i, &t, &weight, table.get());
    const double ratio = std::erf(t) / t;
    const double product = weight * ratio * ratio * std::exp(-t * t);
    sum.power1 += product * t;
    sum.power2 += product;
  }
  return sum;
}

/// Integrals from 0 to ρ, over ρ = E*r/p with the pressure p and 1/√2 times the rms slope, r, of the
/// following functions of x = 1/ρ in Persson's theory with the energy factor γ:
///     gap          ∫_x^∞ [γ + 3(1−γ)erf²(t)] exp(−t²) dt/t
///     compliance   [γ + 3(1−γ)erf²(x)] exp(−x²)
struct Antiderivatives {
  double gap, compliance;
};

Antiderivatives antiderivatives(double rho, double energy_factor) {
  if (!(rho > 0)) return {0, 0};
  const double x = 1 / rho, correlated = 3 * (1 - energy_factor);
  const ErfSquareIntegrals erf_square = erf_square_integrals(x);
  const double exponential_integral = -std::expint(-x * x);  // exponential integral E1(x²)
  const double plain = rho * std::exp(-x * x) - root_pi * std::erfc(x);
  return {energy_factor * (rho * exponential_integral / 2 - plain) +
              correlated * (rho * erf_square.power1 - erf_square.power2),
          energy_factor * plain + correlated * erf_square.power2};
}

}  // namespace

double bearing_area_fraction(double mean_gap, double rms_height) {
  require_positive(rms_height, "rms_height");
  return std::erfc(mean_gap / (std::numbers::sqrt2 * rms_height)) / 2;
}

double bgt_area_fraction(double pressure, double contact_modulus, double rms_slope) {
  require_positive(pressure, "pressure");
  require_positive(contact_modulus, "contact_modulus");
  require_positive(rms_slope, "rms_slope");
  return std::sqrt(2 * pi) * pressure / (contact_modulus * rms_slope);
}

double persson_area_fraction(double pressure, double contact_modulus, double rms_slope) {
  require_positive(pressure, "pressure");
  require_positive(contact_modulus, "contact_modulus");
  require_positive(rms_slope, "rms_slope");
  return std::erf(std::numbers::sqrt2 * pressure / (contact_modulus * rms_slope));
}

std::vector<RoughnessShell> roughness_shells(const std::function<double(double)>& density,
                                             double lowest, double highest, int count) {
  require_positive(lowest, "lowest");
  require(highest > lowest, "highest", highest, "must be larger than the lowest wave number");
  require(count >= 1, "count", count, "must be >= 1");
  const double step = std::log(highest / lowest) / count;
  std::vector<RoughnessShell> shells;
  for (int i = 0; i < count; ++i) {
    const double wavenumber = lowest * std::exp((i + 0.5) * step);
    shells.push_back({wavenumber, 2 * pi * wavenumber * wavenumber * density(wavenumber) * step});
  }
  return shells;
}

PerssonTheory::PerssonTheory(std::vector<RoughnessShell> shells, double contact_modulus,
                             double energy_factor)
    : contact_modulus_(contact_modulus), energy_factor_(energy_factor) {
  require_positive(contact_modulus, "contact_modulus");
  require(energy_factor > 0 && energy_factor <= 1, "energy_factor", energy_factor,
          "must satisfy 0 < energy_factor <= 1");
  std::ranges::sort(shells, {}, &RoughnessShell::wavenumber);
  double power = 0, square_slope = 0;
  for (const RoughnessShell& shell : shells) {
    require_positive(shell.wavenumber, "shells.wavenumber");
    require(std::isfinite(shell.power) && shell.power >= 0, "shells.power", shell.power,
            "must be finite and >= 0");
    if (shell.power == 0) continue;
    const double inner = std::sqrt(square_slope / 2);
    power += shell.power;
    square_slope += shell.wavenumber * shell.wavenumber * shell.power;
    rings_.push_back({shell.wavenumber, inner, std::sqrt(square_slope / 2)});
  }
  require(!rings_.empty(), "shells", shells.size(),
          "shells have no power, but a surface must be rough");
  rms_height_ = std::sqrt(power);
  rms_slope_ = std::sqrt(square_slope);
}

double PerssonTheory::mean_gap(double pressure) const {
  require_positive(pressure, "pressure");
  const double unit = pressure / contact_modulus_;
  double sum = 0, inner = 0;
  for (const Ring& ring : rings_) {
    const double outer = antiderivatives(ring.outer / unit, energy_factor_).gap;
    sum += (outer - inner) / ring.wavenumber;
    inner = outer;
  }
  return 2 / root_pi * unit * sum;
}

double PerssonTheory::stiffness_per_area(double pressure) const {
  require_positive(pressure, "pressure");
  const double unit = pressure / contact_modulus_;
  double sum = 0, inner = 0;
  for (const Ring& ring : rings_) {
    const double outer = antiderivatives(ring.outer / unit, energy_factor_).compliance;
    sum += (outer - inner) / ring.wavenumber;
    inner = outer;
  }
  return contact_modulus_ * root_pi / (2 * sum);
}

double PerssonTheory::contact_area_fraction(double pressure) const {
  return persson_area_fraction(pressure, contact_modulus_, rms_slope_);
}

double PerssonTheory::pressure(double target) const {
  require_positive(target, "mean_gap");
  const Asymptote limit = asymptote();
  // ln p is smooth over the mean gap ū, bends down from its asymptote, and ends at complete
  // contact, where p is a few times E*h' with the rms slope h'.
  const auto excess = [&](double log_ratio) {
    return mean_gap(contact_modulus_ * std::exp(log_ratio)) - target;
  };
  double low = std::log(limit.factor) - target / limit.decay_length - 1, high = low + 2;
  require(low > -690, "mean_gap", target, "is so large that the pressure underflows");
  while (excess(low) < 0) low -= 1;
  while (excess(high) > 0) high += 1;
  return contact_modulus_ * std::exp(detail::find_root(excess, low, high));
}

PerssonTheory::Asymptote PerssonTheory::asymptote() const {
  // For small x, ∫_x^∞ exp(−t²)dt/t = −ln x − γ_E/2 with Euler's constant γ_E, so that the integral
  // over r reduces to ∫dr/q and ∫ln r dr/q, where r is 1/√2 times the rms slope of the waves up to
  // the wave number q.
  double length = 0, log_slope = 0;
  const auto antiderivative = [](double r) { return r > 0 ? r * std::log(r) - r : 0; };
  for (const Ring& ring : rings_) {
    length += (ring.outer - ring.inner) / ring.wavenumber;
    log_slope += (antiderivative(ring.outer) - antiderivative(ring.inner)) / ring.wavenumber;
  }
  const double correlated = 3 * (1 - energy_factor_) / energy_factor_;
  return {.decay_length = 2 * energy_factor_ / root_pi * length,
          .factor = std::exp(log_slope / length - std::numbers::egamma / 2 +
                             correlated * erf_square_integrals(0).power1)};
}

ForceCurve persson_curve(const PerssonTheory& theory, const Material& material, double nominal_area,
                         const std::vector<double>& pressures) {
  require_positive(nominal_area, "nominal_area");
  std::vector<double> ascending = pressures;
  std::ranges::sort(ascending);
  ForceCurve curve{.model = "persson",
                   .nominal_area = nominal_area,
                   .rms_height = theory.rms_height(),
                   .samples = {}};
  for (const double pressure : ascending) {
    const double stiffness = theory.stiffness_per_area(pressure) * nominal_area;
    const double mean_gap = theory.mean_gap(pressure);
    curve.samples.push_back({.indentation = -mean_gap,
                             .mean_gap = mean_gap,
                             .force = pressure * nominal_area,
                             .pressure = pressure,
                             .contact_area_fraction = theory.contact_area_fraction(pressure),
                             .normal_stiffness = stiffness,
                             // NaN if G* is NaN.
                             .tangential_stiffness = material.tangential_modulus /
                                                     material.contact_modulus * stiffness});
  }
  return curve;
}

}  // namespace salebra
