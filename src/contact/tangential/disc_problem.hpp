// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/progress.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>
#include <vector>

#include "surface_response.hpp"

namespace salebra::detail {

/// A traction that was projected on its limit stays there up to so much of it.
inline constexpr double limit_round_off = 1e-12;

/// minimise ½ τ·Kτ − τ·v with |τ_i| <= limit_i, the quadratic programme of PartialSlipSolver, on
/// the points of a contact set. A vector is (components × points); with one component the discs are
/// intervals.
class DiscProblem {
 public:
  /// limits: for each point, > 0, Pa, may be infinite. stiffness_scale: E of K ≈ 2/(E q), Pa.
  DiscProblem(ContactSystem& system, const PointList& points, std::vector<double> limits,
              std::vector<double> targets, double stiffness_scale);

  /// From a guess, which need not be feasible, to residual < tolerance, m. On return `gradient` is
  /// Kτ − v.
  PartialSlipReport solve(double tolerance, int max_iterations, const Progress& progress,
                          std::vector<double>& tractions, std::vector<double>& gradient);

  /// Whether a point slips: |τ − κg| exceeds its limit. (|τ| itself may be short of a limit that
  /// has grown by less than the tolerance since the guess.)
  bool slips(const std::vector<double>& tractions, const std::vector<double>& gradient,
             std::size_t point) const;

  /// Takes only projected gradient steps, which is slow and always converges: the Newton steps'
  /// fallback, for tests of it.
  void use_gradient_steps_only() { newton_ = false; }

 private:
  // What a Newton step may change: everything in free points, the direction of traction in bound
  // ones.
  struct Face {
    std::vector<char> bound;        // per point
    std::vector<double> normal;     // τ/|τ| of bound points
    std::vector<double> curvature;  // λ = |g|/limit of bound points, m/Pa; 0 elsewhere
  };
  struct Iterate {
    std::vector<double> tractions, gradient;
    double energy = 0;
  };

  std::size_t count() const { return limits_.size(); }
  std::size_t components() const { return targets_.size() / limits_.size(); }
  double length(const std::vector<double>& vector, std::size_t point) const;
  bool at_limit(const std::vector<double>& tractions, std::size_t point) const;
  void project(std::vector<double>& tractions) const;
  void evaluate(Iterate& iterate);
  double residual(const Iterate& iterate) const;
  Face face_of(const Iterate& iterate) const;
  void project_on(const Face& face, std::vector<double>& vector) const;
  std::vector<double> newton_direction(const Iterate& iterate, const Face& face, double reduction,
                                       double tolerance, int max_iterations,
                                       PartialSlipReport& report);
  bool newton_step(const Face& face, const std::vector<double>& direction, Iterate& iterate);
  bool gradient_step(Iterate& iterate);
  bool accept(Iterate&& trial, Iterate& iterate) const;

  ContactSystem& system_;
  const PointList& points_;
  std::vector<double> limits_, targets_;
  double cell_stiffness_;   // κ, Pa/m
  double gradient_length_;  // of the last projected gradient step, Pa/m
  bool newton_ = true;
};

}  // namespace salebra::detail
