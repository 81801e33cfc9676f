// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of material, normal contact and contact spots.
#include "interop/contact.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>

#include "base/special_values.hpp"
#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

using detail::infinity;

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
          nb::arg("young") = infinity, nb::arg("poisson") = 0.0);

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

void bind_body(nb::module_& m) {
  nb::class_<Body>(m, "Body",
                   R"(A linear elastic body, known by the response of its surface to waves of load.

:func:`press` and :func:`sweep_pressures` take it in place of a material, for periodic surfaces, and :func:`normal_stiffness` and
:func:`stick_stiffness` give its stiffnesses. Displacements are measured from the mean plane of the surface, or from the rigid base of a
layer (`measured_from`); K, K_t, indentation and energy depend on this choice, the pressures under a given load do not. Waves longer than
the period of the surface do not exist: a layer much thicker than the period is a half-space.

>>> coated = salebra.Body.layered([(5e-6, 3e9, 0.49)], salebra.ElasticBody(210e9, 0.3))
>>> f"{coated.compliance(1e6)['normal']:.4g}"
'5.04e-16'
)")
      .def_static("half_space", &Body::half_space, nb::arg("first"),
                  nb::arg("second") = ElasticBody{},
                  "Homogeneous isotropic half-spaces; results have the bits of their material.")
      .def_static(
          "layered",
          [](const std::vector<std::tuple<double, double, double>>& layers,
             const ElasticBody& base) {
            std::vector<ElasticLayer> found;
            for (const auto& [thickness, young, poisson] : layers)
              found.push_back({thickness, young, poisson});
            return Body::layered(found, base);
          },
          nb::arg("layers"), nb::arg("base") = ElasticBody{},
          "Bonded layers (thickness, Young's modulus, Poisson's ratio), from the surface down, on "
          "a "
          "half-space or, by default, on a rigid base.")
      .def_static(
          "graded",
          [](double modulus, double depth, double exponent, double poisson) {
            return Body::graded({modulus, depth, exponent, poisson});
          },
          nb::arg("modulus"), nb::arg("depth"), nb::arg("exponent"), nb::arg("poisson"),
          "A half-space with E = modulus·(z/depth)^exponent at the depth z, 0 <= exponent < 1.")
      .def_static(
          "transversely_isotropic",
          [](double c11, double c33, double c13, double c44, double c66) {
            return Body::transversely_isotropic({c11, c33, c13, c44, c66});
          },
          nb::arg("c11"), nb::arg("c33"), nb::arg("c13"), nb::arg("c44"), nb::arg("c66"),
          "A transversely isotropic half-space whose axis is the normal of the surface; "
          "stiffnesses in Pa.")
      .def_static(
          "anisotropic",
          [](const std::array<std::array<double, 6>, 6>& stiffness,
             const std::array<double, 3>& normal, const std::array<double, 3>& x) {
            return Body::anisotropic(AnisotropicStiffness{stiffness}.of_surface(normal, x));
          },
          nb::arg("stiffness"), nb::arg("normal") = std::array<double, 3>{0, 0, 1},
          nb::arg("x") = std::array<double, 3>{1, 0, 0},
          "A half-space of any anisotropic material: 6 × 6 stiffnesses in Pa, in the order xx, yy, "
          "zz, yz, xz, xy; normal and x: the outward normal of the surface and its x axis in the "
          "axes of the stiffnesses.")
      .def_static(
          "cubic",
          [](double c11, double c12, double c44, const std::array<double, 3>& normal,
             const std::array<double, 3>& x) {
            return Body::anisotropic(
                AnisotropicStiffness::cubic(c11, c12, c44).of_surface(normal, x));
          },
          nb::arg("c11"), nb::arg("c12"), nb::arg("c44"),
          nb::arg("normal") = std::array<double, 3>{0, 0, 1},
          nb::arg("x") = std::array<double, 3>{1, 0, 0},
          "A half-space of a cubic crystal; stiffnesses in Pa, and the outward normal of the "
          "surface and its x axis as directions of the crystal.")
      .def_static(
          "tabulated",
          [](std::vector<double> wavenumber, std::vector<double> normal,
             std::vector<double> in_plane, std::vector<double> across, double uniform_normal,
             double uniform_tangential) {
            return Body::tabulated({std::move(wavenumber), std::move(normal), std::move(in_plane),
                                    std::move(across), uniform_normal, uniform_tangential});
          },
          nb::arg("wavenumber"), nb::arg("normal"), nb::arg("in_plane") = std::vector<double>(),
          nb::arg("across") = std::vector<double>(), nb::arg("uniform_normal") = infinity,
          nb::arg("uniform_tangential") = infinity,
          "A response given at wave numbers, m/Pa; ln C is a cubic of ln q between them. The "
          "uniform responses are those of a body on a rigid base.")
      .def_static("pair", &Body::pair, nb::arg("first"), nb::arg("second"),
                  "Two bodies in contact: their compliances add.")
      .def(
          "measured_from",
          [](const Body& self, const Choice<Datum>& datum) {
            return self.measured_from(datum.value("datum"));
          },
          nb::arg("datum"), "The same body with displacements from the mean plane or its base.")
      .def_prop_ro(
          "datum", [](const Body& self) { return std::string(name_of(self.datum())); },
          "'mean_plane' or 'base': what displacements are measured from.")
      .def(
          "compliance",
          [](const Body& self, double wavenumber, std::optional<double> direction) {
            const SurfaceCompliance c = direction
                                            ? self.compliance(wavenumber * std::cos(*direction),
                                                              wavenumber * std::sin(*direction))
                                            : self.compliance(wavenumber);
            nb::typed<nb::dict, nb::str, double> found;
            found["normal"] = c.normal;
            found["in_plane"] = c.in_plane;
            found["across"] = c.across;
            found["coupling"] = c.coupling;
            found["mixed"] = c.mixed;
            return found;
          },
          nb::arg("wavenumber"), nb::arg("direction") = nb::none(),
          "Displacements per unit load of a wave, m/Pa: normal, in_plane (along the wave vector), "
          "across (perpendicular to it), mixed (in plane by a load across) and coupling (normal by "
          "a load in plane); NaN if unknown. direction: of the wave vector, rad from x; without it "
          "the mean over all directions.");
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
  result_methods(state);
}

