// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the slider on a spring.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <salebra/damping/slider.hpp>

#include "bindings.hpp"
#include "interop/arrays.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"

namespace salebra::python {
namespace {

void bind_slider_classes(nb::module_& m) {
  auto slider = described_class<Slider>(m, "Slider",
                                        R"(A mass that a spring and a dashpot drag over a contact.

.. math:: m\ddot x + c(\dot x - V) - b\dot x + k(x - Vt) + T = 0

Parameters
----------
mass : float
    m, kg.
spring_stiffness : float
    k, N/m.
velocity : float
    V of the drive, m/s.
support_damping : float
    c of the dashpot in parallel with the spring, N s/m.
falling_slope : float
    b of a friction force that falls by b per velocity, N s/m.
)");
  keyword_constructor(slider, 3);

  described_class<SliderMotion>(m, "SliderMotion",
                                "Final motion of a slider, with means over slow cycles; unknown "
                                "numbers are NaN.");
  described_class<SliderStability>(
      m, "SliderStability",
      "Growth or decay of a small disturbance of steady sliding; unknown numbers are NaN.");
  described_class<SliderThreshold>(m, "SliderThreshold",
                                   "Minimum amplitude (m) or angular frequency (rad/s) of the "
                                   "normal oscillation at which sliding is "
                                   "stable; NaN: none in the range.");
}

void bind_functions(nb::module_& m) {
  m.def(
      "slider_motion",
      [](const ContactLaw& law, const Slider& slider, double friction_coefficient,
         double normal_amplitude, double angular_frequency, std::optional<double> indentation,
         std::optional<double> force, bool averaged, const Choice<Hold>& hold,
         const Choice<SliderStart>& start, int steps, double tolerance, int max_cycles,
         const ProgressArgument& progress) {
        cite({"popov2015"});
        const OperatingPoint point = operating_point_of(indentation, force);
        SliderOptions options{.hold = hold.value("hold"),
                              .start = start.value("start"),
                              .steps = steps,
                              .tolerance = tolerance,
                              .max_cycles = max_cycles};
        return interruptible(progress, [&](Progress told) {
          options.on_progress = told;
          const NormalOscillation normal{normal_amplitude, angular_frequency};
          return averaged
                     ? averaged_slider_motion(law, point, normal, slider, friction_coefficient,
                                              options)
                     : slider_motion(law, point, normal, slider, friction_coefficient, options);
        });
      },
      nb::arg("law"), nb::arg("slider"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("normal_amplitude") = 0.0, nb::arg("angular_frequency") = 0.0,
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      nb::arg("averaged") = false, nb::arg("hold") = "auto", nb::arg("start") = "rest",
      nb::arg("steps") = 32, nb::arg("tolerance") = 1e-2, nb::arg("max_cycles") = 200,
      nb::arg("progress") = false,
      R"(Stick–slip or steady sliding of a slider on a contact whose indentation is δ0 − u_z cos ωt.

The simulation follows the history of the springs of the contact until the motion repeats, with at least `steps` steps in each period. With
`averaged` it uses the mean friction force of `steady_sliding()` instead.

Parameters
----------
law : ContactLaw
slider : Slider
friction_coefficient : float
normal_amplitude, angular_frequency : float
    u_z, m, and ω, rad/s; without them no oscillation.
indentation, force : float
    δ0, m, or the force, N. Give exactly one.
averaged : bool
hold : str
    Which mean over a cycle stays fixed.
start : str
    At rest on the verge of slipping, or sliding with a small disturbance.
steps : int
    Steps in a period, doubled until the tolerance is met.
tolerance : float
    Relative tolerance of the amplitude of a slow cycle.
max_cycles : int
    Maximum number of slow cycles.
progress : bool or callable
)");
  m.def(
      "slider_stability",
      [](const ContactLaw& law, const Slider& slider, double friction_coefficient,
         double normal_amplitude, double angular_frequency, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, int steps) {
        const OperatingPoint point = operating_point_of(indentation, force);
        const SliderOptions options{.hold = hold.value("hold"), .steps = steps};
        return unlocked([&] {
          return slider_stability(law, point, {normal_amplitude, angular_frequency}, slider,
                                  friction_coefficient, options);
        });
      },
      nb::arg("law"), nb::arg("slider"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("normal_amplitude"), nb::arg("angular_frequency"),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(), nb::arg("hold") = "auto",
      nb::arg("steps") = 32,
      "Tests whether small disturbances of steady sliding grow, by the full equation of motion and "
      "by "
      "dT̄/dv + c − b; indentation (m) or force (N), one of the two.");
  m.def(
      "threshold_amplitude",
      [](const ContactLaw& law, const Slider& slider, double friction_coefficient,
         double angular_frequency, double max_amplitude, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, int steps) {
        const OperatingPoint point = operating_point_of(indentation, force);
        const SliderOptions options{.hold = hold.value("hold"), .steps = steps};
        return unlocked([&] {
          return threshold_amplitude(law, point, {max_amplitude, angular_frequency}, slider,
                                     friction_coefficient, options);
        });
      },
      nb::arg("law"), nb::arg("slider"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("angular_frequency"), nb::arg("max_amplitude"), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("hold") = "auto", nb::arg("steps") = 32,
      "Minimum normal amplitude (m) at which small disturbances of sliding decay; indentation "
      "(m) or force (N), one of the two.");
  m.def(
      "threshold_angular_frequency",
      [](const ContactLaw& law, const Slider& slider, double friction_coefficient,
         double normal_amplitude, double max_angular_frequency, std::optional<double> indentation,
         std::optional<double> force, const Choice<Hold>& hold, int steps) {
        const OperatingPoint point = operating_point_of(indentation, force);
        const SliderOptions options{.hold = hold.value("hold"), .steps = steps};
        return unlocked([&] {
          return threshold_angular_frequency(law, point, {normal_amplitude, max_angular_frequency},
                                             slider, friction_coefficient, options);
        });
      },
      nb::arg("law"), nb::arg("slider"), nb::kw_only(), nb::arg("friction_coefficient"),
      nb::arg("normal_amplitude"), nb::arg("max_angular_frequency"),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(), nb::arg("hold") = "auto",
      nb::arg("steps") = 32,
      "Minimum angular frequency (rad/s) at which small disturbances of sliding decay; "
      "indentation (m) or force (N), one of the two.");
}

}  // namespace

void bind_slider(nb::module_& m) {
  bind_slider_classes(m);
  bind_functions(m);
}

}  // namespace salebra::python
