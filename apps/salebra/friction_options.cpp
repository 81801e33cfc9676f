// SPDX-License-Identifier: GPL-3.0-or-later
// Options of frictional and coupled cycles of `oscillate`.
#include "friction_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

namespace salebra::cli {

void FrictionOptions::add_to(Command& app) {
  const Heading under(app, "Friction");
  add_quantity(app, "--friction", friction_coefficient, Dimension::dimensionless,
               "Coulomb coefficient of friction: simulate the cycle once more, with slip; without "
               "this option nothing slips");
  app.add_flag(
      "--coupled", coupled,
      "simulate the cycle once more with pressures and tractions coupled by Dundurs' beta");
  add_quantity(app, "--dundurs", dundurs, Dimension::dimensionless,
               "Dundurs' beta for --coupled; default: from the material");
  app.add_option(
      "--max-periods", max_periods,
      "maximum number of periods with friction until two in a row lose the same; default 6");
}

void FrictionOptions::check() const {
  if (friction_coefficient) require_positive(*friction_coefficient, "--friction");
  require(max_periods >= 2, "--max-periods", max_periods,
          "must be >= 2: the loss is steady when two periods agree");
  require(max_periods == 6 || given(), "--max-periods", max_periods,
          "applies only to a cycle with friction; add --friction or --coupled");
  if (!dundurs) return;
  require(coupled, "--dundurs", *dundurs, "has no effect without --coupled; add it");
  require(std::abs(*dundurs) <= 0.5, "--dundurs", *dundurs, "must be -0.5 ... 0.5");
}

void FrictionOptions::check(const Oscillation& motion, double indentation) const {
  if (!coupled) return;
  const double amplitude =
      std::visit([](const auto& kind) { return kind.normal_amplitude; }, motion);
  require_that(indentation >= amplitude, "--coupled",
               fmt::format("given, but the body leaves the surface (indentation {:g} m < amplitude "
                           "{:g} m); a coupled cycle needs permanent contact",
                           indentation, amplitude));
}

void FrictionOptions::apply(CycleOptions& cycle, const MaterialOptions& bodies,
                            const Body& body) const {
  if (friction_coefficient) cycle.friction_coefficient = *friction_coefficient;
  cycle.max_periods = max_periods;
  if (!coupled) return;
  require(body.half_space_material().has_value(), "--body", bodies.body_file,
          "cannot be combined with --coupled; give the elastic constants of half-spaces");
  if (dundurs)
    cycle.coupling_constant =
        *dundurs / (std::numbers::pi * body.half_space_material()->contact_modulus);
  else
    cycle.coupling_constant = bodies.coupling_constant();
}

std::vector<std::string> FrictionOptions::cycles() const {
  std::vector<std::string> names{""};
  if (given()) names.emplace_back("-friction");
  if (coupled) names.emplace_back("-coupled");
  return names;
}

}  // namespace salebra::cli
