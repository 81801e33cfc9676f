// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the cycle with friction, uncoupled and coupled.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>

#include <limits>
#include <salebra/damping/frictional_cycle.hpp>

#include "bindings.hpp"
#include "interop/checkpoint.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/path.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void bind_result(nb::module_& m) {
  using Result = FrictionalCycleResult;
  nb::class_<Result> result(
      m, "FrictionalCycleResult",
      "A simulated period of a contact with finite friction; columns are views.");
  result
      .def_ro("work_per_cycle", &Result::work_per_cycle,
              "∮F_x dx less the change of the stored energy, J.")
      .def_ro("dissipated", &Result::dissipated, "∮∫τ·ds over the cells, an independent sum, J.")
      .def_ro("normal_work", &Result::normal_work, "∮F dδ, J; 0 without coupling.")
      .def_ro(
          "gap_work", &Result::gap_work,
          "Of normal_work, what the steps make of gaps that close and open within one of them, J: "
          "work_per_cycle = dissipated + gap_work.")
      .def_ro("relaxation_work", &Result::relaxation_work,
              "Of dissipated, by cells that open and close, J.")
      .def_ro("slip_work", &Result::slip_work,
              "Of dissipated, by slip in cells that are in contact all the time, J.")
      .def_ro("stored_energy_change", &Result::stored_energy_change, "J")
      .def_ro("contact_area_min", &Result::contact_area_min, "m²")
      .def_ro("contact_area_max", &Result::contact_area_max, "m²")
      .def_ro("periods", &Result::periods)
      .def_ro("steady", &Result::steady, "The last period lost the same as the one before.")
      .def_ro("converged", &Result::converged)
      .def_ro("interrupted", &Result::interrupted)
      .def("__repr__", [](const Result& r) {
        return describe("FrictionalCycleResult",
                        {{"work_per_cycle", r.work_per_cycle},
                         {"relaxation_work", r.relaxation_work},
                         {"slip_work", r.slip_work}},
                        r.converged ? "converged=True" : "converged=False");
      });
  view_property(result, "loss", &Result::loss, "Lost in a period by unit area, (nx, ny), J/m².");
  view_property(result, "smallest", &Result::smallest, "Cells that are in contact always.");
  view_property(result, "largest", &Result::largest, "Cells that are in contact at some time.");
  column_property(result, "time", &Result::samples, &FrictionalSample::t, "Over the period.");
  column_property(result, "indentation", &Result::samples, &FrictionalSample::indentation, "δ, m.");
  column_property(result, "tangential", &Result::samples, &FrictionalSample::tangential, "x, m.");
  column_property(result, "tangential_force", &Result::samples, &FrictionalSample::tangential_force,
                  "F_x, N.");
  column_property(result, "normal_force", &Result::samples, &FrictionalSample::normal_force,
                  "F, N.");
  column_property(result, "work", &Result::samples, &FrictionalSample::work, "J");
  column_property(result, "contact_area", &Result::samples, &FrictionalSample::contact_area, "m²");
  column_property(result, "slip_area", &Result::samples, &FrictionalSample::slip_area, "m²");
  result_methods(result, true);
}

FrictionalCycleOptions options_of(double friction, int steps, int max_periods,
                                  double steady_tolerance, double direction, double tolerance,
                                  int max_iterations, Boundary boundary) {
  FrictionalCycleOptions options{.friction_coefficient = friction,
                                 .steps = steps,
                                 .max_periods = max_periods,
                                 .steady_tolerance = steady_tolerance,
                                 .direction = direction};
  options.stick = {.tolerance = tolerance, .max_iterations = max_iterations, .boundary = boundary};
  return options;
}

