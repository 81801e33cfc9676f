// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the tangential contact along a path and its damping.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>

#include <limits>
#include <memory>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/damping/contact_element.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <salebra/damping/trajectory_damping.hpp>

#include "bindings.hpp"
#include "interop/arrays.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"

namespace salebra::python {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void bind_tangential_contact(nb::module_& m) {
  nb::class_<TangentialContact>(
      m, "TangentialContact",
      R"(The tangential state of any contact with nested contact sets, along any path.

.. math:: F_x = \int_{-\infty}^{\delta} K_t'(\zeta)\,[x - x_0(\zeta)]\,d\zeta

Exact for motion in straight steps. The motion must stay within lowest <= δ <= highest;
below a ``lowest`` without force nothing touches.

Parameters
----------
law : ContactLaw
lowest, highest : float
    m.
friction_coefficient : float
    μ >= 0; infinite: full stick, the case of the paper.
merge_tolerance : float
    How far the stored history may deviate from the motion, m; 0 keeps all of it.
table_tolerance : float
    Relative, of the table of K_t that stands for the law.
tangential_range : float
    Largest distance of two positions x of the motion, m; > 0 where friction is finite and > 0.
)")
      .def(
          "__init__",
          [](TangentialContact* self, const ContactLaw& law, double lowest, double highest,
             double friction_coefficient, double merge_tolerance, double table_tolerance,
             double tangential_range) {
            new (self) TangentialContact(
                law, lowest, highest,
                {friction_coefficient, merge_tolerance, table_tolerance, tangential_range});
          },
          nb::arg("law"), nb::arg("lowest"), nb::arg("highest"), nb::kw_only(),
          nb::arg("friction_coefficient") = infinite, nb::arg("merge_tolerance") = 0.0,
          nb::arg("table_tolerance") = 1e-12, nb::arg("tangential_range") = 0.0,
          nb::keep_alive<1, 2>())
      .def(
          "copy", [](const TangentialContact& self) { return TangentialContact(self); },
          "A state to come back to. Copies share the table of K_t.")
      .def("start", &TangentialContact::start, nb::arg("indentation"), nb::arg("x"),
           "Puts the indenter down, all springs free of stress; sets the energies to 0.")
      .def("move_to", &TangentialContact::move_to, nb::arg("indentation"), nb::arg("x"),
           "Moves on a straight line in (δ, x), m.")
      .def("move_to_force", &TangentialContact::move_to_force, nb::arg("indentation"),
           nb::arg("force"), "Moves on a straight line to where F_x is `force`, N.")
      .def("slide", &TangentialContact::slide, nb::arg("indentation"), nb::arg("x"),
           nb::arg("direction"),
           "The state after endless sliding towards +x (direction 1) or −x (−1); sets losses and "
           "work to 0.")
      .def_prop_ro("displacement", &TangentialContact::displacement, "x, m.")
      .def_prop_ro("tangential_force", &TangentialContact::tangential_force, "F_x, N.")
      .def_prop_ro("stored_energy", &TangentialContact::stored_energy, "J")
      .def_prop_ro("dissipated", &TangentialContact::dissipated,
                   "Lost since start() or slide(), J.")
      .def_prop_ro("dissipated_in_permanent_contact",
                   &TangentialContact::dissipated_in_permanent_contact,
                   "Of it, by slip of levels that never leave contact, J.")
      .def_prop_ro("external_work", &TangentialContact::external_work,
                   "∫F_x dx since start() or slide(), J.")
      .def_prop_ro("permanent_stiffness", &TangentialContact::permanent_stiffness,
                   "K_t at `lowest`, N/m.")
      .def_prop_ro("memory", &TangentialContact::memory, "Pieces of history now held.");
}

void bind_contact_element(nb::module_& m) {
  nb::class_<LawSprings>(
      m, "LawSprings",
      R"(A contact law as springs of springs with friction, shared by contact elements.

Parameters
----------
law : ContactLaw
lowest, highest : float
    Indentations between which contacts will move with the accuracy asked for, m. Below, springs are
    coarser; above, the force goes on along its tangent.
friction_coefficient : float
    μ >= 0; infinite: full stick.
springs : int
    8 … 4096; half of them lie between lowest and highest, half below.
)")
      .def(
          "__init__",
          [](LawSprings* self, const ContactLaw& law, double lowest, double highest,
             double friction_coefficient, int springs) {
            new (self) LawSprings(law, lowest, highest, {friction_coefficient, springs});
          },
          nb::arg("law"), nb::arg("lowest"), nb::arg("highest"), nb::kw_only(),
          nb::arg("friction_coefficient") = infinite, nb::arg("intervals") = LawSpringsOptions().springs)
      .def("__len__", &LawSprings::size)
      .def_prop_ro("friction_coefficient", &LawSprings::friction_coefficient, "μ")
      .def_prop_ro(
          "nodes", [](const LawSprings& self) { return array_of(self.nodes()); },
          nb::rv_policy::automatic, "Indentations at which levels end, m.");

  nb::class_<ElementForces>(m, "ElementForces", "What a contact element answers to a step.")
      .def_ro("normal_force", &ElementForces::normal_force, "F, N.")
      .def_ro("tangential_force", &ElementForces::tangential_force,
              "F_x and F_y, N: what holds the displaced body.")
      .def_ro("stiffness", &ElementForces::stiffness,
              "Derivatives of F, F_x, F_y, by rows, over indentation, x and y, N/m.");

  nb::class_<ContactElement>(
      m, "ContactElement",
      R"(A contact as an element of another program, with both tangential directions.

Springs are anchored where they touch, let go where they part, and slip along their own stretch; all of them
slip at a tangential force of μF. A copy is a state to come back to, and copies share their springs.

Parameters
----------
springs : LawSprings
)")
      .def(nb::init<std::shared_ptr<const LawSprings>>(), nb::arg("intervals"))
      .def(
          "copy", [](const ContactElement& self) { return ContactElement(self); },
          "A state to come back to.")
      .def("__copy__", [](const ContactElement& self) { return ContactElement(self); })
      .def(
          "__deepcopy__",
          [](const ContactElement& self, nb::handle) { return ContactElement(self); },
          nb::arg("memo"))
      .def("start", &ContactElement::start, nb::arg("indentation"), nb::arg("x") = 0.0,
           nb::arg("y") = 0.0, "Puts the body down, all springs free of stress.")
      .def("forces", &ContactElement::forces, nb::arg("indentation"), nb::arg("x"),
           nb::arg("y") = 0.0, "The forces at the end of a straight step, which is not taken.")
      .def("move_to", &ContactElement::move_to, nb::arg("indentation"), nb::arg("x"),
           nb::arg("y") = 0.0, "Takes a straight step, and returns the forces at its end.")
      .def_prop_ro(
          "state", [](const ContactElement& self) { return array_of(self.state()); },
          nb::rv_policy::automatic,
          "A copy, for restart files, of the position and of where each level is anchored, m.")
      .def(
          "restore", [](ContactElement& self, const Values& state) { self.restore(state.values); },
          nb::arg("state"), "Goes back to a state of an element with the same levels.");
}

void bind_damping_of_trajectory(nb::module_& m) {
  described_class<TrajectoryDamping>(m, "TrajectoryDamping",
                                     "Steady state of a contact under a periodic motion.");
  m.def(
      "trajectory_damping",
      [](const ContactLaw& law, const SampledMotion& trajectory, double friction_coefficient,
         const std::optional<Values>& transverse) {
        cite({"popov2015"});
        require(!transverse || friction_coefficient == infinite, "friction_coefficient",
                friction_coefficient,
                "cannot be combined with transverse, whose slip is not followed; leave one out");
        return unlocked([&] {
          return transverse ? trajectory_damping(law, trajectory, transverse->values)
                            : trajectory_damping(law, trajectory, {friction_coefficient});
        });
      },
      nb::arg("law"), nb::arg("trajectory"), nb::kw_only(),
      nb::arg("friction_coefficient") = infinite, nb::arg("transverse") = nb::none(),
      "Steady state of a periodic trajectory; exact for its straight steps. "
      "friction_coefficient: μ, infinite for full stick; transverse: y at the samples, m, of a "
      "motion in two directions without slip.");
}

}  // namespace

void bind_trajectories(nb::module_& m) {
  bind_tangential_contact(m);
  bind_contact_element(m);
  bind_damping_of_trajectory(m);
}

}  // namespace salebra::python
