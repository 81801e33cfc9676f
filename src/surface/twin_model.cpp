// SPDX-License-Identifier: GPL-3.0-or-later
// Expected spectra of scans, their likelihood and its derivatives.
#include "surface/twin_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/twin_kernels.hpp"

namespace salebra::twin_detail {
namespace {

using std::numbers::pi;

constexpr double tail_freedom = 4, blur_freedom = 0.05;
constexpr double min_gain_error = 1e-4;  ///< minimum standard deviation of a gain, for
                                         ///< calibrations of 0
/// Power of skew heights beyond the cut-off q_s, where waves that are sums of shorter and longer ones
/// are all there is: about ∝ e^{−6q/q_s} within a factor of e, by the series in powers of the
/// correlation, for transforms of Gaussian fields with skewness −0.7 to −2, Hurst exponents 0.45 to
/// 0.95 and 4 to 40 wavelengths of the cut-off in the roll-off.
constexpr double sums_decay = 6;
constexpr double bend_freedom = 1.5;  ///< standard deviation of second differences of ln C
                                      ///< between knots

/// r − 1 − ln r for r = `ratio`, without cancellation near r = 1.
double deviation(double ratio) {
  const double off = ratio - 1;
  return std::abs(off) < 1e-3 ? off * off * (0.5 - off * (1.0 / 3 - off / 4))
                              : off - std::log(ratio);
}

/// √(2m(r − 1 − ln r)) with the sign of r − 1, for the ratio r of measured to expected power and
/// the number m of modes (`precision`), and its derivative with respect to ln of the expected
/// power.
std::pair<double, double> deviance_residual(double ratio, double precision) {
  const double root = std::sqrt(2 * precision * deviation(ratio));
  const double value = ratio < 1 ? -root : root;
  const double slope = root < 1e-6 ? -std::sqrt(precision) : precision * (1 - ratio) / value;
  return {value, slope};
}

/// Weight of the power that a tip adds beyond the cut-off: it rises from 0 at 0.90 of the cut-off
/// wave number to 1 at 0.96.
double beyond(double wavenumber, double cutoff) {
  return std::clamp((wavenumber / cutoff - 0.90) / 0.06, 0.0, 1.0);
}

}  // namespace

TwinModel::TwinModel(const std::vector<TwinData>& data, TwinLaw law)
    : data_(data), law_(std::move(law)) {
  size_ = law_.size() + 2 * static_cast<Index>(data_.size());
  for (std::size_t g = 0; g < data_.size(); ++g) {
    const TwinData& group = data_[g];
    groups_.push_back({LawPoints(law_, group.cell_wavenumber), {}, {}, -1, -1});
    for (const double q : group.cell_wavenumber) groups_.back().square.push_back(q * q);
    if (group.tail) groups_.back().tail = size_++;
    if (group.blur > 0) groups_.back().blur = size_++;
    bins_ += static_cast<Index>(group.bins.size());
    largest_ = std::max(largest_, 2 * pi / group.wavenumber.front());
    finest_ = std::max(finest_, group.wavenumber.back());
  }
  set_tolerance(0.3, 0.3, 1);

  // Groups of scans of one instrument share its calibration error.
  const auto count = static_cast<Index>(data_.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j) {
      const TwinData &a = data_[static_cast<std::size_t>(i)],
                     &b = data_[static_cast<std::size_t>(j)];
      if (a.instrument == b.instrument)
        covariance(i, j) = a.height_calibration * b.height_calibration;
      if (i == j)
        covariance(i, i) += a.scan_calibration * a.scan_calibration / a.mean_scans +
                            min_gain_error * min_gain_error;
    }
  gain_whitening_ = Eigen::LLT<Eigen::MatrixXd>(covariance)
                        .matrixL()
                        .solve(Eigen::MatrixXd::Identity(count, count));

  lowest_ = Eigen::VectorXd::Constant(size_, -15);
  highest_ = Eigen::VectorXd::Constant(size_, 15);
  lowest_[law_.cutoff()] = std::log(2 * pi / finest_ / 20);
  highest_[law_.cutoff()] = std::log(largest_ / 5);
  if (law_.table()) {
    lowest_.head(law_.size() - 1).setConstant(-400);
    highest_.head(law_.size() - 1).setConstant(400);
  } else {
    lowest_[0] = -400;
    highest_[0] = 400;
    lowest_[TwinLaw::hurst] = 0.02;
    highest_[TwinLaw::hurst] = 1.2;
    lowest_[TwinLaw::rolloff] = std::log(2 * pi / finest_ * 1.5);
    highest_[TwinLaw::rolloff] = std::log(30 * largest_);
  }

  // The residuals of the priors are linear in the parameters, so their derivatives are the same
  // everywhere.
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(size_);
  const Eigen::VectorXd start = priors(none);
  prior_slopes_.resize(start.size(), size_);
  for (Index p = 0; p < size_; ++p)
    prior_slopes_.col(p) = priors(Eigen::VectorXd::Unit(size_, p)) - start;
}

void TwinModel::set_tolerance(double everywhere, double beyond_cutoff, double cutoff) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].precisions.clear();
    for (std::size_t bin = 0; bin < data_[g].bins.size(); ++bin) {
      // A bin that begins at the cut-off contains little but leakage across the sharp end of the
      // spectrum.
      constexpr double half_bin = 1.0724;  // √1.15, half of a bin's ratio
      const double q = data_[g].wavenumber[bin], edge = q / half_bin / cutoff;
      // Of skew heights, the bins beyond it contain sums of shorter and longer waves, of which the
      // tail gives the power to a factor of e.
      const bool sums = data_[g].tail && !data_[g].tip && edge > 0.95 && edge < 2.2;
      const double s = edge > 0.95 && edge < 1.05 ? 3 * beyond_cutoff
                       : sums                     ? 2 * beyond_cutoff
                       : q > 0.8 * cutoff         ? beyond_cutoff
                                                  : everywhere;
      const double relative = data_[g].psd_error[bin];
      groups_[g].precisions.push_back(1 / (1 / data_[g].modes[bin] + s * s + relative * relative));
    }
  }
}

