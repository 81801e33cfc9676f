// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic programme of partial slip: tractions within |τ| <= μp, by Newton steps on faces.
#include "disc_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "conjugate_gradients.hpp"

namespace salebra::detail {
namespace {

// The part of what is left of a misfit that the error of single precision may be.
constexpr double allowed_doubt = 0.01;

double largest(const std::vector<double>& vector) {
  return largest_of(vector.data(), static_cast<Index>(vector.size()));
}

}  // namespace

DiscProblem::DiscProblem(ContactSystem& system, const PointList& points, std::vector<double> limits,
                         std::vector<double> targets, double stiffness_scale)
    : system_(system),
      points_(points),
      limits_(std::move(limits)),
      targets_(std::move(targets)),
      cell_stiffness_(stiffness_scale * system.preconditioner().diagonal()),
      gradient_length_(cell_stiffness_),
      open_(std::ranges::count_if(limits_, [](double limit) { return limit > 0; })) {}

double DiscProblem::length(const std::vector<double>& vector, std::size_t point) const {
  if (components() == 1) return std::abs(vector[point]);
  const double x = vector[point], y = vector[count() + point];
  return std::sqrt(x * x + y * y);
}

bool DiscProblem::at_limit(const std::vector<double>& tractions, std::size_t point) const {
  return length(tractions, point) >= (1 - limit_round_off) * limits_[point];
}

bool DiscProblem::slips(const std::vector<double>& tractions, const std::vector<double>& gradient,
                        std::size_t point) const {
  double square = 0;
  for (std::size_t i = point; i < tractions.size(); i += count())
    square += std::pow(tractions[i] - cell_stiffness_ * gradient[i], 2);
  return std::sqrt(square) > limits_[point];
}

void DiscProblem::project(std::vector<double>& tractions) const {
  for (std::size_t k = 0; k < count(); ++k) {
    const double size = length(tractions, k);
    if (size <= limits_[k]) continue;
    for (std::size_t i = k; i < tractions.size(); i += count()) tractions[i] *= limits_[k] / size;
  }
}

DiscProblem::Iterate DiscProblem::evaluated(std::vector<double> tractions) {
  Iterate iterate{std::move(tractions), std::vector<double>(targets_.size(), 0.0), 0};
  if (largest(iterate.tractions) > 0)
    system_.response().apply(points_, iterate.tractions.data(), points_, iterate.gradient.data());
  for (std::size_t i = 0; i < targets_.size(); ++i) iterate.gradient[i] -= targets_[i];
  return iterate;
}

// The response to what has changed, in single precision, is added to what is known.
DiscProblem::Iterate DiscProblem::moved(const Iterate& from, std::vector<double> tractions) {
  std::vector<double> change(tractions.size());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = tractions[i] - from.tractions[i];
  Iterate iterate{std::move(tractions), std::vector<double>(targets_.size()), 0};
  system_.response().apply_loosely(points_, change.data(), iterate.gradient.data());
  iterate.doubt = from.doubt + SurfaceResponse::loose_error * largest(iterate.gradient);
  for (std::size_t i = 0; i < targets_.size(); ++i) iterate.gradient[i] += from.gradient[i];
  return iterate;
}

DiscProblem::Iterate DiscProblem::start(std::vector<double> tractions, const KnownResponse* known) {
  project(tractions);
  if (known == nullptr) return evaluated(std::move(tractions));
  Iterate begin{known->tractions, known->displacements, known->error};
  for (std::size_t i = 0; i < targets_.size(); ++i) begin.gradient[i] -= targets_[i];
  Iterate iterate = moved(begin, std::move(tractions));
  if (iterate.doubt < allowed_doubt * residual(iterate)) return iterate;
  return evaluated(std::move(iterate.tractions));
}

double DiscProblem::residual(const Iterate& iterate) const {
  std::vector<double> moved = iterate.tractions;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= cell_stiffness_ * iterate.gradient[i];
  project(moved);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= iterate.tractions[i];
  return open_ > 0 ? std::sqrt(dot(moved, moved)) / root_of_count() / cell_stiffness_ : 0;
}

DiscProblem::Face DiscProblem::face_of(const Iterate& iterate) const {
  Face face;
  for (std::size_t k = 0; k < count(); ++k) {
    if (!at_limit(iterate.tractions, k)) continue;
    double outward = 0;
    for (std::size_t i = k; limits_[k] > 0 && i < targets_.size(); i += count())
      outward -= iterate.tractions[i] / limits_[k] * iterate.gradient[i];
    // Pulled inwards, the point sticks again.
    if (outward < 0) continue;
    face.bound.push_back(k);
    face.curvature.push_back(limits_[k] > 0 ? outward / limits_[k] : 0);
    for (std::size_t i = k; i < targets_.size(); i += count())
      face.normal.push_back(limits_[k] > 0 ? iterate.tractions[i] / limits_[k] : 0);
  }
  return face;
}

void DiscProblem::project_on(const Face& face, std::vector<double>& vector) const {
  const double* normal = face.normal.data();
  for (const std::size_t k : face.bound) {
    const double share = limits_[k] > 0 ? 1 : 0;
    double outward = 0;
    for (std::size_t i = k, c = 0; i < vector.size(); i += count(), ++c)
      outward += normal[c] * vector[i];
    for (std::size_t i = k; i < vector.size(); i += count())
      vector[i] = share * (vector[i] - *normal++ * outward);
  }
}

DiscProblem::Direction DiscProblem::newton_direction(const Iterate& iterate, const Face& face,
                                                     double reduction, int max_iterations,
                                                     PartialSlipReport& report) {
  const std::size_t unknowns = targets_.size();
  std::vector<double> solution(unknowns, 0.0), misfit(unknowns), scaled;
  for (std::size_t i = 0; i < unknowns; ++i) misfit[i] = -iterate.gradient[i];
  project_on(face, misfit);
  const auto for_bound = [&](const std::vector<double>& values, const auto& body) {
    for (std::size_t bound = 0; bound < face.bound.size(); ++bound)
      for (std::size_t i = face.bound[bound]; i < unknowns; i += count()) body(i, values[bound]);
  };
  // The stencil is the inverse of K, but for a factor, not of K + Λ: where the curvature Λ prevails,
  // the inverse is 1/Λ.
  std::vector<double> scales;
  for (const double curvature : face.curvature)
    scales.push_back(1 / std::sqrt(1 + cell_stiffness_ * curvature));
  const auto scale = [&](std::vector<double>& vector) {
    for_bound(scales, [&](std::size_t i, double factor) { vector[i] *= factor; });
  };
  const double goal =
      std::max(reduction * std::sqrt(dot(misfit, misfit)), 0.3 * tolerance_ * root_of_count());
  // What the response to the step in single precision would leave in doubt, beside what is to be
  // left of the misfit.
  const double doubt = iterate.doubt + SurfaceResponse::loose_error * largest(misfit);
  const int before = report.iterations;
  const CgOutcome outcome = conjugate_gradients(
      [&](const std::vector<double>& in, std::vector<double>& out) {
        system_.response().apply_loosely(points_, in.data(), out.data());
        for_bound(face.curvature,
                  [&](std::size_t i, double curvature) { out[i] += curvature * in[i]; });
        project_on(face, out);
      },
      [&](const std::vector<double>& in, std::vector<double>& out) {
        scaled = in;
        scale(scaled);
        for (std::size_t c = 0; c < components(); ++c)
          system_.preconditioner().apply(points_, scaled.data() + c * count(),
                                         out.data() + c * count());
        scale(out);
        project_on(face, out);
      },
      [&](double square, int iterations) {
        return std::sqrt(square) <= goal || before + iterations >= max_iterations;
      },
      dot, solution, misfit);
  // A step that the system's accuracy did not allow has cost as much as one taken.
  report.iterations += outcome.iterations + (outcome.exhausted ? 1 : 0);
  return {std::move(solution), /*small=*/doubt < allowed_doubt * goal / root_of_count()};
}

// Armijo's rule for the energy, which a step d changes by d·(g + g')/2, with room for round-off.
bool DiscProblem::accept(Iterate&& trial, Iterate& iterate) const {
  double slope = 0, change = 0, noise = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const double step = trial.tractions[i] - iterate.tractions[i];
    slope += iterate.gradient[i] * step;
    change += (iterate.gradient[i] + trial.gradient[i]) / 2 * step;
    noise += std::abs(step * targets_[i]);
  }
  if (change > 1e-4 * std::min(slope, 0.0) + 1e-14 * noise) return false;
  iterate = std::move(trial);
  return true;
}

