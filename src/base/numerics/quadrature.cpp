// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive quadrature with break points, and root search, by GSL.
#include "quadrature.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <salebra/base/error.hpp>
#include <vector>

#include "base/quiet_gsl.hpp"
#include "base/stop_check.hpp"

namespace salebra::detail {
namespace {

using Workspace =
    std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>;

// GSL is written in C: an exception of the integrand must not unwind through GSL's functions, so it
// is kept and thrown again after GSL has returned.
struct Guarded {
  const std::function<double(double)>& f;
  std::exception_ptr failure;

  static double call(double x, void* self) {
    auto& guarded = *static_cast<Guarded*>(self);
    if (guarded.failure) return 0;
    try {
      stop_if_asked();
      return guarded.f(x);
    } catch (...) {
      guarded.failure = std::current_exception();
      return 0;
    }
  }
};

}  // namespace

Integral integrate(const std::function<double(double)>& f, std::span<const double> points,
                   double relative_tolerance, double absolute_tolerance) {
  quiet_gsl();
  std::vector<double> distinct;
  for (const double point : points)
    if (distinct.empty() || point > distinct.back()) distinct.push_back(point);
  if (distinct.size() < 2) return {.converged = true};
  // GSL takes no more points than its workspace has intervals. A measured curve may have thousands
  // of loads, at each of which K_t has a kink.
  constexpr std::size_t most_points = 403, part = 400;
  if (distinct.size() > most_points) {
    Integral sum;
    for (std::size_t first = 0; first + 1 < distinct.size(); first += part) {
      const std::size_t count = std::min(part + 1, distinct.size() - first);
      const Integral one = integrate(f, std::span(distinct).subspan(first, count),
                                     relative_tolerance, absolute_tolerance);
      sum.value += one.value, sum.error += one.error;
    }
    sum.converged =
        sum.error <= std::max(absolute_tolerance, relative_tolerance * std::abs(sum.value));
    return sum;
  }

  constexpr std::size_t max_intervals = 2000;
  const Workspace workspace(gsl_integration_workspace_alloc(max_intervals),
                            &gsl_integration_workspace_free);
  if (!workspace) throw std::bad_alloc();
  Guarded guarded{f, nullptr};
  const gsl_function function{&Guarded::call, &guarded};
  Integral result;
  const int status = gsl_integration_qagp(&function, distinct.data(), distinct.size(),
                                          absolute_tolerance, relative_tolerance, max_intervals,
                                          workspace.get(), &result.value, &result.error);
  if (guarded.failure) std::rethrow_exception(guarded.failure);
  // If the tolerance is near round-off, GSL ends the refinement with a status for round-off; then
  // the error estimate decides whether the integral has converged.
  const auto goal = [&] {
    return std::max(absolute_tolerance, relative_tolerance * std::abs(result.value));
  };
  const auto converged = [&] { return std::isfinite(result.value) && result.error <= 10 * goal(); };
  result.converged = std::isfinite(result.value) && (status == GSL_SUCCESS || converged());
  if (result.converged || distinct.size() == 2 || !std::isfinite(result.value)) return result;
  // Among many pieces the extrapolation towards a singularity at an end of one of them may fail.
  // Each piece for itself then needs fewer intervals.
  const double share = goal() / double(distinct.size());
  result = {};
  for (std::size_t i = 0; i + 1 < distinct.size(); ++i) {
    Integral piece;
    gsl_integration_qags(&function, distinct[i], distinct[i + 1], share, relative_tolerance,
                         max_intervals, workspace.get(), &piece.value, &piece.error);
    if (guarded.failure) std::rethrow_exception(guarded.failure);
    result.value += piece.value;
    result.error += piece.error;
  }
  result.converged = converged();
  return result;
}

double find_root(const std::function<double(double)>& f, double low, double high) {
  // The zero lies between `best` and `bound`. `last` is the argument that was `best` or `bound`
  // before; the interpolation needs it as a third point.
  double best = high, bound = low, last = low;
  double f_best = f(best), f_bound = f(bound), f_last = f_bound;
  if (f_bound == 0) return bound;
  if (f_best == 0) return best;
  if (std::signbit(f_best) == std::signbit(f_bound) || std::isnan(f_best) || std::isnan(f_bound))
    throw NotConverged("find_root: the function does not change sign over the interval");
  double fraction = 0.5;
  for (int step = 0; step < 400; ++step) {
    stop_if_asked();
    const double trial = best + fraction * (bound - best);
    const double f_trial = f(trial);
    if (std::signbit(f_trial) == std::signbit(f_best)) {
      last = best, f_last = f_best;
    } else {
      last = bound, f_last = f_bound;
      bound = best, f_bound = f_best;
    }
    best = trial, f_best = f_trial;
    const double width = std::abs(bound - best);
    const double resolution =
        2 * std::numeric_limits<double>::epsilon() * std::max(std::abs(best), std::abs(bound));
    if (f_best == 0 || width <= resolution) break;
    // Chandrupatla's criterion: interpolate only where the three points lie on a monotone parabola.
    const double position = (best - bound) / (last - bound);
    const double value = (f_best - f_bound) / (f_last - f_bound);
    fraction = 0.5;
    if (value * value < position && (1 - value) * (1 - value) < 1 - position)
      fraction = f_best / (f_bound - f_best) * f_last / (f_bound - f_last) +
                 (last - best) / (bound - best) * f_best / (f_last - f_best) * f_bound /
                     (f_last - f_bound);
    const double least = resolution / width;
    fraction = std::clamp(fraction, std::min(least, 0.5), std::max(1 - least, 0.5));
  }
  return std::abs(f_best) < std::abs(f_bound) ? best : bound;
}

}  // namespace salebra::detail
