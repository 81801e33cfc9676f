// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of tangential stiffness, partial slip and sliding contact.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <salebra/contact/tangential/stick.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/described.hpp"
#include "interop/processes.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void bind_stiffness(nb::module_& m) {
  described_class<StickStiffness>(
      m, "StickStiffness",
      "Tangential stiffness of a contact set in full stick: F_x = xx·x + xy·y, F_y = xy·x + yy·y.");
  m.def(
      "stick_stiffness",
      [](const ContactArgument& contact, const Grid2D& grid, const Material& material,
         double tolerance, int max_iterations, const Choice<Boundary>& boundary, bool hold_lateral,
         bool along_x_only, const ProcessesArgument& comm, const ProgressArgument& progress) {
        StickOptions options{.tolerance = tolerance,
                             .max_iterations = max_iterations,
                             .boundary = boundary.value("boundary"),
                             .hold_lateral = hold_lateral};
        const Communicator communicator = comm.communicator();
        return interruptible(
            progress,
            [&](Progress told) {
              options.on_progress = std::move(told);
              return stick_stiffness(contact.set, grid, material, options, along_x_only, {}, communicator);
            },
            communicator);
      },
      nb::arg("contact"), nb::arg("grid"), nb::arg("material"), nb::kw_only(),
      nb::arg("tolerance") = 1e-6, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("hold_lateral") = true,
      nb::arg("along_x_only") = false, nb::arg("comm") = nb::none(), nb::arg("progress") = false,
      R"(Tangential stiffness K_t of a contact set in full stick, by linear solves with Cerruti's response.

.. math:: \hat u_x = \sum_i\frac{1}{G_iq}\left[\left(1-\nu_i\frac{q_x^2}{q^2}\right)\hat\tau_x - \nu_i\frac{q_xq_y}{q^2}\hat\tau_y\right]

Parameters
----------
contact : array_like of bool
    (nx, ny). Cells in contact, such as ``state.contact_pressure > 0``.
grid : Grid2D
material : Material
    With the constants of its bodies.
tolerance : float
    Of the displacement; K_t is better by a square. 1e-14 … 1e-1.
hold_lateral : bool
    The displacement across the motion is held at 0; False: the traction across it is 0.
along_x_only : bool
    One direction alone costs half; yy and xy are NaN.
comm : mpi4py.MPI.Intracomm, optional
    The processes whose rows `contact` is, where it comes from a surface that is spread.

Raises
------
InvalidInput
    If every cell of a periodic grid is in contact: it has no finite stiffness.
)");
  described_class<PunchStiffness>(m, "PunchStiffness",
                                  "Normal stiffness of a contact set: a flat punch of that shape.");
  m.def(
      "punch_stiffness",
      [](const ContactArgument& contact, const Grid2D& grid, const MaterialArgument& material,
         double tolerance, int max_iterations, const Choice<Boundary>& boundary,
         const ProgressArgument& progress) {
        const double contact_modulus = material.material().contact_modulus;
        PunchOptions options{.tolerance = tolerance,
                             .max_iterations = max_iterations,
                             .boundary = boundary.value("boundary")};
        return interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          return punch_stiffness(contact.set, grid, contact_modulus, options);
        });
      },
      nb::arg("contact"), nb::arg("grid"), nb::arg("material"), nb::kw_only(),
      nb::arg("tolerance") = 1e-6, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("progress") = false,
      "Normal stiffness K = dF/dδ of a contact set, N/m. The same of a state: "
      ":func:`normal_stiffness`.");
}

