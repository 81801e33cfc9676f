// SPDX-License-Identifier: GPL-3.0-or-later
// Conjugate gradients on the contact set: the iteration, its restarts and the exact residual.
#include "active_set_cg.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <type_traits>

#include "gradient_projection.hpp"
#include "tile_sums.hpp"

namespace salebra::detail {
namespace {

// CG works on the tiles with cells under pressure or closer to the contact plane than this fraction
// of h_rms: the wide margin at first, the narrow one later, when few cells still change.
constexpr double widest_margin = 0.1, narrowest_margin = 0.03;
// The gap is stored up to this distance from the expected contact plane, in h_rms, unless a result
// needs all gaps: the widest margin, and as much again for the change of the plane.
constexpr double kept_reach = 0.2;
// The set of free cells changes when its violations (pressures outside the bounds, gaps of wrong
// sign) exceed this fraction of the last step.
constexpr double usual_threshold = 0.5;
// If CG stalls, it tries these values in place of usual_threshold, one after the other.
constexpr std::array<double, 2> other_thresholds = {1.0, 0.1};
// In float, the residual is computed anew when the estimate of the complementarity error e_c has
// fallen by this factor.
constexpr double refresh_after = 1e-4;
// On the multilevel kernel, whose own error is a few per cent, the residual is computed anew when
// the estimate of e_c has fallen by this factor.
constexpr double multilevel_refresh_after = 0.03;
// While the multilevel kernel is in use, fresh residuals are computed in double once the
// complementarity error e_c is below this value.
constexpr double exact_below = 2e-6;
// CG goes from the multilevel kernel to exact transforms when this many fresh residuals in a row
// did not halve the complementarity error e_c.
constexpr int max_misses = 2;
// A solve whose result only starts a finer grid computes the residual anew at most this many times.
constexpr int max_inexact_refreshes = 3;

}  // namespace

template <class Real>
ActiveSetCg<Real>::ActiveSetCg(const Grid2D& grid, const RowPartition& rows,
                               const NormalResponse& response, Boundary boundary,
                               const Heights& heights, double rms_height)
    : grid_(grid),
      rows_(rows),
      boundary_(boundary),
      halo_rows_(halo_rows(rows, boundary)),
      heights_(heights),
      rms_height_(rms_height),
      cell_compliance_(detail::cell_compliance(grid, response)),
      operators_(NormalOperators::of(grid, response, boundary, rows)),
      compliance_(operators_->compliance<Real>()),
      kernels_(tile_kernels<Real>()),
      tiles_per_row_(tiles_across(grid.ny)) {
  for (int i = -halo; i <= halo; ++i)
    for (int j = -halo; j <= halo; ++j)
      stencil_[static_cast<std::size_t>((i + halo) * (2 * halo + 1) + j + halo)] =
          static_cast<Real>(response.contact_modulus * operators_->inverse().weight(i, j));
  static_assert(halo == InverseStencil::radius);
}

// Corrects the pressures p to the requested mean, within 0 … bound.
template <class Real>
void ActiveSetCg<Real>::correct_load(const ScaledOperatingPoint& target, double* p) const {
  const double load = target.value * static_cast<double>(grid_.points()), bound = target.bound;
  const double carried = sum_rows([&](Index begin, Index end) {
    return kernels_.clip(p + begin * grid_.ny, (end - begin) * grid_.ny, bound);
  });
  if (!(carried > 0)) {
    std::fill(p, p + points(), target.value);
    return;
  }
  if (std::isinf(bound)) {
    const double scale = load / carried;
    for_rows([&](Index begin, Index end) {
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) p[k] *= scale;
    });
    return;
  }
  const auto correction = correction_for_load(load, bound, [&](const LoadCorrection& trial) {
    LoadSums total;
    for (const LoadSums& part : over_rows<LoadSums>([&](Index begin, Index end) {
           LoadSums sums;
           for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
             sums.add(trial(p[k], bound), bound);
           return sums;
         }))
      total += part;
    return total;
  });
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) p[k] = correction(p[k], bound);
  });
}

template <class Real>
Convolution2D<double>& ActiveSetCg<Real>::exact_compliance() {
  if constexpr (std::is_same_v<Real, double>) {
    return compliance_;
  } else {
    if (!exact_compliance_) exact_compliance_ = operators_->compliance<double>();
    // The spectrum overwrites the tiles' arrays in the pool; the tiles are listed anew afterwards.
    exact_compliance_->keep_spectrum_in(pool(exact_compliance_->spectrum_bytes()));
    return *exact_compliance_;
  }
}

