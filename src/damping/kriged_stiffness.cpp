// SPDX-License-Identifier: GPL-3.0-or-later
// Kriging of the normal stiffness between contacts on a grid.
#include "kriged_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/numerics/dense_systems.hpp"

namespace salebra::detail {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using std::numbers::pi;

// Variance of the number of lattice points inside a smooth closed curve at a random position on a
// square lattice, per unit length of the curve: Σ|k|⁻³/(4π³) over the reciprocal lattice vectors k
// (D. G. Kendall, Quart. J. Math. 19 (1948) 1, for ovals).
constexpr double lattice_variance = 0.0728;
constexpr Index trend_terms = 3;
constexpr double prior_width = 1.5;

/// `positions` are decreasing indentations. Returns the index of the interval between two of them
/// that contains `indentation`, and the distance from the upper end of this interval as a fraction
/// of it.
std::pair<Index, double> interval_of(const VectorXd& positions, double indentation) {
  const auto after =
      std::upper_bound(positions.begin(), positions.end(), indentation, std::greater());
  const Index i = std::clamp<Index>(after - positions.begin() - 1, 0, positions.size() - 2);
  const double share = (indentation - positions(i)) / (positions(i + 1) - positions(i));
  return {i, std::clamp(share, 0.0, 1.0)};
}

}  // namespace

ArrayXd VarianceScales::of_spots() { return ArrayXd::LinSpaced(25, -9, 3).exp(); }
ArrayXd VarianceScales::of_cells() { return ArrayXd::LinSpaced(15, 0, 7).exp(); }

VarianceScales::VarianceScales() {
  const ArrayXd rows = of_spots().log().square(), columns = of_cells().log().square();
  log_probability_ =
      -(rows.replicate(1, columns.size()) + columns.transpose().replicate(rows.size(), 1)) /
      (2 * prior_width * prior_width);
}

ArrayXXd VarianceScales::probability() const {
  const ArrayXXd relative = (log_probability_ - log_probability_.maxCoeff()).exp();
  return relative / relative.sum();
}

std::pair<Index, Index> VarianceScales::best() const {
  std::pair<Index, Index> position;
  log_probability_.maxCoeff(&position.first, &position.second);
  return position;
}

KrigedStiffness::KrigedStiffness(const std::vector<StiffnessSample>& samples, VectorXd positions)
    : positions_(std::move(positions)) {
  const StiffnessSample &high = samples.front(), &low = samples.back();
  half_ = (high.indentation - low.indentation) / 2;
  corrections_ = VectorXd::NullaryExpr(static_cast<Index>(samples.size()), [&](Index k) {
    return samples[static_cast<std::size_t>(k)].force_correction;
  });
  const VectorXd x = (positions_.array() - (high.indentation + low.indentation) / 2) / half_;
  const Observations observations = observations_of(samples);
  set_covariances(samples, x, observations);
  values_ = observations.values / bend_;
  trend_ = MatrixXd(positions_.size(), trend_terms);
  for (Index power = 0; power < trend_terms; ++power)
    trend_.col(power) = x.array().pow(static_cast<double>(power));
  find_contrasts(observations.operators * trend_);
  find_scales();
  predict(samples[samples.size() / 2]);
}

KrigedStiffness::Observations KrigedStiffness::observations_of(
    const std::vector<StiffnessSample>& samples) const {
  const auto count = static_cast<Index>(samples.size());
  const Index size = positions_.size(), data = 2 * count - 1;
  Observations observations{MatrixXd::Zero(data, size), VectorXd(data), VectorXd(size)};
  Index at = 0;
  for (Index k = 0; k < count; ++k) {
    const StiffnessSample& sample = samples[static_cast<std::size_t>(k)];
    const Index begin = at;
    while (at + 1 < size && std::abs(positions_(at + 1) - sample.indentation) <=
                                std::abs(positions_(at) - sample.indentation))
      ++at;
    observations.operators(count - 1 + k, at) = 1;
    observations.values(count - 1 + k) = sample.stiffness;
    observations.entered(at) = sample.cells;
    if (k == 0) continue;
    const StiffnessSample& above = samples[static_cast<std::size_t>(k - 1)];
    for (Index i = begin; i < at; ++i) {
      const double width = (positions_(i) - positions_(i + 1)) / half_;
      observations.operators(k - 1, i) += width / 2;
      observations.operators(k - 1, i + 1) += width / 2;
      const double share =
          (positions_(begin) - positions_(i + 1)) / (positions_(begin) - positions_(at));
      observations.entered(i + 1) = above.cells + share * (sample.cells - above.cells);
    }
    observations.values(k - 1) = (above.force - sample.force) / half_;
  }
  return observations;
}

