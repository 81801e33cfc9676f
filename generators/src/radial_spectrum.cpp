// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic spectra from a function or a table, and from Gaussian and exponential correlations.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <sstream>
#include <utility>

#include "radial_moments.hpp"

namespace salebra {
namespace {

using std::numbers::pi;
// A wave at a limit of the table counts as inside, whatever the rounding of its wave number.
constexpr double limit_tolerance = 1e-9;

struct Panel {
  double from, to;
  double left, middle, right;  // f at from, centre and to

  double simpson() const { return (to - from) / 6 * (left + 4 * middle + right); }
};

// Halves the panel of Simpson's rule until two successive results agree. The difference of two
// results is 15 times the error of the one with half panels.
template <class Function>
double adaptive(const Function& f, const Panel& panel, double tolerance, int depth) {
  const double centre = (panel.from + panel.to) / 2;
  const Panel lower{panel.from, centre, panel.left, f((panel.from + centre) / 2), panel.middle};
  const Panel upper{centre, panel.to, panel.middle, f((centre + panel.to) / 2), panel.right};
  const double fine = lower.simpson() + upper.simpson();
  const double change = fine - panel.simpson();
  if (depth == 0 || std::abs(change) < 15 * tolerance) return fine + change / 15;
  return adaptive(f, lower, tolerance / 2, depth - 1) +
         adaptive(f, upper, tolerance / 2, depth - 1);
}

// Integrates octave by octave, the highest wave numbers first, because a spectrum changes by powers
// of ten. Thirty octaves suffice: below them, a spectrum with a finite mean square contributes
// nothing that counts.
template <class Function>
double integrate(const Function& f, double lowest, double highest) {
  double sum = 0;
  for (double to = highest; to > lowest && to > 1e-9 * highest; to /= 2) {
    const double from = std::max(to / 2, lowest);
    // Several panels per octave, so that the first points do not miss a narrow peak of the
    // spectrum.
    constexpr int panels = 8;
    for (int k = 0; k < panels; ++k) {
      const double a = from + (to - from) * k / panels, b = from + (to - from) * (k + 1) / panels;
      const Panel panel{a, b, f(a), f((a + b) / 2), f(b)};
      const double size = std::max({std::abs(sum), std::abs(panel.simpson())});
      // The tolerance must be a normal number: with 0 or rounding noise as the tolerance, the
      // halving of panels would not end.
      sum += adaptive(f, panel, std::max(1e-12 * size, std::numeric_limits<double>::min()), 30);
    }
  }
  return sum;
}

}  // namespace

FunctionSpectrum::FunctionSpectrum(std::function<double(double)> density, double lowest,
                                   double highest, std::string name)
    : density_(std::move(density)), lowest_(lowest), highest_(highest), name_(std::move(name)) {
  require_positive(highest, "highest");
  require(lowest >= 0 && lowest < highest, "lowest", lowest, "must be >= 0 and below highest");
  moments_ = detail::isotropic_moments([&](int order) {
    const auto integrand = [&](double q) {
      const double value = density_(q);
      require(std::isfinite(value) && value >= 0, "density", value,
              "must be finite and >= 0 between lowest and highest");
      return std::pow(q, order + 1) * value;
    };
    return 2 * pi * integrate(integrand, lowest, highest);
  });
}

double FunctionSpectrum::radial_density(double q) const {
  if (q < lowest_ * (1 - limit_tolerance) || q > highest_ * (1 + limit_tolerance)) return 0;
  return density_(q);
}

TabulatedSpectrum::TabulatedSpectrum(std::vector<double> wavenumbers, std::vector<double> densities)
    : wavenumbers_(std::move(wavenumbers)), densities_(std::move(densities)) {
  require(wavenumbers_.size() >= 2, "wavenumbers", wavenumbers_.size(),
          "points given; give two or more");
  require(wavenumbers_.size() == densities_.size(), "densities", densities_.size(),
          "values given; give one for each wavenumber");
  for (std::size_t k = 0; k < wavenumbers_.size(); ++k) {
    const std::string row = "[" + std::to_string(k) + "]";
    require_positive(wavenumbers_[k], "wavenumbers" + row);
    require_positive(densities_[k], "densities" + row);
    require(k == 0 || wavenumbers_[k] > wavenumbers_[k - 1], "wavenumbers" + row, wavenumbers_[k],
            "must exceed the one before; sort the table");
  }
}

double TabulatedSpectrum::radial_density(double q) const {
  if (q < wavenumbers_.front() * (1 - limit_tolerance) ||
      q > wavenumbers_.back() * (1 + limit_tolerance))
    return 0;
  const auto above = std::upper_bound(wavenumbers_.begin() + 1, wavenumbers_.end() - 1, q);
  const auto k = static_cast<std::size_t>(above - wavenumbers_.begin());
  const double position =
      std::log(q / wavenumbers_[k - 1]) / std::log(wavenumbers_[k] / wavenumbers_[k - 1]);
  return densities_[k - 1] * std::pow(densities_[k] / densities_[k - 1], position);
}

SpectralMoments TabulatedSpectrum::moments() const {
  return detail::isotropic_moments([this](int order) {
    double sum = 0;
    for (std::size_t k = 1; k < wavenumbers_.size(); ++k) {
      const double ratio = wavenumbers_[k] / wavenumbers_[k - 1];
      const double exponent = std::log(densities_[k] / densities_[k - 1]) / std::log(ratio);
      sum += densities_[k - 1] * std::pow(wavenumbers_[k - 1], order + 2) *
             detail::power_integral(ratio, order + 2 + exponent);
    }
    return 2 * pi * sum;
  });
}

std::string TabulatedSpectrum::description() const {
  std::ostringstream text;
  text.precision(12);
  text << "table of " << wavenumbers_.size() << " densities, wavenumbers " << wavenumbers_.front()
       << " to " << wavenumbers_.back();
  return text.str();
}

FunctionSpectrum gaussian_correlation_spectrum(double rms_height, double correlation_length) {
  detail::require_square(rms_height, "rms_height");
  require_positive(correlation_length, "correlation_length");
  const double square = correlation_length * correlation_length;
  const double peak = rms_height * rms_height * square / (4 * pi);
  std::ostringstream name;
  name.precision(12);
  name << "gaussian correlation rms_height=" << rms_height
       << " correlation_length=" << correlation_length;
  return {[=](double q) { return peak * std::exp(-q * q * square / 4); }, 0,
          12 / correlation_length, name.str()};
}

FunctionSpectrum exponential_correlation_spectrum(double rms_height, double correlation_length,
                                                  double short_cutoff) {
  detail::require_square(rms_height, "rms_height");
  require_positive(correlation_length, "correlation_length");
  require_positive(short_cutoff, "short_cutoff");
  const double square = correlation_length * correlation_length;
  const double highest = 2 * pi / short_cutoff;
  const double kept = 1 - 1 / std::sqrt(1 + highest * highest * square);
  const double peak = rms_height * rms_height * square / (2 * pi * kept);
  std::ostringstream name;
  name.precision(12);
  name << "exponential correlation rms_height=" << rms_height
       << " correlation_length=" << correlation_length << " short_cutoff=" << short_cutoff;
  return {[=](double q) { return peak * std::pow(1 + q * q * square, -1.5); }, 0, highest,
          name.str()};
}

}  // namespace salebra