// Returns the convolution for whole fields. Its spectrum shares memory with the tiles' arrays while
// the iterations do not need a spectrum; otherwise it has its own memory.
template <class Real>
Convolution2D<Real>& ActiveSetCg<Real>::dense_compliance() {
  if (on_multilevel_ || tiles_.empty()) {
    // Reserve space for the spectrum of the exact residual in double, which is twice as large and
    // comes later: memory that is not touched does not count.
    compliance_.keep_spectrum_in(pool(2 * compliance_.spectrum_bytes()));
    spectrum_in_pool_ = true;
  }
  return compliance_;
}

template <class Real>
CurvatureSums ActiveSetCg<Real>::take_direction(double z_mean, double beta, double t_mean) {
  const auto a = arrays(std::numeric_limits<double>::infinity());
  return total_of(by_blocks(rows_, displace<CurvatureSums>(
                                       [&](Index begin, Index end, Real* row) {
                                         kernels_.direct(a, begin, end, {z_mean, beta, t_mean},
                                                         row);
                                       },
                                       [&](Index begin, Index end, const Real* row) {
                                         return kernels_.take_image(a, begin, end, row);
                                       })));
}

// Returns a row of the pressure for a Fourier transform. Only tiles in use carry load, so other
// tiles are not read; before the first tiles are chosen, the whole row is read.
template <class Real>
template <class Number>
const Number* ActiveSetCg<Real>::pressure_of(const Run& run, Index row, Number* buffer) const {
  const double* p = run.p + row * grid_.ny;
  const auto copy = [&](Index begin, Index end) {
    std::transform(p + begin, p + end, buffer + begin,
                   [](double value) { return static_cast<Number>(value); });
  };
  if (tiles_.empty()) {
    copy(0, grid_.ny);
    return buffer;
  }
  const Index begin = first_tile(row), end = first_tile(row + 1);
  if (begin == end) return nullptr;
  std::fill_n(buffer, grid_.ny, Number(0));
  for (Index k = begin; k < end; ++k) {
    const Index column = tiles_[static_cast<std::size_t>(k)].column;
    copy(column, std::min<Index>(column + tile_width, grid_.ny));
  }
  return buffer;
}

// Computes g = Gp − h (displacement by the pressures minus height), the complementarity error e_c
// and the plane height. Unless `whole`, g is stored only near the contact plane.
template <class Real>
ContactResidual ActiveSetCg<Real>::dense_gap(Run& run, bool exact, bool whole) {
  // To avoid cancellation, Σp(g − plane) is summed with an approximate plane height; the exact
  // plane height is known only after the pass.
  const double near = run.load_given() ? run.plane_height : run.target.value;
  const double kept_below = whole || std::isfinite(run.target.bound)
                                ? std::numeric_limits<double>::infinity()
                                : near + kept_reach * rms_height_;
  std::vector<GapSums> sums(static_cast<std::size_t>(rows_.count()));
  const auto take = [&](auto kernel, Index row, const auto* displacement) {
    const Index first = row * grid_.ny, tile = row * tiles_per_row_;
    sums[static_cast<std::size_t>(row)] =
        kernel(displacement, {.heights = heights_.values + first,
                              .zero = heights_.zero,
                              .p = run.p + first,
                              .in_use = tiles_.empty() ? nullptr : in_use_.data() + tile,
                              .count = grid_.ny,
                              .bound = run.target.bound,
                              .plane = near,
                              .kept_below = kept_below,
                              .g = run.g + first,
                              .nearest = nearest_.data() + tile});
  };
  ++run.outcome.fft_count;
  double seconds = 0;
  {
    const Stopwatch stopwatch(seconds);
    if (exact || std::is_same_v<Real, double>) {
      exact_compliance().apply(
          [&](int, Index row, double* buffer) { return pressure_of(run, row, buffer); },
          [&](int, Index row, const double* values) { take(kernels_.exact_gap, row, values); });
    } else {
      dense_compliance().apply(
          [&](int, Index row, Real* buffer) { return pressure_of(run, row, buffer); },
          [&](int, Index row, const Real* values) { take(kernels_.gap, row, values); });
    }
  }
  run.outcome.fft_seconds += seconds;
  if (exact && std::is_same_v<Real, float>) {
    ++run.outcome.exact_fft_count;
    run.outcome.exact_fft_seconds += seconds;
  }
  const GapSums total = total_of(by_blocks(rows_, sums));
  if (total.saturated > 0)
    return contact_residual(grid_, rows_, run.target, rms_height_, run.p, run.g);
  ContactResidual result;
  const double misfit =
      run.load_given() ? total.misfit + (near - total.least) * total.pressure : total.distance;
  result.residual = total.pressure > 0 ? misfit / (total.pressure * rms_height_) : 0;
  if (run.load_given()) {
    result.plane_height = total.count > 0 ? total.g / total.count : total.least;
  } else {
    result.residual += std::max(0.0, near - total.least) / rms_height_;
    result.plane_height = near;
  }
  // The choice of the next tiles needs values of g that were not stored.
  if (result.plane_height + widest_margin * rms_height_ > kept_below)
    return dense_gap(run, exact, true);
  return result;
}

