// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/base/progress.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>
#include <vector>

#include "tangential_workspace.hpp"

namespace salebra::detail {

/// A traction within this relative distance of its limit counts as at the limit.
inline constexpr double limit_round_off = 1e-12;

/// Tractions whose displacements have been computed before.
struct KnownResponse {
  const std::vector<double>& tractions;
  const std::vector<double>& displacements;
  double error = 0;  ///< of the displacements, m
};

/// Minimises ½ τ·Kτ − τ·v over the tractions τ with |τ_i| <= limit_i at each point i, where K is
/// the tangential compliance and v the target displacements: the quadratic programme of
/// PartialSlipSolver, on the points of a contact set. A vector is (components × points); the limit
/// makes the traction of a point lie in a disc, or with one component in an interval. A point with
/// limit 0 has no traction; only its displacement is computed.
class DiscProblem {
 public:
  /// limits: one for each point, >= 0, Pa, may be infinite. targets: displacements v, m.
  /// stiffness_scale: TangentialWorkspace::stiffness_scale().
  DiscProblem(ContactSystem& system, const PointList& points, std::vector<double> limits,
              std::vector<double> targets, double stiffness_scale);

  /// Solves from the given tractions, which may exceed their limits, to residual < tolerance, m. On
  /// return `slip` is target minus displacement at points that slip, including points with limit 0,
  /// and 0 at all other points. `known`, if its tractions are near the given ones, saves a response
  /// in double precision; nullptr: none.
  PartialSlipReport solve(double tolerance, int max_iterations, const Progress& progress,
                          std::vector<double>& tractions, std::vector<double>& slip,
                          const KnownResponse* known = nullptr);

  /// Takes only projected gradient steps, which are slow but always converge. Tests use this to
  /// check the fallback for Newton steps that fail.
  void use_gradient_steps_only() { newton_ = false; }

 private:
  // The tractions that a Newton step may change: both components at free points, only the direction
  // at points at their limit (bound), and none at points with limit 0.
  struct Face {
    std::vector<unsigned char> bound;  // for each point
    std::vector<double> normal;     // τ/|τ| of a bound point, otherwise 0 (components × points)
    std::vector<double> curvature;  // |gradient|/limit of a bound point, otherwise 0, m/Pa
  };
  struct Iterate {
    std::vector<double> tractions, gradient;
    double error_bound = 0;  // bound of the error of the gradient, m
  };
  struct Direction {
    std::vector<double> step;  // Pa
    bool small = false;        // whether single precision suffices for its response
  };

  std::size_t count() const { return limits_.size(); }
  // Square root of the number of points that can carry traction.
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
  double gradient_length_;  // length of the last projected gradient step, Pa/m
  double tolerance_ = 0;    // of the residual, m
  std::ptrdiff_t open_;     // number of points with a limit > 0
  bool newton_ = true;
};

/// PartialSlipSolver::solve() on points of its workspace; `scale` multiplies the tolerance of its
/// options.
PartialSlipReport solve_discs(TangentialWorkspace& workspace, ContactSystem& system,
                              const PointList& points, std::vector<double> limits,
                              std::vector<double> targets, double scale,
                              std::vector<double>& tractions, std::vector<double>& slip,
                              const KnownResponse* known = nullptr);

}  // namespace salebra::detail
