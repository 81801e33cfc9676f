// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the method of dimensionality reduction.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/unique_ptr.h>

#include <memory>
#include <salebra/contact/mdr/mdr.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

using Profile = IndenterProfile;
using Evaluation = double (Profile::*)(double) const;

std::shared_ptr<Profile> shared(std::unique_ptr<Profile> profile) {
  cite({"popov_hess2015"});
  return profile;
}

void bind_profile(nb::module_& m) {
  nb::class_<Profile> profile(m, "IndenterProfile", nb::dynamic_attr(),
                              R"(An axisymmetric indenter z = f(r), f(0) = 0, and its image g(x).

.. math:: g(x) = |x|\int_0^{|x|}\frac{f'(r)\,dr}{\sqrt{x^2-r^2}} \quad\text{Eq. (3) of doi:10.1038/srep16189}

Functions take a number or an array of radii, m, up to `largest_radius`.
)");
  const auto evaluation = [&](const char* name, const char* argument, Evaluation function,
                              const char* signature, const char* description) {
    profile.def(
        name,
        [function](const Profile& self, const Numbers& numbers) {
          return for_each_number(numbers, [&](double value) { return (self.*function)(value); });
        },
        nb::arg(argument), nb::sig(signature), description);
  };
  evaluation("height", "r", &Profile::height,
             "def height(self, r: numpy.typing.ArrayLike) -> typing.Any", "f(r), m.");
  evaluation("image", "x", &Profile::image,
             "def image(self, x: numpy.typing.ArrayLike) -> typing.Any", "g(x), m.");
  evaluation("image_slope", "x", &Profile::image_slope,
             "def image_slope(self, x: numpy.typing.ArrayLike) -> typing.Any",
             "g'(x): the c of the paper at the edge.");
  evaluation("image_integral", "x", &Profile::image_integral,
             "def image_integral(self, x: numpy.typing.ArrayLike) -> typing.Any",
             "∫_0^x g dx, m².");
  evaluation("contact_radius", "indentation", &Profile::contact_radius,
             "def contact_radius(self, indentation: numpy.typing.ArrayLike) -> typing.Any",
             "a with g(a) = indentation, m.");
  profile.def_prop_ro("flat_radius", &Profile::flat_radius, "Radius of the flat end, m.")
      .def_prop_ro("largest_radius", &Profile::largest_radius, "Where the profile ends, m.")
      .def_prop_ro("has_side", &Profile::has_side,
                   "Whether the contact stops growing at largest_radius.");

  m.def(
      "cone_profile", [](double angle) { return shared(cone_profile(angle)); }, nb::arg("angle"),
      "f = r tanθ: g = (π/2) tanθ x, Eqs (4), (5). angle: θ between flank and plane, rad.");
  m.def(
      "paraboloid_profile", [](double radius) { return shared(paraboloid_profile(radius)); },
      nb::arg("radius"), "f = r²/2R: g = x²/R. radius: R, m.");
  m.def(
      "power_profile",
      [](double coefficient, double exponent) {
        return shared(power_profile(coefficient, exponent));
      },
      nb::arg("coefficient"), nb::arg("exponent"), "f = B rⁿ, n > 0: g = κ_n B xⁿ.");
  m.def(
      "sphere_profile", [](double radius) { return shared(sphere_profile(radius)); },
      nb::arg("radius"), "f = R − √(R² − r²), exactly: g = x artanh(x/R). radius: R, m.");
  m.def(
      "flat_punch_profile", [](double radius) { return shared(flat_punch_profile(radius)); },
      nb::arg("radius"), "Cylinder with a flat end, m.");
  m.def(
      "rounded_punch_profile",
      [](double flat_radius, double edge_radius) {
        return shared(rounded_punch_profile(flat_radius, edge_radius));
      },
      nb::arg("flat_radius"), nb::arg("edge_radius"), "Flat end with rounded edge, m.");
  nb::class_<TabulatedProfile, Profile>(m, "TabulatedProfile",
                                        "A profile measured or computed at radii: f between them "
                                        "by a monotone cubic, its image by exact quadrature.\n\n"
                                        "radii: from 0, strictly increasing, m, at least seven; "
                                        "heights: rising from their first value, m.")
      .def(
          "__init__",
          [](TabulatedProfile* self, Values radii, Values heights) {
            cite({"popov_hess2015"});
            new (self) TabulatedProfile(std::move(radii.values), std::move(heights.values));
          },
          nb::arg("radii"), nb::arg("heights"))
      .def("image_error", &TabulatedProfile::image_error, nb::arg("x"),
           "Relative change of g(x) when every other point is left out: an upper estimate of the "
           "interpolation error.");
}

}  // namespace

void bind_mdr(nb::module_& m) {
  bind_profile(m);
  using Law = IndenterLaw;
  nb::class_<Law, ContactLaw>(
      m, "IndenterLaw",
      R"(The contact of a profile with an elastic half-space, exact (method of dimensionality reduction).

.. math:: \delta = g(a),\quad F = 2E^*\int_0^a(\delta-g)\,dx,\quad K = 2E^*a,\quad F'' = 2E^*/g'(a),\quad K_t = \tfrac{G^*}{E^*}K

V. L. Popov, M. Heß, doi:10.1007/978-3-642-53876-6.

Parameters
----------
profile : IndenterProfile
material : Material
    With G*.
)")
      .def(
          "__init__",
          [](Law* self, std::shared_ptr<Profile> profile, const Material& material) {
            new (self) Law(std::move(profile), material);
          },
          nb::arg("profile"), nb::arg("material"))
      .def(
          "contact_radius",
          [](const Law& self, const Numbers& indentation) {
            return for_each_number(indentation,
                                   [&](double value) { return self.contact_radius(value); });
          },
          nb::arg("indentation"),
          nb::sig("def contact_radius(self, indentation: numpy.typing.ArrayLike) -> typing.Any"),
          "a, m.")
      .def(
          "pressure",
          [](const Law& self, double indentation, const Numbers& r) {
            return for_each_number(r,
                                   [&](double value) { return self.pressure(indentation, value); });
          },
          nb::arg("indentation"), nb::arg("r"),
          nb::sig(
              "def pressure(self, indentation: float, r: numpy.typing.ArrayLike) -> typing.Any"),
          "p(r) under the indenter, Pa; infinite at the edge of a flat end.")
      .def(
          "surface_displacement",
          [](const Law& self, double indentation, const Numbers& r) {
            return for_each_number(
                r, [&](double value) { return self.surface_displacement(indentation, value); });
          },
          nb::arg("indentation"), nb::arg("r"),
          nb::sig("def surface_displacement(self, indentation: float, r: numpy.typing.ArrayLike) "
                  "-> typing.Any"),
          "Normal displacement of the half-space's surface, m.")
      .def_prop_ro("contact_modulus", &Law::contact_modulus, "E*, Pa.");
}

}  // namespace salebra::python
