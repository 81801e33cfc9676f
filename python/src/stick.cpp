// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of tangential stiffness, partial slip and sliding contact.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <memory>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <variant>

#include "base/special_values.hpp"
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

using detail::infinity;

void bind_stiffness(nb::module_& m) {
  described_class<StickStiffness>(
      m, "StickStiffness",
      "Tangential stiffness of a contact set in full stick: F_x = xx·x + xy·y, F_y = xy·x + yy·y.");
  m.def(
      "stick_stiffness",
      [](const ContactArgument& contact, const Grid2D& grid,
         const std::variant<Material, Body>& material, double tolerance, int max_iterations,
         const Choice<Boundary>& boundary, bool hold_lateral, bool along_x_only,
         const ProcessesArgument& comm, const ProgressArgument& progress) {
        StickOptions options{.tolerance = tolerance,
                             .max_iterations = max_iterations,
                             .boundary = boundary.value("boundary"),
                             .hold_lateral = hold_lateral};
        const Communicator communicator = comm.communicator();
        return interruptible(
            progress,
            [&](Progress told) {
              options.on_progress = std::move(told);
              return std::visit(
                  [&](const auto& pressed) {
                    return stick_stiffness(contact.set, grid, pressed, options, along_x_only, {},
                                           communicator);
                  },
                  material);
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
material : Material or Body
    A material must have the constants of the two bodies.
tolerance : float
    Tolerance of the displacement, 1e-14 … 1e-1; the error of K_t is its square.
hold_lateral : bool
    The displacement across the motion is held at 0; False: the traction across it is 0.
along_x_only : bool
    Solve one direction only, at half the cost; yy and xy are NaN.
comm : mpi4py.MPI.Intracomm, optional
    The processes, if `contact` has the rows of a distributed surface.

Raises
------
InvalidInput
    If every cell of a periodic grid is in contact: the stiffness is infinite.
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
      "Normal stiffness K = dF/dδ of a contact set, N/m. For a state: :func:`normal_stiffness`.");
}

void bind_sliding(nb::module_& m) {
  described_class<PartialSlipReport>(m, "PartialSlipReport", "How a partial-slip solve ended.");
  nb::class_<SlidingContact> sliding(
      m, "SlidingContact",
      R"(A rough contact with friction that keeps the history of each cell.

Each increment of pressures and of a tangential move is solved implicitly with ``|τ| <= μp`` in every cell.

Parameters
----------
grid : Grid2D
material : Material
friction_coefficient : float
    μ >= 0; infinite: full stick.
motion_scale : float
    > 0, m: the tangential displacement that the tolerance refers to.
tolerance, max_iterations, boundary
    Options of the linear solves.
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
          nb::arg("friction_coefficient") = infinity, nb::arg("motion_scale"),
          nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
          nb::arg("boundary") = "periodic")
      .def(
          "advance",
          [](SlidingContact& self, const FieldArgument& pressure, double x, double y) {
            const BorrowedField field(pressure);
            return unlocked([&] { return self.advance(field.field(), {x, y}); });
          },
          nb::arg("pressure"), nb::arg("x") = 0.0, nb::arg("y") = 0.0,
          "Moves the body by (x, y), m, while the pressures change to `pressure` (nx, ny), Pa.")
      .def(
          "slide",
          [](SlidingContact& self, const FieldArgument& pressure, double x, double y) {
            const BorrowedField field(pressure);
            unlocked([&] { self.slide(field.field(), {x, y}); });
          },
          nb::arg("pressure"), nb::arg("x") = 1.0, nb::arg("y") = 0.0,
          "Sets the state after endless sliding along (x, y) at these pressures, with work and "
          "losses "
          "0.")
      .def_prop_ro("slipping", &SlidingContact::slipping,
                   "Number of cells at their friction limit after the last increment.")
      .def_prop_ro(
          "converged",
          [](const SlidingContact& self) { return self.termination() == Termination::converged; },
          "Whether every increment converged.")
      .def_prop_ro(
          "termination",
          [](const SlidingContact& self) { return std::string(name_of(self.termination())); },
          "How the worst increment ended: 'converged', 'stalled', 'iteration_limit', "
          "'out_of_range' or 'interrupted'.");
  using enum Dimension;
  using S = SlidingContact;
  const auto property = [&sliding](auto member, const Kept& line) {
    described_property(sliding, member, line);
  };
  property([](const S& s) -> const Field& { return s.contact_pressure(); },
           {"contact_pressure", "contact pressure", pressure});
  property([](const S& s) -> const Field& { return s.traction().x; },
           {"traction_x", "shear traction along x", pressure});
  property([](const S& s) -> const Field& { return s.traction().y; },
           {"traction_y", "shear traction along y", pressure});
  property([](const S& s) -> const Field& { return s.loss(); },
           {"loss", "work of friction in each cell since the start", energy});
  property([](const S& s) { return s.tangential_force().x; },
           {"tangential_force_x", "tangential force along x", force});
  property([](const S& s) { return s.tangential_force().y; },
           {"tangential_force_y", "tangential force along y", force});
  property(&S::stored_energy, {"stored_energy", "elastic energy of the tractions", energy});
  property(&S::work, {"work", "∫F dx since the start", energy});
  property(
      &S::released_energy,
      {"released_energy", "part of the sum of `loss` that cells released as they opened", energy});
}

}  // namespace

void bind_stick(nb::module_& m) {
  bind_stiffness(m);
  bind_sliding(m);
}

}  // namespace salebra::python
