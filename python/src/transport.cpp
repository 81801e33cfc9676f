// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of conductances, flow factors, and distributions of pressure and gap.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <salebra/contact/normal/conductance.hpp>
#include <salebra/contact/normal/distributions.hpp>
#include <salebra/contact/normal/flow_factors.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

void bind_conductance(nb::module_& m) {
  const auto define = [&m](const char* name, auto conductance, const char* first,
                           const char* second, const char* signature, const char* text) {
    m.def(
        name,
        [conductance](const Numbers& normal_stiffness, const MaterialArgument& material,
                      double of_first, std::optional<double> of_second) {
          cite({"barber2003"});
          const double modulus = material.material().contact_modulus;
          return for_each_number(normal_stiffness, [&](double stiffness) {
            return conductance(stiffness, modulus, of_first, of_second.value_or(of_first));
          });
        },
        nb::arg("normal_stiffness"), nb::arg("material"), nb::arg(first),
        nb::arg(second) = nb::none(), nb::sig(signature), text);
  };
  define(
      "electrical_conductance", &electrical_conductance, "resistivity_1", "resistivity_2",
      "def electrical_conductance(normal_stiffness: numpy.typing.ArrayLike, material: Material "
      "| float, resistivity_1: float, resistivity_2: float | None = None) -> typing.Any",
      R"(Electrical conductance of a contact from its normal stiffness, S; S/m² of a stiffness per area.

.. math:: C = \frac{2K}{E^*(\rho_1+\rho_2)}

This is exact for every set of contact spots, unlike sums over spots. Resistivities in Ω m: one for both bodies or one for each.

References
----------
Barber (2003), doi:10.1098/rspa.2002.1038.
)");
  define(
      "thermal_conductance", &thermal_conductance, "conductivity_1", "conductivity_2",
      "def thermal_conductance(normal_stiffness: numpy.typing.ArrayLike, material: Material | "
      "float, conductivity_1: float, conductivity_2: float | None = None) -> typing.Any",
      R"(Thermal conductance of the solid spots of a contact from its normal stiffness, W/K; W/(m² K) of a stiffness per area.

.. math:: \frac{2K}{E^*(1/\kappa_1+1/\kappa_2)}

Conductivities in W/(m K): one for both bodies or one for each. Radiation and the medium in the gap are neglected.

References
----------
Barber (2003), doi:10.1098/rspa.2002.1038.
)");
}

void bind_flow(nb::module_& m) {
  described_class<FlowFactors>(m, "FlowFactors",
                               "Flow of a viscous fluid through a gap between rough surfaces; "
                               "factors are NaN if nothing flows.");
  m.def(
      "flow_factors",
      [](const BoundContact& state, double tolerance, int max_iterations, double lay_angle,
         const ProgressArgument& progress) {
        cite({"patir_cheng1978"});
        require_that(state.boundary == Boundary::periodic, "state",
                     "has a free boundary, and flow factors are of a gap that repeats itself");
        return interruptible(progress, [&](Progress told) {
          return flow_factors(state, state.grid,
                              {tolerance, max_iterations, lay_angle, std::move(told)});
        });
      },
      nb::arg("state"), nb::kw_only(), nb::arg("tolerance") = FlowOptions().tolerance,
      nb::arg("max_iterations") = FlowOptions().max_iterations,
      nb::arg("lay_angle") = FlowFactors::unknown, nb::arg("progress") = false,
      R"(Percolation and pressure flow factors of the gap of a periodic contact, by Reynolds' equation.

.. math:: \nabla\cdot(g^3\nabla p) = 0,\ \langle\nabla p\rangle = e_x, \qquad
          \phi_x = \frac{\langle g^3\,\partial p/\partial x\rangle}{\langle g\rangle^3}

The mean gap is the mean over all cells, including those in contact. With `lay_angle`, the angle of the lay from the x axis in rad as
:func:`surface_lay` finds it, the factors across and along the lay are computed too.

References
----------
Patir and Cheng (1978), doi:10.1115/1.3453103.
)");
  described_class<ContactDistributions>(
      m, "ContactDistributions",
      "Densities of contact pressure and gap over the nominal area, in bins of equal width.");
  m.def(
      "contact_distributions",
      [](const BoundContact& state, int bins) {
        return unlocked([&] { return contact_distributions(state, state.grid, bins); });
      },
      nb::arg("state"), nb::arg("bins") = 100,
      "Densities of pressure (cells in contact) and of gap (other cells), from 0 to the maximum. "
      "Their "
      "integrals add up to 1.");
}

}  // namespace

void bind_transport(nb::module_& m) {
  bind_conductance(m);
  bind_flow(m);
}

}  // namespace salebra::python
