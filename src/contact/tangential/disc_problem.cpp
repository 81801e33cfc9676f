// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic programme of partial slip: tractions τ with |τ| <= μp, found by Newton steps. A face is
// the set of tractions at which given points are at their limit and all other points below it.
#include "disc_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "conjugate_gradients.hpp"

namespace salebra::detail {
namespace {

// Allowed error by single precision, as a fraction of the remaining misfit of the displacements.
constexpr double allowed_error = 0.01;

double largest(const std::vector<double>& vector) {
  return max_of(vector.data(), static_cast<Index>(vector.size()));
}

template <class Each, class Value>
double length(const Each& each, const Value& value) {
  double square = 0;
  each([&](std::size_t i) { square += value(i) * value(i); });
  return std::sqrt(square);
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

template <class Body>
void DiscProblem::for_values(const Body& body) const {
  for_each(targets_.size(), 2 * targets_.size(), body);
}

// Calls body(point, each) for all points; each(visit) calls visit(i) for the indices i of the
// point's components.
template <class Body>
void DiscProblem::for_points(const Body& body) const {
  const std::size_t points = count(), work = 4 * targets_.size();
  if (targets_.size() == points) {
    for_each(points, work, [&](std::size_t k) { body(k, [k](const auto& visit) { visit(k); }); });
  } else {
    for_each(points, work, [&, points](std::size_t k) {
      body(k, [k, points](const auto& visit) {
        visit(k);
        visit(points + k);
      });
    });
  }
}

template <class Each>
void DiscProblem::project(std::vector<double>& tractions, std::size_t point,
                          const Each& each) const {
  const double size = length(each, [&](std::size_t i) { return tractions[i]; });
  if (size <= limits_[point]) return;
  each([&, stretch = limits_[point] / size](std::size_t i) { tractions[i] *= stretch; });
}

DiscProblem::Iterate DiscProblem::evaluated(std::vector<double> tractions) {
  Iterate iterate{std::move(tractions), std::vector<double>(targets_.size(), 0.0), 0};
  if (largest(iterate.tractions) > 0)
    system_.response().apply(points_, iterate.tractions.data(), points_, iterate.gradient.data());
  for_values([&](std::size_t i) { iterate.gradient[i] -= targets_[i]; });
  return iterate;
}

// Evaluates new tractions: adds the response to the change of the tractions, in single precision,
// to the known response of `from`.
DiscProblem::Iterate DiscProblem::moved(const Iterate& from, std::vector<double> tractions) {
  std::vector<double> change(tractions.size());
  for_values([&](std::size_t i) { change[i] = tractions[i] - from.tractions[i]; });
  Iterate iterate{std::move(tractions), std::vector<double>(targets_.size()), 0};
  system_.response().apply_loosely(points_, change.data(), iterate.gradient.data());
  iterate.error_bound = from.error_bound + SurfaceResponse::loose_error * largest(iterate.gradient);
  for_values([&](std::size_t i) { iterate.gradient[i] += from.gradient[i]; });
  return iterate;
}

DiscProblem::Iterate DiscProblem::start(std::vector<double> tractions, const KnownResponse* known) {
  for_points([&](std::size_t k, const auto& each) { project(tractions, k, each); });
  if (known == nullptr) return evaluated(std::move(tractions));
  Iterate begin{known->tractions, known->displacements, known->error};
  for_values([&](std::size_t i) { begin.gradient[i] -= targets_[i]; });
  Iterate iterate = moved(begin, std::move(tractions));
  if (iterate.error_bound < allowed_error * residual(iterate)) return iterate;
  return evaluated(std::move(iterate.tractions));
}

double DiscProblem::residual(const Iterate& iterate) const {
  std::vector<double> moved(targets_.size());
  for_points([&](std::size_t k, const auto& each) {
    each([&](std::size_t i) {
      moved[i] = iterate.tractions[i] - cell_stiffness_ * iterate.gradient[i];
    });
    project(moved, k, each);
    each([&](std::size_t i) { moved[i] -= iterate.tractions[i]; });
  });
  return open_ > 0 ? std::sqrt(dot(moved, moved)) / root_of_count() / cell_stiffness_ : 0;
}

DiscProblem::Face DiscProblem::face_of(const Iterate& iterate) const {
  Face face{std::vector<unsigned char>(count()), std::vector<double>(targets_.size()),
            std::vector<double>(count())};
  for_points([&](std::size_t k, const auto& each) {
    const double size = length(each, [&](std::size_t i) { return iterate.tractions[i]; });
    if (limits_[k] == 0 || size < (1 - limit_round_off) * limits_[k]) return;
    double outward = 0;
    each(
        [&](std::size_t i) { outward -= iterate.tractions[i] / limits_[k] * iterate.gradient[i]; });
    // If the gradient pulls the traction of a point inwards from its limit, the point sticks again.
    if (outward < 0) return;
    face.bound[k] = 1;
    face.curvature[k] = outward / limits_[k];
    each([&](std::size_t i) { face.normal[i] = iterate.tractions[i] / limits_[k]; });
  });
  return face;
}

// Sets `vector` to value(i, point) for each component i, without the part that the face does not
// allow.
template <class Value>
void DiscProblem::project_on(const Face& face, std::vector<double>& vector,
                             const Value& value) const {
  for_points([&](std::size_t k, const auto& each) {
    double outward = 0;
    each([&](std::size_t i) {
      vector[i] = value(i, k);
      outward += face.normal[i] * vector[i];
    });
    each([&](std::size_t i) {
      vector[i] = limits_[k] > 0 ? vector[i] - face.normal[i] * outward : 0;
    });
  });
}

DiscProblem::Direction DiscProblem::newton_direction(const Iterate& iterate, const Face& face,
                                                     double reduction, int max_iterations,
                                                     PartialSlipReport& report) {
  const std::size_t unknowns = targets_.size();
  std::vector<double> solution(unknowns, 0.0), misfit(unknowns), scaled(unknowns), scale(count());
  project_on(face, misfit, [&](std::size_t i, std::size_t) { return -iterate.gradient[i]; });
  // Up to a factor the stencil is the inverse of the compliance K, not of K + Λ, where the diagonal
  // Λ is the curvature of the limits: where Λ prevails, the inverse is 1/Λ.
  for_points([&](std::size_t k, const auto&) {
    scale[k] = 1 / std::sqrt(1 + cell_stiffness_ * face.curvature[k]);
  });
  const double goal =
      std::max(reduction * std::sqrt(dot(misfit, misfit)), 0.3 * tolerance_ * root_of_count());
  // Error that the response to the step would have in single precision; at the end it is compared
  // with the misfit that may remain.
  const double error_bound = iterate.error_bound + SurfaceResponse::loose_error * largest(misfit);
  const int before = report.iterations;
  const CgOutcome outcome = conjugate_gradients(
      [&](const std::vector<double>& in, std::vector<double>& out) {
        system_.response().apply_loosely(points_, in.data(), out.data());
        project_on(face, out, [&](std::size_t i, std::size_t k) {
          return out[i] + face.curvature[k] * in[i];
        });
      },
      [&](const std::vector<double>& in, std::vector<double>& out) {
        for_points([&](std::size_t k, const auto& each) {
          each([&](std::size_t i) { scaled[i] = scale[k] * in[i]; });
        });
        for (std::size_t first = 0; first < unknowns; first += count())
          system_.preconditioner().apply(scaled.data() + first, out.data() + first);
        project_on(face, out, [&](std::size_t i, std::size_t k) { return scale[k] * out[i]; });
      },
      [&](double square, int iterations) {
        return std::sqrt(square) <= goal || before + iterations >= max_iterations;
      },
      dot, solution, misfit);
  // A step that round-off prevented has cost as much as a step that was taken.
  report.iterations += outcome.iterations + (outcome.exhausted ? 1 : 0);
  return {std::move(solution), /*small=*/error_bound < allowed_error * goal / root_of_count()};
}

// Whether a trial lowers the energy enough (Armijo's rule), with an allowance for round-off. A step
// d from gradient g to gradient g' changes the energy by d·(g + g')/2.
bool DiscProblem::accept(Iterate&& trial, Iterate& iterate) const {
  using Sums = Eigen::Array3d;  // g·d, the change of energy, and its round-off
  const Index unknowns = static_cast<Index>(targets_.size());
  Sums sums = Sums::Zero();
  for (const Sums& part : parallel::map_blocks<Sums>(
           unknowns,
           [&](Index begin, Index end) {
             Sums of_block = Sums::Zero();
             for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end);
                  ++i) {
               const double step = trial.tractions[i] - iterate.tractions[i];
               of_block += Sums(iterate.gradient[i] * step,
                                (iterate.gradient[i] + trial.gradient[i]) / 2 * step,
                                std::abs(step * targets_[i]));
             }
             return of_block;
           },
           4 * unknowns))
    sums += part;
  if (sums[1] > 1e-4 * std::min(sums[0], 0.0) + 1e-14 * sums[2]) return false;
  iterate = std::move(trial);
  return true;
}

bool DiscProblem::newton_step(const Face& face, const Direction& direction, Iterate& iterate) {
  for (const double part : {1.0, 0.5, 0.1}) {
    std::vector<double> tractions(targets_.size());
    for_points([&](std::size_t k, const auto& each) {
      each([&](std::size_t i) { tractions[i] = iterate.tractions[i] + part * direction.step[i]; });
      if (face.bound[k]) {
        const double size = length(each, [&](std::size_t i) { return tractions[i]; });
        each([&, stretch = limits_[k] / size](std::size_t i) { tractions[i] *= stretch; });
      }
      project(tractions, k, each);
    });
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
    std::vector<double> tractions(targets_.size());
    for_points([&](std::size_t k, const auto& each) {
      each([&](std::size_t i) {
        tractions[i] = before.tractions[i] - gradient_length_ * before.gradient[i];
      });
      project(tractions, k, each);
    });
    if (!accept(evaluated(std::move(tractions)), iterate)) {
      gradient_length_ /= 4;
      continue;
    }
    // Barzilai and Borwein's length for the next gradient step.
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
                                     std::vector<double>& tractions, std::vector<double>& slip,
                                     const KnownResponse* known) {
  PartialSlipReport report;
  const int first_fft = system_.response().fft_count();
  system_.preconditioner().hold(points_);
  tolerance_ = tolerance;
  Iterate iterate = start(std::move(tractions), known);
  std::vector<unsigned char> last_bound;
  for (;;) {
    report.residual = residual(iterate);
    if (report.residual < tolerance && iterate.error_bound > allowed_error * tolerance) {
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
      // While the set of slipping points still changes, an accurate solution for the current set is
      // of no use.
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
    if (!moved) {  // round-off has used up the accuracy of the energy
      report.termination = Termination::stalled;
      break;
    }
  }
  // A point slips if |τ − κg| exceeds its limit, with traction τ, gradient g and a cell stiffness
  // κ. |τ| itself may be below a limit that has grown by less than the tolerance since the guess.
  std::vector<unsigned char> slipping(count());
  for_points([&](std::size_t k, const auto& each) {
    const bool slips = length(each, [&](std::size_t i) {
                         return iterate.tractions[i] - cell_stiffness_ * iterate.gradient[i];
                       }) > limits_[k];
    slipping[k] = slips && limits_[k] > 0;
    each([&](std::size_t i) { iterate.gradient[i] = slips ? -iterate.gradient[i] : 0; });
  });
  report.slipping = std::ranges::count(slipping, 1);
  report.fft_count = system_.response().fft_count() - first_fft;
  tractions = std::move(iterate.tractions);
  slip = std::move(iterate.gradient);
  return report;
}

PartialSlipReport solve_discs(TangentialWorkspace& workspace, ContactSystem& system,
                              const PointList& points, std::vector<double> limits,
                              std::vector<double> targets, double scale,
                              std::vector<double>& tractions, std::vector<double>& slip,
                              const KnownResponse* known) {
  const StickOptions& options = workspace.options();
  DiscProblem problem(system, points, std::move(limits), std::move(targets),
                      workspace.stiffness_scale());
  PartialSlipReport report = problem.solve(options.tolerance * scale, options.max_iterations,
                                           options.on_progress, tractions, slip, known);
  report.residual /= scale;
  return report;
}

}  // namespace salebra::detail
