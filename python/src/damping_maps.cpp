// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the friction map, the stress map and the damping of asperities.
#include <nanobind/stl/variant.h>

#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/stress_map.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

void bind_friction_map(nb::module_& m) {
  auto friction = described_class<FrictionMap>(m, "FrictionMap",
                                               "Losses with friction over the loss in full stick: "
                                               "shows when friction acts as \"infinite\".");
  result_methods(friction);
  m.def(
      "friction_map",
      [](const ContactLaw& law, double mean_indentation, double normal_amplitude,
         double tangential_amplitude, const Values& friction_numbers, const Values& phases,
         int steps, const ProgressArgument& progress) {
        return interruptible(progress, [&](Progress told) {
          return friction_map(law, mean_indentation, normal_amplitude, tangential_amplitude,
                              friction_numbers.values, phases.values, {steps, std::move(told)});
        });
      },
      nb::arg("law"), nb::arg("mean_indentation"), nb::arg("normal_amplitude"),
      nb::arg("tangential_amplitude"), nb::arg("friction_numbers"), nb::arg("phases"),
      nb::kw_only(), nb::arg("steps") = 1000, nb::arg("progress") = false,
      "W(μ)/W(∞) over friction numbers M = μE*u_z/(G*u_x) and phases, rad; lengths in m.");
}

void bind_stress_map(nb::module_& m) {
  auto stress = described_class<StressMap>(
      m, "StressMap",
      "Stresses under an axisymmetric indenter over phases and radii: Fig. 4 of "
      "doi:10.1038/srep16189.");
  result_methods(stress);
  m.def(
      "stress_map",
      [](const IndenterLaw& law, double mean_indentation, const Oscillation& motion, int phases,
         int radii, const ProgressArgument& progress) {
        cite({"popov2015", "popov_hess2015"});
        return interruptible(progress, [&](Progress told) {
          return stress_map(law, mean_indentation, motion, phases, radii, told);
        });
      },
      nb::arg("law"), nb::arg("mean_indentation"), nb::arg("motion"), nb::kw_only(),
      nb::arg("phases") = 128, nb::arg("radii") = 256, nb::arg("progress") = false,
      "The map of Fig. 4: phases + 1 angles from −π to π, and radii cells from 0 to 1.05 times the "
      "largest contact radius.");
}

void bind_asperities(nb::module_& m) {
  described_class<AsperityDamping>(m, "AsperityDamping",
                                   "The relaxation damping of every summit of a surface.");
  m.def(
      "asperity_damping",
      [](const SummitList& summits, const Material& material, double separation,
         const Oscillation& motion, const Choice<SummitShape>& shape) {
        cite({"popov2015", "greenwood_williamson1966"});
        require_whole(summits, "the loss of its summits");
        const SummitShape chosen = shape.value("shape");
        return unlocked([&] {
          return asperity_damping(summits.summits, material, separation, motion, chosen);
        });
      },
      nb::arg("summits"), nb::arg("material"), nb::arg("separation"), nb::arg("motion"),
      nb::kw_only(), nb::arg("shape") = "circular",
      "Damping of each summit as an independent sticking contact. separation: mean separation from "
      "the "
      "mean of the summit heights, m.");
}

}  // namespace

void bind_damping_maps(nb::module_& m) {
  bind_friction_map(m);
  bind_stress_map(m);
  bind_asperities(m);
}

}  // namespace salebra::python
