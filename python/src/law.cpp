// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of contact laws.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/law/roughness_law.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/export/deck.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

void bind_law(nb::module_& m) {
  nb::class_<ContactLaw> law(
      m, "ContactLaw", nb::dynamic_attr(),
      R"(Force–indentation law of a contact: the only input of the contact to the damping problem.

The indentation δ increases as the bodies approach. Methods take a number or an array and return the same shape. Above
highest_indentation they raise InvalidInput; below first_touch they return 0.
)");
  number_method(law, "force", "indentation", &ContactLaw::force, "F(δ), N.");
  number_method(law, "normal_stiffness", "indentation", &ContactLaw::normal_stiffness,
                "K = F', N/m.");
  number_method(law, "force_curvature", "indentation", &ContactLaw::force_curvature,
                "K' = F'', N/m².");
  number_method(law, "tangential_stiffness", "indentation", &ContactLaw::tangential_stiffness,
                "K_t, N/m: (G*/E*)K unless the law has its own K_t.");
  number_method(law, "tangential_curvature", "indentation", &ContactLaw::tangential_curvature,
                "K_t', N/m².");
  number_method(
      law, "indentation_of", "force", &ContactLaw::indentation_of,
      "δ with F(δ) = force > 0, m; raises InvalidInput if the law does not reach that force.");
  const auto length = [&law](auto member, const char* name, const char* meaning) {
    described_property(law, member, Kept{name, meaning, Dimension::length});
  };
  length(&ContactLaw::first_touch, "first_touch",
         "where the bodies touch first; −∞ for a law with a force at every indentation");
  length(&ContactLaw::lowest_indentation, "lowest_indentation",
         "where the samples of a table begin; −∞ for other laws");
  length(&ContactLaw::highest_indentation, "highest_indentation", "+∞ unless the law is a table");
  length(&ContactLaw::break_points, "break_points",
         "indentations at which F, K, K_t or a first derivative jumps");
  law.def_prop_ro("modulus_ratio", &ContactLaw::modulus_ratio, "G*/E*.")
      .def(
          "export",
          [](const ContactLaw& self, const Choice<DeckFormat>& format,
             std::optional<double> indentation, double nominal_area, double friction_coefficient,
             const std::string& units, std::optional<std::pair<double, double>> pressure_window,
             int rows, int sliders, double min_force, const std::string& name,
             const std::string& source, const std::vector<double>& conductivity,
             double contact_modulus) {
            require_that(format.value("format") != DeckFormat::fmu, "format",
                         "fmu is an archive, which only the program writes");
            // A pointer that does not own the law, which outlives this call.
            const std::shared_ptr<const ContactLaw> alias(std::shared_ptr<void>(), &self);
            const DeckProblem problem{.contacts = {deck_contact(alias, indentation)},
                                      .format = format.value("format"),
                                      .units = parse_unit_system(units),
                                      .friction_coefficient = friction_coefficient,
                                      .nominal_area = nominal_area,
                                      .pressure_window = pressure_window,
                                      .rows = rows,
                                      .sliders = sliders,
                                      .min_force = min_force,
                                      .name = name,
                                      .conductivity = conductivity,
                                      .contact_modulus = contact_modulus,
                                      .source = source};
            return unlocked([&] { return solve(problem).text; });
          },
          nb::arg("format"), nb::kw_only(), nb::arg("indentation") = nb::none(),
          nb::arg("nominal_area") = DeckContact::unknown,
          nb::arg("friction_coefficient") = DeckContact::unknown, nb::arg("units") = "m,kg,s",
          nb::arg("pressure_window") = nb::none(), nb::arg("rows") = 200, nb::arg("sliders") = 200,
          nb::arg("min_force") = 0.01, nb::arg("name") = "contact", nb::arg("source") = "",
          nb::arg("conductivity") = std::vector<double>{},
          nb::arg("contact_modulus") = DeckContact::unknown,
          R"(Returns the law as input of another program: the text of a deck.

Parameters
----------
format : {"csv", "json", "calculix", "abaqus", "ansys", "code_aster", "moose", "elmer", "jenkins", "c_header"}
    "jenkins": sliders in parallel, Iwan's model; "c_header": `ContactElement` without dependencies.
indentation : float, optional
    Indentation at which friction and sliders are computed, m; 0 by default for an exponential law. A law without a table is exported
    from a thousandth to ten times the force there.
nominal_area : float
    Area, m², that converts force to pressure; not for sliders.
friction_coefficient : float
    Needed for decks with friction and for sliders.
units : str
    Units of length, mass and time in the other program, such as "mm,t,s".
pressure_window : (float, float), optional
    Nominal pressures of a table, Pa.
rows, sliders : int
    Number of rows and sliders; in a C header `sliders` is the number of springs.
min_force : float
    T/(μF) above which the loss of the sliders is correct to 1 %.
name : str
    Prefix of every name in a C header.
source : str
    Source of the law, for the header.
conductivity : sequence of float
    Thermal conductivity of the bodies, W/(m K), one value for both or one for each: adds the conductance over the pressure.
contact_modulus : float
    E*, Pa, which the conductance needs.

Returns
-------
str

Raises
------
InvalidInput
    If the law is not convex, or if an argument is missing that the format needs.
)");

  nb::class_<PowerLaw, ContactLaw>(
      m, "PowerLaw",
      "F = B δⁿ for δ > 0, 0 below: cone n = 2, paraboloid n = 3/2, profile r^m n = 1 + 1/m.\n\n"
      "coefficient: B, N/mⁿ; modulus_ratio: G*/E*.")
      .def(nb::init<double, double, double>(), nb::arg("coefficient"), nb::arg("exponent"),
           nb::arg("modulus_ratio"))
      .def_prop_ro("coefficient", &PowerLaw::coefficient, "B, N/mⁿ.")
      .def_prop_ro("exponent", &PowerLaw::exponent, "n.");
  nb::class_<ExponentialLaw, ContactLaw>(
      m, "ExponentialLaw",
      "F = F0 exp(δ/l), where δ = 0 at F = F0: the law of nominally flat rough surfaces, F ∝ "
      "exp(−ū/l).\n\n"
      "reference_force: F0, N; decay_length: l, m; modulus_ratio: G*/E*.")
      .def(nb::init<double, double, double>(), nb::arg("reference_force"), nb::arg("decay_length"),
           nb::arg("modulus_ratio"))
      .def_prop_ro("decay_length", &ExponentialLaw::decay_length, "l, m.");
  described_class<RoughnessLaw>(m, "RoughnessLaw",
                                "What the roughness of two sides says of their exponential force "
                                "law, with 95 % limits of the "
                                "decay length.");
  m.def(
      "law_of_roughness",
      [](const std::vector<double>& rms_heights, const std::vector<double>& rms_slopes,
         const std::vector<double>& skewnesses, double pressure_over_modulus) {
        std::vector<SideRoughness> sides;
        for (const auto& [name, values] :
             {std::pair{"rms_slopes", &rms_slopes}, {"skewnesses", &skewnesses}})
          require(values->empty() || values->size() == rms_heights.size(), name, values->size(),
                  "values are given; give one for each side");
        for (std::size_t k = 0; k < rms_heights.size(); ++k) {
          sides.push_back({.rms_height = rms_heights[k]});
          if (!rms_slopes.empty()) sides.back().rms_slope = rms_slopes[k];
          if (!skewnesses.empty()) sides.back().skewness = skewnesses[k];
        }
        return law_of_roughness(sides, pressure_over_modulus);
      },
      nb::arg("rms_heights"), nb::kw_only(), nb::arg("rms_slopes") = std::vector<double>(),
      nb::arg("skewnesses") = std::vector<double>(),
      nb::arg("pressure_over_modulus") = SideRoughness::unknown,
      R"(Estimates the decay length of the force law of a joint from the roughness of its sides.

The ratio of decay length and rms height is that of an ensemble of 900 pairs of ground, honed and isotropic surfaces, by the skewness of the
sum and the load p/(E*h'). What is not given widens the limits.

Parameters
----------
rms_heights : sequence of float
    Rq or Sq of one or two sides, m.
rms_slopes : sequence of float, optional
    Sdq of each side, or √2 times Rdq.
skewnesses : sequence of float, optional
    Rsk or Ssk of each side, -2 … 0.3.
pressure_over_modulus : float, optional
    p/E*, with which the load is known if the slopes are.

Raises
------
InvalidInput
    Loads outside p/(E*h') = 0.0005 … 0.1.

Examples
--------
>>> law = salebra.models.law_of_roughness([0.8e-6, 0.4e-6])
>>> law.decay_length_low < law.decay_length < law.decay_length_high
True
)");
  nb::class_<TabulatedLaw, ContactLaw>(
      m, "TabulatedLaw",
      R"(A law by shape-preserving interpolation of a curve, computed or read from a file.

ln F over δ is interpolated by a monotone cubic; if every sample has K, its slopes at the nodes are K/F. K = F' and K' = F'' are its exact
derivatives. K_t is interpolated in the same way if every sample has one; otherwise it is (G*/E*)K. δ is the indentation of the samples,
or −ū if any sample has none.

Parameters
----------
curve : ForceCurve
    At least four usable samples.
modulus_ratio : float, optional
    G*/E*. It is left out for a curve with K_t at every load, as a :class:`Body` that is no half-space needs it.
)")
      .def(
          "__init__",
          [](TabulatedLaw* self, const ForceCurve& curve, std::optional<double> modulus_ratio) {
            new (self) TabulatedLaw(
                curve, modulus_ratio.value_or(std::numeric_limits<double>::quiet_NaN()));
          },
          nb::arg("curve"), nb::arg("modulus_ratio") = nb::none());
}

}  // namespace salebra::python
