// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_odeiv2.h>

#include <memory>
#include <salebra/damping/steady_sliding.hpp>
#include <vector>

#include "slider_equation.hpp"

namespace salebra::detail {

/// Mean friction force T̄(v) of steady sliding at the velocity v >= 0, as piecewise cubics in
/// √(v/v_c) with known values and slopes. In this variable T̄ is smooth, also at v = 0, where it
/// grows as v^{3/2}.
class MeanFriction {
 public:
  MeanFriction(const SliderContact& contact, double friction_coefficient);
  double at(double velocity) const;
  double at_rest() const { return values_.front(); }  ///< μF(δ_min), N

 private:
  double critical_velocity_ = 0;
  std::vector<double> values_, slopes_;  // slopes_: derivatives by √(v/v_c)
};

/// The averaged equation of motion of a slider. While the slider slips in one direction the
/// equation is smooth, and an adaptive Runge–Kutta method integrates it. The time at which the
/// slider stops is located within a step, and the duration of stick has a closed form.
class AveragedSlider {
 public:
  AveragedSlider(const SliderContact& contact, const SteadySliding& sliding,
                 double friction_coefficient, const Slider& slider);
  AveragedSlider(const AveragedSlider&) = delete;
  AveragedSlider& operator=(const AveragedSlider&) = delete;

  void begin(double offset, double relative_velocity);
  /// Advances by 1/256 of 2π√(m/k), with the mass m of the slider and the stiffness k of its
  /// spring.
  void advance();

  /// Computing time of one advance(), in steps of the full equation of motion.
  long steps() const { return 16; }
  double time() const { return totals_.time; }
  double offset() const { return state_[0] * length_; }
  double relative_velocity() const { return state_[1] * slider_.velocity; }
  double tangential_force() const;
  double slid_force() const { return friction_.at_rest(); }
  const SliderTotals& totals() const { return totals_; }
  double stored_energy() const;

 private:
  static constexpr std::size_t size = 7;
  static int derivatives(double time, const double* state, double* rates, void* self);
  double load() const;  // force that friction would have to balance at rest, N
  double stick(double time);
  double slip(double time);

  const Slider slider_;
  MeanFriction friction_;
  double natural_, length_, force_;  // units of frequency, length and force: 1/s, m, N
  int direction_ = 0;                // direction of slip; 0: the slider sticks
  // Displacement/length_, relative velocity/drive velocity, and the totals in these units.
  double state_[size]{};
  SliderTotals totals_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> step_;
  std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)> control_;
  std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)> evolve_;
  double next_step_ = 0;
};

}  // namespace salebra::detail
