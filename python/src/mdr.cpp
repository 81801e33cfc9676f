// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the method of dimensionality reduction.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/unique_ptr.h>

#include <memory>
#include <salebra/contact/mdr/mdr.hpp>

#include "bindings.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

using Profile = IndenterProfile;

void bind_profile(nb::module_& m) {
  nb::class_<Profile> profile(m, "IndenterProfile", nb::dynamic_attr(),
                              R"(An axisymmetric indenter z = f(r), f(0) = 0, and its image g(x).

.. math:: g(x) = |x|\int_0^{|x|}\frac{f'(r)\,dr}{\sqrt{x^2-r^2}} \quad\text{Eq. (3) of doi:10.1038/srep16189}

Methods take a radius or an array of radii, m, up to `max_radius`.
)");
  number_method(profile, "height", "r", &Profile::height, "f(r), m.");
  number_method(profile, "image", "x", &Profile::image, "g(x), m.");
  number_method(profile, "image_slope", "x", &Profile::image_slope,
                "g'(x): the c of the paper at the edge.");
  number_method(profile, "image_integral", "x", &Profile::image_integral, "∫_0^x g dx, m².");
  number_method(profile, "contact_radius", "indentation", &Profile::contact_radius,
                "a with g(a) = indentation, m.");
  described_property(profile, &Profile::flat_radius,
                     Kept{"flat_radius", "radius of the flat end", Dimension::length});
  described_property(profile, &Profile::max_radius,
                     Kept{"max_radius", "radius where the profile ends", Dimension::length});
  profile.def_prop_ro("has_side", &Profile::has_side,
                      "Whether the contact stops growing at max_radius.");

  const auto made_by = [&m](const char* name, auto make, const char* description,
                            auto... arguments) {
    m.def(
        name,
        [make](decltype(arguments, 0.0)... sizes) -> std::shared_ptr<Profile> {
          cite({"popov_hess2015"});
          return make(sizes...);
        },
        arguments..., description);
  };
  made_by("cone_profile", &cone_profile,
          "f = r tanθ: g = (π/2) tanθ x, Eqs (4), (5). angle: θ between flank and plane, rad.",
          nb::arg("angle"));
  made_by("paraboloid_profile", &paraboloid_profile, "f = r²/2R: g = x²/R. radius: R, m.",
          nb::arg("radius"));
  made_by("power_profile", &power_profile, "f = B rⁿ, n > 0: g = κ_n B xⁿ.", nb::arg("coefficient"),
          nb::arg("exponent"));
  made_by("sphere_profile", &sphere_profile,
          "f = R − √(R² − r²), exactly: g = x artanh(x/R). radius: R, m.", nb::arg("radius"));
  made_by("flat_punch_profile", &flat_punch_profile, "Cylinder with a flat end, m.",
          nb::arg("radius"));
  made_by("rounded_punch_profile", &rounded_punch_profile, "Flat end with rounded edge, m.",
          nb::arg("flat_radius"), nb::arg("edge_radius"));
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
  nb::class_<Law, ContactLaw> law(
      m, "IndenterLaw",
      R"(The contact of a profile with an elastic half-space, exact (method of dimensionality reduction).

.. math:: \delta = g(a),\quad F = 2E^*\int_0^a(\delta-g)\,dx,\quad K = 2E^*a,\quad F'' = 2E^*/g'(a),\quad K_t = \tfrac{G^*}{E^*}K

V. L. Popov, M. Heß, doi:10.1007/978-3-642-53876-6.

Parameters
----------
profile : IndenterProfile
material : Material
    Must have G*.
)");
  number_method(law, "contact_radius", "indentation", &Law::contact_radius, "a, m.");
  law.def(
         "__init__",
         [](Law* self, std::shared_ptr<Profile> profile, const Material& material) {
           new (self) Law(std::move(profile), material);
         },
         nb::arg("profile"), nb::arg("material"))
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