bool DiscProblem::newton_step(const Face& face, const Direction& direction, Iterate& iterate) {
  for (const double part : {1.0, 0.5, 0.1}) {
    std::vector<double> tractions = iterate.tractions;
    for (std::size_t i = 0; i < tractions.size(); ++i) tractions[i] += part * direction.step[i];
    for (const std::size_t k : face.bound) {
      if (limits_[k] == 0) continue;
      const double stretch = limits_[k] / length(tractions, k);
      for (std::size_t i = k; i < tractions.size(); i += count()) tractions[i] *= stretch;
    }
    project(tractions);
    if (accept(direction.small ? moved(iterate, std::move(tractions))
                               : evaluated(std::move(tractions)),
               iterate))
      return true;
  }
  return false;
}

bool DiscProblem::gradient_step(Iterate& iterate) {
  const Iterate before = iterate;
  for (int halving = 0; halving < 60; ++halving) {
    std::vector<double> tractions = before.tractions;
    for (std::size_t i = 0; i < targets_.size(); ++i)
      tractions[i] -= gradient_length_ * before.gradient[i];
    project(tractions);
    if (!accept(evaluated(std::move(tractions)), iterate)) {
      gradient_length_ /= 4;
      continue;
    }
    // Barzilai and Borwein's length for the next one.
    double path = 0, curvature = 0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const double moved = iterate.tractions[i] - before.tractions[i];
      path += moved * moved;
      curvature += moved * (iterate.gradient[i] - before.gradient[i]);
    }
    if (curvature > 0) gradient_length_ = path / curvature;
    return true;
  }
  return false;
}

