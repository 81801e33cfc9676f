// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/contact/mdr/mdr.hpp>
#include <string>

#include "options.hpp"

namespace salebra::cli {

/// The shape of an axisymmetric indenter.
struct IndenterOptions {
  std::string profile, table;
  std::optional<double> angle, radius, exponent, coefficient, flat_radius, edge_radius;

  void add_to(Command& app);
  /// Throws InvalidInput naming the option that is missing, and those that the profile does not
  /// have.
  std::shared_ptr<const IndenterProfile> indenter() const;
  /// What to do with several motions where a command takes one: `salebra damping` has some of the
  /// profiles as laws.
  std::string advice_for_ranges() const;
};

}  // namespace salebra::cli
