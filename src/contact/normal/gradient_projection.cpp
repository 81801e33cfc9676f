// SPDX-License-Identifier: GPL-3.0-or-later
// Fallback contact solver if the active set cycles: gradient projection, with conjugate gradients
// on the free cells while the set of free cells stays the same.
#include "gradient_projection.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "load_correction.hpp"

namespace salebra::detail {
namespace {

// A step is taken if the energy falls by at least this fraction of what the slope of the energy at
// the beginning of the step promises.
constexpr double sufficient_decrease = 0.1;
// CG on one set of free cells ends when a step gains less than this fraction of the best step on
// this set.
constexpr double worthwhile_gain = 0.02;
constexpr int max_steps_on_a_face = 60;
constexpr int max_backtracks = 30;
constexpr int max_fruitless_rounds = 3;
constexpr int refresh_every = 20;  // rounds, because round-off adds up in g

class Descent {
 public:
  Descent(const ProjectionProblem& problem, double* p, double* g, ActiveSetOutcome& outcome)
      : compliance_(problem.compliance),
        rows_(problem.rows),
        cells_(static_cast<double>(problem.grid.points())),
        boundary_(problem.boundary),
        target_(problem.target),
        heights_(problem.heights.values, rows_.count(), problem.grid.ny),
        zero_(problem.heights.zero),
        p_(p, rows_.count(), problem.grid.ny),
        g_(g, rows_.count(), problem.grid.ny),
        inverse_(problem.grid),
        outcome_(outcome) {
    image_.resize(rows_.count(), problem.grid.ny);
  }

  // Corrects the load and computes g = Gp − h anew from the pressures p: each step adds round-off
  // to the load and to g, the more the longer the cells are.
  void refresh() {
    if (target_.load_given()) correct_load();
    apply(p_);
    g_ = image_ - (heights_ - zero_);
  }

  // Changes the pressures p to the projection of p − step·gradient onto the bounds and the load.
  // Returns false if no such step lowers the energy: then p is the solution.
  bool project_gradient() {
    if (!(step_ > 0)) step_ = first_step();
    for (int trial = 0; trial < max_backtracks; ++trial) {
      const Field down = gradient();
      const Field change = projected(p_ - step_ * down) - p_;
      const double slope = sum(down * change);
      if (!(slope < 0)) return false;
      apply(change);
      const double curvature = sum(change * image_);
      const double best = -slope / curvature;  // factor of `change` with the least energy
      if (slope + 0.5 * curvature <= sufficient_decrease * slope) {
        take(change);
        step_ *= std::clamp(best, 0.5, 4.0);
        return true;
      }
      step_ *= std::clamp(best, 0.1, 0.5);
    }
    return false;
  }

  // Preconditioned CG on the cells strictly between their bounds, until the pressure p of a cell
  // meets a bound or steps gain little. It has its own loop because the last step ends at a bound,
  // and p and g = Gp − h stay those of pressures within the bounds at every step.
  void descend_on_face(int most) {
    const Field mask = (p_ > 0 && p_ < target_.bound).cast<double>();
    const double count = sum(mask);
    if (count < 2) return;
    Field direction = Field::Zero(p_.rows(), p_.cols()), z, old_image;
    double curvature = 0, best_gain = 0;
    for (int k = 0; k < most; ++k) {
      const double plane_height = target_.load_given() ? sum(mask * g_) / count : target_.value;
      const Field r = mask * (g_ - plane_height);
      inverse_.apply(rows_, mask, r, boundary_, z);
      if (target_.load_given()) z -= mask * (sum(z) / count);
      const double beta = k > 0 ? -sum(z * old_image) / curvature : 0;
      direction = z + beta * direction;
      const double descent = sum(r * direction);
      if (!(descent > 0)) return;
      apply(direction);
      old_image = image_;
      curvature = sum(direction * image_);
      if (!(curvature > 0)) return;
      const double step = descent / curvature;
      ++outcome_.iterations;
      const double max_step = max_step_along(direction);
      if (step <= max_step) {
        take_multiple(direction, -step);
      } else {
        // If the step goes beyond the first bound, project its end onto the bounds and take this
        // step if it lowers the energy, otherwise go only up to the bound.
        const Field change = projected(p_ - step * direction) - p_;
        const Field down = gradient();
        const double slope = sum(down * change);
        apply(change);
        if (slope < 0 && slope + 0.5 * sum(change * image_) <= sufficient_decrease * slope) {
          take(change);
        } else {
          image_ = old_image;
          take_multiple(direction, -max_step);
        }
        return;
      }
      const double gain = step * descent;
      best_gain = std::max(best_gain, gain);
      if (gain < worthwhile_gain * best_gain) return;
    }
  }

