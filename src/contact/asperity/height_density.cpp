// SPDX-License-Identifier: GPL-3.0-or-later
// Density of summit heights (Gaussian, exponential, tabulated) and its partial moments.
#include "height_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/numerics/quadrature.hpp"

namespace salebra::detail {
namespace {

constexpr double relative_tolerance = 1e-12;
// Densities of summit heights are cut off where they have fallen by exp(−negligible_exponent),
// which is negligible against 1 in double precision, even times the powers of height minus
// separation that the moments contain.
constexpr double negligible_exponent = 45;

/// ∫ (z−h)^n φ(z) dz over [max(h, low), high] for n = `exponent` and a smooth density φ, computed
/// as 2∫ t^{2n+1} φ(h + t²) dt, whose integrand is not singular even at n = −1/2.
double shifted_moment(double exponent, double h, double low, double high,
                      const std::function<double(double)>& density) {
  const double from = std::sqrt(std::max(0.0, low - h)), to = std::sqrt(std::max(0.0, high - h));
  const int power = static_cast<int>(std::lround(2 * exponent)) + 1;
  const auto integrand = [&](double t) {
    double weight = 2;
    for (int factor = 0; factor < power; ++factor) weight *= t;
    return weight * density(h + t * t);
  };
  const Integral integral = integrate(integrand, std::array{from, to}, relative_tolerance);
  if (!integral.converged) throw NotConverged("greenwood_williamson: quadrature over heights");
  return integral.value;
}

/// F_n(h) = ∫_h^∞ (z−h)^n φ(z) dz in Greenwood and Williamson's notation: n = `exponent`, φ the
/// standard normal density.
double gaussian_moment(double exponent, double h) {
  if (exponent == 0) return std::erfc(h / std::numbers::sqrt2) / 2;
  // φ(z) falls from φ(0), or from φ(h) if h > 0, by exp(−negligible_exponent) at z = high.
  const double reach = std::sqrt(2 * negligible_exponent + std::max(h, 0.0) * std::max(h, 0.0));
  // The factor φ(h) is taken out of the integrand: with it, the integrand would underflow at
  // heights where the moment does not.
  const double offset = std::max(h, 0.0) * std::max(h, 0.0) / 2;
  const double scaled = shifted_moment(exponent, h, -reach, reach,
                                       [&](double z) { return std::exp(offset - z * z / 2); });
  return scaled * std::exp(-offset) / std::sqrt(2 * std::numbers::pi);
}

double exponential_moment(double exponent, double h) {
  if (h >= 0) return std::tgamma(exponent + 1) * std::exp(-h);
  if (exponent == 0) return 1;
  return shifted_moment(exponent, h, 0, negligible_exponent, [](double z) { return std::exp(-z); });
}

void require_table(const std::vector<HeightDensityPoint>& table) {
  require(table.size() >= 2, "table", table.size(), "points given; at least two are needed");
  for (std::size_t i = 0; i < table.size(); ++i) {
    require(std::isfinite(table[i].density) && table[i].density >= 0, "table.density",
            table[i].density, "must be finite and >= 0");
    require(std::isfinite(table[i].height) && (i == 0 || table[i].height > table[i - 1].height),
            "table.height", table[i].height, "must be finite and larger than the one before");
  }
}

/// Probability of a height below each point of a piecewise linear density.
std::vector<double> cumulative_of(const std::vector<HeightDensityPoint>& table) {
  std::vector<double> cumulative{0};
  for (std::size_t i = 1; i < table.size(); ++i)
    cumulative.push_back(cumulative.back() + (table[i].height - table[i - 1].height) *
                                                 (table[i].density + table[i - 1].density) / 2);
  return cumulative;
}

}  // namespace

HeightDensity::HeightDensity(const SummitEnsemble& ensemble)
    : distribution_(ensemble.distribution), sigma_(ensemble.summit_rms), table_(ensemble.table) {
  if (distribution_ != SummitDistribution::tabulated) {
    require_positive(sigma_, "summit_rms");
    return;
  }
  require_table(table_);
  cumulative_ = cumulative_of(table_);
  const double total = cumulative_.back();
  require(total > 0, "table.density", total, "vanishes everywhere; give the density of summits");
  for (HeightDensityPoint& point : table_) point.density /= total;
  for (double& value : cumulative_) value /= total;
}

double HeightDensity::moment(double exponent, double separation) const {
  if (distribution_ == SummitDistribution::tabulated) return tabulated_moment(exponent, separation);
  const double h = separation / sigma_;
  return std::pow(sigma_, exponent) * (distribution_ == SummitDistribution::gaussian
                                           ? gaussian_moment(exponent, h)
                                           : exponential_moment(exponent, h));
}

double HeightDensity::tabulated_moment(double exponent, double separation) const {
  double sum = 0;
  for (std::size_t i = 1; i < table_.size(); ++i) {
    const HeightDensityPoint &below = table_[i - 1], &above = table_[i];
    if (above.height <= separation) continue;
    // Between two points φ = constant + gradient·t, where t = z − s is the height above the
    // separation s; each power of t is integrated in closed form.
    const double gradient = (above.density - below.density) / (above.height - below.height);
    const double constant = below.density + gradient * (separation - below.height);
    const double from = std::max(0.0, below.height - separation), to = above.height - separation;
    sum += constant * (std::pow(to, exponent + 1) - std::pow(from, exponent + 1)) / (exponent + 1) +
           gradient * (std::pow(to, exponent + 2) - std::pow(from, exponent + 2)) / (exponent + 2);
  }
  return sum;
}

double HeightDensity::quantile(double probability) const {
  if (distribution_ == SummitDistribution::exponential) return -sigma_ * std::log1p(-probability);
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, probability);
  const auto i = static_cast<std::size_t>(above - cumulative_.begin());
  const HeightDensityPoint &below = table_[i - 1], &next = table_[i];
  const double width = next.height - below.height;
  const double rest = std::max(0.0, probability - cumulative_[i - 1]);
  const double gradient = (next.density - below.density) / width;
  // The distance t above the point `below` at which below.density·t + gradient·t²/2 = rest, in a
  // form without cancellation for either sign of the gradient.
  const double root = std::sqrt(std::max(0.0, below.density * below.density + 2 * gradient * rest));
  const double sum = below.density + root;
  return below.height + (sum > 0 ? std::min(width, 2 * rest / sum) : 0.0);
}