void KrigedStiffness::set_covariances(const std::vector<StiffnessSample>& samples,
                                      const VectorXd& x, const Observations& observations) {
  const StiffnessSample &high = samples.front(), &low = samples.back(),
                        &middle = samples[samples.size() / 2];
  const Index size = x.size();
  double perimeter = 0, together = 0;
  for (const StiffnessSample& sample : samples) {
    perimeter += sample.perimeter / static_cast<double>(samples.size());
    together += sample.together / static_cast<double>(samples.size());
  }
  // Increases of K and of the number of cells over half the range of indentations. Few entered
  // cells would give uncertain values, so these are averaged with the increases by an exponential
  // law (area proportional to force), which count as one group of cells.
  const double strain = middle.force > 0 ? half_ * middle.stiffness / middle.force : 0;
  const double law = strain * middle.stiffness, of_law = strain * middle.cells;
  const double rise = (high.stiffness - low.stiffness) / 2;
  const double entering = std::max(0.0, high.cells - low.cells) / 2;
  const double group = together / 2, groups = entering / group;
  bend_ = (groups * std::abs(rise) + law) / (groups + 1);
  const double step = (std::abs(rise) + law * group / of_law) / (entering + group) / bend_;
  const double variance = lattice_variance * std::max(perimeter, 1.0);
  const double of_spots = 1 / (2 * pi * std::max(middle.spots, 1.0));
  spots_ = MatrixXd::NullaryExpr(size, size, [&](Index i, Index k) {
    const double apart = std::abs(x(i) - x(k));
    return apart > 0 ? of_spots * apart * apart * std::log(apart) : 0.0;
  });
  // Counts one group of cells more, so that its noise is allowed for even if no cell entered.
  const VectorXd entered = observations.entered + group * x;
  const MatrixXd cells = MatrixXd::NullaryExpr(size, size, [&](Index i, Index k) {
    return together * step * step * variance *
           std::exp(-std::abs(entered(i) - entered(k)) / (2 * variance));
  });
  spots_to_samples_ = observations.operators * spots_;
  of_spots_ = spots_to_samples_ * observations.operators.transpose();
  of_cells_ = observations.operators * cells * observations.operators.transpose();
}

void KrigedStiffness::find_contrasts(const MatrixXd& trend) {
  fit_ = pseudo_inverse(trend);
  // `free` spans the linear combinations of sample values that are 0 for every parabola. contrasts_
  // spans the same space, and makes the covariances by cells and by contact patches both diagonal.
  const MatrixXd free =
      symmetric_modes(trend * trend.transpose()).vectors.leftCols(trend.rows() - trend_terms);
  const Modes noise = symmetric_modes(free.transpose() * of_cells_ * free);
  const double least = 1e-12 * noise.values.maxCoeff();
  const MatrixXd whitened =
      free * noise.vectors * noise.values.array().max(least).rsqrt().matrix().asDiagonal();
  const Modes both = symmetric_modes(whitened.transpose() * of_spots_ * whitened);
  contrasts_ = whitened * both.vectors;
  ratios_ = both.values.array().max(0.0);
  found_ = contrasts_.transpose() * values_;
}

void KrigedStiffness::find_scales() {
  const ArrayXd rows = VarianceScales::of_spots(), columns = VarianceScales::of_cells();
  log_likelihood_ = ArrayXXd::NullaryExpr(rows.size(), columns.size(), [&](Index i, Index k) {
    const ArrayXd expected = columns(k) + rows(i) * ratios_.array();
    return -(expected.log() + found_.array().square() / expected).sum() / 2;
  });
  VarianceScales own;
  own.add(log_likelihood_);
  const auto [row, column] = own.best();
  best_of_spots_ = rows(row), best_of_cells_ = columns(column);
}