void bind_presses(nb::module_& m) {
  m.def(
      "press",
      [](const BoundSurface& surface, const PressedArgument& material,
         std::optional<double> pressure, std::optional<double> mean_gap,
         std::optional<double> indentation, std::optional<double> force, double tolerance,
         int max_iterations, const Choice<Boundary>& boundary, const Choice<Precision>& precision,
         double hardness, const std::optional<FieldArgument>& initial_pressure,
         const ProgressArgument& progress) {
        cite({"polonsky_keer1999", "stanley_kato1997"});
        const std::optional<Body>& body = material.body;
        const double contact_modulus = body ? std::numeric_limits<double>::quiet_NaN()
                                            : material.material.material().contact_modulus;
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
              const OperatingPoint point =
                  operating_point_of(pressure, mean_gap, indentation, force);
              return new BoundContact{body
                                          ? press(surface.surface, *body, point, options)
                                          : press(surface.surface, contact_modulus, point, options),
                                      surface.surface.grid,
                                      contact_modulus,
                                      options.boundary,
                                      {body}};
            },
            surface.surface.communicator);
      },
      nb::arg("surface"), nb::arg("material"), nb::kw_only(), nb::arg("pressure") = nb::none(),
      nb::arg("mean_gap") = nb::none(), nb::arg("indentation") = nb::none(),
      nb::arg("force") = nb::none(), nb::arg("tolerance") = 1e-10, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("precision") = "mixed",
      nb::arg("hardness") = infinity, nb::arg("initial_pressure") = nb::none(),
      nb::arg("progress") = false,
      R"(Frictionless contact of a rigid rough surface with an elastic half-space at a nominal pressure, force, mean gap or indentation.

.. math:: \min_p\ \tfrac12\,p\cdot Gp - p\cdot h, \quad 0\le p\le \text{hardness},\ \langle p\rangle = \text{nominal pressure};
          \qquad \hat u(q) = \frac{2\hat p(q)}{E^*|q|}

by nested conjugate gradients on the contact set. Each of the 15 to 100 iterations costs one pair of transforms; the solver needs 57 to
67 bytes per cell. Give exactly one of pressure, mean_gap, indentation and force.

Parameters
----------
surface : Surface
material : Material, Body or float
    A number is E* > 0, Pa. A body other than a half-space needs a periodic surface.
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
              return state.pressed.body
                         ? normal_stiffness(state, state.grid, *state.pressed.body, options)
                         : normal_stiffness(state, state.grid, state.contact_modulus, options);
            },
            state.communicator);
      },
      nb::arg("state"), nb::kw_only(), nb::arg("tolerance") = 1e-10,
      nb::arg("max_iterations") = 1000, nb::arg("progress") = false,
      R"(Normal stiffness K = dF/dδ of a state, N/m, by one linear solve on its fixed contact set.

Infinite for a periodic surface in full contact, unless the body is measured from its base; NaN if the solve did not converge or was interrupted.
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
  bind_body(m);
  bind_state(m);
  bind_presses(m);
  bind_first_loading(m);
  bind_spots(m);
}

}  // namespace salebra::python
