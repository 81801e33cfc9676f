// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the cycle without slip, its contact sets, and the interval quadrature.
#include <fmt/format.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/damping/joint.hpp>

#include "base/special_values.hpp"
#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/contact_sets.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/drawn.hpp"
#include "interop/path.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"
#include "results/cycle_recorder.hpp"

namespace salebra::python {
namespace {

using detail::infinity;

NormalContactOptions contact_options(double tolerance, int max_iterations,
                                     const Choice<Boundary>& boundary) {
  return {.tolerance = tolerance,
          .max_iterations = max_iterations,
          .boundary = boundary.value("boundary")};
}

void bind_contact_sets(nb::module_& m) {
  described_class<ContactSetAt>(m, "ContactSetAt",
                                "The cells of the frictionless normal contact at one indentation.");
  nb::class_<BoundContactSets>(
      m, "ContactSets", nb::dynamic_attr(),
      R"(The normal contact as a function of the indentation, for the direct simulation.

Parameters
----------
function : callable
    Takes the indentation, m, and returns (contact set (nx, ny) of bool, force in N). It must be deterministic: it is called once for
    each indentation.
grid : Grid2D

See Also
--------
boundary_element_contact_sets : the contact sets of a surface.
)")
      .def(
          "__init__",
          [](BoundContactSets* self, const ContactSetFunction& given, const Grid2D& grid) {
            // The function may be released by a thread that does not hold the interpreter's lock,
            // so the lock is taken for this.
            const std::shared_ptr<nb::object> held(new nb::object(given.function),
                                                   [](nb::object* object) {
                                                     const nb::gil_scoped_acquire locked;
                                                     delete object;
                                                   });
            new (self) BoundContactSets{
                [held](double indentation) {
                  const nb::gil_scoped_acquire locked;
                  const nb::object answer = (*held)(indentation);
                  auto [contact, force] = nb::cast<std::pair<nb::object, double>>(answer);
                  const nb::module_ numpy = nb::module_::import_("numpy");
                  const nb::object array = numpy.attr("ascontiguousarray")(contact, "bool");
                  const auto flags =
                      nb::cast<nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>>(
                          array);
                  ContactSetAt made;
                  made.contact = Eigen::Map<const ContactSet>(flags.data(), Index(flags.shape(0)),
                                                              Index(flags.shape(1)));
                  made.force = force;
                  return made;
                },
                grid, "function"};
          },
          nb::arg("function"), nb::arg("grid"))
      .def(
          "__call__",
          [](const BoundContactSets& self, double indentation) {
            return unlocked([&] { return self.contact_sets(indentation); });
          },
          nb::arg("indentation"), "The contact at an indentation, m.")
      .def_ro("grid", &BoundContactSets::grid);
  m.def(
      "boundary_element_contact_sets",
      [](const BoundSurface& surface, const PressedArgument& material, double tolerance,
         int max_iterations, const Choice<Boundary>& boundary) {
        const Body body = material.pressed();
        cite({"polonsky_keer1999", "stanley_kato1997"});
        const NormalContactOptions options = contact_options(tolerance, max_iterations, boundary);
        return BoundContactSets{
            boundary_element_contact_sets(Surface(surface.surface), body, options),
            surface.surface.grid,
            // The settings of a cycle tell bodies that are not half-spaces apart.
            fmt::format("surface {}, {} Pa, {} boundary to {} in {} iterations",
                        fingerprint(surface.surface.heights),
                        material.body ? 0 : material.material.material().contact_modulus,
                        boundary.text, tolerance, max_iterations)};
      },
      nb::arg("surface"), nb::arg("material"), nb::kw_only(), nb::arg("tolerance") = 1e-10,
      nb::arg("max_iterations") = 1000, nb::arg("boundary") = "periodic",
      "The contact sets of a surface by boundary elements. `boundary` must be that of the "
      "simulation. "
      "Copies the surface.");
}

void bind_result(nb::module_& m) {
  auto result = described_class<CycleResult>(
      m, "CycleResult", "A simulated period; columns are views.", nb::dynamic_attr());
  result_methods(result);
}

// Runs simulate(options, progress), and writes and reads the checkpoint if there is one.
template <class Simulate>
nb::typed<nb::object, CycleResult> simulation(
    CycleOptions options, const Oscillation& motion,
    const std::optional<std::filesystem::path>& checkpoint, double checkpoint_every, bool resume,
    CycleSettings settings, const ProgressArgument& progress, const Simulate& simulate) {
  require_that(checkpoint || !resume, "resume",
               "given without a checkpoint; name the file of the run to continue");
  CycleResult simulated = interruptible(progress, [&](Progress told) {
    options.on_progress = told;
    CycleRecorder recorder({.checkpoint = checkpoint.value_or(std::filesystem::path()),
                            .checkpoint_every = checkpoint_every,
                            .resume = resume},
                           std::move(settings), {});
    CycleResult result =
        recorder.run(options, [&](const CycleOptions& chosen) { return simulate(chosen, told); });
    if (result.termination != Termination::interrupted) recorder.done();
    return result;
  });
  const double friction = options.friction_coefficient;
  return with_figure(std::move(simulated), [motion, friction](const CycleResult& result) {
    figures::Figure figure = figures::figure_of(result);
    figure.caption = "The last period of a simulated oscillation." +
                     figures::setting_text(figures::motion_text(motion_of(motion)), friction,
                                           mean_over_period(result, &CycleSample::normal_force)) +
                     ".";
    figures::state_validity(figure, std::span<const AssumptionVerdict>());
    return figure;
  });
}

StickOptions stick_options(double tolerance, int max_iterations, const Choice<Boundary>& boundary) {
  return {.tolerance = tolerance,
          .max_iterations = max_iterations,
          .boundary = boundary.value("boundary")};
}

void bind_simulations(nb::module_& m) {
  m.def(
      "simulate_cycle",
      [](const BoundContactSets& contact_sets, const PressedArgument& material,
         const std::variant<EqualFrequency, Drag>& motion, double mean_indentation, int steps,
         int max_periods, double direction, double tolerance, int max_iterations,
         const Choice<Boundary>& boundary, const std::optional<std::filesystem::path>& checkpoint,
         double checkpoint_every, bool resume, const ProgressArgument& progress) {
        cite({"popov2015"});
        const CycleOptions options{.steps = steps,
                                   .max_periods = max_periods,
                                   .direction = direction,
                                   .stick = stick_options(tolerance, max_iterations, boundary)};
        CycleSettings settings = cycle_settings(contact_sets.grid, material.pressed(),
                                                oscillation(motion), mean_indentation, options);
        settings.emplace_back("contact_sets", contact_sets.identity);
        return simulation(options, oscillation(motion), checkpoint, checkpoint_every, resume,
                          std::move(settings), progress,
                          [&](const CycleOptions& chosen, const Progress&) {
                            return simulate_cycle(contact_sets.contact_sets, contact_sets.grid,
                                                  material.pressed(),
                                                  trajectory(motion, mean_indentation), chosen);
                          });
      },
      nb::arg("contact_sets"), nb::arg("material"), nb::arg("motion"), nb::arg("mean_indentation"),
      nb::kw_only(), nb::arg("steps") = 64, nb::arg("max_periods") = 6, nb::arg("direction") = 0.0,
      nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("checkpoint") = nb::none(),
      nb::arg("checkpoint_every") = 60.0, nb::arg("resume") = false, nb::arg("progress") = false,
      R"(Direct three-dimensional simulation of a contact with infinite friction through one oscillation.

Cells that enter keep the displacement that they have at that time; cells that leave release their traction. The error of the steps
is of second order: −h²/24 of W, h = 2π/steps, for equal frequencies and K_t' = const.

Parameters
----------
contact_sets : ContactSets
    Such as :func:`boundary_element_contact_sets` of a surface.
material : Material or Body
motion : EqualFrequency or Drag
mean_indentation : float
    m, from first touch.
steps : int
    Steps in a period, each with another contact set; >= 4.
max_periods : int
    Maximum number of periods; the simulation ends earlier if a period repeats the previous one.
direction : float
    Angle of the tangential motion to the x axis, rad.
tolerance, max_iterations, boundary
    Options of each stick solve.
checkpoint : str or os.PathLike, optional
    File that keeps the state while the simulation runs. It is removed at the end; a run that stops before, by Ctrl-C for example,
    leaves it.
checkpoint_every : float
    Time between checkpoints, s; 0 for every step.
resume : bool
    Continue from the checkpoint if there is one; the result has the same bits. If `contact_sets` is a Python function, it must be the same.
progress : bool or callable

Raises
------
InvalidInput
    "<file>: <setting> was … in the checkpoint and is … now" for a checkpoint of another run, and for one that exists without resume.
)");
  // The simulations with friction and with coupling have the same arguments, except that coupling
  // has a coupling constant too.
  const auto define = [&m]<class... Constant>(const char* name,
                                              std::type_identity<void(Constant...)>,
                                              const char* description, auto... constant_argument) {
    m.def(
        name,
        [](const BoundSurface& surface,
           const std::conditional_t<sizeof...(Constant) == 0, PressedArgument, Material>& material,
           const std::variant<EqualFrequency, Drag>& motion, double mean_indentation,
           double friction_coefficient, Constant... coupling_constant, int steps, int max_periods,
           double steady_tolerance, double direction, double tolerance, int max_iterations,
           const Choice<Boundary>& boundary, const std::optional<std::filesystem::path>& checkpoint,
           double checkpoint_every, bool resume, const ProgressArgument& progress) {
          cite({"popov2015", "polonsky_keer1999", "stanley_kato1997"});
          CycleOptions options{.friction_coefficient = friction_coefficient,
                               .steps = steps,
                               .max_periods = max_periods,
                               .steady_tolerance = steady_tolerance,
                               .direction = direction,
                               .stick = stick_options(tolerance, max_iterations, boundary)};
          ((options.coupling_constant = coupling_constant), ...);
          const auto body = [&]() -> Body {
            if constexpr (sizeof...(Constant) == 0)
              return material.pressed();
            else
              return material;
          }();
          CycleSettings settings = cycle_settings(surface.surface.grid, body, oscillation(motion),
                                                  mean_indentation, options);
          if (checkpoint) settings.emplace_back("surface", fingerprint(surface.surface.heights));
          return simulation(
              options, oscillation(motion), checkpoint, checkpoint_every, resume,
              std::move(settings), progress, [&](const CycleOptions& chosen, const Progress& told) {
                const NormalContactOptions normal{.boundary = chosen.stick.boundary,
                                                  .on_progress = told};
                const Trajectory path = trajectory(motion, mean_indentation);
                if constexpr (sizeof...(Constant) > 0)
                  return simulate_coupled_cycle(surface.surface, material, path, chosen, normal);
                else
                  return simulate_frictional_cycle(
                      boundary_element_pressures(Surface(surface.surface), body, normal),
                      surface.surface.grid, body, path, chosen);
              });
        },
        nb::arg("surface"), nb::arg("material"), nb::arg("motion"), nb::arg("mean_indentation"),
        nb::kw_only(), nb::arg("friction_coefficient") = infinity, constant_argument...,
        nb::arg("steps") = 64, nb::arg("max_periods") = 6, nb::arg("steady_tolerance") = 1e-5,
        nb::arg("direction") = 0.0, nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
        nb::arg("boundary") = "periodic", nb::arg("checkpoint") = nb::none(),
        nb::arg("checkpoint_every") = 60.0, nb::arg("resume") = false, nb::arg("progress") = false,
        description);
  };
  define(
      "simulate_frictional_cycle", std::type_identity<void()>{},
      R"(Direct three-dimensional simulation of a surface with Coulomb friction through one oscillation.

Each step solves ``|τ| <= μp`` in every cell. Without drift the permanent contact settles within two or three periods. A constant drag
starts from the state after long sliding, and its second period loses the same energy as the first. Arguments as for :func:`simulate_cycle`, including
checkpoints; friction_coefficient: μ.
)");
  m.def(
      "simulated_joint_loss",
      [](const BoundSurface& surface, const PressedArgument& material, double mean_indentation,
         double friction_coefficient, std::optional<double> tangential_amplitude,
         std::optional<double> tangential_force, double normal_amplitude, double phase, int steps,
         int max_periods, double tolerance, int max_iterations, const Choice<Boundary>& boundary,
         const ProgressArgument& progress) {
        require_one(tangential_amplitude.has_value(), "tangential_amplitude",
                    tangential_force.has_value(), "tangential_force");
        const TangentialOscillation motion =
            tangential_force ? TangentialOscillation(TangentialForce{*tangential_force})
                             : TangentialOscillation(TangentialAmplitude{*tangential_amplitude});
        CycleOptions options{.friction_coefficient = friction_coefficient,
                             .steps = steps,
                             .max_periods = max_periods,
                             .stick = stick_options(tolerance, max_iterations, boundary)};
        return interruptible(progress, [&](Progress told) {
          options.on_progress = told;
          return simulated_joint_loss(
              boundary_element_pressures(Surface(surface.surface), material.pressed(),
                                         {.boundary = options.stick.boundary, .on_progress = told}),
              surface.surface.grid, material.pressed(), mean_indentation,
              {motion, normal_amplitude, phase}, options);
        });
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("mean_indentation"), nb::kw_only(),
      nb::arg("friction_coefficient"), nb::arg("tangential_amplitude") = nb::none(),
      nb::arg("tangential_force") = nb::none(), nb::arg("normal_amplitude") = 0.0,
      nb::arg("phase") = 0.0, nb::arg("steps") = 64, nb::arg("max_periods") = 20,
      nb::arg("tolerance") = 1e-8, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("progress") = false,
      R"(:func:`joint_loss` of a surface cell by cell: direct three-dimensional simulation by displacement (m) or by force (N).

Relaxation and slip are distinguished cell by cell; the exponent is NaN. The error of the steps is of second order: 2.5 %
of W with 16 steps.
)");
  define("simulate_coupled_cycle", std::type_identity<void(std::optional<double>)>{},
         "Like :func:`simulate_frictional_cycle`, with the coupling of normal and tangential "
         "directions "
         "(Dundurs' β): shows when the coupling can be neglected, as the paper does. "
         "coupling_constant: β/(πE*), 1/Pa, by default the material's.",
         nb::arg("coupling_constant") = nb::none());
}

void bind_quadrature(nb::module_& m) {
  described_class<IntervalQuadratureResult>(m, "IntervalQuadratureResult",
                                            "The loss of a cycle from a few contact sets.");
  m.def(
      "interval_quadrature",
      [](const BoundContactSets& contact_sets, const Material& material, const Oscillation& motion,
         double mean_indentation, int count, double direction, double tolerance, int max_iterations,
         const Choice<Boundary>& boundary, const ProgressArgument& progress) {
        cite({"popov2015"});
        IntervalQuadratureOptions options{.intervals = count, .direction = direction};
        options.stick = {.tolerance = tolerance,
                         .max_iterations = max_iterations,
                         .boundary = boundary.value("boundary")};
        return interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          return interval_quadrature(contact_sets.contact_sets, contact_sets.grid, material, motion,
                                     mean_indentation, options);
        });
      },
      nb::arg("contact_sets"), nb::arg("material"), nb::arg("motion"), nb::arg("mean_indentation"),
      nb::kw_only(), nb::arg("intervals") = 0, nb::arg("direction") = 0.0,
      nb::arg("tolerance") = 1e-5, nb::arg("max_iterations") = 1000,
      nb::arg("boundary") = "periodic", nb::arg("progress") = false,
      R"(Relaxation damping of a contact without stepping through the cycle: W = ½∮ s² dK_t by parts.

The integral uses Gauss–Legendre nodes in θ, δ(θ) = δ0 + u_z cosθ, and each node costs a normal contact, a stick and a punch solve.
intervals = 0: 16 for equal frequencies, 32 for drag.
)");
}

}  // namespace

void bind_cycle(nb::module_& m) {
  bind_contact_sets(m);
  bind_result(m);
  bind_simulations(m);
  bind_quadrature(m);
}

}  // namespace salebra::python
