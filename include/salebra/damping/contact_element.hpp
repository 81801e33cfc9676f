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

struct LawLevelsOptions {
  /// μ >= 0; infinite: full stick, the case of the paper.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  int levels = 64;  ///< 8 … 4096. Half of them lie in the range of the motion, half below it
};

/// A contact law as a stack of indentation levels, each a spring with a limit of friction, made for
/// contacts by the thousand: immutable, and shared between elements and threads. Between its nodes
/// the force has the law's F and K at both ends: it is a cubic where that is convex, and a power of
/// the distance from one end where no cubic is. A level of K_t acts at one depth c, the middle of its
/// springs. Its stretch is limited to μ(F/G)(δ − c), with G(δ) = ∫K_t dζ up to δ, so that all levels
/// together carry μF, whatever K_t/K is. All that lies below the lowest node is one level; there F
/// falls to 0 along its tangent, which is where the surfaces part.
/// Springs cannot have a negative stiffness. Where K_t scatters and falls from one node to the next,
/// these nodes share their mean.
class LawLevels {
 public:
  /// lowest, highest   δ between which the contact will move with the accuracy asked for, m. Levels
  ///                   reach down from there to 1e-6 of the highest force, or to the end of the law.
  ///                   Other indentations are allowed in a step: below, levels are coarser; above,
  ///                   the force goes on along its tangent
  /// throws            InvalidInput for options out of range, indentations that the law does not
  ///                   cover, and a K_t that falls by more than scatter does: the mean of the nodes
  ///                   differs from one of them by more than a quarter
  LawLevels(const ContactLaw& law, double lowest, double highest,
            const LawLevelsOptions& options = {});

  double friction_coefficient() const { return friction_coefficient_; }
  std::size_t size() const { return stiffness_.size(); }
  const std::vector<double>& nodes() const { return node_; }         ///< δ, m, increasing
  const std::vector<double>& forces() const { return force_; }       ///< F at the nodes, N
  const std::vector<double>& stiffnesses() const { return slope_; }  ///< K at the nodes, N/m
  /// K_t of each level, N/m: the first that below the lowest node, then those between nodes.
  const std::vector<double>& level_stiffnesses() const { return stiffness_; }
  const std::vector<double>& level_depths() const { return depth_; }  ///< c of each level, m

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

/// What a contact answers to a step, and how that depends on its end: what Newton's method needs.
struct ElementForces {
  double normal_force = 0;                   ///< F, N, >= 0
  std::array<double, 2> tangential_force{};  ///< F_x, F_y, N: what holds the displaced body
  /// ∂(F, F_x, F_y)/∂(δ, x, y) by rows, N/m, from the same state before the step.
  std::array<std::array<double, 3>, 3> stiffness{};
};

/// A contact as an element of a finite element, multibody or particle program, with both tangential
/// directions: an implicit step of
///     F_t = Σ_i k_i(δ)(x − a_i),   |k_i(x − a_i)| <= μN_i(δ),   ΣN_i = F,
/// over the levels i of LawLevels. A spring is anchored where it touches, lets go where it
/// parts, and slips by the return along its own stretch, as bodies of Coulomb and plasticity do
/// [Simo and Hughes (1998)]; all of them slip at |F_t| = μF, and no path leads beyond that.
/// TangentialContact is the limit of many levels for one direction, without an error of the step. On
/// a law with a K_t of its own the two differ in the stretch at which a spring slips, by K_t/K:
/// TangentialContact and joint_loss() take it at one indentation, an element takes G/F, of the whole
/// contact, with which it carries μF when it slides. They differ in K_t where it falls too. With a noise
/// of 1 % in F and K_t of 60 loads on a sphere each loss is 17 % off that of the sphere (standard
/// deviation), and the two are up to a quarter apart, with a standard deviation of less than half of that.
/// A copy of an element is a state to come back to; copies share their levels.
/// cost  of a step some nanoseconds for each level that slips, touches or parts, and one for each of
///       the rest; 32 bytes a level of memory
class ContactElement {
 public:
  /// Apart, at x = y = 0. Throws InvalidInput without levels.
  explicit ContactElement(std::shared_ptr<const LawLevels> levels);

  /// Puts the body down at (indentation, x, y), all springs free of stress.
  void start(double indentation, double x, double y);
  /// The forces at the end of a step on a straight line to (indentation, x, y), which is not taken:
  /// for the iterations of a step, and for one that may be rejected. Apart, all forces are 0.
  ElementForces forces(double indentation, double x, double y) const;
  /// Takes the step.
  ElementForces move_to(double indentation, double x, double y);

  /// δ, x, y, and x and y of the anchors of every level: 3 + 2 size() numbers for restart files.
  const std::vector<double>& state() const { return state_; }
  /// Throws InvalidInput unless there are as many numbers, all finite.
  void restore(std::span<const double> state);
  const LawLevels& levels() const { return *levels_; }

 private:
  struct Step;
  void sum(std::size_t from, std::size_t to);

  std::shared_ptr<const LawLevels> levels_;
  std::vector<double> state_;
  std::vector<std::array<double, 2>> held_;  // Σk_j a_j of the levels up to each
};

}  // namespace salebra