void TwinModel::set_scatter(double factor) {
  for (Group& group : groups_)
    for (double& precision : group.precisions) precision /= factor;
}

Eigen::VectorXd TwinModel::priors(const Eigen::VectorXd& parameters) const {
  const auto count = static_cast<Index>(data_.size());
  std::vector<double> values;
  const Eigen::VectorXd gains = gain_whitening_ * parameters.segment(law_.size(), count);
  for (Index g = 0; g < count; ++g) {
    const auto at = static_cast<std::size_t>(g);
    values.push_back(gains[g]);
    values.push_back(parameters[noise_at(at)] / data_[at].noise_freedom);
    if (groups_[at].tail >= 0) values.push_back(parameters[groups_[at].tail] / tail_freedom);
    if (groups_[at].blur >= 0) values.push_back(parameters[groups_[at].blur] / blur_freedom);
  }
  for (Index k = 1; law_.table() && k + 2 < law_.size(); ++k)
    values.push_back((parameters[k - 1] - 2 * parameters[k] + parameters[k + 1]) / bend_freedom);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

double TwinModel::tail(const Eigen::VectorXd& parameters, std::size_t group,
                       std::size_t bin) const {
  const Index at = groups_[group].tail;
  if (at < 0) return 0;
  const TwinData& data = data_[group];
  const double q = data.wavenumber[bin];
  const double cutoff = 2 * pi * std::exp(-parameters[law_.cutoff()]), weight = beyond(q, cutoff);
  const double fall =
      data.tip ? 5 * std::log(q / data.tail_reference) : sums_decay * (q / cutoff - 1);
  return weight == 0 ? 0 : weight * data.noise * std::exp(parameters[at] - fall);
}

std::size_t TwinModel::evaluate(const Eigen::VectorXd& parameters, std::size_t group,
                                Work& work) const {
  const TwinData& data = data_[group];
  const Group& own = groups_[group];
  const double end = std::log(2 * pi) - parameters[law_.cutoff()];
  const auto cells = static_cast<std::size_t>(std::ranges::lower_bound(data.cell_low, end) -
                                              data.cell_low.begin());
  work.source.resize(cells);
  log_density(law_, {parameters.data(), static_cast<std::size_t>(law_.size())}, own.points,
              work.source);
  if (own.blur >= 0) {
    const double variance = data.blur * data.blur * std::exp(2 * parameters[own.blur]);
    if (data.lay.stretch == 1)
      for (std::size_t cell = 0; cell < cells; ++cell)
        work.source[cell] -= variance * own.square[cell];
    else
      for (std::size_t cell = 0; cell < cells; ++cell)
        work.source[cell] += data.lay.log_blur(variance, own.square[cell]);
  }
  exponentials(work.source);
  if (cells > 0)
    work.source.back() *= std::min(1.0, (end - data.cell_low[cells - 1]) /
                                            (data.cell_high[cells - 1] - data.cell_low[cells - 1]));
  work.signal.assign(data.bins.size(), 0.0);
  add_products(work.source, data.weights.data(), work.signal);
  const double gain = std::exp(2 * parameters[gain_at(group)]),
               noise = data.noise * std::exp(2 * parameters[noise_at(group)]);
  work.expected.resize(data.bins.size());
  for (std::size_t bin = 0; bin < data.bins.size(); ++bin) {
    work.signal[bin] *= gain;
    work.expected[bin] = work.signal[bin] + noise + data.leaked[bin] + tail(parameters, group, bin);
  }
  return cells;
}

double TwinModel::log_posterior(const Eigen::VectorXd& parameters, Work& work) const {
  if ((parameters.array() < lowest_.array()).any() || (parameters.array() > highest_.array()).any())
    return -std::numeric_limits<double>::infinity();
  if (!law_.table() && parameters[TwinLaw::rolloff] < parameters[law_.cutoff()])
    return -std::numeric_limits<double>::infinity();
  double sum = priors(parameters).squaredNorm() / 2;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    evaluate(parameters, group, work);
    const TwinData& data = data_[group];
    work.ratio.resize(data.bins.size());
    for (std::size_t bin = 0; bin < data.bins.size(); ++bin)
      work.ratio[bin] = work.expected[bin] = data.psd[bin] / work.expected[bin];
    logarithms(work.ratio);
    for (std::size_t bin = 0; bin < data.bins.size(); ++bin)
      sum += groups_[group].precisions[bin] * (work.expected[bin] - 1 - work.ratio[bin]);
  }
  return -sum;
}

