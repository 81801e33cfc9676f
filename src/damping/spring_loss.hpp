// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra::detail {

/// Springs of 1 N/m that stay closed while a slow drag goes back and forth over the distance X,
/// with turning points at random phases φ of the normal oscillation. A sliding spring has the
/// smallest stretch e, at the smallest indentation, and the stretch e + r(φ) at the phase φ.
/// Without turning points it would lose (e + ⟨r⟩)X over the distance X, where ⟨ ⟩ is the mean over
/// φ. After a turning point at φ the spring sticks until it reaches its stretch limit in the new
/// direction. Until then the limit may fall faster than the body moves, and drag the anchor back by
/// b(φ) = max(0, max over later phases φ' of (r(φ) − r(φ') − x(φ') + x(φ))), x being the position
/// of the body. The loss is
///     W = (e + ⟨r⟩) X − 2(e + ⟨r⟩)² + (2e + 4/3 ⟨r⟩)⟨b⟩,
/// to first order in (distance per normal cycle)/X. It is exact at e = 0 in slow motion, where ⟨b⟩
/// = ⟨r⟩/2.
class SlidingSprings {
 public:
  /// swing  amplitude (μ/g)u_z of the stretch limit, m
  /// speed  velocity v/ω of the drag, m per radian
  SlidingSprings(double swing, double speed);

  /// 1 − W/(⟨r⟩X) at e = 0: the fraction of the loss that turning points prevent, for springs that
  /// are closed at all times by the smallest margin. For a spring that touches from the phase −θ to
  /// θ the fraction is θ/π times this. excursion: X, m.
  double turning_share(double excursion) const { return (2 * rise_ - 4.0 / 3 * back_) / excursion; }
  /// Loss W over the distance X for the smallest stretch e, m² (J for 1 N/m); at least 0.
  double loss_over_distance(double min_stretch, double excursion) const;
  /// Smallest stretch e of the deepest spring that slips, at which W is 0.
  double deepest(double excursion) const;

 private:
  double rise_, back_ = 0;  // the means ⟨r⟩ and ⟨b⟩, m
};

/// Loss w(ζ) of one spring of 1 N/m at depth ζ (it touches at the indentation ζ) per normal cycle
/// of the steady state. With friction the loss of a contact is W = ∫K_t'(ζ) w(ζ) dζ. A spring may
/// be stretched by (μ/g)(δ − ζ), g = K_t/K. Under a drag between turning points w is the mean over
/// the cycles of the path and over the phases of the turning points. Integration by parts gives
///     W = −∫K_t w' dζ,
/// since w is 0 at the largest indentation and at the deepest spring that slips, and is continuous
/// where springs begin to stay closed.
class LossOfSpring {
 public:
  /// stretch    stretch limit of a spring divided by its depth, μ/g
  /// excursion  distance between the turning points of a drag, m; not used in an oscillation
  LossOfSpring(const Oscillation& motion, double stretch, double excursion);

  /// w of the spring with the depth ζ = δ0 + spring_depth, δ0 being the mean indentation.
  double operator()(double spring_depth) const;
  /// Depth below the smallest indentation down to which springs slip.
  double depth() const { return depth_; }
  /// Largest |dw/dζ| of the springs that stay closed.
  double steepest() const { return steepest_; }

 private:
  double displacement(double angle) const;
  double followed(double spring_depth, double half, int periods) const;

  Oscillation motion_;
  double amplitude_, stretch_, excursion_;
  double distance_ = 0;                        // distance of a drag per normal cycle, m
  std::optional<SlidingSprings> closed_ = {};  // set for a drag
  double depth_ = 0, steepest_ = 0;
};

}  // namespace salebra::detail
