// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the closed-form losses.
#include <nanobind/stl/function.h>
#include <nanobind/stl/variant.h>

#include <salebra/damping/closed_form.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

namespace cf = closed_form;

void bind_closed_form(nb::module_& parent) {
  nb::module_ m = parent.def_submodule("_closed_form");
  m.def("edge_slope", &cf::edge_slope, nb::arg("contact_modulus"), nb::arg("force_curvature"),
        "Eq. (6): slope c = 2E*/F'' of the one-dimensional profile at the edge of the contact.");
  m.def(
      "released_distance",
      [](double spring_depth, const Oscillation& motion) {
        return std::visit([&](const auto& one) { return cf::released_distance(spring_depth, one); },
                          motion);
      },
      nb::arg("spring_depth"), nb::arg("motion"),
      R"(Distance, m, by which a spring at `spring_depth` (m) is released; valid at any amplitude.

.. math:: s = 2u_x\sqrt{1-(z_0/u_z)^2}\,\sin\varphi_0 \;\text{Eq. (7)}, \qquad s = 2(v/\omega)\arccos(z_0/u_z) \;\text{Eq. (13)}
)");
  m.def("spring_energy", &cf::spring_energy, nb::arg("tangential_modulus"),
        nb::arg("released_distance"), nb::arg("spring_width"),
        "Eq. (8): energy ½G*s²Δx of one spring, J.");
  m.def("intermittent_contact", &cf::intermittent_contact, nb::arg("spring_depth"),
        nb::arg("normal_amplitude"),
        "Eq. (9): ``−|u_z| < z0 < |u_z|``, whether a point is in contact during only a part of the "
        "cycle.");
  m.def(
      "work_per_cycle_by_slope",
      [](double tangential_modulus, double edge_slope, const Oscillation& motion) {
        cite({"popov2015"});
        return std::visit(
            [&](const auto& one) {
              return cf::work_per_cycle_by_slope(tangential_modulus, edge_slope, one);
            },
            motion);
      },
      nb::arg("tangential_modulus"), nb::arg("edge_slope"), nb::arg("motion"),
      R"(Energy lost per cycle, J, by the slope c of the profile at the edge.

.. math:: W = \tfrac{16}{3}\tfrac{G^*}{c}u_x^2|u_z|\sin^2\varphi_0 \;\text{Eq. (11)}, \qquad
          W = 4(\pi^2-4)\tfrac{G^*}{c}|u_z|(v/\omega)^2 \;\text{Eq. (14)}
)");
  m.def(
      "work_per_cycle_by_quadrature",
      [](double tangential_modulus, double edge_slope, double normal_amplitude,
         const std::function<double(double)>& released_distance) {
        cite({"popov2015"});
        return cf::work_per_cycle(tangential_modulus, edge_slope, normal_amplitude,
                                  released_distance);
      },
      nb::arg("tangential_modulus"), nb::arg("edge_slope"), nb::arg("normal_amplitude"),
      nb::arg("released_distance"),
      "Eq. (10): W = (G*/c) ∫ s² dz0 over the interval of Eq. (9), both edges of the contact, by "
      "adaptive quadrature, J. "
      "released_distance: a function of the spring depth.");
  m.def(
      "work_per_cycle",
      [](double modulus_ratio, double force_curvature, const Oscillation& motion) {
        cite({"popov2015"});
        return std::visit(
            [&](const auto& one) {
              return cf::work_per_cycle(modulus_ratio, force_curvature, one);
            },
            motion);
      },
      nb::arg("modulus_ratio"), nb::arg("force_curvature"), nb::arg("motion"),
      R"(Energy lost per cycle, J, in the limit u_z → 0 of every contact with K_t = (G*/E*)K; exact for F'' = const (the cone).

.. math:: W = \tfrac83\tfrac{G^*}{E^*}F''u_x^2|u_z|\sin^2\varphi_0 \;\text{Eq. (12)}, \qquad
          W = 2(\pi^2-4)\tfrac{G^*}{E^*}F''|u_z|(v/\omega)^2 \;\text{Eq. (15)}
)");
  m.def(
      "work_per_cycle_rough",
      [](double modulus_ratio, double force, double decay_length, const Drag& motion) {
        cite({"popov2015"});
        return cf::work_per_cycle_rough(modulus_ratio, force, decay_length, motion);
      },
      nb::arg("modulus_ratio"), nb::arg("force"), nb::arg("decay_length"), nb::arg("motion"),
      R"(Eq. (16): energy lost per normal cycle by a nominally flat rough contact in slow tangential oscillation, J.

.. math:: W = 2(\pi^2-4)\tfrac{G^*}{E^*}\tfrac{F}{l^2}|u_z|(v/\omega)^2

Valid where F ∝ exp(−ū/l) holds over the sweep and u_z ≪ l.

Parameters
----------
modulus_ratio : float
    G*/E*.
force : float
    F, N.
decay_length : float
    l, m.
motion : Drag
)");
  m.def("power", &cf::power, nb::arg("work_per_cycle"), nb::arg("motion"),
        "P = Wω/2π, W. NaN where ω is not known.");
  m.def("damping_constant", &cf::damping_constant, nb::arg("work_per_cycle"), nb::arg("motion"),
        "γ = P/⟨ẋ²⟩ of the equivalent viscous damper, N s/m: P/v² in case (b), 2P/(u_x ω)² in case "
        "(a).");
  m.def(
      "work_per_cycle_exponential", &cf::work_per_cycle_exponential, nb::arg("modulus_ratio"),
      nb::arg("reference_force"), nb::arg("decay_length"), nb::arg("motion"),
      R"(Finite amplitude, F = F0 exp(δ/l), mean indentation held; k = u_z/l, relative accuracy about 1e-14; J.

.. math:: W_a = 8\tfrac{G^*}{E^*}\tfrac{F_0}{l^2}u_x^2u_z\sin^2\varphi_0\,\frac{k\cosh k-\sinh k}{k^3}, \qquad
          W_b = 2\tfrac{G^*}{E^*}\tfrac{F_0}{l^2}u_z(v/\omega)^2J(k)
)");
  m.def("work_per_cycle_exponential_held_force", &cf::work_per_cycle_exponential_held_force,
        nb::arg("modulus_ratio"), nb::arg("mean_force"), nb::arg("decay_length"), nb::arg("motion"),
        "The same with the mean force held (a dead weight): F0 = mean_force/I_0(k); J.");
  m.def("indentation_shift_at_held_force", &cf::indentation_shift_at_held_force,
        nb::arg("normal_amplitude"), nb::arg("decay_length"),
        "Change of the mean indentation, −l ln I_0(k), under a dead weight, m.");
  m.def("work_per_cycle_force_controlled", &cf::work_per_cycle_force_controlled,
        nb::arg("modulus_ratio"), nb::arg("force_amplitude"), nb::arg("decay_length"),
        nb::arg("motion"),
        "Force-controlled normal oscillation on the exponential law: Eqs (12), (15) with F''u_z → "
        "F_a/l, exact at every F_a; J.");
  m.def("equal_frequency_ratio_scaled", &cf::equal_frequency_ratio_scaled, nb::arg("k"),
        "e^{−k}·3(k cosh k − sinh k)/k³.");
  m.def("drag_integral_scaled", &cf::drag_integral_scaled, nb::arg("k"),
        "e^{−k} J(k), J(k) = ∫_0^π θ² sinθ e^{k cosθ} dθ, J(0) = π² − 4.");
  m.def("mean_force_ratio_scaled", &cf::mean_force_ratio_scaled, nb::arg("k"), "e^{−k} I_0(k).");
  m.def("frequency_ratio_integral", &cf::frequency_ratio_integral, nb::arg("ratio"),
        "I(r) = 1 − (1 + cos 2πr)/(2(1 − 4r²)) of two frequencies, r = ω_x/ω_z.");
  m.def("frequency_ratio_phase_sum", &cf::frequency_ratio_phase_sum, nb::arg("normal_cycles"),
        nb::arg("phase"), "S for r = q/p in lowest terms: p sin²φ0 for p <= 2, p/2 otherwise.");
}

}  // namespace salebra::python
