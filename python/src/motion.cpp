// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of oscillations and sampled paths.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <salebra/damping/oscillation.hpp>

#include "bindings.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"

namespace salebra::python {

void bind_motion(nb::module_& m) {
  auto equal = described_class<EqualFrequency>(
      m, "EqualFrequency",
      R"(Case (a) of the paper: z = u_z cos ωt, x = u_x cos(ωt + φ0).

Parameters
----------
normal_amplitude : float
    u_z >= 0, m.
tangential_amplitude : float
    u_x, m.
phase : float
    φ0, rad.
angular_frequency : float
    ω, rad/s; or ``frequency``, ω/2π in Hz. 0: not known. Power and damping constant depend on it, the work per cycle does not.
)");
  keyword_constructor(equal, 3);
  auto drag = described_class<Drag>(
      m, "Drag",
      R"(Case (b) of the paper: z = u_z cos ωt and a slow oscillation along x, of velocity v and an excursion far below (μE*/G*)F/K.

A motion at constant velocity that continues slides, whatever the coefficient of friction.

Parameters
----------
normal_amplitude : float
    u_z >= 0, m.
drag_velocity : float
    v, m/s.
angular_frequency : float
    ω > 0, rad/s; or ``frequency``, ω/2π in Hz.
)");
  keyword_constructor(drag, 3);
  auto two = described_class<TwoFrequencies>(m, "TwoFrequencies",
                                             "Two frequencies: z = u_z cos ω_z t, x = u_x cos(ω_x "
                                             "t + φ0). Equal frequencies are case (a); slow "
                                             "tangential motion approaches case (b).");
  keyword_constructor(two, 5);
  m.def(
      "common_period",
      [](const TwoFrequencies& motion, int max_cycles) {
        const CommonPeriod period = common_period(motion, max_cycles);
        return std::pair(period.normal_cycles, period.tangential_cycles);
      },
      nb::arg("motion"), nb::arg("max_cycles") = 1000,
      "(p, q) with ω_x/ω_z = q/p in lowest terms; (0, 0) if the motion does not repeat within "
      "max_cycles normal cycles.");

  described_class<SampledMotion>(
      m, "SampledMotion",
      R"(One period of any motion, linear between the samples; the last sample closes the period.

Parameters
----------
time : array_like
    s, strictly increasing.
indentation : array_like
    δ, m; the last value equals the first.
displacement : array_like
    x, m; the last value may differ from the first by a drift, which every period repeats.
)")
      .def(
          "__init__",
          [](SampledMotion* self, Values time, Values indentation, Values displacement) {
            SampledMotion motion{std::move(time.values), std::move(indentation.values),
                                 std::move(displacement.values)};
            motion.validate();
            new (self) SampledMotion(std::move(motion));
          },
          nb::arg("time"), nb::arg("indentation"), nb::arg("displacement"));
  m.def(
      "sample",
      [](const Motion& motion, double mean_indentation, int steps) {
        return with_motion(motion,
                           [&](const auto& one) { return sample(one, mean_indentation, steps); });
      },
      nb::arg("motion"), nb::arg("mean_indentation"), nb::arg("steps"),
      "Samples one period about a mean indentation (m), with `steps` linear steps in each normal "
      "cycle, "
      "starting at a minimum of δ.");
}

}  // namespace salebra::python
