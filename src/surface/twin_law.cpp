// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of the spectrum of a surface twin: densities, their derivatives and moments, and tables of
// the spectrum.
#include "surface/twin_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/special_values.hpp"
#include "surface/twin_kernels.hpp"

namespace salebra {
namespace twin_detail {
namespace {

using std::numbers::pi;

/// ∫_0^t e^{ps} ds = (e^{pt} − 1)/p, or t for p = 0.
double grown(double p, double t) { return std::abs(p * t) < 1e-12 ? t : std::expm1(p * t) / p; }

/// Second derivatives, at the knots, of the natural splines that are 1 at one knot and 0 at all
/// others; one column for each spline.
Eigen::MatrixXd spline_curvatures(const std::vector<double>& knots) {
  const auto n = static_cast<Index>(knots.size());
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n), right = Eigen::MatrixXd::Zero(n, n);
  const auto step = [&](Index k) {
    return knots[static_cast<std::size_t>(k) + 1] - knots[static_cast<std::size_t>(k)];
  };
  for (Index k = 1; k + 1 < n; ++k) {
    left(k, k - 1) = step(k - 1) / 6;
    left(k, k) = (step(k - 1) + step(k)) / 3;
    left(k, k + 1) = step(k) / 6;
    right(k, k - 1) = 1 / step(k - 1);
    right(k, k) = -1 / step(k - 1) - 1 / step(k);
    right(k, k + 1) = 1 / step(k);
  }
  // Elimination without pivoting: the matrix is tridiagonal, and its diagonal dominates.
  for (Index k = 1; k < n; ++k) {
    const double factor = left(k, k - 1) / left(k - 1, k - 1);
    left(k, k) -= factor * left(k - 1, k);
    right.row(k) -= factor * right.row(k - 1);
  }
  for (Index k = n - 1; k >= 0; --k) {
    if (k + 1 < n) right.row(k) -= left(k, k + 1) * right.row(k + 1);
    right.row(k) /= left(k, k);
  }
  return right;
}

/// Values at x of the splines that are 1 at one knot and 0 at all others; they continue as straight
/// lines beyond the first and the last knot.
Eigen::RowVectorXd spline_row(const std::vector<double>& knots, const Eigen::MatrixXd& curvatures,
                              double x) {
  const auto n = static_cast<Index>(knots.size());
  const double inside = std::clamp(x, knots.front(), knots.back());
  const auto above = std::ranges::upper_bound(knots, inside) - knots.begin();
  const Index k = std::clamp<Index>(above - 1, 0, n - 2);
  const double low = knots[static_cast<std::size_t>(k)],
               high = knots[static_cast<std::size_t>(k) + 1];
  const double step = high - low, a = (high - inside) / step, b = (inside - low) / step;
  Eigen::RowVectorXd row =
      ((a * a * a - a) * curvatures.row(k) + (b * b * b - b) * curvatures.row(k + 1)) *
      (step * step / 6);
  row[k] += a;
  row[k + 1] += b;
  if (x == inside) return row;
  Eigen::RowVectorXd slope =
      step / 6 * ((1 - 3 * a * a) * curvatures.row(k) + (3 * b * b - 1) * curvatures.row(k + 1));
  slope[k] -= 1 / step;
  slope[k + 1] += 1 / step;
  return row + (x - inside) * slope;
}

}  // namespace

LawPoints::LawPoints(const TwinLaw& law, std::span<const double> wavenumbers) {
  for (const double q : wavenumbers) {
    x.push_back(std::log(q / law.reference));
    square.push_back(q / law.reference * (q / law.reference));
  }
  if (!law.table()) return;
  const Eigen::MatrixXd curvatures = spline_curvatures(law.knots);
  basis.resize(static_cast<Index>(x.size()), static_cast<Index>(law.knots.size()));
  for (std::size_t k = 0; k < x.size(); ++k)
    basis.row(static_cast<Index>(k)) = spline_row(law.knots, curvatures, x[k]);
}

void log_density(const TwinLaw& law, std::span<const double> parameters, const LawPoints& points,
                 std::span<double> values) {
  const std::size_t count = values.size();
  if (law.table()) {
    const Eigen::Map<const Eigen::VectorXd> heights(parameters.data(), law.size() - 1);
    for (std::size_t k = 0; k < count; ++k)
      values[k] = points.basis.row(static_cast<Index>(k)).dot(heights);
    return;
  }
  const double amplitude = parameters[0], exponent = 1 + parameters[TwinLaw::hurst];
  const double corner = std::log(2 * pi / law.reference) - parameters[TwinLaw::rolloff];
  if (law.form == SpectrumForm::corner) {
    for (std::size_t k = 0; k < count; ++k)
      values[k] = amplitude - 2 * exponent * std::max(points.x[k], corner);
    return;
  }
  const double shift = std::exp(2 * corner);
  for (std::size_t k = 0; k < count; ++k) values[k] = points.square[k] + shift;
  logarithms(values);
  for (std::size_t k = 0; k < count; ++k) values[k] = amplitude - exponent * values[k];
}

void log_density_slopes(const TwinLaw& law, std::span<const double> parameters,
                        const LawPoints& points, Index count, Eigen::MatrixXd& slopes) {
  slopes.setZero(count, law.size());
  if (law.table()) {
    slopes.leftCols(law.size() - 1) = points.basis.topRows(count);
    return;
  }
  const double exponent = 1 + parameters[TwinLaw::hurst];
  const double corner = std::log(2 * pi / law.reference) - parameters[TwinLaw::rolloff];
  slopes.col(0).setOnes();
  for (Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (law.form == SpectrumForm::corner) {
      slopes(k, TwinLaw::hurst) = -2 * std::max(points.x[at], corner);
      slopes(k, TwinLaw::rolloff) = points.x[at] < corner ? 2 * exponent : 0;
    } else {
      const double shift = std::exp(2 * corner), sum = points.square[at] + shift;
      slopes(k, TwinLaw::hurst) = -std::log(sum);
      slopes(k, TwinLaw::rolloff) = 2 * exponent * shift / sum;
    }
  }
}

TwinDraw draw_of(const TwinLaw& law, std::span<const double> parameters, double lowest) {
  TwinDraw draw;
  draw.form = law.form;
  draw.reference = law.reference;
  const double end =
      std::log(2 * pi / law.reference) - parameters[static_cast<std::size_t>(law.cutoff())];
  draw.short_cutoff = std::exp(parameters[static_cast<std::size_t>(law.cutoff())]);
  double height = 0, slope = 0;  // ∫C d²q, ∫q²C d²q with q in units of law.reference
  if (law.table()) {
    draw.hurst = draw.rolloff = detail::unknown;
    for (const double knot : law.knots) draw.knots.push_back(law.reference * std::exp(knot));
    draw.log_psd.assign(parameters.begin(), parameters.end() - 1);
    const double start = std::log(lowest / law.reference);
    const Eigen::MatrixXd curvatures = spline_curvatures(law.knots);
    const Eigen::Map<const Eigen::VectorXd> heights(parameters.data(), law.size() - 1);
    constexpr int steps = 400;  // Simpson's rule in ln q, error about 1e-6
    const double step = (end - start) / steps;
    for (int k = 0; k <= steps; ++k) {
      const double x = start + step * k, weight = (k == 0 || k == steps ? 1
                                                   : k % 2              ? 4
                                                                        : 2) *
                                                  step / 3;
      const double power =
          2 * pi * weight * std::exp(2 * x + spline_row(law.knots, curvatures, x).dot(heights));
      height += power;
      slope += power * std::exp(2 * x);
    }
  } else {
    draw.hurst = parameters[TwinLaw::hurst];
    draw.rolloff = std::exp(parameters[TwinLaw::rolloff]);
    draw.amplitude = parameters[0];
    const double h = draw.hurst,
                 corner = std::log(2 * pi / law.reference) - parameters[TwinLaw::rolloff];
    const double level = 2 * pi * std::exp(draw.amplitude);
    if (law.form == SpectrumForm::corner) {
      const double flat = std::min(corner, end), reach = std::max(0.0, end - corner);
      const double plateau = level * std::exp(-2 * (1 + h) * corner);
      height = plateau * std::exp(2 * flat) / 2 +
               level * std::exp(-2 * h * corner) * grown(-2 * h, reach);
      slope = plateau * std::exp(4 * flat) / 4 +
              level * std::exp((2 - 2 * h) * corner) * grown(2 - 2 * h, reach);
    } else {
      // Integrate over u = q_r² + q² with the roll-off q_r, from u = q_r² up by the factor e^reach.
      const double from = 2 * corner, reach = std::log1p(std::exp(2 * (end - corner)));
      height = level / 2 * std::exp(-h * from) * grown(-h, reach);
      slope = level / 2 * std::exp((1 - h) * from) * (grown(1 - h, reach) - grown(-h, reach));
    }
  }
  draw.rms_height = law.reference * std::sqrt(height);
  draw.rms_slope = law.reference * law.reference * std::sqrt(slope);
  return draw;
}

}  // namespace twin_detail

