// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the tangential contact along a path and its damping.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>

#include <memory>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/damping/contact_element.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <salebra/damping/trajectory_damping.hpp>

#include "base/special_values.hpp"
#include "bindings.hpp"
#include "interop/arrays.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/drawn.hpp"
#include "interop/running.hpp"

namespace salebra::python {
namespace {

using detail::infinity;

void bind_tangential_contact(nb::module_& m) {
  nb::class_<TangentialContact> contact(
      m, "TangentialContact",
      R"(Tangential state of a contact with nested contact sets, along any path.

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
    Maximum deviation of the stored history from the motion, m; 0 keeps all history.
table_tolerance : float
    Relative tolerance of the table of K_t that replaces the law.
tangential_range : float
    Maximum distance between two positions x of the motion, m; > 0 if friction is finite and > 0.
)");
  contact
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
          nb::arg("friction_coefficient") = infinity, nb::arg("merge_tolerance") = 0.0,
          nb::arg("table_tolerance") = 1e-12, nb::arg("tangential_range") = 0.0,
          nb::keep_alive<1, 2>())
      .def(
          "copy", [](const TangentialContact& self) { return TangentialContact(self); },
          "A copy, to return to this state later. Copies share the table of K_t.")
      .def("start", &TangentialContact::start, nb::arg("indentation"), nb::arg("x"),
           "Starts at a position with all springs free of stress and the energies 0.")
      .def("move_to", &TangentialContact::move_to, nb::arg("indentation"), nb::arg("x"),
           "Moves on a straight line in (δ, x), m.")
      .def("move_to_force", &TangentialContact::move_to_force, nb::arg("indentation"),
           nb::arg("force"), "Moves on a straight line to where F_x is `force`, N.")
      .def("slide", &TangentialContact::slide, nb::arg("indentation"), nb::arg("x"),
           nb::arg("direction"),
           "Sets the state after endless sliding towards +x (direction 1) or −x (−1), with losses "
           "and work "
           "0.")
      .def_prop_ro("memory", &TangentialContact::memory, "Number of pieces of history now held.");
  using enum Dimension;
  using T = TangentialContact;
  const auto property = [&contact](auto member, const Kept& line) {
    described_property(contact, member, line);
  };
  property(&T::displacement, {"displacement", "displacement x", length});
  property(&T::tangential_force, {"tangential_force", "tangential force F_x", force});
  property(&T::stored_energy, {"stored_energy", "elastic energy of the springs", energy});
  property(&T::dissipated, {"dissipated", "energy lost since start() or slide()", energy});
  property(&T::dissipated_in_permanent_contact,
           {"dissipated_in_permanent_contact",
            "part of `dissipated` by slip of springs that never leave contact", energy});
  property(&T::external_work, {"external_work", "∫F_x dx since start() or slide()", energy});
  property(&T::permanent_stiffness, {"permanent_stiffness", "K_t at `lowest`", stiffness});
}

void bind_contact_element(nb::module_& m) {
  nb::class_<LawSprings> law_levels(
      m, "LawSprings",
      R"(A contact law as springs with friction limits, which contact elements share.

Parameters
----------
law : ContactLaw
lowest, highest : float
    Indentations, m, between which the springs are accurate; the lowest may lie below first touch. Below, springs are coarser, down to first touch; above, the force continues along its tangent.
friction_coefficient : float
    μ >= 0; infinite: full stick.
springs : int
    8 … 4096; half of them lie between lowest and highest, half below. Where they reach first touch at equal distances, all do.
)");
  law_levels
      .def(
          "__init__",
          [](LawSprings* self, const ContactLaw& law, double lowest, double highest,
             double friction_coefficient, int springs) {
            new (self) LawSprings(law, lowest, highest, {friction_coefficient, springs});
          },
          nb::arg("law"), nb::arg("lowest"), nb::arg("highest"), nb::kw_only(),
          nb::arg("friction_coefficient") = infinity,
          nb::arg("springs") = LawSpringsOptions().springs)
      .def("__len__", &LawSprings::size)
      .def_prop_ro("friction_coefficient", &LawSprings::friction_coefficient, "μ");
  described_property(law_levels, &LawSprings::nodes,
                     Kept{"nodes", "indentations at which springs end", Dimension::length});

  nb::class_<ElementForces> forces(m, "ElementForces",
                                   "Forces and stiffnesses of a contact element after a step.");
  described_property(forces, &ElementForces::normal_force,
                     Kept{"normal_force", "normal force F", Dimension::force});
  described_property(
      forces, &ElementForces::tangential_force,
      Kept{"tangential_force", "F_x and F_y, which hold the displaced body", Dimension::force});
  described_property(
      forces, &ElementForces::stiffness,
      Kept{"stiffness", "derivatives of F, F_x, F_y (rows) by indentation, x and y (columns)",
           Dimension::stiffness});

  nb::class_<ContactElement> element(
      m, "ContactElement",
      R"(A contact as an element of another program, with both tangential directions.

Springs are anchored where they touch, are released where they separate, and slip in the direction of their stretch; all of them slip at a
tangential force of μF. A copy keeps a state to return to; copies share their springs.

Parameters
----------
springs : LawSprings
)");
  described_property(
      element, [](const ContactElement& self) { return std::vector(self.state()); },
      Kept{"state", "a copy, for restart files, of the position and the anchor of each spring",
           Dimension::length});
  element.def(nb::init<std::shared_ptr<const LawSprings>>(), nb::arg("springs"))
      .def(
          "copy", [](const ContactElement& self) { return ContactElement(self); },
          "A copy, to return to this state later.")
      .def("__copy__", [](const ContactElement& self) { return ContactElement(self); })
      .def(
          "__deepcopy__",
          [](const ContactElement& self, nb::handle) { return ContactElement(self); },
          nb::arg("memo"))
      .def("start", &ContactElement::start, nb::arg("indentation"), nb::arg("x") = 0.0,
           nb::arg("y") = 0.0, "Starts at a position with all springs free of stress.")
      .def("forces", &ContactElement::forces, nb::arg("indentation"), nb::arg("x"),
           nb::arg("y") = 0.0, "Forces at the end of a straight step, without taking the step.")
      .def("move_to", &ContactElement::move_to, nb::arg("indentation"), nb::arg("x"),
           nb::arg("y") = 0.0, "Takes a straight step, and returns the forces at its end.")
      .def(
          "restore", [](ContactElement& self, const Values& state) { self.restore(state.values); },
          nb::arg("state"), "Restores a `state` of an element with the same springs.");
}

double mean_force_of(const ContactLaw& law, const SampledMotion& path) {
  double impulse = 0;
  for (std::size_t k = 1; k < path.time.size(); ++k)
    impulse += (law.force(path.indentation[k]) + law.force(path.indentation[k - 1])) / 2 *
               (path.time[k] - path.time[k - 1]);
  return impulse / path.period();
}

void bind_damping_of_trajectory(nb::module_& m) {
  described_class<TrajectoryDamping>(m, "TrajectoryDamping",
                                     "Steady state of a contact under a periodic motion.",
                                     nb::dynamic_attr());
  m.def(
      "trajectory_damping",
      [](const ContactLaw& law, const SampledMotion& trajectory, double friction_coefficient,
         const std::optional<Values>& transverse) {
        cite({"popov2015"});
        require(!transverse || friction_coefficient == infinity, "friction_coefficient",
                friction_coefficient,
                "cannot be combined with transverse, whose slip is not followed; leave one out");
        TrajectoryDamping loss = unlocked([&] {
          return transverse ? trajectory_damping(law, trajectory, transverse->values)
                            : trajectory_damping(law, trajectory, {friction_coefficient});
        });
        const double mean_force = mean_force_of(law, trajectory);
        return with_figure(std::move(loss), [trajectory, friction_coefficient,
                                             mean_force](const TrajectoryDamping& drawn) {
          figures::Figure figure = figures::figure_of(trajectory, drawn);
          figure.caption +=
              figures::setting_text(motion_text_of(trajectory), friction_coefficient, mean_force) +
              ".";
          figures::state_validity(figure, std::span<const AssumptionVerdict>());
          return figure;
        });
      },
      nb::arg("law"), nb::arg("trajectory"), nb::kw_only(),
      nb::arg("friction_coefficient") = infinity, nb::arg("transverse") = nb::none(),
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