// Estimates the complementarity error e_c from the sums of a step of CG. with_clipped: also count
// the pressure that the bounds cut off, if the set of free cells stays unchanged.
template <class Real>
double ActiveSetCg<Real>::estimate_of(const StepSums& step, const Run& run,
                                      bool with_clipped) const {
  const double carried =
      step.pressure + (step.saturated > 0 ? step.saturated * run.target.bound : 0);
  const double scale_of_misfit = carried * rms_height_;
  if (!(scale_of_misfit > 0)) return std::numeric_limits<double>::infinity();
  double estimate =
      run.load_given()
          ? (step.signed_misfit - (step.least - run.plane_height) * step.pressure) / scale_of_misfit
          : step.misfit / scale_of_misfit +
                std::max(0.0, run.plane_height - step.least) / rms_height_;
  if (with_clipped) estimate += step.clipped / carried;
  return estimate;
}
// Takes one step of CG, and changes the set of free cells if needed. Returns false if no cell is
// free.
template <class Real>
bool ActiveSetCg<Real>::iterate(Run& run) {
  if (!(run.count > 0)) return false;
  const bool load_given = run.load_given();
  const auto a = arrays(run.target.bound);

  fill_halo_of_residual();
  const auto now = total_of(over_tiles<PreconditionSums>(
      [&](Index begin, Index end) { return kernels_.precondition(a, begin, end); }));
  // If the load is given, a step must not change it: directions have zero mean over the free cells.
  const double z_mean = load_given ? now.z / run.count : 0;
  const double t_mean = load_given ? now.t / run.count : 0;
  const double zw = now.zw - z_mean * now.w;
  const double zz = std::max(0.0, now.zz - now.z * z_mean);
  // Scalar product <t, r> of the residual r with the direction t = z − z_mean + β(t − t_mean),
  // where z is the preconditioned residual.
  const auto descent_along = [&](double beta) {
    return now.zr - z_mean * now.r + beta * (now.tr - t_mean * now.r);
  };
  double beta = run.has_direction ? std::max(0.0, -zw / run.curvature) : 0;
  if (descent_along(beta) <= 0) beta = 0;
  const double descent = descent_along(beta);

  CurvatureSums curvature;
  {
    const Applying applying(*this, run.outcome);
    curvature = take_direction(z_mean, beta, t_mean);
  }
  run.has_direction = true;
  run.curvature = curvature.tw;
  const double alpha =
      curvature.tw > 0 && std::isfinite(descent / curvature.tw) ? descent / curvature.tw : 0;
  if (load_given) run.plane_height -= alpha * curvature.w / run.count;

  const auto step = total_of(over_tiles<StepSums>([&](Index begin, Index end) {
    return kernels_.step(a, begin, end, alpha, run.plane_height);
  }));
  ++run.outcome.iterations;
  const auto resting =
      static_cast<double>(std::count(quiet_.begin(), quiet_.end(), 1)) * tile_width;
  run.outcome.resting_cells += resting;
  run.outcome.active_cells += static_cast<double>(tile_points()) - resting;
  const bool worth_a_change =
      std::sqrt(std::max(step.outside, step.wrong / (cell_compliance_ * cell_compliance_))) >
      run.threshold * std::abs(alpha) * std::sqrt(zz);
  run.estimate = estimate_of(step, run, !worth_a_change);
  const bool done = run.estimate < 0.7 * run.limits.tolerance;
  if (run.estimate < 0.5 * run.best) {
    run.best = run.estimate;
    run.since_best = 0;
  } else if (++run.since_best >= run.limits.patience) {
    run.has_direction = false;
    run.since_best = 0;
    if (run.stalls < other_thresholds.size()) run.threshold = other_thresholds[run.stalls];
    ++run.stalls;
  }
  if (worth_a_change || (done && (step.outside > 0 || step.wrong > 0))) {
    change_set(run, step.outside > 0, step.pressure);
  }
  return true;
}