PartialSlipReport DiscProblem::solve(double tolerance, int max_iterations, const Progress& progress,
                                     std::vector<double>& tractions, std::vector<double>& gradient,
                                     const KnownResponse* known) {
  PartialSlipReport report;
  const int first_fft = system_.response().fft_count();
  tolerance_ = tolerance;
  Iterate iterate = start(std::move(tractions), known);
  std::optional<std::vector<std::size_t>> last_bound;
  for (;;) {
    report.residual = residual(iterate);
    if (report.residual < tolerance && iterate.doubt > allowed_doubt * tolerance) {
      iterate = evaluated(std::move(iterate.tractions));
      report.residual = residual(iterate);
    }
    if (report.residual < tolerance) report.termination = Termination::converged;
    if (report.converged() || report.iterations >= max_iterations) break;
    if (progress &&
        !progress({"partial slip", report.iterations / static_cast<double>(max_iterations),
                   report.iterations, report.residual})) {
      report.termination = Termination::interrupted;
      break;
    }
    bool moved = false;
    if (newton_) {
      Face face = face_of(iterate);
      // While the slipping part still changes, an exact answer for it is of no use.
      const double reduction = face.bound == last_bound ? 1e-3 : 0.1;
      const Direction direction =
          newton_direction(iterate, face, reduction, max_iterations, report);
      moved = newton_step(face, direction, iterate);
      last_bound = std::move(face.bound);
    }
    if (!moved) {
      ++report.iterations;
      moved = gradient_step(iterate);
    }
    ++report.steps;
    if (!moved) {  // round-off has used up the energy's accuracy
      report.termination = Termination::stalled;
      break;
    }
  }
  for (std::size_t k = 0; k < count(); ++k)
    report.slipping += limits_[k] > 0 && slips(iterate.tractions, iterate.gradient, k);
  report.fft_count = system_.response().fft_count() - first_fft;
  tractions = std::move(iterate.tractions);
  gradient = std::move(iterate.gradient);
  return report;
}

PartialSlipReport solve_discs(TangentialWorkspace& workspace, ContactSystem& system,
                              const PointList& points, std::vector<double> limits,
                              std::vector<double> targets, double scale,
                              std::vector<double>& tractions, std::vector<double>& slip,
                              const KnownResponse* known) {
  const StickOptions& options = workspace.options();
  const Material& material = workspace.material();
  // K̂ = (2π/q)(c1 + c2 …) lies between the values along and across the wave; 2/(E q) with their
  // mean.
  const double stiffness_scale =
      1 / (std::numbers::pi * (material.cerruti_isotropic + material.cerruti_directed / 2));
  DiscProblem problem(system, points, std::move(limits), std::move(targets), stiffness_scale);
  PartialSlipReport report = problem.solve(options.tolerance * scale, options.max_iterations,
                                           options.on_progress, tractions, slip, known);
  report.residual /= scale;
  const std::size_t count = points.cell.size();
  for (std::size_t k = 0; k < count; ++k) {
    const double sign = problem.slips(tractions, slip, k) ? -1 : 0;
    for (std::size_t i = k; i < slip.size(); i += count) slip[i] *= sign;
  }
  return report;
}

}  // namespace salebra::detail