namespace {

/// Power spectral density C of a tabulated spectrum at wave numbers below its end. The curvatures
/// of the spline cost the third power of the number of knots and are computed once for all wave
/// numbers.
std::vector<double> table_density(const TwinDraw& draw, const std::vector<double>& wavenumbers) {
  std::vector<double> positions, densities;
  for (const double knot : draw.knots) positions.push_back(std::log(knot));
  const Eigen::Map<const Eigen::VectorXd> heights(draw.log_psd.data(),
                                                  static_cast<Index>(draw.log_psd.size()));
  const Eigen::MatrixXd curvatures = twin_detail::spline_curvatures(positions);
  for (const double q : wavenumbers)
    densities.push_back(
        std::exp(twin_detail::spline_row(positions, curvatures, std::log(q)).dot(heights)));
  return densities;
}

}  // namespace

double TwinDraw::density(double q) const {
  if (q > 2 * std::numbers::pi / short_cutoff * (1 + 1e-12)) return 0;
  if (form == SpectrumForm::table) return table_density(*this, {q}).front();
  const double corner = 2 * std::numbers::pi / rolloff;
  return form == SpectrumForm::corner
             ? std::exp(amplitude - 2 * (1 + hurst) * std::log(std::max(q, corner) / reference))
             : std::exp(amplitude - 2 * (1 + hurst) * std::log(std::hypot(q, corner) / reference));
}

