// SPDX-License-Identifier: GPL-3.0-or-later
// Most likely parameters of a surface twin, profiles of its likelihood, and its curvature.
#include "surface/twin_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/stop_check.hpp"

namespace salebra::twin_detail {
namespace {

using std::numbers::pi;

constexpr double law_tolerance = 0.03, zone_tolerance = 0.5, first_tolerance = 0.3;

double cutoff_wavenumber(const TwinModel& model, const Eigen::VectorXd& parameters) {
  return 2 * pi * std::exp(-parameters[model.law().cutoff()]);
}

/// ln of the scans' power spectral density C near a wave number, for heights without a calibration
/// error (gain 1).
double seen_level(const TwinModel& model, double wavenumber) {
  double level = 0, nearest = std::numeric_limits<double>::infinity();
  for (const TwinData& data : model.data())
    for (std::size_t bin = 0; bin < data.bins.size(); ++bin) {
      const double distance = std::abs(std::log(data.wavenumber[bin] / wavenumber));
      if (distance >= nearest) continue;
      nearest = distance;
      // The weights convert C to the power of the bin: that of a profile is about 2q C, with the
      // wave number q.
      double sum = 0;
      const std::size_t bins = data.bins.size();
      for (std::size_t cell = 0; cell < data.cell_wavenumber.size(); ++cell)
        sum += data.weights[cell * bins + bin] *
               std::pow(data.cell_wavenumber[cell] / data.wavenumber[bin], -3.4);
      level = std::log(std::max(data.psd[bin] / sum, std::numeric_limits<double>::min()));
    }
  return level;
}

std::vector<Eigen::VectorXd> starts(const TwinModel& model) {
  const TwinLaw& law = model.law();
  std::vector<Eigen::VectorXd> all;
  std::vector<double> cutoffs{model.lowest()[law.cutoff()] + 0.2};
  for (const double factor : {1.3, 3.0, 6.0, 12.0, 24.0})
    cutoffs.push_back(std::log(2 * pi / model.finest_wavenumber() * factor));
  const double level = seen_level(model, law.reference);
  for (const double hurst : {0.5, 0.85})
    for (const double rolloff : {0.15, 0.6})
      for (const double cutoff : cutoffs) {
        Eigen::VectorXd start = Eigen::VectorXd::Zero(model.size());
        start.head(4) << level, hurst, std::log(rolloff * model.max_scan()), cutoff;
        all.push_back(start);
      }
  return all;
}

Eigen::VectorXd bounded(const TwinModel& model, const Eigen::VectorXd& parameters) {
  constexpr double margin = 1e-6;
  return parameters.cwiseMax((model.lowest().array() + margin).matrix())
      .cwiseMin((model.highest().array() - margin).matrix());
}

}  // namespace

TwinFit minimised(const TwinModel& model, Eigen::VectorXd start, const std::vector<Index>& fixed) {
  TwinModel::Work work;
  Eigen::VectorXd at = bounded(model, start), values, next_values;
  for (const Index parameter : fixed) at[parameter] = start[parameter];
  Eigen::MatrixXd slopes;
  model.residuals(at, work, values, &slopes);
  double cost = values.squaredNorm() / 2, damping = 1e-2;
  const Index size = model.size();
  for (int iteration = 0; iteration < 80; ++iteration) {
    const Eigen::VectorXd gradient = slopes.transpose() * values;
    // A parameter at a bound that the step would move beyond the bound is held.
    std::vector<Index> free;
    for (Index p = 0; p < size; ++p) {
      const bool held = std::ranges::find(fixed, p) != fixed.end() ||
                        (at[p] <= model.lowest()[p] + 2e-6 && gradient[p] > 0) ||
                        (at[p] >= model.highest()[p] - 2e-6 && gradient[p] < 0);
      if (!held) free.push_back(p);
    }
    if (free.empty()) break;
    const Eigen::MatrixXd own = slopes(Eigen::all, free);
    Eigen::MatrixXd curvature = own.transpose().lazyProduct(own);
    bool moved = false;
    double gained = 0;
    while (damping < 1e9) {
      detail::stop_if_asked();
      Eigen::MatrixXd damped = curvature;
      damped.diagonal().array() += damping * (curvature.diagonal().array() + 1e-3);
      const Eigen::VectorXd step = Eigen::LDLT<Eigen::MatrixXd>(damped).solve(gradient(free));
      Eigen::VectorXd next = at;
      for (std::size_t k = 0; k < free.size(); ++k)
        next[free[k]] -= std::clamp(step[static_cast<Index>(k)], -2.0, 2.0);
      next = bounded(model, next);
      for (const Index parameter : fixed) next[parameter] = start[parameter];
      model.residuals(next, work, next_values, nullptr);
      const double next_cost = next_values.squaredNorm() / 2;
      if (next_cost < cost) {
        gained = cost - next_cost;
        at = next;
        cost = next_cost;
        damping = std::max(damping / 5, 1e-7);
        moved = true;
        break;
      }
      damping *= 6;
    }
    if (!moved || gained < 1e-5) break;
    model.residuals(at, work, values, &slopes);
  }
  return {at, cost};
}

TwinFit refitted(TwinModel& model, const Eigen::VectorXd& start) {
  TwinFit fit{start, 0};
  // The range with the wider tolerance moves with the cut-off, hence two passes.
  for (int pass = 0; pass < 2; ++pass) {
    model.set_tolerance(law_tolerance, zone_tolerance, cutoff_wavenumber(model, fit.parameters));
    fit = minimised(model, fit.parameters);
  }
  return fit;
}

TwinFit fitted(TwinModel& model) {
  model.set_tolerance(first_tolerance, first_tolerance, 1);
  std::vector<TwinFit> candidates;
  TwinModel::Work work;
  Eigen::VectorXd values;
  for (const Eigen::VectorXd& start : starts(model)) {
    const Eigen::VectorXd inside = bounded(model, start);
    model.residuals(inside, work, values, nullptr);
    const double cost = values.squaredNorm() / 2;
    if (std::isfinite(cost)) candidates.push_back({inside, cost});
  }
  std::ranges::stable_sort(candidates, {}, &TwinFit::cost);
  candidates.resize(std::min<std::size_t>(candidates.size(), 6));
  TwinFit best{{}, std::numeric_limits<double>::infinity()};
  for (const TwinFit& candidate : candidates) {
    const TwinFit fit = minimised(model, candidate.parameters);
    if (fit.cost < best.cost) best = fit;
  }
  require_that(std::isfinite(best.cost), "scans",
               "have spectral densities so large that their squares overflow; check the units of "
               "heights and lengths");
  return refitted(model, best.parameters);
}

TwinProfile profiled(const TwinModel& model, Index parameter, std::vector<double> values,
                     const Eigen::VectorXd& start) {
  TwinProfile profile{std::move(values), {}};
  profile.fits.resize(profile.values.size());
  Eigen::VectorXd at = start;
  for (std::size_t k = profile.values.size(); k-- > 0;) {
    at[parameter] = profile.values[k];
    profile.fits[k] = minimised(model, at, {parameter});
    at = profile.fits[k].parameters;
  }
  return profile;
}

std::optional<double> TwinProfile::limit(double least, double drop) const {
  for (const TwinFit& fit : fits) least = std::min(least, fit.cost);
  std::size_t best = 0;
  for (std::size_t k = 0; k < fits.size(); ++k)
    if (fits[k].cost < fits[best].cost) best = k;
  for (std::size_t k = best; k-- > 0;) {
    if (fits[k].cost < least + drop) continue;
    const double part = (least + drop - fits[k + 1].cost) / (fits[k].cost - fits[k + 1].cost);
    return values[k + 1] + std::clamp(part, 0.0, 1.0) * (values[k] - values[k + 1]);
  }
  return {};
}

Eigen::MatrixXd laplace_covariance(const TwinModel& model, const Eigen::VectorXd& parameters,
                                   const std::vector<Index>& fixed) {
  TwinModel::Work work;
  Eigen::VectorXd values;
  Eigen::MatrixXd slopes;
  model.residuals(parameters, work, values, &slopes);
  Eigen::MatrixXd curvature = slopes.transpose().lazyProduct(slopes);
  // A parameter that the data do not determine gets the width of its range, by a weak prior.
  for (Index p = 0; p < model.size(); ++p)
    curvature(p, p) += p < model.law().size() ? 1.0 : 1.0 / 16;
  for (const Index parameter : fixed) curvature(parameter, parameter) += 1e12;
  return Eigen::LDLT<Eigen::MatrixXd>(curvature).solve(
      Eigen::MatrixXd::Identity(model.size(), model.size()));
}

}  // namespace salebra::twin_detail