Eigen::MatrixXd TwinModel::slopes_of_expected(const Eigen::VectorXd& parameters, std::size_t group,
                                              std::size_t cells, Work& work) const {
  const TwinData& data = data_[group];
  const Group& own = groups_[group];
  const auto count = static_cast<Index>(cells);
  const double gain = std::exp(2 * parameters[gain_at(group)]);
  const Eigen::Map<const Eigen::ArrayXd> source(work.source.data(), count);
  log_density_slopes(law_, {parameters.data(), static_cast<std::size_t>(law_.size())}, own.points,
                     count, work.slopes);
  Eigen::MatrixXd slopes =
      Eigen::MatrixXd::Zero(static_cast<Index>(data.bins.size()), law_.size() + 1);
  std::vector<double> column(cells);
  const auto project = [&](Index to) {
    add_products(column, data.weights.data(), {&slopes(0, to), data.bins.size()});
    slopes.col(to) *= gain;
  };
  for (Index p = 0; p < law_.cutoff(); ++p) {
    Eigen::Map<Eigen::ArrayXd>(column.data(), count) = source * work.slopes.col(p).array();
    project(p);
  }
  if (own.blur >= 0) {
    const double variance = data.blur * data.blur * std::exp(2 * parameters[own.blur]);
    for (std::size_t cell = 0; cell < cells; ++cell)
      column[cell] = 2 * data.lay.log_blur_slope(variance, own.square[cell]) * work.source[cell];
    project(law_.size());
  }
  // The cut-off wavelength changes how much of the last cell lies below the cut-off.
  const double end = std::log(2 * pi) - parameters[law_.cutoff()];
  if (cells > 0 && end < data.cell_high[cells - 1]) {
    std::ranges::fill(column, 0.0);
    column[cells - 1] = -work.source[cells - 1] / std::max(1e-12, end - data.cell_low[cells - 1]);
    project(law_.cutoff());
  }
  return slopes;
}

