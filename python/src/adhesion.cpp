// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of adhesive contacts: of surfaces, their cycles, and of axisymmetric indenters.
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <memory>
#include <salebra/contact/mdr/adhesive_indenter.hpp>
#include <salebra/contact/normal/adhesive_cycle.hpp>
#include <salebra/contact/sweep.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

/// The Python object of an adhesive contact. It is also a NormalContactState, so that every
/// function that takes such a state accepts it.
struct BoundAdhesiveContact : BoundContact, AdhesionOfState {};

constexpr void describe(auto&& visit, std::type_identity<BoundAdhesiveContact>) {
  describe(visit, std::type_identity<BoundContact>{});
  describe(visit, std::type_identity<AdhesionOfState>{});
}

/// The Python object of a loading cycle: loading and unloading as force curves, whose stiffnesses
/// are not computed.
struct BoundCycle : AdhesiveCycleNumbers {
  ForceCurve loading, unloading;
  bool converged = false;
};

constexpr void describe(auto&& visit, std::type_identity<BoundCycle>) {
  using S = BoundCycle;
  describe(visit, std::type_identity<AdhesiveCycleNumbers>{});
  visit(&S::loading, Kept{"loading", "force curve from the outermost position to the closest"});
  visit(&S::unloading, Kept{"unloading", "force curve from the closest position outward"});
  visit(&S::converged, Kept{"converged", "False: do not use the numbers"});
}

void bind_states(nb::module_& m) {
  described_class<Adhesion>(m, "Adhesion", R"(Energy per area of two surfaces at a gap, −w at g = 0.

.. math:: \phi = -w e^{-g/\rho}, \qquad -w(1 - g/\rho)\ \text{below}\ \rho, \qquad -\frac{w}{(1+g/\rho)^2}

of ``"exponential"``, ``"maugis"`` and ``"van_der_waals"`` with a hard wall.

Parameters
----------
work : float
    w >= 0, J/m².
range : float
    ρ > 0, m.
potential : {"exponential", "maugis", "van_der_waals"}
)")
      .def(
          "__init__",
          [](Adhesion* self, double work, double range,
             const Choice<AdhesionPotential>& potential) {
            new (self) Adhesion{potential.value("potential"), work, range};
          },
          nb::arg("work"), nb::arg("range"), nb::arg("potential") = "exponential")
      .def("energy", &Adhesion::energy, nb::arg("gap"), "φ(g), J/m².")
      .def("tension", &Adhesion::tension, nb::arg("gap"), "φ'(g), Pa.")
      .def("max_tension", &Adhesion::max_tension, "φ'(0), Pa.");

  nb::class_<BoundAdhesiveContact, BoundContact> state(
      m, "AdhesiveContactState", R"(Result of an adhesive contact; its fields are views, not copies.

`contact_pressure` acts in the cells that touch and `tension` between all cells; mean pressure and force are those of the difference of
the two. Do not use the numbers unless `converged`.
)");
  auto bound = nb::borrow<nb::class_<BoundAdhesiveContact>>(state);
  describe([&](auto member, const auto& line) { described_property(bound, member, line); },
           std::type_identity<AdhesionOfState>{});
  value_methods(bound);
}

