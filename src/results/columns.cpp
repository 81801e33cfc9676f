// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of described structs, and JSON objects made of them.
#include "columns.hpp"

#include <cmath>
#include <stdexcept>

namespace salebra::detail {
namespace {

Dimension over_area(Dimension dimension) {
  switch (dimension) {
    case Dimension::force:
      return Dimension::pressure;
    case Dimension::energy:
      return Dimension::energy_per_area;
    case Dimension::stiffness:
      return Dimension::stiffness_per_area;
    default:
      throw std::logic_error("a quantity of this dimension has no form per area");
  }
}

}  // namespace

void add_column(std::vector<Column>& columns, const Quantity& quantity, bool list, bool extensive,
                bool where_known, std::function<Json(const void*)> value) {
  const std::string name(quantity.name), long_name(quantity.long_name);
  columns.push_back({name, quantity.dimension, long_name, list, false, where_known, value});
  if (extensive)
    columns.push_back({name + "_per_area", over_area(quantity.dimension),
                       long_name + " over nominal area", list, true, where_known,
                       std::move(value)});
}

Json numbers_of(const std::vector<Column>& columns, const Rows& rows, bool several,
                double nominal_area) {
  Json object = Json::object();
  for (const Column& column : columns) {
    if (!column.value || column.list || (column.per_area && !(nominal_area > 0))) continue;
    const auto value_of = [&](std::size_t row) {
      const Json value = column.value(static_cast<const char*>(rows.first) + row * rows.stride);
      return column.per_area ? Json(value.number() / nominal_area) : value;
    };
    bool known = !column.where_known;
    for (std::size_t row = 0; !known && row < rows.count; ++row)
      known = !std::isnan(value_of(row).number());
    if (!known) continue;
    Json& member = object[column.name] = several ? Json::array() : value_of(0);
    for (std::size_t row = 0; several && row < rows.count; ++row) member.push_back(value_of(row));
  }
  return object;
}

Json lists_of(const std::vector<Column>& columns, const void* whole) {
  Json object = Json::object();
  for (const Column& column : columns)
    if (column.value && column.list) object[column.name] = column.value(whole);
  return object;
}

}  // namespace salebra::detail
