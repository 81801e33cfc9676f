// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// The shape of an axisymmetric indenter, which is a law.
struct IndenterOptions {
  std::string law, table;
  std::optional<double> angle, radius, exponent, coefficient, edge_radius;

  /// others: words of --law beside the shapes.
  void add_to(Command& app, const std::vector<std::string>& others = {});
  /// Throws InvalidInput naming the option that is missing, and those that the shape does not have.
  std::shared_ptr<const IndenterProfile> indenter() const;
  /// Throws InvalidInput for an option of a shape that is not among the wanted; chosen: what was
  /// chosen, "--law cone".
  void require_only(const std::vector<std::string>& wanted, const std::string& chosen) const;

 private:
  std::vector<std::pair<std::string, const std::optional<double>*>> known() const;
};

}  // namespace salebra::cli