void TwinModel::residuals(const Eigen::VectorXd& parameters, Work& work, Eigen::VectorXd& values,
                          Eigen::MatrixXd* slopes) const {
  const Eigen::VectorXd prior = priors(parameters);
  values.resize(prior.size() + bins_);
  values.head(prior.size()) = prior;
  if (slopes) {
    slopes->setZero(values.size(), size_);
    slopes->topRows(prior.size()) = prior_slopes_;
  }
  Index row = prior.size();
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    const std::size_t cells = evaluate(parameters, group, work);
    const TwinData& data = data_[group];
    const Group& own = groups_[group];
    const std::size_t bins = data.bins.size();
    const double noise = data.noise * std::exp(2 * parameters[noise_at(group)]);
    Eigen::MatrixXd of_expected;
    if (slopes) of_expected = slopes_of_expected(parameters, group, cells, work);
    for (std::size_t bin = 0; bin < bins; ++bin, ++row) {
      const double expected_power = work.expected[bin];
      const auto [value, slope] =
          deviance_residual(data.psd[bin] / expected_power, own.precisions[bin]);
      values[row] = value;
      if (!slopes) continue;
      const double factor = slope / expected_power;
      const auto at = static_cast<Index>(bin);
      slopes->row(row).head(law_.size()) = factor * of_expected.row(at).head(law_.size());
      (*slopes)(row, gain_at(group)) = factor * 2 * work.signal[bin];
      (*slopes)(row, noise_at(group)) = factor * 2 * noise;
      if (own.blur >= 0) (*slopes)(row, own.blur) = factor * of_expected(at, law_.size());
      if (own.tail < 0) continue;
      (*slopes)(row, own.tail) = factor * tail(parameters, group, bin);
      // Derivative of the tail with respect to ln λ_s, the cut-off wavelength: its weight, and the
      // power of skew heights, depend on the wave number relative to the cut-off.
      const double cutoff_waves =
          data.wavenumber[bin] / (2 * pi) * std::exp(parameters[law_.cutoff()]);
      const double of_tail = tail(parameters, group, bin);
      double of_cutoff = data.tip ? 0 : -sums_decay * cutoff_waves * of_tail;
      if (cutoff_waves > 0.90 && cutoff_waves < 0.96)
        of_cutoff += of_tail * cutoff_waves / (cutoff_waves - 0.90);
      (*slopes)(row, law_.cutoff()) += factor * of_cutoff;
    }
  }
}

std::vector<double> TwinModel::expected(const Eigen::VectorXd& parameters,
                                        std::size_t group) const {
  Work work;
  evaluate(parameters, group, work);
  return work.expected;
}

TwinModel::Misfit TwinModel::misfit(const Eigen::VectorXd& parameters, std::size_t group) const {
  return misfit_of(parameters, group, data_[group].psd, 1);
}

TwinModel::Misfit TwinModel::misfit_of(const Eigen::VectorXd& parameters, std::size_t group,
                                       const std::vector<double>& psd, double share) const {
  Work work;
  evaluate(parameters, group, work);
  const TwinData& data = data_[group];
  std::vector<double> precisions;
  for (std::size_t bin = 0; bin < data.bins.size(); ++bin) {
    const double tolerance = 1 / groups_[group].precisions[bin] - 1 / data.modes[bin];
    precisions.push_back(1 / (1 / (share * data.modes[bin]) + tolerance));
  }
  // Find the most likely gain (factor of the heights) of this scan.
  double shift = 0;  // twice the logarithm of the gain
  Misfit sum;
  for (int iteration = 0; share < 1 && iteration < 20; ++iteration) {
    double up = 0, down = 1e-300;
    for (std::size_t bin = 0; bin < data.bins.size(); ++bin) {
      const double signal = work.signal[bin] * std::exp(shift),
                   mean = work.expected[bin] - work.signal[bin] + signal, part = signal / mean;
      up += precisions[bin] * part * (psd[bin] / mean - 1);
      down += precisions[bin] * part * part;
    }
    shift += std::clamp(up / down, -1.0, 1.0);
  }
  sum.gain = std::exp(shift / 2);
  for (std::size_t bin = 0; bin < data.bins.size(); ++bin) {
    const double mean = work.expected[bin] + work.signal[bin] * std::expm1(shift);
    sum.deviance += 2 * precisions[bin] * deviation(psd[bin] / mean);
    sum.expected += precisions[bin] * data.scatter[bin] / (share * data.modes[bin]);
  }
  return sum;
}

double TwinModel::gain(const Eigen::VectorXd& parameters, std::size_t group) const {
  return std::exp(parameters[gain_at(group)]);
}

}  // namespace salebra::twin_detail