void bind_runs(nb::module_& m) {
  m.def(
      "simulate_frictional_cycle",
      [](const BoundSurface& surface, const Material& material,
         const std::variant<EqualFrequency, Drag>& motion, double mean_indentation, double friction,
         int steps, int max_periods, double steady_tolerance, double direction, double tolerance,
         int max_iterations, const Choice<Boundary>& boundary,
         const std::optional<std::filesystem::path>& checkpoint, double checkpoint_every,
         bool resume, const ProgressArgument& progress) {
        cite({"popov2015", "polonsky_keer1999", "stanley_kato1997"});
        const Boundary chosen = boundary.value("boundary");
        FrictionalCycleOptions options = options_of(friction, steps, max_periods, steady_tolerance,
                                                    direction, tolerance, max_iterations, chosen);
        CycleSettings settings = cycle_settings(surface.surface.grid, material, oscillation(motion),
                                                mean_indentation, options);
        if (checkpoint) settings.emplace_back("surface", fingerprint(surface.surface.heights));
        return interruptible(progress, [&](Progress told) {
          options.on_progress = told;
          const PressureLevels levels =
              boundary_element_pressures(Surface(surface.surface), material.contact_modulus,
                                         {.boundary = chosen, .on_progress = told});
          return with_checkpoint<FrictionalCycleState>(
              {checkpoint, checkpoint_every, resume}, std::move(settings), options,
              [&](const FrictionalCycleOptions& with_states) {
                return simulate_frictional_cycle(levels, surface.surface.grid, material,
                                                 trajectory(motion, mean_indentation), with_states);
              });
        });
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("motion"), nb::arg("mean_indentation"),
      nb::kw_only(), nb::arg("friction_coefficient") = infinite, nb::arg("steps") = 64,
      nb::arg("max_periods") = 6, nb::arg("steady_tolerance") = 1e-5, nb::arg("direction") = 0.0,
      nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("checkpoint") = nb::none(),
      nb::arg("checkpoint_every") = 60.0, nb::arg("resume") = false, nb::arg("progress") = false,
      R"(Direct three-dimensional simulation of a surface with Coulomb friction through one oscillation.

Each step solves ``|τ| <= μp`` in every cell. Without drift the permanent contact settles within two or three periods; a drag goes on until
all of it slides: raise max_periods, and look at `steady`. Arguments as :func:`simulate_cycle`, checkpoints included; friction_coefficient: μ.
)");
  m.def(
      "simulate_coupled_cycle",
      [](const BoundSurface& surface, const Material& material,
         const std::variant<EqualFrequency, Drag>& motion, double mean_indentation, double friction,
         std::optional<double> coupling, int steps, int max_periods, double steady_tolerance,
         double direction, double tolerance, int max_iterations, const Choice<Boundary>& boundary,
         const ProgressArgument& progress) {
        cite({"popov2015", "polonsky_keer1999", "stanley_kato1997"});
        const Boundary chosen = boundary.value("boundary");
        FrictionalCycleOptions options = options_of(friction, steps, max_periods, steady_tolerance,
                                                    direction, tolerance, max_iterations, chosen);
        options.coupling = coupling;
        return interruptible(progress, [&](Progress told) {
          options.on_progress = told;
          return simulate_coupled_cycle(surface.surface, material,
                                        trajectory(motion, mean_indentation), options,
                                        {.boundary = chosen, .on_progress = told});
        });
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("motion"), nb::arg("mean_indentation"),
      nb::kw_only(), nb::arg("friction_coefficient") = infinite, nb::arg("coupling") = nb::none(),
      nb::arg("steps") = 64, nb::arg("max_periods") = 6, nb::arg("steady_tolerance") = 1e-5,
      nb::arg("direction") = 0.0, nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("progress") = false,
      "The same with the coupling of normal and tangential directions (Dundurs' β); coupling: "
      "β/(πE*), 1/Pa, by default the "
      "material's. It tells when neglecting the coupling, as the paper does, is safe.");
}

}  // namespace

void bind_frictional_cycle(nb::module_& m) {
  bind_result(m);
  bind_runs(m);
}

}  // namespace salebra::python
