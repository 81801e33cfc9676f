// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/slider.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

namespace salebra::detail {

/// Integrals over the time since begin().
struct SliderTotals {
  double time = 0;          // s
  double stuck = 0;         // duration of stick, s
  double impulse = 0;       // ∫T dt with the tangential force T of the contact, N s
  double drive_work = 0;    // work of the drive, J
  double support_loss = 0;  // loss in the dashpot of the support, J
  double falling_gain = 0;  // b∫ẋ² dt with the falling slope b of friction, J
  double contact_loss = 0;  // loss in the contact, J
};

/// The contact under a slider, with the indentation δ = δ0 − u_z cos ωt.
struct SliderContact {
  const ContactLaw& law;
  double indentation;        ///< δ0, m
  double normal_amplitude;   ///< u_z, m
  double angular_frequency;  ///< ω, rad/s; not used for u_z = 0
  /// Coefficient of friction of the given contact law times its (G*/E*)K/K_t at δ0.
  double friction_coefficient;

  double min_indentation() const { return indentation - normal_amplitude; }
};

/// The full equation of motion of a slider, integrated step by step. The slider has the mass m and
/// the position x; a spring of stiffness k connects it to a drive at Vt. c: damping of the support,
/// b: falling slope of friction, T: tangential force of the contact. The unknowns are y = x − Vt
/// and w = ẋ − V:
///     mẇ = −k y − (c − b)w + bV − T.
/// T is no function of (t, x, ẋ), but depends on the turning points of the path. A general solver
/// of differential equations would need these as a state of variable length, copied for each trial
/// stage, and its error estimate would fail at the kinks where a spring begins or ends to slip.
/// TangentialContact follows straight steps in (δ, x) exactly, with the slip, touch and release of
/// each spring where they happen within the step. The step is therefore explicit and of second
/// order (velocity Verlet, with the damping force taken at the new velocity). The end of a step is
/// known before the contact moves. A turning point of x within a step is known too, and divides the
/// step. Turning points of δ and first touch are ends of steps. The remaining error comes from the
/// curvature of the path within a step. It is of second order, and halving the steps gives an
/// estimate.
class SliderEquation {
 public:
  /// Period of the normal oscillation, s. Without an oscillation, the natural period of the slider
  /// on its spring and the contact.
  static double period_of(const SliderContact& contact, const Slider& slider);
  /// Number of steps in a period of the normal oscillation, if the shorter of this period and the
  /// natural period of the slider has `steps` steps.
  static double steps_of_period(const SliderContact& contact, const Slider& slider, int steps);
  SliderEquation(const SliderContact& contact, const Slider& slider, int steps);

  /// Starts at the smallest δ with all springs of the contact at their stretch limit, a state that
  /// each period of steady sliding passes. offset: y, m; relative_velocity: w, m/s.
  void begin(double offset, double relative_velocity);
  /// Advances by one period of the oscillation, between two minima of the indentation.
  void advance();

  double period() const { return period_; }
  /// Number of steps in one advance().
  long steps() const { return static_cast<long>(nodes_.size()) - 1; }
  double time() const { return period_ * periods_; }
  double offset() const { return offset_; }                        ///< y = x − Vt, m
  double relative_velocity() const { return relative_velocity_; }  ///< w = ẋ − V, m/s
  double tangential_force() const { return force_; }               ///< T, N
  /// T at the minimum of δ if all springs slip, N.
  double slid_force() const { return slid_force_; }
  /// Smallest velocity of the slider in the last period, m/s.
  double min_velocity() const { return min_velocity_; }
  const SliderTotals& totals() const { return totals_; }  ///< since begin()
  double stored_energy() const;

 private:
  // An instant of the oscillation: the time since the smallest indentation, δ and dδ/dt.
  struct Instant {
    double time = 0, indentation = 0, speed = 0;
  };
  Instant instant_at(double time) const;
  void step(Instant from, const Instant& to);
  void part(const Instant& from, const Instant& to, double acceleration);
  Instant next_event(const Instant& from, const Instant& to, double acceleration) const;
  double position_at(double time) const;  // position of the drive plus the current y, m
  double acceleration(double force) const;

  const SliderContact at_;
  const Slider slider_;
  TangentialContact contact_;
  double slope_limit_;  // μK/K_t, the stretch limit of a spring divided by its depth
  double span_ = 0;     // the larger of u_z and F/K at the largest indentation, m
  double period_ = 0;
  std::vector<Instant> nodes_;  // ends of the steps within a period
  double slid_force_ = 0;
  long periods_ = 0;
  double offset_ = 0, relative_velocity_ = 0, force_ = 0, min_velocity_ = 0;
  // Largest x − (μK/K_t)δ since begin(). When it is reached again, springs that never open slip.
  double furthest_ = 0;
  SliderTotals totals_;
};

}  // namespace salebra::detail