 private:
  template <class Change>
  void apply(const Change& change) {
    compliance_.apply(change.data(), image_.data());
    ++outcome_.fft_count;
  }
  void take(const Field& change) {
    p_ = (p_ + change).max(0.0).min(target_.bound);
    g_ += image_;
  }
  void take_multiple(const Field& direction, double multiple) {
    p_ = (p_ + multiple * direction).max(0.0).min(target_.bound);
    g_ += multiple * image_;
  }
  void correct_load() {
    const double bound = target_.bound;
    const auto correction =
        correction_for_load(target_.value * cells_, bound, [&](const LoadCorrection& trial) {
          LoadSums total;
          for (const LoadSums& part : parallel::map_blocks<LoadSums>(
                   rows_,
                   [&](Index begin, Index end) {
                     LoadSums sums;
                     for (Index i = begin; i < end; ++i)
                       for (Index j = 0; j < p_.cols(); ++j)
                         sums.add(trial(p_(i, j), bound), bound);
                     return sums;
                   },
                   p_.size()))
            total += part;
          return total;
        });
    p_ = p_.unaryExpr([&](double p) { return correction(p, bound); });
  }
  // Gradient of the energy. If the load is given, a constant may be subtracted from g; with the
  // mean of g over the free cells, sums over the gradient cancel least.
  Field gradient() const {
    if (!target_.load_given()) return g_ - target_.value;
    const Field free = (p_ > 0 && p_ < target_.bound).cast<double>();
    const double count = sum(free);
    return g_ - (count > 0 ? sum(free * g_) / count : least(g_));
  }

  // Initial step: the central weight of the approximate inverse, which would remove the gradient of
  // a single cell; the first trials correct it.
  double first_step() const { return inverse_.weight(0, 0); }

  double max_step_along(const Field& direction) const {
    double max_step = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < p_.size(); ++k) {
      const double t = direction.data()[k], p = p_.data()[k];
      if (t > 0) max_step = std::min(max_step, p / t);
      if (t < 0) max_step = std::min(max_step, (p - target_.bound) / t);
    }
    return rows_.communicator().min_of(max_step);
  }

  // The point nearest to x within the bounds and, if the load is given, with this load: clamp(x +
  // shift) with a suitable shift.
  Field projected(const Field& x) const {
    if (!target_.load_given()) return x.max(0.0).min(target_.bound);
    const double load = target_.value * cells_, lowest = least(x);
    double low = least(-x),
           high = std::isfinite(target_.bound) ? target_.bound - lowest : target_.value - lowest;
    double shift = 0;
    for (int round = 0; round < 100 && low < high; ++round) {
      if (!(shift > low && shift < high)) shift = 0.5 * (low + high);
      const Field y = x + shift;
      const double missing = load - sum(y.max(0.0).min(target_.bound));
      if (std::abs(missing) < 1e-15 * load) break;
      (missing > 0 ? low : high) = shift;
      const double moving = sum((y > 0 && y < target_.bound).template cast<double>());
      shift = moving > 0 ? shift + missing / moving : 0.5 * (low + high);
    }
    return (x + shift).max(0.0).min(target_.bound);
  }

  // Sum over the cells of all processes, added within blocks of rows.
  template <class Values>
  double sum(const Values& values) const {
    return parallel::sum_blocks(rows_, [&](Index begin, Index end) {
      double part = 0;
      for (Index i = begin; i < end; ++i)
        for (Index j = 0; j < values.cols(); ++j) part += values(i, j);
      return part;
    });
  }
  template <class Values>
  double least(const Values& values) const {
    return rows_.communicator().min_of(values.size() > 0 ? values.minCoeff()
                                                         : std::numeric_limits<double>::infinity());
  }

  using Dense = Eigen::Map<Field>;
  Convolution2D<double>& compliance_;
  RowPartition rows_;
  double cells_;  // number of cells of all processes
  Boundary boundary_;
  ScaledOperatingPoint target_;
  Eigen::Map<const Field> heights_;
  double zero_;
  Dense p_, g_;
  InverseStencil inverse_;
  ActiveSetOutcome& outcome_;
  Field image_;
  double step_ = 0;
};

}  // namespace

void gradient_projection(const ProjectionProblem& problem, const ActiveSetLimits& limits, double* p,
                         double* g, ActiveSetOutcome& outcome) {
  const Grid2D& grid = problem.grid;
  const RowPartition& rows = problem.rows;
  Descent descent(problem, p, g, outcome);
  descent.refresh();
  int fruitless = 0;  // rounds in which gradient projection found no descent: by rounding, or at
                      // the solution
  for (int round = 1;; ++round) {
    fruitless = descent.project_gradient() ? 0 : fruitless + 1;
    ++outcome.iterations;
    descent.descend_on_face(
        std::min(max_steps_on_a_face, limits.max_iterations - outcome.iterations));
    auto now = contact_residual(grid, rows, problem.target, problem.rms_height, p, g);
    const bool stalled = fruitless >= max_fruitless_rounds;
    const bool ends = stalled || outcome.iterations >= limits.max_iterations;
    bool interrupted = false;
    if (limits.keep_going &&
        !rows.communicator().all_agree(limits.keep_going(outcome.iterations, now.residual)))
      interrupted = true;
    if (limits.take_checkpoint && rows.communicator().all_agree(limits.checkpoint_due())) {
      const std::vector<double> kept(p, p + rows.count() * grid.ny);
      limits.take_checkpoint();
      std::ranges::copy(kept, p);
    }
    if (now.residual < limits.tolerance || ends || interrupted || round % refresh_every == 0) {
      descent.refresh();
      now = contact_residual(grid, rows, problem.target, problem.rms_height, p, g);
    }
    outcome.residual = now.residual;
    outcome.plane_height = now.plane_height;
    outcome.termination = interrupted                       ? Termination::interrupted
                          : now.residual < limits.tolerance ? Termination::converged
                          : stalled                         ? Termination::stalled
                                                            : Termination::iteration_limit;
    if (outcome.converged() || ends || interrupted) return;
  }
}

}  // namespace salebra::detail
