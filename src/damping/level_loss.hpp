// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra::detail {

/// w(ζ) of W = ∫K_t'(ζ) w(ζ) dζ with friction: what one spring of 1 N/m at the level ζ, which may be
/// stretched by (μ/g)(δ − ζ), loses in a normal cycle of the steady state. By parts
///     W = −∫K_t w' dζ,
/// since w is 0 at the greatest indentation and at the deepest level that slips, and continuous
/// where levels begin to stay closed.
class LevelLoss {
 public:
  /// stretch    μ/g
  /// excursion  between the turning points of a drag, m
  LevelLoss(const Oscillation& motion, double stretch, double excursion);

  /// level: ζ − δ0.
  double operator()(double level) const;
  /// How far below the least indentation levels slip.
  double depth() const { return depth_; }
  /// Largest |w'| of the levels that stay closed.
  double steepest() const { return steepest_; }

 private:
  double displacement(double angle) const;
  double followed(double level, double half, int periods) const;

  Oscillation motion_;
  double amplitude_, stretch_, excursion_;
  double way_ = 0, rise_ = 0;  // of a drag in a normal cycle; mean rise of the stretch, m
  double depth_ = 0, steepest_ = 0;
};

}  // namespace salebra::detail
