// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of material, normal contact and contact spots.
#include "interop/contact.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>
#include <memory>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void bind_material(nb::module_& m) {
  described_class<ElasticBody>(
      m, "ElasticBody",
      "One elastic half-space: Young's modulus E, Pa, and Poisson's ratio ν. An infinite modulus "
      "(the default) is a rigid body.")
      .def(
          "__init__",
          [](ElasticBody* self, double young, double poisson) {
            new (self) ElasticBody{young, poisson};
          },
          nb::arg("young") = infinite, nb::arg("poisson") = 0.0);

  described_class<Material>(m, "Material", R"(Elastic constants of the two bodies of a contact.

.. math:: \frac{1}{E^*} = \sum_i\frac{1-\nu_i^2}{E_i} \quad\text{Eq. (1)}, \qquad
          \frac{1}{G^*} = \sum_i\frac{2-\nu_i}{4G_i} \quad\text{Eq. (2)}

of doi:10.1038/srep16189.

Parameters
----------
contact_modulus : float
    E*, Pa.
poisson : float, optional
    Poisson's ratio of the elastic body if the other is rigid: gives G* = 2E*(1−ν)/(2−ν).
tangential_modulus : float, optional
    G*, Pa, instead of `poisson`. With neither, only normal contact can be computed.
)")
      .def(
          "__init__",
          [](Material* self, double contact_modulus, std::optional<double> poisson,
             std::optional<double> tangential_modulus) {
            require(!poisson || !tangential_modulus, "tangential_modulus",
                    tangential_modulus.value_or(0),
                    "was given together with poisson; give one of them");
            new (self) Material(poisson ? Material::of_contact_modulus(contact_modulus, *poisson)
                                : tangential_modulus
                                    ? Material::of_moduli(contact_modulus, *tangential_modulus)
                                    : Material::of_contact_modulus(contact_modulus));
          },
          nb::arg("contact_modulus"), nb::kw_only(), nb::arg("poisson") = nb::none(),
          nb::arg("tangential_modulus") = nb::none())
      .def_static("of_bodies", &Material::of_bodies, nb::arg("first"),
                  nb::arg("second") = ElasticBody{},
                  "The material of two elastic bodies; at least one of them is not rigid.");
  m.def("_warning_of_pressure", &warning_of_pressure, nb::arg("pressure"),
        nb::arg("contact_modulus"),
        "Warning about a probable mistake in the unit of one of them, or None.");
}

void bind_state(nb::module_& m) {
  auto state = described_class<BoundContact>(
      m, "NormalContactState", R"(Result of a normal contact; its fields are views, not copies.

Unless `converged`, the numbers describe the last iterate: do not use them.
)");
  state
      .def_prop_ro(
          "rows",
          [](const BoundContact& self) {
            return range_of(RowPartition(self.communicator, self.grid.nx));
          },
          nb::sig("def rows(self) -> range"),
          "Rows ix of the fields that this process holds; the same as those of the surface.")
      .def(
          "gather",
          [](nb::handle_t<BoundContact> self, int root) {
            const nb::handle object = self;
            const auto& mine = nb::cast<const BoundContact&>(object);
            return gather(self, root, mine.communicator, [&] {
              return unlocked([&] {
                const RowPartition rows(mine.communicator, mine.grid.nx);
                auto whole = std::make_unique<BoundContact>(mine);
                whole->communicator = {};
                whole->contact_pressure = gathered(rows, mine.contact_pressure, root);
                whole->gap = gathered(rows, mine.gap, root);
                return whole;
              });
            });
          },
          nb::arg("root") = 0,
          nb::sig("def gather(self, root: int = 0) -> NormalContactState | None"),
          "The state with complete fields in one process, None in the others; see "
          ":meth:`Surface.gather`.");
  result_methods(state, true);
}

