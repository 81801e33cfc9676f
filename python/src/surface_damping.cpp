// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the damping of one surface with its error, and of a surface on finer cells.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <salebra/damping/surface_damping.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/cycle_motion.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

void bind_surface_damping(nb::module_& m) {
  described_class<SurfaceDamping>(
      m, "SurfaceDamping", "Damping of one surface at one load, with its error; NaN is unknown.");
  m.def(
      "surface_damping",
      [](const BoundSurface& surface, const Material& material,
         const std::variant<EqualFrequency, Drag>& motion, const ForceCurve& curve,
         const Choice<Hold>& hold, const Choice<Amplitude>& amplitude,
         const Choice<Boundary>& boundary, double relative_error,
         const std::optional<Choice<SeamCheck>>& seam, double friction_coefficient,
         double excursion, const ProgressArgument& progress) {
        cite({"popov2015"});
        SurfaceDampingOptions options{.hold = hold.value("hold"),
                                      .amplitude = amplitude.value("amplitude"),
                                      .boundary = boundary.value("boundary"),
                                      .relative_error = relative_error,
                                      .friction_coefficient = friction_coefficient,
                                      .excursion = excursion};
        if (seam) options.seam = seam->value("seam");
        return interruptible(
            progress,
            [&](Progress told) {
              options.on_progress = std::move(told);
              return surface_damping(surface.surface, material, oscillation(motion), curve,
                                     options);
            },
            surface.surface.ranks);
      },
      nb::arg("surface"), nb::arg("material"), nb::arg("motion"), nb::arg("curve"), nb::kw_only(),
      nb::arg("hold") = "indentation", nb::arg("amplitude") = "finite",
      nb::arg("boundary") = "periodic", nb::arg("relative_error") = 0.0,
      nb::arg("seam") = nb::none(), nb::arg("friction_coefficient") = SurfaceDamping::unknown,
      nb::arg("excursion") = SurfaceDamping::unknown, nb::arg("progress") = false,
      R"(Relaxation damping of one surface at each load of its curve, from contacts inside the oscillation, with its error.

Nothing is interpolated between loads. The cells are halved once, which gives their error; relative_error > 0 halves them further
where the error is above this part of W. A surface that is spread over processes is refined whole by the first of them.

Parameters
----------
surface : Surface
material : Material
motion : EqualFrequency or Drag
curve : ForceCurve
    Of this surface and material, by sweep_pressures(); its loads are the loads of the answer. Where it has K_t of stick solves, so have the contacts.
hold : {"indentation", "force"}
amplitude : {"finite", "small"}
boundary : {"periodic", "free"}
relative_error : float
    0, or the part of W that the error is to be below.
seam : {"window", "free"}, optional
    Solves once more without the seam of a surface that is not periodic, and counts the change as an error.
friction_coefficient : float
    With it relaxation_work and slip_work are the loss with slip, and work_with_slip_error is their error; NaN: they are unknown.
excursion : float
    Between the turning points of a Drag; without it its slip is not followed.

Returns
-------
list of SurfaceDamping
    In the order of the loads.
)");
}

}  // namespace salebra::python
