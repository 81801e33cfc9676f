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
  int springs = 64;  ///< 8 to 4096; half of them lie in the range of the motion, half below it; all
                     ///< at equal distances where these reach down to first touch
};

/// A contact law as a stack of springs at increasing depth, each with a friction limit, made for
/// thousands of contacts: it is immutable, and elements and threads share it.
///
///     auto springs = std::make_shared<const LawSprings>(law, 0, 2e-8, LawSpringsOptions{0.3});
///
/// Between two neighbouring nodes (indentations), F is interpolated so that F and K agree with the
/// law at both nodes: by a cubic where the cubic is convex, and otherwise by a power of the
/// distance from one of the two nodes. The tangential stiffness of each spring acts at one depth c,
/// the middle of the spring. Its stretch is limited to μ(F/G)(δ − c), with G(δ) the integral of K_t
/// over all depths up to δ, so that all springs together carry μF, whatever K_t/K is. The lowest
/// node is first touch, where the surfaces separate and F is 0. A law without first touch ends at a
/// node where F is at most 1e-6 of F(highest); the contact below is a single spring, and F is
/// continued along its tangent to F = 0. Springs cannot have a negative stiffness: neighbouring
/// intervals between nodes whose mean K_t falls because of scatter all get the mean of their K_t.
class LawSprings {
 public:
  /// lowest, highest   range of δ, m, in which the contact moves at full accuracy. `lowest` may lie
  ///                   below first touch; where F is below 1e-6 of F(highest), springs are coarser.
  ///                   A step may leave the range: below `lowest` springs are coarser, and above
  ///                   `highest` the force continues along its tangent
  /// throws            InvalidInput for options out of range, for a `highest` that the law does not
  ///                   cover or where F is 0, and for a K_t that falls with δ by more than scatter,
  ///                   i.e. if its rising mean changes ∫K_t dζ at a node by more than 3 %, or 3e-4
  ///                   of that at `highest`
  LawSprings(const ContactLaw& law, double lowest, double highest,
             const LawSpringsOptions& options = {});

  double friction_coefficient() const { return friction_coefficient_; }
  std::size_t size() const { return stiffness_.size(); }
  const std::vector<double>& nodes() const { return node_; }    ///< indentations δ, m, increasing
  const std::vector<double>& forces() const { return force_; }  ///< F at the nodes, N
  const std::vector<double>& stiffnesses() const { return slope_; }  ///< K at the nodes, N/m
  /// Tangential stiffness of each spring, N/m: first the spring below the lowest node, then the
  /// springs between nodes.
  const std::vector<double>& spring_stiffnesses() const { return stiffness_; }
  const std::vector<double>& spring_depths() const {
    return depth_;
  }  ///< depth c of each spring, m

  struct Normal {
    double force = 0, stiffness = 0, curvature = 0;  ///< F, N; K, N/m; K', N/m²
  };
  Normal normal(double indentation) const;

 private:
  friend class ContactElement;
  double above_jump(std::size_t node) const;
  void set_normal(const ContactLaw& law);
  void set_tangential(const ContactLaw& law);
  Normal held(double indentation) const;  // G, K_t, K_t'

  double friction_coefficient_;
  std::vector<double> node_, force_, slope_;
  std::vector<double> stiffness_, depth_;  // of springs
  std::vector<double> held_, sum_;         // G and K_t at the nodes
};

/// Forces at the end of a step, and their derivatives with respect to the end point of the step,
/// for Newton's method.
struct ElementForces {
  double normal_force = 0;                   ///< F, N, >= 0
  std::array<double, 2> tangential_force{};  ///< F_x, F_y, N, needed to hold the body there
  /// Matrix ∂(F, F_x, F_y)/∂(δ, x, y), one row per force, N/m, for a fixed state at the start of
  /// the step.
  std::array<std::array<double, 3>, 3> stiffness{};
};

/// A contact as an element of a finite element, multibody or particle program, with both tangential
/// directions. A step is the implicit update
///     F_t = Σ_i k_i(δ)(x − a_i),   |k_i(x − a_i)| <= μN_i(δ),   ΣN_i = F,
/// over the springs i of LawSprings, with stiffness k_i, anchor a_i and share N_i of the normal
/// force.
///
///     ContactElement element(springs);
///     ElementForces forces = element.move_to(1e-8, 1e-9, 0);
///
/// A spring is anchored where it touches, is released where it separates, and slips by the return
/// mapping of Coulomb friction along its own stretch [Simo and Hughes (1998)]; at |F_t| = μF all
/// springs slip, and the tangential force cannot grow further. TangentialContact is the limit of
/// infinitely many springs, for one tangential direction and without a step error. If the law has
/// its own K_t, a ContactElement and joint_loss() limit the stretch of the springs with the mean
/// ratio G/F of the whole contact, G = ∫K_t dζ, so that it carries μF in gross sliding; a
/// TangentialContact limits it with K_t/K at one indentation unless it is given a ratio. The classes
/// also differ where K_t falls with δ. A copy of an
/// element saves its state; copies share their springs.
/// cost  a step takes some nanoseconds for each spring that slips, touches or separates, and one
///       nanosecond for each of the remaining springs; 32 bytes of memory per spring
class ContactElement {
 public:
  /// The contact is open at first, at x = y = 0. Throws InvalidInput if springs is nullptr.
  explicit ContactElement(std::shared_ptr<const LawSprings> springs);

  /// Puts the body down at (indentation, x, y), with all springs free of stress.
  void start(double indentation, double x, double y);
  /// Returns the forces at the end of a straight step to (indentation, x, y) without taking it, for
  /// iterations and for steps that may be rejected. In an open contact all forces are 0.
  ElementForces forces(double indentation, double x, double y) const;
  /// Takes a straight step to (indentation, x, y) and returns the forces at its end.
  ElementForces move_to(double indentation, double x, double y);

  /// δ, x, y, and the anchors x and y of every spring: 3 + 2 size() numbers for restart files.
  const std::vector<double>& state() const { return state_; }
  /// Restores a result of state(). Throws InvalidInput unless it has 3 + 2 size() numbers, all
  /// finite.
  void restore(std::span<const double> state);
  const LawSprings& springs() const { return *springs_; }

 private:
  struct Step;
  void sum(std::size_t from, std::size_t to);

  std::shared_ptr<const LawSprings> springs_;
  std::vector<double> state_;
  std::vector<std::array<double, 2>> held_;  // Σk_j a_j of the springs up to each
};

}  // namespace salebra