double HeightDensity::highest() const {
  switch (distribution_) {
    case SummitDistribution::gaussian:
      return 37 * sigma_;  // the density has fallen by exp(−37²/2)
    case SummitDistribution::exponential:
      return 700 * sigma_;  // the density has fallen by exp(−700)
    default:
      return table_.back().height;
  }
}

std::vector<double> HeightDensity::breaks() const {
  if (distribution_ == SummitDistribution::gaussian) return {};
  if (distribution_ == SummitDistribution::exponential) return {0};
  std::vector<double> heights;
  for (const HeightDensityPoint& point : table_) heights.push_back(point.height);
  return heights;
}

double HeightDensity::density(double height) const {
  const double h = height / sigma_;
  switch (distribution_) {
    case SummitDistribution::gaussian:
      return std::exp(-h * h / 2) / (std::sqrt(2 * std::numbers::pi) * sigma_);
    case SummitDistribution::exponential:
      return h < 0 ? 0 : std::exp(-h) / sigma_;
    default:
      break;
  }
  const auto above = std::ranges::lower_bound(table_, height, {}, &HeightDensityPoint::height);
  if (above == table_.begin() || above == table_.end()) return 0;
  const HeightDensityPoint &low = above[-1], &high = *above;
  return low.density +
         (high.density - low.density) * (height - low.height) / (high.height - low.height);
}

std::vector<double> HeightDensity::support(double from) const {
  std::vector<double> positions;
  const double h = std::max(0.0, from / sigma_);
  if (distribution_ == SummitDistribution::gaussian) {
    // Above the height h > 1 (in σ), the Gaussian density falls over a distance of about 1/h.
    const double reach = std::sqrt(2 * negligible_exponent + h * h);
    positions = {-reach, -3, 0, h > 0 ? h + 3 / (1 + h) : 3, reach};
    for (double& position : positions) position *= sigma_;
  } else if (distribution_ == SummitDistribution::exponential) {
    positions = {0, (h + 3) * sigma_, (h + negligible_exponent) * sigma_};
  } else {
    positions = breaks();
  }
  std::ranges::sort(positions);
  if (!(from < positions.back())) return {};
  const auto first = std::ranges::upper_bound(positions, from);
  if (first == positions.begin()) return positions;
  positions.erase(positions.begin(), first);
  positions.insert(positions.begin(), from);
  return positions;
}

double HeightDensity::scale() const {
  return distribution_ == SummitDistribution::tabulated
             ? (table_.back().height - table_.front().height) / 4
             : sigma_;
}

}  // namespace salebra::detail