void bind_press(nb::module_& m) {
  m.def(
      "press_adhesive",
      [](const BoundSurface& surface, const PressedArgument& material, const Adhesion& adhesion,
         std::optional<double> pressure, std::optional<double> mean_gap,
         std::optional<double> indentation, std::optional<double> force, double tolerance,
         int max_outer_iterations, const Choice<Boundary>& boundary, double hardness,
         const BoundAdhesiveContact* start, bool force_coarse, const ProgressArgument& progress) {
        const double contact_modulus = material.body ? std::numeric_limits<double>::quiet_NaN()
                                                     : material.material.material().contact_modulus;
        AdhesiveContactOptions options{
            .tolerance = tolerance,
            .max_outer_iterations = max_outer_iterations,
            .contact = {.boundary = boundary.value("boundary"), .hardness = hardness},
            .start_tension = start ? &start->tension : nullptr,
            .force_coarse = force_coarse};
        return interruptible(
            progress,
            [&](Progress told) {
              options.contact.on_progress = std::move(told);
              auto state = press_adhesive(
                  surface.surface, material.pressed(),
                  operating_point_of(pressure, mean_gap, indentation, force), adhesion, options);
              return new BoundAdhesiveContact{{std::move(static_cast<NormalContactState&>(state)),
                                               surface.surface.grid,
                                               contact_modulus,
                                               options.contact.boundary,
                                               {material.body}},
                                              std::move(static_cast<AdhesionOfState&>(state))};
            },
            surface.surface.communicator);
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("adhesion"), nb::kw_only(),
      nb::arg("pressure") = nb::none(), nb::arg("mean_gap") = nb::none(),
      nb::arg("indentation") = nb::none(), nb::arg("force") = nb::none(),
      nb::arg("tolerance") = AdhesiveContactOptions().tolerance,
      nb::arg("max_outer_iterations") = AdhesiveContactOptions().max_outer_iterations,
      nb::arg("boundary") = "periodic",
      nb::arg("hardness") = std::numeric_limits<double>::infinity(), nb::arg("start") = nb::none(),
      nb::arg("force_coarse") = false, nb::arg("progress") = false,
      R"(Adhesive contact of a rigid rough surface with an elastic half-space.

.. math:: \min_{g\ge0}\ \tfrac12\langle(g+h)\,k(g+h)\rangle + \langle\phi(g)\rangle + P\langle g\rangle

by a sequence of non-adhesive contacts, each of which lowers this energy. Exactly one of pressure, mean_gap, indentation and force is given; a pressure
or force may pull. Solutions are local minima: they depend on the start.

Parameters
----------
surface : Surface
material : Material, Body or float
    A number is E* > 0, Pa.
adhesion : Adhesion
pressure, mean_gap, indentation, force : float, optional
    Pa, m, m, N.
tolerance : float
    Tolerance of the residual of the tension, 1e-10 … 1e-1.
max_outer_iterations : int
    Maximum number of non-adhesive contacts.
boundary : {"periodic", "free"}
hardness : float
    Hardness of a first loading under a pressure or force > 0, Pa: the maximum of pressure minus tension.
start : AdhesiveContactState, optional
    State from which the solution continues on the same branch, for loading and unloading.
force_coarse : bool
    Solve even with less than 1.4 cells in the process zone.
progress : bool or callable

Returns
-------
AdhesiveContactState
    Unless `converged`, its numbers must not be used as the answer; `detached` where the load parts the surfaces.
)");

  described_class<BoundCycle>(m, "AdhesiveCycle",
                              "Loading and unloading of an adhesive contact in steps.");
  m.def(
      "adhesive_cycle",
      [](const BoundSurface& surface, const PressedArgument& material, const Adhesion& adhesion,
         const std::optional<Values>& pressures, const std::optional<Values>& mean_gaps,
         const std::optional<Values>& indentations, bool unload, double tolerance,
         int max_outer_iterations, const Choice<Boundary>& boundary, bool force_coarse,
         const ProgressArgument& progress) {
        require_that(pressures.has_value() + mean_gaps.has_value() + indentations.has_value() == 1,
                     "operating points",
                     "exactly one of `pressures`, `mean_gaps` and `indentations` must be given");
        std::vector<OperatingPoint> points;
        const auto add = [&](const std::optional<Values>& values, ControlQuantity control) {
          if (values)
            for (const double value : values->values) points.push_back({control, value});
        };
        add(pressures, ControlQuantity::pressure);
        add(mean_gaps, ControlQuantity::mean_gap);
        add(indentations, ControlQuantity::indentation);
        const Body body = material.pressed();
        AdhesiveCycleOptions options{
            .contact = {.tolerance = tolerance,
                        .max_outer_iterations = max_outer_iterations,
                        .contact = {.boundary = boundary.value("boundary")},
                        .force_coarse = force_coarse},
            .unload = unload};
        return interruptible(
            progress,
            [&](Progress told) {
              options.contact.contact.on_progress = std::move(told);
              const AdhesiveCycle cycle =
                  adhesive_cycle(surface.surface, body, points, adhesion, options);
              const auto curve_of = [&](const std::vector<AdhesiveContactState>& branch) {
                ForceCurve curve;
                curve.model = "bem";
                curve.body = body.fingerprint();
                curve.adhesive = true;
                curve.nominal_area = surface.surface.grid.area();
                for (const AdhesiveContactState& state : branch)
                  curve.samples.push_back(
                      force_sample(state, surface.surface, body,
                                   {.contact = options.contact.contact, .stiffness = false}));
                return curve;
              };
              return BoundCycle{cycle, curve_of(cycle.loading), curve_of(cycle.unloading),
                                cycle.converged()};
            },
            surface.surface.communicator);
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("adhesion"), nb::kw_only(),
      nb::arg("pressures") = nb::none(), nb::arg("mean_gaps") = nb::none(),
      nb::arg("indentations") = nb::none(), nb::arg("unload") = true,
      nb::arg("tolerance") = AdhesiveContactOptions().tolerance,
      nb::arg("max_outer_iterations") = AdhesiveContactOptions().max_outer_iterations,
      nb::arg("boundary") = "periodic", nb::arg("force_coarse") = false,
      nb::arg("progress") = false,
      R"(Presses a surface step by step and pulls it off again. Each contact starts from the previous one.

Parameters
----------
surface : Surface
material : Material, Body or float
adhesion : Adhesion
pressures, mean_gaps, indentations : array_like, optional
    Give one of them, from the loosest to the tightest contact, Pa or m. With pressures the pull-off is bracketed to 2 %; with gaps the
    force passes its minimum, and the work of the cycle is known.
unload : bool
    False: only load.
tolerance, max_outer_iterations, boundary, force_coarse, progress
    As for :func:`press_adhesive`.
)");
}

void bind_indenters(nb::module_& m) {
  described_class<AdhesivePoint>(m, "AdhesivePoint", "One equilibrium of an adhesive indenter.");
  m.def("jkr_contact", &jkr_contact, nb::arg("profile"), nb::arg("contact_modulus"),
        nb::arg("work"), nb::arg("contact_radius"),
        R"(Equilibrium by the JKR model (adhesion without range) for any profile, from its image.

.. math:: \delta = g(a) - \sqrt{2\pi wa/E^*}, \qquad F = 2E^*\left[a\delta - \int_0^a g\,dx\right]

References
----------
Johnson et al. (1971), doi:10.1098/rspa.1971.0141.
)");
  m.def("jkr_pull_off", &jkr_pull_off, nb::arg("profile"), nb::arg("contact_modulus"),
        nb::arg("work"), "The state of minimum force; −(3/2)πwR for a paraboloid.");
  m.def("dmt_contact", &dmt_contact, nb::arg("radius"), nb::arg("contact_modulus"), nb::arg("work"),
        nb::arg("contact_radius"),
        "Equilibrium by the DMT model (adhesion does not deform the contact): F = 4E*a³/(3R) − "
        "2πwR, δ = a²/R.");
  nb::class_<MaugisDugdale>(m, "MaugisDugdale",
                            "A paraboloid under a tension w/ρ wherever the gap is below ρ: "
                            "Maugis (1992), doi:10.1016/0021-9797(92)90285-T.")
      .def(nb::init<double, double, double, double>(), nb::arg("radius"),
           nb::arg("contact_modulus"), nb::arg("work"), nb::arg("range"))
      .def("contact", &MaugisDugdale::contact, nb::arg("contact_radius"),
           "The state at a contact radius >= 0, m.")
      .def("pull_off", &MaugisDugdale::pull_off, "The state of minimum force.")
      .def_prop_ro("transition_parameter", &MaugisDugdale::transition_parameter,
                   "λ, 1.16 times Tabor's parameter.");
  m.def(
      "adhesive_equilibrium",
      [](const std::function<AdhesivePoint(double)>& contact, const AdhesivePoint& pull_off,
         std::optional<double> force, std::optional<double> indentation) {
        require_that(force.has_value() != indentation.has_value(), "force",
                     "exactly one of `force` and `indentation` must be given");
        return force ? adhesive_equilibrium(contact, pull_off, &AdhesivePoint::force, *force)
                     : adhesive_equilibrium(contact, pull_off, &AdhesivePoint::indentation,
                                            *indentation);
      },
      nb::arg("contact"), nb::arg("pull_off"), nb::kw_only(), nb::arg("force") = nb::none(),
      nb::arg("indentation") = nb::none(),
      R"(The equilibrium under a force, N, or at an indentation, m, on the branch that starts at the pull-off.

Parameters
----------
contact : callable
    Returns the state at a contact radius, such as ``ball.contact`` of :class:`MaugisDugdale` or ``lambda a: jkr_contact(profile, 1e6, 0.05, a)``.
pull_off : AdhesivePoint
    Pull-off of the same model.
force, indentation : float, optional
    Give one of them; a force may pull.
)");
  m.def("tabor_parameter", &tabor_parameter, nb::arg("radius"), nb::arg("contact_modulus"),
        nb::arg("work"), nb::arg("range"), "μ = (R w²/(E*² ρ³))^(1/3).");
  m.def(
      "suggested_adhesion_model",
      [](double parameter) { return std::string(name_of(suggested_model(parameter))); },
      nb::arg("tabor_parameter"),
      "Name of the model for a Tabor parameter: \"dmt\" below 0.1, \"jkr\" above 5, "
      "\"maugis_dugdale\" "
      "between.");
}

}  // namespace

void bind_adhesion(nb::module_& m) {
  bind_states(m);
  bind_press(m);
  bind_indenters(m);
}

}  // namespace salebra::python