// Puts the pressures p within their bounds and corrects their load, computes g = Gp − h and the
// complementarity error e_c over all cells, and chooses the tiles anew.
template <class Real>
void ActiveSetCg<Real>::refresh(Run& run, bool last) {
  collect_pressure(run);
  const bool exact =
      run.limits.exact &&
      !(on_multilevel_ && run.estimate > std::max(exact_below, 0.7 * run.limits.tolerance));
  const bool whole = last || run.estimate < 2 * run.limits.tolerance || run.interrupted() ||
                     run.outcome.iterations >= run.limits.max_iterations ||
                     (!run.limits.exact && run.refreshes + 1 >= max_inexact_refreshes);
  const auto [plane_height, residual] = dense_gap(run, exact, whole);
  run.plane_height = plane_height;
  run.outcome.residual = residual;
  if (on_multilevel_) {
    run.misses = residual > 0.5 * run.at_refresh ? run.misses + 1 : 0;
    if (run.misses >= max_misses) on_multilevel_ = false;
    run.best = std::max(run.best, residual);
  }
  run.at_refresh = std::max(residual, std::numeric_limits<double>::min());
  ++run.refreshes;
  if (!run.interrupted() && residual < run.limits.tolerance && exact == run.limits.exact)
    run.outcome.termination = Termination::converged;
  run.finished = run.outcome.converged() || run.interrupted() ||
                 run.outcome.iterations >= run.limits.max_iterations ||
                 (!run.limits.exact && run.refreshes >= max_inexact_refreshes);
  if (run.finished && !whole) dense_gap(run, exact, true);
  if (!run.finished)
    choose_tiles(run, std::min(widest_margin, std::max(narrowest_margin, 20 * residual)));
}

template <class Real>
ActiveSetOutcome ActiveSetCg<Real>::solve(const ScaledOperatingPoint& target,
                                          const ActiveSetLimits& limits, double* p, double* g) {
  reset();
  Run run{target, limits, p, g};
  run.threshold = usual_threshold;
  if (run.load_given()) {
    correct_load(target, p);
    run.plane_height = limits.expected_plane_height.value_or(0);
  } else {
    run.plane_height = target.value;
  }
  multilevel_share_ = limits.multilevel_share.value_or(worthwhile_share(false));
  auto [plane_height, residual] =
      dense_gap(run, false, run.load_given() && !limits.expected_plane_height.has_value());
  // Even a start that meets the tolerance is iterated once. Otherwise, if each of several contacts
  // starts from the one before, the differences between their results would show how good the
  // starts were. Single precision cannot show how far a start is from the solution.
  if (limits.exact && residual < std::max(exact_below, limits.tolerance)) {
    const ContactResidual exact = dense_gap(run, true, true);
    plane_height = exact.plane_height;
    residual = exact.residual;
  }
  run.plane_height = plane_height;
  choose_tiles(run, widest_margin);
  if (on_multilevel_) run.at_refresh = residual;
  go_on(run);
  if (run.finished || !limits.exact) run.outcome.plane_height = run.plane_height;
  return run.outcome;
}

template <class Real>
void ActiveSetCg<Real>::go_on(Run& run) {
  const ActiveSetLimits& limits = run.limits;
  for (;;) {
    const bool progressed = iterate(run);
    if (limits.keep_going &&
        !rows_.communicator().all_agree(limits.keep_going(run.outcome.iterations, run.estimate)))
      run.outcome.termination = Termination::interrupted;
    if (limits.take_checkpoint && rows_.communicator().all_agree(limits.checkpoint_due())) {
      unpack_pressure(run, 1);
      limits.take_checkpoint();
    }
    const bool stalled = run.stalls > other_thresholds.size();
    const double factor = on_multilevel_ && limits.exact ? multilevel_refresh_after : refresh_after;
    const bool fresh_needed =
        run.estimate < 0.7 * limits.tolerance || run.interrupted() ||
        run.outcome.iterations >= limits.max_iterations ||
        (std::is_same_v<Real, float> && run.estimate < factor * run.at_refresh);
    const bool falls_back = stalled || !progressed;
    if (fresh_needed || falls_back) refresh(run, falls_back);
    if (run.finished) break;
    if (falls_back) {
      // If no cell is free, or the set of free cells keeps changing, a slower method, gradient
      // projection, finishes the solve; on a coarse grid the result is accepted as it is.
      if (limits.exact)
        gradient_projection(
            {exact_compliance(), grid_, rows_, boundary_, heights_, rms_height_, run.target},
            limits, run.p, run.g, run.outcome);
      break;
    }
  }
}

template class ActiveSetCg<float>;
template class ActiveSetCg<double>;

}  // namespace salebra::detail
