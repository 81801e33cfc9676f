// SPDX-License-Identifier: GPL-3.0-or-later
// Electrical and thermal conductance of a contact from its normal stiffness.
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <string_view>

namespace salebra {
namespace {

double conductance_of(double normal_stiffness, double contact_modulus, double resistance,
                      std::string_view field) {
  // NaN means an unknown stiffness, and its conductance is NaN too.
  require(!(normal_stiffness < 0), "normal_stiffness", normal_stiffness, "must be >= 0");
  require_positive(contact_modulus, "contact_modulus");
  require(resistance > 0 && resistance < std::numeric_limits<double>::infinity(), field, resistance,
          "must be finite, and > 0 in at least one body");
  return 2 * normal_stiffness / (contact_modulus * resistance);
}

}  // namespace

double electrical_conductance(double normal_stiffness, double contact_modulus, double resistivity_1,
                              double resistivity_2) {
  for (const double resistivity : {resistivity_1, resistivity_2})
    require(resistivity >= 0, "resistivity", resistivity, "must be >= 0");
  return conductance_of(normal_stiffness, contact_modulus, resistivity_1 + resistivity_2,
                        "resistivity");
}

double thermal_conductance(double normal_stiffness, double contact_modulus, double conductivity_1,
                           double conductivity_2) {
  for (const double conductivity : {conductivity_1, conductivity_2})
    require(conductivity > 0, "conductivity", conductivity, "must be > 0");
  return conductance_of(normal_stiffness, contact_modulus, 1 / conductivity_1 + 1 / conductivity_2,
                        "conductivity");
}

void Conduction::validate() const { conductances(0, 1, *this); }

Conductances conductances(double normal_stiffness_per_area, double contact_modulus,
                          const Conduction& conduction) {
  Conductances found;
  const auto ask = [&](const char* name, const std::vector<double>& bodies, auto conductance) {
    require(bodies.size() <= 2, name, bodies.size(),
            "values given; give one for both bodies, or one for each");
    return bodies.empty() ? Conductances().thermal_conductance
                          : conductance(normal_stiffness_per_area, contact_modulus, bodies.front(),
                                        bodies.back());
  };
  found.thermal_conductance = ask("conductivity", conduction.conductivity, thermal_conductance);
  found.electrical_conductance = ask("resistivity", conduction.resistivity, electrical_conductance);
  return found;
}

}  // namespace salebra
