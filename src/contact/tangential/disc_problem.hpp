// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/base/progress.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>
#include <vector>

#include "tangential_workspace.hpp"

namespace salebra::detail {

/// A traction that was projected on its limit stays there up to so much of it.
inline constexpr double limit_round_off = 1e-12;

/// Tractions whose displacements are known.
struct KnownResponse {
  const std::vector<double>& tractions;
  const std::vector<double>& displacements;
  double error = 0;  ///< of the displacements, m
};

/// minimise ½ τ·Kτ − τ·v with |τ_i| <= limit_i, the quadratic programme of PartialSlipSolver, on
/// the points of a contact set. A vector is (components × points); with one component the discs are
/// intervals. Where the limit is 0, τ is, and the point tells only where it goes.
class DiscProblem {
 public:
  /// limits: for each point, >= 0, Pa, may be infinite. stiffness_scale: E of K ≈ 2/(E q), Pa.
  DiscProblem(ContactSystem& system, const PointList& points, std::vector<double> limits,
              std::vector<double> targets, double stiffness_scale);

  /// From a guess, which need not be feasible, to residual < tolerance, m. On return `slip` is
  /// v − Kτ where a point slips, as it does where its limit is 0, and 0 elsewhere. `known`, near the
  /// guess, saves a response in double precision; nullptr: none.
  PartialSlipReport solve(double tolerance, int max_iterations, const Progress& progress,
                          std::vector<double>& tractions, std::vector<double>& slip,
                          const KnownResponse* known = nullptr);

  /// Takes only projected gradient steps, which is slow and always converges: the Newton steps'
  /// fallback, for tests of it.
  void use_gradient_steps_only() { newton_ = false; }

 private:
  // What a Newton step may change: everything in free points, the direction of traction in bound
  // ones, nothing where there is no limit.
  struct Face {
    std::vector<unsigned char> bound;  // of each point
    std::vector<double> normal;        // τ/|τ| of a bound point, else 0 (components × points)
    std::vector<double> curvature;     // λ = |g|/limit of a bound point, else 0, m/Pa
  };
  struct Iterate {
    std::vector<double> tractions, gradient;
    double error_bound = 0;  // how far the gradient may be off, m
  };
  struct Direction {
    std::vector<double> step;  // Pa
    bool small = false;        // enough for the response to it in single precision
  };

  std::size_t count() const { return limits_.size(); }
  // Root of the number of cells that can carry traction.
  double root_of_count() const { return std::sqrt(static_cast<double>(open_)); }
  template <class Body>
  void for_values(const Body& body) const;
  template <class Body>
  void for_points(const Body& body) const;
  template <class Each>
  void project(std::vector<double>& tractions, std::size_t point, const Each& each) const;
  Iterate start(std::vector<double> tractions, const KnownResponse* known);
  Iterate evaluated(std::vector<double> tractions);
  Iterate moved(const Iterate& from, std::vector<double> tractions);
  double residual(const Iterate& iterate) const;
  Face face_of(const Iterate& iterate) const;
  template <class Value>
  void project_on(const Face& face, std::vector<double>& vector, const Value& value) const;
  Direction newton_direction(const Iterate& iterate, const Face& face, double reduction,
                             int max_iterations, PartialSlipReport& report);
  bool newton_step(const Face& face, const Direction& direction, Iterate& iterate);
  bool gradient_step(Iterate& iterate);
  bool accept(Iterate&& trial, Iterate& iterate) const;

  ContactSystem& system_;
  const PointList& points_;
  std::vector<double> limits_, targets_;
  double cell_stiffness_;   // κ, Pa/m
  double gradient_length_;  // of the last projected gradient step, Pa/m
  double tolerance_ = 0;    // of the residual, m
  std::ptrdiff_t open_;     // points of a limit > 0
  bool newton_ = true;
};

/// PartialSlipSolver::solve on points of its workspace.
PartialSlipReport solve_discs(TangentialWorkspace& workspace, ContactSystem& system,
                              const PointList& points, std::vector<double> limits,
                              std::vector<double> targets, double scale,
                              std::vector<double>& tractions, std::vector<double>& slip,
                              const KnownResponse* known = nullptr);

}  // namespace salebra::detail
