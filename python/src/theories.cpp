// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the theories of contact area and mean gap.
#include <nanobind/stl/function.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/contact/theories.hpp>
#include <salebra/generators/spectrum.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/contact.hpp"
#include "interop/described.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

void bind_theories(nb::module_& m) {
  m.def(
      "bearing_area_fraction",
      [](const Numbers& mean_gap, double rms_height) {
        return for_each_number(mean_gap,
                               [&](double gap) { return bearing_area_fraction(gap, rms_height); });
      },
      nb::arg("mean_gap"), nb::arg("rms_height"),
      nb::sig("def bearing_area_fraction(mean_gap: numpy.typing.ArrayLike, rms_height: float) -> "
              "typing.Any"),
      "Fraction of a Gaussian surface above a plane, ½ erfc(ū/(√2 h_rms)), without deformation. "
      "Lengths "
      "in m.");
  m.def(
      "bgt_area_fraction",
      [](const Numbers& pressure, const MaterialArgument& material, double rms_slope) {
        const double contact_modulus = material.material().contact_modulus;
        cite({"bush_gibson_thomas1975"});
        return for_each_number(
            pressure, [&](double p) { return bgt_area_fraction(p, contact_modulus, rms_slope); });
      },
      nb::arg("pressure"), nb::arg("material"), nb::arg("rms_slope"),
      nb::sig("def bgt_area_fraction(pressure: numpy.typing.ArrayLike, material: Material | float, "
              "rms_slope: float) -> typing.Any"),
      "Bush, Gibson and Thomas, doi:10.1016/0043-1648(75)90145-3: A/A0 = √(2π) p/(E*h'), the limit "
      "of small pressures (Pa).");
  m.def(
      "persson_area_fraction",
      [](const Numbers& pressure, const MaterialArgument& material, double rms_slope) {
        const double contact_modulus = material.material().contact_modulus;
        cite({"persson2001"});
        return for_each_number(pressure, [&](double p) {
          return persson_area_fraction(p, contact_modulus, rms_slope);
        });
      },
      nb::arg("pressure"), nb::arg("material"), nb::arg("rms_slope"),
      nb::sig(
          "def persson_area_fraction(pressure: numpy.typing.ArrayLike, material: Material | float, "
          "rms_slope: float) -> typing.Any"),
      "Persson, doi:10.1063/1.1388626: A/A0 = erf(√2 p/(E*h')), with slope √(8/π) at small "
      "pressures "
      "(Pa).");

  described_class<RoughnessShell>(m, "RoughnessShell", "A narrow ring of a spectrum.")
      .def(
          "__init__",
          [](RoughnessShell* self, double wavenumber, double power) {
            new (self) RoughnessShell{wavenumber, power};
          },
          nb::arg("wavenumber"), nb::arg("power"));
  m.def(
      "roughness_shells",
      [](const IsotropicSpectrum& spectrum, double lowest, double highest, int count) {
        return roughness_shells([&](double q) { return spectrum.radial_density(q); }, lowest,
                                highest, count);
      },
      nb::arg("spectrum"), nb::arg("lowest"), nb::arg("highest"), nb::arg("count") = 1000,
      "Divides an isotropic spectrum between two wave numbers, rad/m, into `count` shells of equal "
      "ratio.");

  described_class<PerssonTheory::Asymptote>(
      m, "PerssonAsymptote", "p = factor·E*·exp(−ū/decay_length), the limit of small pressures.");
  nb::class_<PerssonTheory> persson(m, "PerssonTheory", nb::dynamic_attr(),
                                    R"(Mean gap and stiffness by Persson's theory.

.. math:: \bar u(p) = \sqrt\pi\int q^2Cw\int_p^\infty[\gamma+3(1-\gamma)P^2]\,e^{-(wp'/E^*)^2}\frac{dp'}{p'}\,dq

with P(q) = erf(w p/E*), w⁻² = π∫^q q³C dq: doi:10.1103/PhysRevLett.99.125502, doi:10.1088/0953-8984/20/21/215214.

Parameters
----------
shells : list of RoughnessShell
material : Material or float
    A number is E*, Pa.
energy_factor : float
    γ in (0, 1]: 0.4 to 0.5 agrees with simulations.
)");
  persson
      .def(
          "__init__",
          [](PerssonTheory* self, std::vector<RoughnessShell> shells,
             const MaterialArgument& material, double energy_factor) {
            cite({"persson2001", "persson2007", "yang_persson2008"});
            new (self) PerssonTheory(std::move(shells), material.material().contact_modulus,
                                     energy_factor);
          },
          nb::arg("shells"), nb::arg("material"),
          nb::arg("energy_factor") = PerssonTheory::usual_energy_factor)
      .def_prop_ro("asymptote", &PerssonTheory::asymptote, "The limit of small pressures.")
      .def_prop_ro("rms_height", &PerssonTheory::rms_height, "Rms height, m.")
      .def_prop_ro("rms_slope", &PerssonTheory::rms_slope);
  number_method(persson, "mean_gap", "pressure", &PerssonTheory::mean_gap, "ū, m.");
  number_method(persson, "stiffness_per_area", "pressure", &PerssonTheory::stiffness_per_area,
                "K/A0 = −dp/dū, Pa/m.");
  number_method(persson, "contact_area_fraction", "pressure", &PerssonTheory::contact_area_fraction,
                "A/A0.");
  number_method(persson, "pressure", "mean_gap", &PerssonTheory::pressure,
                "The inverse of mean_gap, for ū > 0, Pa.");
  m.def(
      "persson_curve",
      [](const PerssonTheory& theory, const Material& material, double nominal_area,
         const Values& pressures) {
        return persson_curve(theory, material, nominal_area, pressures.values);
      },
      nb::arg("theory"), nb::arg("material"), nb::arg("nominal_area"), nb::arg("pressures"),
      "Force curve at the given pressures (> 0, Pa), lowest first; K_t = (G*/E*)K if G* is known. "
      "nominal_area in m².");
}

}  // namespace salebra::python