SpectrumTable tabulated(const TwinDraw& draw, double lowest, int points_per_decade) {
  const double end = 2 * std::numbers::pi / draw.short_cutoff;
  require(lowest > 0 && lowest < end, "lowest", lowest,
          "must be > 0 and below the wave number of the short cut-off");
  require(points_per_decade >= 1, "points_per_decade", points_per_decade, "must be >= 1");
  const double step = std::pow(10.0, 1.0 / points_per_decade);
  const double corner = draw.form == SpectrumForm::corner ? 2 * std::numbers::pi / draw.rolloff : 0;
  SpectrumTable table;
  for (double q = lowest; q < end * (1 - 1e-9); q *= step) {
    // The wave number of a corner between two points becomes a point of the table.
    if (!table.wavenumber.empty() && corner > table.wavenumber.back() && corner < q)
      table.wavenumber.push_back(corner);
    table.wavenumber.push_back(q);
  }
  if (corner > table.wavenumber.back() && corner < end) table.wavenumber.push_back(corner);
  table.wavenumber.push_back(end);
  if (draw.form == SpectrumForm::table)
    table.psd = table_density(draw, table.wavenumber);
  else
    for (const double q : table.wavenumber) table.psd.push_back(draw.density(q));
  return table;
}

}  // namespace salebra
