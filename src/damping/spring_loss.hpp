// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra::detail {

/// Levels that stay closed on a slow way between turning points at random phases of the normal
/// cycle, springs of 1 N/m. The least stretch of one in a cycle is e, and while it slides its
/// stretch is e + r(φ), r = 0 at the least indentation. Sliding would lose (e + ⟨r⟩)X on the way X.
/// After a turning point at φ a spring sticks until its limit meets it from ahead, and until then it
/// may be dragged back by b(φ) = max(0, max(r(φ) − r(φ') − x(φ') + x(φ))) where its limit falls
/// faster than it is drawn. The mean over φ is
///     W = (e + ⟨r⟩) X − 2(e + ⟨r⟩)² + (2e + 4/3 ⟨r⟩)⟨b⟩,
/// to first order in the way of a cycle over X, exact at e = 0 in slow motion, where ⟨b⟩ = ⟨r⟩/2.
class SlidingSprings {
 public:
  /// swing  (μ/g)u_z, m
  /// speed  v/ω, m
  SlidingSprings(double swing, double speed);

  /// 1 − W/(⟨r⟩X) at e = 0: the part that turning points take where levels begin to stay closed;
  /// of a level that touches from −θ to θ, θ/π times it.
  double turning_share(double excursion) const { return (2 * rise_ - 4.0 / 3 * back_) / excursion; }
  /// W, m²; 0 where it is not above 0.
  double loss_over_distance(double min_stretch, double excursion) const;
  /// e of the deepest level that slips, where W is 0.
  double deepest(double excursion) const;

 private:
  double rise_, back_ = 0;  // ⟨r⟩, ⟨b⟩
};

/// w(ζ) of W = ∫K_t'(ζ) w(ζ) dζ with friction: what one spring of 1 N/m at the level ζ, which may be
/// stretched by (μ/g)(δ − ζ), loses in a normal cycle of the steady state; with turning points it is
/// the mean over the cycles of the way and over the phases of its ends. By parts
///     W = −∫K_t w' dζ,
/// since w is 0 at the greatest indentation and at the deepest level that slips, and continuous
/// where levels begin to stay closed.
class LossOfSpring {
 public:
  /// stretch    μ/g
  /// excursion  between the turning points of a drag, m
  LossOfSpring(const Oscillation& motion, double stretch, double excursion);

  /// level: ζ − δ0.
  double operator()(double spring_depth) const;
  /// How far below the least indentation levels slip.
  double depth() const { return depth_; }
  /// Largest |w'| of the levels that stay closed.
  double steepest() const { return steepest_; }

 private:
  double displacement(double angle) const;
  double followed(double spring_depth, double half, int periods) const;

  Oscillation motion_;
  double amplitude_, stretch_, excursion_;
  double distance_ = 0;                            // of a drag in a normal cycle, m
  std::optional<SlidingSprings> closed_ = {};  // of a drag
  double depth_ = 0, steepest_ = 0;
};

}  // namespace salebra::detail
