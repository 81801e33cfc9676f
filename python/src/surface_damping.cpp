// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the damping of one surface with its error.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <salebra/analysis/damping.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <utility>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/damping.hpp"
#include "interop/described.hpp"
#include "interop/direction.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

/// The losses of a solution over the pressure, with their assumptions.
BoundDampingCurve curve_of(const DampingSolution& solution, const std::vector<double>& pressures) {
  BoundDampingCurve curve{"pressure", {}, {}};
  for (std::size_t i = 0; i < solution.results.size(); ++i) {
    curve.values.push_back(pressures[i % pressures.size()]);
    curve.results.push_back({solution.results[i], solution.assumptions[i], {}});
  }
  return curve;
}

/// The losses at the loads of a curve over the pressure, without assumptions.
BoundDampingCurve curve_of(const std::vector<SurfaceDamping>& losses, const ForceCurve& loads,
                           const Oscillation& motion) {
  BoundDampingCurve curve{"pressure", loads.column(&ForceSample::pressure), {}};
  for (std::size_t k = 0; k < losses.size(); ++k) {
    const ForceSample& load = loads.samples[k];
    DampingResult result;
    static_cast<Loss&>(result) = losses[k];
    result.power = closed_form::power(result.work_per_cycle, motion);
    result.normal_stiffness = load.normal_stiffness;
    result.tangential_stiffness = load.tangential_stiffness;
    result.force = load.force;
    result.indentation = load.indentation;
    result.mean_force = losses[k].mean_force;
    result.max_force = losses[k].max_force;
    result.contact_time = losses[k].contact_time;
    result.hold = losses[k].hold;
    result.error_estimate = losses[k].work_per_cycle_error();
    result.converged = losses[k].converged;
    result.direction = load.direction;
    curve.results.push_back({result, {}, {}});
  }
  return curve;
}

}  // namespace