void bind_presses(nb::module_& m) {
  m.def(
      "press",
      [](const BoundSurface& surface, const MaterialArgument& material,
         std::optional<double> pressure, std::optional<double> mean_gap,
         std::optional<double> indentation, std::optional<double> force, double tolerance,
         int max_iterations, const Choice<Boundary>& boundary, const Choice<Precision>& precision,
         double hardness, const std::optional<FieldArgument>& initial_pressure,
         const ProgressArgument& progress) {
        cite({"polonsky_keer1999", "stanley_kato1997"});
        const double contact_modulus = material.material().contact_modulus;
        const std::unique_ptr<BorrowedField> initial =
            initial_pressure ? std::make_unique<BorrowedField>(*initial_pressure) : nullptr;
        NormalContactOptions options{.tolerance = tolerance,
                                     .max_iterations = max_iterations,
                                     .boundary = boundary.value("boundary"),
                                     .precision = precision.value("precision"),
                                     .hardness = hardness,
                                     .initial_pressure = initial ? &initial->field() : nullptr};
        return interruptible(
            progress,
            [&](Progress told) {
              options.on_progress = std::move(told);
              return new BoundContact{
                  press(surface.surface, contact_modulus,
                        operating_point_of(pressure, mean_gap, indentation, force), options),
                  surface.surface.grid, contact_modulus, options.boundary};
            },
            surface.surface.communicator);
      },
      nb::arg("surface"), nb::arg("material"), nb::kw_only(), nb::arg("pressure") = nb::none(),
      nb::arg("mean_gap") = nb::none(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("tolerance") = 1e-10, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("precision") = "mixed",
      nb::arg("hardness") = infinite, nb::arg("initial_pressure") = nb::none(),
      nb::arg("progress") = false,
      R"(Frictionless contact of a rigid rough surface with an elastic half-space at a nominal pressure, force, mean gap or indentation.

.. math:: \min_p\ \tfrac12\,p\cdot Gp - p\cdot h, \quad 0\le p\le \text{hardness},\ \langle p\rangle = \text{nominal pressure};
          \qquad \hat u(q) = \frac{2\hat p(q)}{E^*|q|}

by nested conjugate gradients on the contact set. Each of the 15 to 100 iterations costs one pair of transforms; the solver needs 57 to
67 bytes per cell. Give exactly one of pressure, mean_gap, indentation and force.

Parameters
----------
surface : Surface
material : Material or float
    A number is E* > 0, Pa.
pressure : float, optional
    Nominal, > 0, Pa, below the hardness.
mean_gap : float, optional
    ū in (0, max h − mean h), m. Periodic and elastic contacts only.
indentation : float, optional
    Rigid approach from first touch, > 0, m; below max h − mean h for periodic contacts.
force : float, optional
    > 0, N: pressure times the nominal area.
tolerance : float
    Stop at e_c = Σp(g − g_min)/(Σp·h_rms) < tolerance, checked in double precision; 1e-14 … 1e-1.
max_iterations : int
    On the finest grid level.
boundary : {"periodic", "free"}
    "periodic": the surface repeats infinitely; "free": one loaded patch on an infinite half-space.
precision : {"mixed", "full"}
    "mixed": transforms in float, residuals and acceptance in double.
hardness : float
    Maximum pressure that the bodies carry, Pa: cells saturate at it.
initial_pressure : array_like, optional
    Start of the iteration, Pa, in the shape of the heights; not copied if C-contiguous float64.
progress : bool or callable
    True: a bar of tqdm; a function of a :class:`ProgressReport` that returns False to stop.

Returns
-------
NormalContactState
    Unless `converged`, its numbers describe the last iterate: do not use them.

Raises
------
InvalidInput
    Before any work. A solve that does not converge returns its state and raises nothing.

References
----------
Polonsky and Keer (1999), doi:10.1016/S0043-1648(99)00113-1; Stanley and Kato (1997),
doi:10.1115/1.2833523.
)");

  m.def(
      "normal_stiffness",
      [](const BoundContact& state, double tolerance, int max_iterations,
         const ProgressArgument& progress) {
        NormalContactOptions options{
            .tolerance = tolerance, .max_iterations = max_iterations, .boundary = state.boundary};
        return interruptible(
            progress,
            [&](Progress told) {
              options.on_progress = std::move(told);
              return normal_stiffness(state, state.grid, state.contact_modulus, options);
            },
            state.communicator);
      },
      nb::arg("state"), nb::kw_only(), nb::arg("tolerance") = 1e-10,
      nb::arg("max_iterations") = 1000, nb::arg("progress") = false,
      R"(Normal stiffness K = dF/dδ of a state, N/m, by one linear solve on its fixed contact set.

Infinite for a periodic surface in full contact; NaN if the solve did not converge or was interrupted.
)");
}

void bind_first_loading(nb::module_& m) {
  described_class<FirstLoading>(m, "FirstLoading",
                                "Results of a plastic first loading; NaN if there was none.")
      .def_prop_ro("yielded", &FirstLoading::yielded, "Whether any part of the surface yielded.");
  m.def(
      "after_first_loading",
      [](const BoundSurface& surface, const MaterialArgument& material, double pressure,
         double hardness, double normal_amplitude, double tolerance, int max_iterations,
         const Choice<Boundary>& boundary,
         const ProgressArgument& progress) -> nb::typed<nb::tuple, BoundSurface, FirstLoading> {
        const double contact_modulus = material.material().contact_modulus;
        NormalContactOptions options{.tolerance = tolerance,
                                     .max_iterations = max_iterations,
                                     .boundary = boundary.value("boundary"),
                                     .hardness = hardness};
        ResidualSurface residual = interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          return after_first_loading(surface.surface, contact_modulus, pressure, options,
                                     normal_amplitude);
        });
        if (residual.termination == Termination::interrupted)
          throw Interrupted("after_first_loading: interrupted");
        if (!residual.converged())
          throw NotConverged("after_first_loading: the contact did not reach its tolerance");
        return nb::borrow<nb::typed<nb::tuple, BoundSurface, FirstLoading>>(nb::make_tuple(
            nb::cast(new_surface(std::move(residual.surface)), nb::rv_policy::take_ownership),
            residual.first_loading));
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("pressure"), nb::kw_only(),
      nb::arg("hardness"), nb::arg("normal_amplitude") = 0.0, nb::arg("tolerance") = 1e-10,
      nb::arg("max_iterations") = 1000, nb::arg("boundary") = "periodic",
      nb::arg("progress") = false,
      R"(The surface after a plastic first loading, in which pressures are limited to the hardness.

Where the pressure reaches the hardness, the surface sinks in permanently. Unloading, and every later cycle below the first load, is the
elastic contact of the returned surface.

Parameters
----------
surface : Surface
material : Material or float
    A number is E* > 0, Pa.
pressure : float
    Maximum nominal pressure, > 0, Pa, below the hardness.
hardness : float
    > 0, Pa.
normal_amplitude : float
    u_z >= 0, m: the first loading ends at the maximum pressure of an oscillation about the nominal pressure.
tolerance, max_iterations, boundary, progress
    As for :func:`press`.

Returns
-------
(Surface, FirstLoading)
    The residual surface, and the numbers of the first loading.

Raises
------
InvalidInput
    If the hardness is not above the mean pressure.
NotConverged
    If a contact did not reach its tolerance.

References
----------
Almqvist et al. (2007), Tribology International 40, 574; Johnson (1985), Contact Mechanics,
section 6.4.
)");
}

void bind_spots(nb::module_& m) {
  described_class<ContactSpot>(m, "ContactSpot", "A connected part of the contact area.");
  described_class<ContactSpots>(m, "ContactSpots",
                                "The contact spots, largest area first; columns are views.")
      .def("__len__", [](const ContactSpots& self) { return self.spots.size(); });
  m.def(
      "contact_spots",
      [](const BoundContact& state) {
        cite({"yastrebov2017"});
        return unlocked([&] {
          return contact_spots(state.contact_pressure, state.grid, state.boundary,
                               state.communicator);
        });
      },
      nb::arg("state"),
      "Contact spots: connected cells with p > 0; neighbours wrap for periodic boundaries. If the "
      "state is distributed over processes, each process gets all spots.");
}

}  // namespace

void bind_contact(nb::module_& m) {
  bind_material(m);
  bind_state(m);
  bind_presses(m);
  bind_first_loading(m);
  bind_spots(m);
}

}  // namespace salebra::python
