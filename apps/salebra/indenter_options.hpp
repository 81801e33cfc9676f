// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <string>
#include <vector>

#include "options.hpp"

namespace salebra::cli {

/// Options for the shape of an axisymmetric indenter, from which its contact law follows.
struct IndenterOptions {
  std::string law, table;
  std::optional<double> angle, radius, exponent, coefficient, edge_radius;

  /// others: further allowed values of --law that are no shapes.
  void add_to(Command& app, const std::vector<std::string>& others = {});
  /// Throws InvalidInput for a missing option and for options that the shape does not have.
  std::shared_ptr<const IndenterProfile> indenter() const;
  /// "paraboloid, R = 5 mm"; other shapes by their name.
  std::string in_words() const;
  /// Throws InvalidInput if an option of an indenter was given that is not among `wanted`. chosen:
  /// the choice that the error message names, such as "--law cone".
  void require_only(const std::vector<std::string>& wanted, const std::string& chosen) const;

 private:
  std::vector<std::pair<std::string, const std::optional<double>*>> known() const;
};

}  // namespace salebra::cli