void bind_sliding(nb::module_& m) {
  described_class<PartialSlipReport>(m, "PartialSlipReport", "How a partial-slip solve ended.");
  nb::class_<SlidingContact> sliding(
      m, "SlidingContact",
      R"(A rough contact with friction that remembers where each of its cells has been drawn to.

Increments of pressures and of a tangential move, each solved implicitly with ``|τ| <= μp`` in every cell.

Parameters
----------
grid : Grid2D
material : Material
friction_coefficient : float
    μ >= 0; infinite: full stick.
motion_scale : float
    > 0, m: the tangential displacement that the tolerance refers to.
tolerance, max_iterations, boundary
    Of the linear solves.
)");
  sliding
      .def(
          "__init__",
          [](SlidingContact* self, const Grid2D& grid, const Material& material,
             double friction_coefficient, double motion_scale, double tolerance, int max_iterations,
             const Choice<Boundary>& boundary) {
            new (self) SlidingContact(grid, material,
                                      {friction_coefficient,
                                       motion_scale,
                                       {.tolerance = tolerance,
                                        .max_iterations = max_iterations,
                                        .boundary = boundary.value("boundary")}});
          },
          nb::arg("grid"), nb::arg("material"), nb::kw_only(),
          nb::arg("friction_coefficient") = infinite, nb::arg("motion_scale"),
          nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
          nb::arg("boundary") = "periodic")
      .def(
          "advance",
          [](SlidingContact& self, const FieldArgument& pressure, double x, double y) {
            const BorrowedField field(pressure);
            return unlocked([&] { return self.advance(field.field(), {x, y}); });
          },
          nb::arg("pressure"), nb::arg("x") = 0.0, nb::arg("y") = 0.0,
          "To new pressures (nx, ny), Pa, while the body moves by (x, y), m.")
      .def(
          "slide",
          [](SlidingContact& self, const FieldArgument& pressure, double x, double y) {
            const BorrowedField field(pressure);
            unlocked([&] { self.slide(field.field(), {x, y}); });
          },
          nb::arg("pressure"), nb::arg("x") = 1.0, nb::arg("y") = 0.0,
          "The state after endless sliding along (x, y) at these pressures; sets work and losses "
          "to 0.")
      .def_prop_ro(
          "contact_pressure",
          [](nb::handle_t<SlidingContact> self) {
            return view(nb::cast<SlidingContact&>(nb::handle(self)).contact_pressure(), self);
          },
          "Pa")
      .def_prop_ro(
          "traction_x",
          [](nb::handle_t<SlidingContact> self) {
            return view(nb::cast<SlidingContact&>(nb::handle(self)).traction().x, self);
          },
          "Pa")
      .def_prop_ro(
          "traction_y",
          [](nb::handle_t<SlidingContact> self) {
            return view(nb::cast<SlidingContact&>(nb::handle(self)).traction().y, self);
          },
          "Pa")
      .def_prop_ro(
          "loss",
          [](nb::handle_t<SlidingContact> self) {
            return view(nb::cast<SlidingContact&>(nb::handle(self)).loss(), self);
          },
          "Friction's work in each cell since the start, J.")
      .def_prop_ro(
          "tangential_force_x",
          [](const SlidingContact& self) { return self.tangential_force().x; }, "N")
      .def_prop_ro(
          "tangential_force_y",
          [](const SlidingContact& self) { return self.tangential_force().y; }, "N")
      .def_prop_ro("slipping", &SlidingContact::slipping,
                   "Cells at their limit after the last increment.")
      .def_prop_ro("stored_energy", &SlidingContact::stored_energy, "J")
      .def_prop_ro("work", &SlidingContact::work, "∫F dx since the start, J.")
      .def_prop_ro("released_energy", &SlidingContact::released_energy, "J")
      .def_prop_ro(
          "converged",
          [](const SlidingContact& self) { return self.termination() == Termination::converged; },
          "Every increment did.")
      .def_prop_ro(
          "termination",
          [](const SlidingContact& self) { return std::string(name_of(self.termination())); },
          "How the increments ended, the worst of them: 'converged', 'stalled', 'iteration_limit', "
          "'out_of_range' or 'interrupted'.");
}

}  // namespace

void bind_stick(nb::module_& m) {
  bind_stiffness(m);
  bind_sliding(m);
}

}  // namespace salebra::python