void bind_surface_damping(nb::module_& m) {
  m.def(
      "surface_damping",
      [](const BoundSurface& surface, const std::variant<Material, Body>& material,
         const std::variant<EqualFrequency, Drag>& motion, const ForceCurve* curve,
         const std::optional<Values>& pressures, const ContactParameters* parameters,
         const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
         const Choice<Boundary>& boundary, double relative_error,
         const std::optional<Choice<SeamCheck>>& seam, double friction_coefficient,
         double excursion, const std::variant<double, std::string>& direction,
         const ProgressArgument& progress) {
        cite({"popov2015"});
        const DirectionChoice chosen = direction_of(direction);
        require_that(!curve || chosen == DirectionChoice(LayDirection::automatic), "direction",
                     "given with a `curve`, which has the direction of its K_t; leave it out");
        require_one(curve != nullptr, "curve", pressures.has_value(), "pressures");
        ContactParameters all = known(parameters);
        const auto take = [](double& parameter, double given, const char* name) {
          if (std::isnan(given)) return;
          require(std::isnan(parameter) || parameter == given, name, given,
                  "differs from that of `parameters`; give one of them");
          parameter = given;
        };
        take(all.friction_coefficient, friction_coefficient, "friction_coefficient");
        take(all.excursion, excursion, "excursion");
        const Motion described = motion_of(oscillation(motion));
        warn_of_unknown(described, &all);
        SurfaceDampingOptions options{.hold = hold.value("hold"),
                                      .amplitude = amplitude.value("amplitude"),
                                      .boundary = boundary.value("boundary"),
                                      .relative_error = relative_error,
                                      .friction_coefficient = all.friction_coefficient,
                                      .excursion = all.excursion};
        if (seam) options.seam = seam->value("seam");
        require_that(curve || options.boundary == Boundary::periodic, "boundary",
                     "'free' needs a `curve` that was swept so; give it in place of `pressures`");
        const Body body = std::visit([](const auto& one) { return Body(one); }, material);
        if (curve)
          return interruptible(
              progress,
              [&](Progress told) {
                options.on_progress = std::move(told);
                return curve_of(
                    surface_damping(surface.surface, body, oscillation(motion), *curve, options),
                    *curve, oscillation(motion));
              },
              surface.surface.communicator);
        std::vector<std::string> warnings;
        BoundDampingCurve found = interruptible(
            progress,
            [&](Progress told) {
              SurfaceContact contact{.surface = surface.surface,
                                     .body = body,
                                     .pressure = pressures->values,
                                     .direction = chosen};
              if (!std::isnan(all.hardness)) contact.hardness = all.hardness;
              const DampingSolution solution = solve(DampingProblem{.contact = std::move(contact),
                                                                    .motions = {described},
                                                                    .hold = options.hold,
                                                                    .amplitude = options.amplitude,
                                                                    .parameters = all,
                                                                    .surface = options},
                                                     {.on_progress = std::move(told)});
              warnings = solution.contact.warnings;
              warnings.insert(warnings.end(), solution.warnings.begin(), solution.warnings.end());
              return curve_of(solution, pressures->values);
            },
            surface.surface.communicator);
        for (const std::string& warning : warnings) warn_user(warning);
        return found;
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("motion"), nb::arg("curve") = nb::none(),
      nb::kw_only(), nb::arg("pressures") = nb::none(), nb::arg("parameters") = nb::none(),
      nb::arg("hold") = "auto", nb::arg("amplitude") = "finite", nb::arg("boundary") = "periodic",
      nb::arg("relative_error") = 0.0, nb::arg("seam") = nb::none(),
      nb::arg("friction_coefficient") = Loss::unknown, nb::arg("excursion") = Loss::unknown,
      nb::arg("direction") = "auto", nb::arg("progress") = false,
      R"(Damping of one surface at each pressure, from contacts within the oscillation, with its error.

Nothing is interpolated between loads. Cells are halved once to estimate their error; with relative_error > 0 they are halved further
while the error is above this fraction of W. If the surface is distributed over processes, the first process refines it.

Parameters
----------
surface : Surface
material : Material or Body
    A body other than a half-space needs a `curve` with K_t of stick solves. If cells leave while the bodies approach, and their share
    exceeds the relative error, there is no loss.
motion : EqualFrequency or Drag
curve : ForceCurve, optional
    Curve of this surface and material by sweep_pressures(), whose loads are used. Assumptions are then not judged. If the curve has K_t of
    stick solves, the contacts have it too.
pressures : float or array, optional
    Nominal pressures, Pa, instead of a curve; a curve is then swept about each.
parameters : ContactParameters, optional
    Friction, hardness, density and the like. With a coefficient of friction the loss includes slip; with a hardness the surface is first
    loaded plastically; all of them are used to judge the assumptions.
hold : {"auto", "force", "indentation"}
    What the oscillation keeps at all loads; "auto": the mean force if the contact lifts off at the lowest load.
amplitude : {"finite", "small"}
boundary : {"periodic", "free"}
    Boundary of the curve; `pressures` use "periodic".
relative_error : float
    Goal for the error as a fraction of W; 0: none.
seam : {"window", "free"}, optional
    Solve once more without the seam of a surface that is not periodic, and count the change as an error.
friction_coefficient : float
    As in `parameters`; NaN: infinite, no slip.
excursion : float
    Distance between the turning points of a Drag, m, as in `parameters`; required for a Drag with friction.
direction : float or str
    Direction of the tangential motion: an angle from the x axis, rad or with a unit such as "30deg", or "across", "along" or "both" for the
    lay of the surface. "auto": "both" if the surface has a lay, otherwise along x. With both, all pressures across the lay come first.

Returns
-------
DampingCurve
    A sequence of DampingResult in the order of the loads, with an array for each number: ``found.damping_constant``,
    ``found.damping_constant_error``, ``found.damping_constant_without_slip``, ``found.regime``, ``found.direction``.
)");
}

}  // namespace salebra::python
