// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>
#include <string>
#include <utility>
#include <vector>

namespace salebra {

/// A group of a result file. The unit and the meaning of each dataset come from the glossary of
/// quantities, by the name of the dataset.
/// throws  as ResultGroup; InvalidInput for a name that is not in the glossary
class QuantityGroup {
 public:
  explicit QuantityGroup(ResultGroup group) : group_(std::move(group)) {}

  void coordinate(const std::string& name, const std::vector<double>& values) {
    const Quantity quantity = listed(name);
    group_.coordinate(name, values, unit(quantity), std::string(quantity.long_name));
  }
  template <class Values>
  void dataset(const std::string& name, const Values& values,
               const std::vector<std::string>& coordinates) {
    const Quantity quantity = listed(name);
    group_.dataset(name, values, coordinates, unit(quantity), std::string(quantity.long_name));
  }
  /// Writes a field; `first` and `second` name the coordinates that belong to its two indices.
  void dataset(const std::string& name, const Field& values, const std::string& first = "x",
               const std::string& second = "y", FieldType type = FieldType::float64) {
    const Quantity quantity = listed(name);
    group_.dataset(name, values, first, second, unit(quantity), std::string(quantity.long_name),
                   type);
  }
  void scalar(const std::string& name, double value) {
    const Quantity quantity = listed(name);
    group_.scalar(name, value, unit(quantity), std::string(quantity.long_name));
  }
  /// Writes a number as an attribute, in the SI unit of its quantity.
  template <class Value>
  void attribute(const std::string& name, Value value) {
    group_.attribute(std::string(listed(name).name), value);
  }
  /// Writes the coordinates x and y of the cells of a grid.
  void axes(const Grid2D& grid) {
    coordinate("x", positions(grid.nx, grid.dx()));
    coordinate("y", positions(grid.ny, grid.dy()));
  }
  /// The group without glossary, for texts and indices, which are no quantities.
  ResultGroup& plain() { return group_; }

 private:
  static Quantity listed(const std::string& name) {
    require(is_quantity(name), "quantity", name,
            "is not in the table; describe it in salebra/results");
    return find_quantity(name);
  }
  static std::string unit(const Quantity& quantity) {
    return std::string(si_unit(quantity.dimension));
  }

  ResultGroup group_;
};

}  // namespace salebra
