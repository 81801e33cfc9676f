// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic programme of partial slip: tractions within |τ| <= μp, by Newton steps on faces.
#include "disc_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "conjugate_gradients.hpp"

namespace salebra::detail {

DiscProblem::DiscProblem(ContactSystem& system, const PointList& points, std::vector<double> limits,
                         std::vector<double> targets, double stiffness_scale)
    : system_(system),
      points_(points),
      limits_(std::move(limits)),
      targets_(std::move(targets)),
      cell_stiffness_(stiffness_scale * system.preconditioner().diagonal()),
      gradient_length_(cell_stiffness_) {}

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

void DiscProblem::evaluate(Iterate& iterate) {
  iterate.gradient.resize(targets_.size());
  system_.response().apply(points_, iterate.tractions.data(), points_, iterate.gradient.data());
  for (std::size_t i = 0; i < targets_.size(); ++i) iterate.gradient[i] -= targets_[i];
  iterate.energy =
      (dot(iterate.tractions, iterate.gradient) - dot(iterate.tractions, targets_)) / 2;
}

double DiscProblem::residual(const Iterate& iterate) const {
  std::vector<double> moved = iterate.tractions;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= cell_stiffness_ * iterate.gradient[i];
  project(moved);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= iterate.tractions[i];
  return std::sqrt(dot(moved, moved) / static_cast<double>(count())) / cell_stiffness_;
}

DiscProblem::Face DiscProblem::face_of(const Iterate& iterate) const {
  Face face{std::vector<char>(count(), 0), std::vector<double>(targets_.size(), 0.0),
            std::vector<double>(count(), 0.0)};
  for (std::size_t k = 0; k < count(); ++k) {
    if (!at_limit(iterate.tractions, k)) continue;
    double outward = 0;
    for (std::size_t i = k; i < targets_.size(); i += count()) {
      face.normal[i] = iterate.tractions[i] / limits_[k];
      outward -= face.normal[i] * iterate.gradient[i];
    }
    // Pulled inwards, the point sticks again.
    if (outward < 0) continue;
    face.bound[k] = 1;
    face.curvature[k] = outward / limits_[k];
  }
  return face;
}

void DiscProblem::project_on(const Face& face, std::vector<double>& vector) const {
  for (std::size_t k = 0; k < count(); ++k) {
    if (!face.bound[k]) continue;
    double outward = 0;
    for (std::size_t i = k; i < vector.size(); i += count()) outward += face.normal[i] * vector[i];
    for (std::size_t i = k; i < vector.size(); i += count()) vector[i] -= face.normal[i] * outward;
  }
}

std::vector<double> DiscProblem::newton_direction(const Iterate& iterate, const Face& face,
                                                  double reduction, double tolerance,
                                                  int max_iterations, PartialSlipReport& report) {
  const std::size_t unknowns = targets_.size();
  std::vector<double> solution(unknowns, 0.0), misfit(unknowns), scale(count());
  for (std::size_t i = 0; i < unknowns; ++i) misfit[i] = -iterate.gradient[i];
  project_on(face, misfit);
  // The stencil is the inverse of K, not of K + Λ: where the curvature Λ prevails, the inverse is
  // 1/Λ.
  for (std::size_t k = 0; k < count(); ++k)
    scale[k] = 1 / std::sqrt(1 + cell_stiffness_ * face.curvature[k]);
  const double stencil_scale = cell_stiffness_ / system_.preconditioner().diagonal();
  const auto apply_scale = [&](std::vector<double>& vector) {
    for (auto value = vector.begin(); value != vector.end();)
      for (const double factor : scale) *value++ *= factor;
  };
  const double goal = std::max(reduction * std::sqrt(dot(misfit, misfit)),
                               tolerance * std::sqrt(static_cast<double>(count())));
  const int before = report.iterations;
  const CgOutcome outcome = conjugate_gradients(
      [&](const std::vector<double>& in, std::vector<double>& out) {
        system_.response().apply_loosely(points_, in.data(), out.data());
        for (std::size_t i = 0; i < unknowns;)
          for (const double curvature : face.curvature) {
            out[i] += curvature * in[i];
            ++i;
          }
        project_on(face, out);
      },
      [&](const std::vector<double>& in, std::vector<double>& out) {
        std::vector<double> scaled = in;
        apply_scale(scaled);
        for (std::size_t c = 0; c < components(); ++c)
          system_.preconditioner().apply(points_, scaled.data() + c * count(),
                                         out.data() + c * count());
        for (double& value : out) value *= stencil_scale;
        apply_scale(out);
        project_on(face, out);
      },
      [&](double square, int iterations) {
        return std::sqrt(square) <= goal || before + iterations >= max_iterations;
      },
      dot, solution, misfit);
  // A step that the system's accuracy did not allow has cost as much as one taken.
  report.iterations += outcome.iterations + (outcome.exhausted ? 1 : 0);
  return solution;
}

// Armijo's rule, with room for round-off of the energy near the solution.
bool DiscProblem::accept(Iterate&& trial, Iterate& iterate) const {
  double slope = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i)
    slope += iterate.gradient[i] * (trial.tractions[i] - iterate.tractions[i]);
  const double noise =
      1e-14 * (std::abs(iterate.energy) + std::abs(dot(iterate.tractions, targets_)));
  if (trial.energy > iterate.energy + 1e-4 * std::min(slope, 0.0) + noise) return false;
  iterate = std::move(trial);
  return true;
}

bool DiscProblem::newton_step(const Face& face, const std::vector<double>& direction,
                              Iterate& iterate) {
  for (const double part : {1.0, 0.5, 0.1}) {
    Iterate trial{iterate.tractions, {}, 0};
    for (std::size_t i = 0; i < direction.size(); ++i) trial.tractions[i] += part * direction[i];
    for (std::size_t k = 0; k < count(); ++k) {
      if (!face.bound[k]) continue;
      const double stretch = limits_[k] / length(trial.tractions, k);
      for (std::size_t i = k; i < direction.size(); i += count()) trial.tractions[i] *= stretch;
    }
    project(trial.tractions);
    evaluate(trial);
    if (accept(std::move(trial), iterate)) return true;
  }
  return false;
}

bool DiscProblem::gradient_step(Iterate& iterate) {
  const Iterate before = iterate;
  for (int halving = 0; halving < 60; ++halving) {
    Iterate trial{before.tractions, {}, 0};
    for (std::size_t i = 0; i < targets_.size(); ++i)
      trial.tractions[i] -= gradient_length_ * before.gradient[i];
    project(trial.tractions);
    evaluate(trial);
    if (!accept(std::move(trial), iterate)) {
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
                                     std::vector<double>& tractions,
                                     std::vector<double>& gradient) {
  PartialSlipReport report;
  const int first_fft = system_.response().fft_count();
  Iterate iterate{std::move(tractions), {}, 0};
  project(iterate.tractions);
  evaluate(iterate);
  std::vector<char> last_bound;
  for (;;) {
    report.residual = residual(iterate);
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
      const std::vector<double> direction =
          newton_direction(iterate, face, reduction, 0.3 * tolerance, max_iterations, report);
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
    report.slipping += slips(iterate.tractions, iterate.gradient, k);
  report.fft_count = system_.response().fft_count() - first_fft;
  tractions = std::move(iterate.tractions);
  gradient = std::move(iterate.gradient);
  return report;
}

}  // namespace salebra::detail
