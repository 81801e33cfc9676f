// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

/// Each function binds one module of the library. module.cpp calls them in the order of the layers,
/// from the lowest up, so that a signature can name every type of lower layers.
namespace salebra::python {

void bind_base(nanobind::module_& module);
void bind_generators(nanobind::module_& module);
void bind_shapes(nanobind::module_& module);
void bind_surface(nanobind::module_& module);
void bind_statistics(nanobind::module_& module);
void bind_files(nanobind::module_& module);
void bind_contact(nanobind::module_& module);
void bind_transport(nanobind::module_& module);
void bind_adhesion(nanobind::module_& module);
void bind_curve(nanobind::module_& module);
void bind_stick(nanobind::module_& module);
void bind_greenwood_williamson(nanobind::module_& module);
void bind_theories(nanobind::module_& module);
void bind_law(nanobind::module_& module);
void bind_mdr(nanobind::module_& module);
void bind_motion(nanobind::module_& module);
void bind_assumptions(nanobind::module_& module);
void bind_damping(nanobind::module_& module);
void bind_surface_damping(nanobind::module_& module);
void bind_trajectories(nanobind::module_& module);
void bind_slider(nanobind::module_& module);
void bind_viscoelastic(nanobind::module_& module);
void bind_damping_maps(nanobind::module_& module);
void bind_closed_form(nanobind::module_& module);
void bind_cycle(nanobind::module_& module);
void bind_study(nanobind::module_& module);
void bind_twin(nanobind::module_& module);
void bind_results(nanobind::module_& module);
void bind_values(nanobind::module_& module);
void bind_figures(nanobind::module_& module);

}  // namespace salebra::python
