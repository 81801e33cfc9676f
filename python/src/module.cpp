// SPDX-License-Identifier: GPL-3.0-or-later
// Module salebra._core: calls the bindings of each module in turn.
#include "bindings.hpp"
#include "confinement/confinement.hpp"

NB_MODULE(_core, m) {
  m.doc() = "The C++ library salebra. Import `salebra`, which has everything that is here.";
  using namespace salebra::python;
  salebra::confinement::install();
  nanobind::module_::import_("numpy");  // imported now, and not in the first call that needs it
  bind_base(m);
  bind_surface(m);
  bind_generators(m);
  bind_shapes(m);
  bind_statistics(m);
  bind_contact(m);
  bind_transport(m);
  bind_curve(m);
  bind_files(m);
  bind_law(m);
  bind_stick(m);
  bind_greenwood_williamson(m);
  bind_theories(m);
  bind_mdr(m);
  bind_adhesion(m);
  bind_motion(m);
  bind_assumptions(m);
  bind_damping(m);
  bind_surface_damping(m);
  bind_trajectories(m);
  bind_slider(m);
  bind_viscoelastic(m);
  bind_damping_maps(m);
  bind_closed_form(m);
  bind_cycle(m);
  bind_study(m);
  bind_twin(m);
  bind_results(m);
  bind_values(m);
  bind_figures(m);
}
