// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/slider.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

namespace salebra::detail {

/// Integrals over the time since the start.
struct SliderTotals {
  double time = 0;          // s
  double stuck = 0;         // s
  double impulse = 0;       // ∫T dt, N s
  double drive_work = 0;    // J
  double support_loss = 0;  // J
  double falling_gain = 0;  // b∫ẋ² dt, J
  double contact_loss = 0;  // J
};

/// The contact under a slider: δ = δ0 − u_z cos ωt.
struct SliderContact {
  const ContactLaw& law;
  double indentation;           ///< δ0, m
  double normal_amplitude;      ///< u_z, m
  double angular_frequency;     ///< ω, rad/s; not used for u_z = 0
  double friction_coefficient;  ///< μ, times the law's G*/E* over its own K_t/K at δ0

  double min_indentation() const { return indentation - normal_amplitude; }
};

/// The full equation of motion of a slider, step by step. The unknowns are y = x − Vt and w = ẋ −
/// V:
///     mẇ = −k y − (c − b)w + bV − T.
/// T is no function of (t, x, ẋ): it depends on the turning points of the path, which a general
/// solver of differential equations would have to be given as a state of variable length, copied
/// for each trial stage, and with a kink wherever a level begins or ends to slip, which no error
/// estimate by embedded orders survives. TangentialContact follows straight steps in (δ, x)
/// exactly, each level's slip, touch and release where it happens within the step. So the step is
/// explicit of second order (velocity Verlet, the velocity's own damping implicit), its end is
/// known before the contact is moved, and so is a turning point of x within it, at which it is
/// divided. Turning points of δ and first touch are ends of steps. What remains is the path's
/// curvature within a step: second order, estimated by halving.
class SliderEquation {
 public:
  /// Period of the oscillation, or without one of the slider on its spring and the contact, s.
  static double period_of(const SliderContact& contact, const Slider& slider);
  /// Steps in it, for `steps` in the faster of both.
  static double steps_of_period(const SliderContact& contact, const Slider& slider, int steps);
  SliderEquation(const SliderContact& contact, const Slider& slider, int steps);

  /// Puts it where δ is least, all levels at the limit of their stretch, which is where every
  /// period of sliding passes.
  void begin(double offset, double relative_velocity);
  /// One period of the oscillation, from least to least indentation.
  void advance();

  double period() const { return period_; }
  /// Number of steps of one advance().
  long steps() const { return static_cast<long>(nodes_.size()) - 1; }
  double time() const { return period_ * periods_; }
  double offset() const { return offset_; }                        ///< y, m
  double relative_velocity() const { return relative_velocity_; }  ///< w, m/s
  double tangential_force() const { return force_; }               ///< T, N
  double slid_force() const { return slid_force_; }  ///< T of sliding at the least indentation, N
  double min_velocity() const { return min_velocity_; }  ///< of the last period, m/s
  const SliderTotals& totals() const { return totals_; }     ///< since begin()
  double stored_energy() const;

 private:
  // An instant of the oscillation: time since the least indentation, δ and dδ/dt.
  struct Instant {
    double time = 0, indentation = 0, speed = 0;
  };
  Instant instant_at(double time) const;
  void step(Instant from, const Instant& to);
  void part(const Instant& from, const Instant& to, double acceleration);
  Instant next_event(const Instant& from, const Instant& to, double acceleration) const;
  double position_at(double time) const;  // x, m, with the offset there is
  double acceleration(double force) const;

  const SliderContact at_;
  const Slider slider_;
  TangentialContact contact_;
  double slope_limit_;  // μK/K_t
  double span_ = 0;     // m, of the indentations that matter
  double period_ = 0;
  std::vector<Instant> nodes_;  // ends of steps within a period
  double slid_force_ = 0;
  long periods_ = 0;
  double offset_ = 0, relative_velocity_ = 0, force_ = 0, min_velocity_ = 0;
  double furthest_ =
      0;  // greatest x − (μK/K_t)δ so far: where it is reached, levels that never open slip
  SliderTotals totals_;
};

}  // namespace salebra::detail
