// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gsl/gsl_odeiv2.h>

#include <memory>
#include <salebra/damping/steady_sliding.hpp>
#include <vector>

#include "slider_equation.hpp"

namespace salebra::detail {

/// T̄(v) of steady sliding for v >= 0: cubics in √(v/v_c), in which it is smooth also where it
/// begins as v^{3/2}, through values and slopes.
class MeanFriction {
 public:
  MeanFriction(const SliderContact& contact, double friction_coefficient);
  double at(double velocity) const;
  double at_rest() const { return values_.front(); }  ///< μF(δ_min), N

 private:
  double critical_velocity_ = 0;
  std::vector<double> values_, slopes_;  // slopes by √(v/v_c)
};

/// The averaged equation of motion of a slider. While it slips one way, the equation is smooth and
/// is left to GSL; where it stops is located on the step that passes it, and how long it sticks is
/// known.
class AveragedSlider {
 public:
  AveragedSlider(const SliderContact& contact, const SteadySliding& sliding,
                 double friction_coefficient, const Slider& slider);
  AveragedSlider(const AveragedSlider&) = delete;
  AveragedSlider& operator=(const AveragedSlider&) = delete;

  void begin(double offset, double relative_velocity);
  void advance();  ///< by a part of 2π√(m/k)

  /// As many steps of the full equation as take the time of one advance().
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
  double natural_, length_, force_;  // scales: 1/s, m, N
  int direction_ = 0;                // of slip; 0: it sticks
  double state_[size]{};             // y/length, w/V, and the totals in these units
  SliderTotals totals_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> step_;
  std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)> control_;
  std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)> evolve_;
  double next_step_ = 0;
};

}  // namespace salebra::detail
