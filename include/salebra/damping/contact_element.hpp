// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <salebra/contact/law/law.hpp>
#include <span>
#include <vector>

namespace salebra {

struct LawSpringsOptions {
  /// μ >= 0; infinite: full stick, the case of the paper.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  int intervals = 64;  ///< 8 … 4096; half of them lie in the range of the motion, half below it
};

/// A contact law as a stack of springs at increasing depth, each with a friction limit, made for
/// thousands of contacts: it is immutable, and elements and threads share it.
///
///     auto levels = std::make_shared<const LawSprings>(law, 0, 2e-8, LawSpringsOptions{0.3});
///
/// Between its nodes the force has the law's F and K at both ends: it is a cubic where that is
/// convex, and otherwise a power of the distance from one end. The spring K_t of a level acts at
/// one depth c, the middle of the level. Its stretch is limited to μ(F/G)(δ − c), with G(δ) = ∫K_t
/// dζ up to δ, so that all levels together carry μF, whatever K_t/K is. Everything below the lowest
/// node is one level; there F falls to 0 along its tangent, where the surfaces separate.
/// Springs cannot have a negative stiffness: nodes between which K_t falls because of scatter share
/// their mean.
class LawSprings {
 public:
  /// lowest, highest   range of δ, m, in which the contact will move at full accuracy. Levels reach
  ///                   down from there to 1e-6 of the highest force, or to the end of the law. A
  ///                   step may leave the range: below it levels are coarser, above it the force
  ///                   continues along its tangent
  /// throws            InvalidInput for options out of range, indentations that the law does not
  ///                   cover, and a K_t that falls by more than scatter: the mean of the nodes
  ///                   differs from one of them by more than a quarter
  LawSprings(const ContactLaw& law, double lowest, double highest,
            const LawSpringsOptions& options = {});

  double friction_coefficient() const { return friction_coefficient_; }
  std::size_t size() const { return stiffness_.size(); }
  const std::vector<double>& nodes() const { return node_; }         ///< δ, m, increasing
  const std::vector<double>& forces() const { return force_; }       ///< F at the nodes, N
  const std::vector<double>& stiffnesses() const { return slope_; }  ///< K at the nodes, N/m
  /// K_t of each level, N/m: first that below the lowest node, then those between nodes.
  const std::vector<double>& spring_stiffnesses() const { return stiffness_; }
  const std::vector<double>& spring_depths() const { return depth_; }  ///< depth c of each level, m

  struct Normal {
    double force = 0, stiffness = 0, curvature = 0;  ///< F, K, K'
  };
  Normal normal(double indentation) const;

 private:
  friend class ContactElement;
  void set_normal(const ContactLaw& law);
  void set_tangential(const ContactLaw& law);
  Normal held(double indentation) const;  // G, K_t, K_t'

  double friction_coefficient_;
  std::vector<double> node_, force_, slope_;
  std::vector<double> stiffness_, depth_;  // of levels
  std::vector<double> held_, sum_;         // G and K_t at the nodes
};

/// Forces at the end of a step, and their derivatives by its end point for Newton's method.
struct ElementForces {
  double normal_force = 0;                   ///< F, N, >= 0
  std::array<double, 2> tangential_force{};  ///< F_x, F_y, N, that hold the displaced body
  /// ∂(F, F_x, F_y)/∂(δ, x, y) by rows, N/m, from the same state before the step.
  std::array<std::array<double, 3>, 3> stiffness{};
};

/// A contact as an element of a finite element, multibody or particle program, with both tangential
/// directions. A step is the implicit update
///     F_t = Σ_i k_i(δ)(x − a_i),   |k_i(x − a_i)| <= μN_i(δ),   ΣN_i = F,
/// over the levels i of LawSprings.
///
///     ContactElement element(levels);
///     ElementForces forces = element.move_to(1e-8, 1e-9, 0);
///
/// A spring is anchored where it touches, is released where it separates, and slips by the return
/// mapping of Coulomb friction along its own stretch [Simo and Hughes (1998)]; at |F_t| = μF all
/// springs slip, and no path leads beyond that. TangentialContact is the limit of many levels for
/// one direction, without a step error. If the law has its own K_t, the two differ by K_t/K in the
/// stretch at which a spring slips: TangentialContact and joint_loss() take it at one indentation, an
/// element takes G/F of the whole contact, so that it carries μF in gross sliding. They also differ
/// where K_t falls. With 1 % noise in F and K_t of 60 loads on a sphere, each loss is 17 % off that of
/// the sphere (standard deviation), and the two differ by up to a quarter, with a standard deviation
/// of less than half of that. A copy of an element saves its state; copies share their levels.
/// cost  for a step some nanoseconds per level that slips, touches or separates, and one for each
///       other level; 32 bytes of memory per level
class ContactElement {
 public:
  /// The contact is open at first, at x = y = 0. Throws InvalidInput without levels.
  explicit ContactElement(std::shared_ptr<const LawSprings> springs);

  /// Puts the body down at (indentation, x, y), with all springs free of stress.
  void start(double indentation, double x, double y);
  /// Returns the forces at the end of a straight step to (indentation, x, y) without taking it, for
  /// iterations and for steps that may be rejected. In an open contact all forces are 0.
  ElementForces forces(double indentation, double x, double y) const;
  /// Takes the step and returns the forces at its end.
  ElementForces move_to(double indentation, double x, double y);

  /// δ, x, y, and the anchors x and y of every level: 3 + 2 size() numbers for restart files.
  const std::vector<double>& state() const { return state_; }
  /// Restores a state(). Throws InvalidInput unless it has this many numbers, all finite.
  void restore(std::span<const double> state);
  const LawSprings& springs() const { return *springs_; }

 private:
  struct Step;
  void sum(std::size_t from, std::size_t to);

  std::shared_ptr<const LawSprings> springs_;
  std::vector<double> state_;
  std::vector<std::array<double, 2>> held_;  // Σk_j a_j of the levels up to each
};

}  // namespace salebra
