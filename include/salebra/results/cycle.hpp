// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/cycle.hpp>
#include <salebra/results/describe.hpp>
#include <vector>

namespace salebra {

/// The time first.
template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<CycleSample>) {
  using enum Dimension;
  using S = CycleSample;
  visit(&S::t, Quantity{"time_in_periods", dimensionless, "time in periods"});
  visit(&S::indentation, Quantity{"indentation", length, "indentation"});
  visit(&S::tangential, Quantity{"tangential", length, "tangential displacement"});
  visit(&S::tangential_force, Quantity{"tangential_force", force, "tangential force"});
  visit(&S::normal_force, Quantity{"normal_force", force, "normal force"});
  visit(&S::work, Quantity{"work", energy, "work of the tangential force since the start"});
  visit(&S::dissipated, Quantity{"dissipated", energy, "energy dissipated since the start"});
  visit(&S::contact_area, Quantity{"contact_area", length_squared, "contact area"});
  visit(&S::slip_area, Quantity{"slip_area", length_squared, "area of cells at their limit"});
  visit(&S::tangential_stiffness,
        Quantity{"tangential_stiffness", stiffness, "tangential stiffness in full stick"});
}

/// One quantity over the samples.
inline std::vector<double> column(const CycleResult& cycle, double CycleSample::*value) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*value);
  return values;
}

}  // namespace salebra