void KrigedStiffness::predict(const StiffnessSample& middle) {
  const MatrixXd parabola = trend_ * fit_;
  const VectorXd expected = best_of_cells_ + best_of_spots_ * ratios_.array();
  const VectorXd beyond = contrasts_ * found_.cwiseQuotient(expected);
  stiffness_ = bend_ * (parabola * (values_ - best_of_spots_ * (of_spots_ * beyond) -
                                    best_of_cells_ * (of_cells_ * beyond)) +
                        best_of_spots_ * (spots_to_samples_.transpose() * beyond));
  force_ = VectorXd::Zero(positions_.size());
  for (Index i = 0; i + 1 < positions_.size(); ++i)
    force_(i + 1) =
        force_(i) - (stiffness_(i) + stiffness_(i + 1)) / 2 * (positions_(i) - positions_(i + 1));
  force_.array() += middle.force - force(middle.indentation);
}

KrigedStiffness::Parts KrigedStiffness::parts(const VectorXd& weights) const {
  const VectorXd trend = fit_.transpose() * (trend_.transpose() * weights);
  const VectorXd to_samples = spots_to_samples_ * weights;
  const VectorXd spots = of_spots_ * trend, cells = of_cells_ * trend;
  return {.trend = trend,
          .by_spots = contrasts_.transpose() * (to_samples - spots),
          .by_cells = -contrasts_.transpose() * cells,
          .spots = trend.dot(spots) - 2 * trend.dot(to_samples) + weights.dot(spots_ * weights),
          .cells = trend.dot(cells)};
}

VectorXd KrigedStiffness::sample_weights(const Parts& parts, double of_spots,
                                         double of_cells) const {
  const ArrayXd expected = of_cells + of_spots * ratios_.array();
  return parts.trend +
         contrasts_ *
             ((of_spots * parts.by_spots + of_cells * parts.by_cells).array() / expected).matrix();
}

KrigedStiffness::Estimate KrigedStiffness::estimate(const VectorXd& weights,
                                                    const VarianceScales& scales) const {
  const Parts one = parts(weights);
  const ArrayXXd probability = scales.probability();
  const ArrayXd rows = VarianceScales::of_spots(), columns = VarianceScales::of_cells();
  const double trend = one.trend.dot(values_);
  double mean = 0, square = 0;
  for (Index i = 0; i < rows.size(); ++i)
    for (Index k = 0; k < columns.size(); ++k) {
      const ArrayXd expected = columns(k) + rows(i) * ratios_.array();
      const ArrayXd by = rows(i) * one.by_spots.array() + columns(k) * one.by_cells.array();
      const double beyond = (by / expected * found_.array()).sum();
      const double variance =
          rows(i) * one.spots + columns(k) * one.cells - (by.square() / expected).sum();
      mean += probability(i, k) * beyond;
      square += probability(i, k) * (std::max(0.0, variance) + beyond * beyond);
    }
  return {bend_ * (trend + mean), bend_ * std::sqrt(std::max(0.0, square - mean * mean))};
}

double KrigedStiffness::solver_error(const VectorXd& weights) const {
  const VectorXd all = sample_weights(parts(weights), best_of_spots_, best_of_cells_);
  const Index differences = all.size() / 2;
  VectorXd by_force = VectorXd::Zero(differences + 1);
  by_force.head(differences) += all.head(differences);
  by_force.tail(differences) -= all.head(differences);
  return by_force.cwiseAbs().dot(corrections_) / half_;
}

VectorXd KrigedStiffness::weights_at(double indentation) const {
  const auto [i, share] = interval_of(positions_, indentation);
  VectorXd weights = VectorXd::Zero(positions_.size());
  weights(i) = 1 - share;
  weights(i + 1) = share;
  return weights;
}

double KrigedStiffness::stiffness(double indentation) const {
  const auto [i, share] = interval_of(positions_, indentation);
  return (1 - share) * stiffness_(i) + share * stiffness_(i + 1);
}

double KrigedStiffness::force(double indentation) const {
  const auto [i, share] = interval_of(positions_, indentation);
  return (1 - share) * force_(i) + share * force_(i + 1);
}

}  // namespace salebra::detail
