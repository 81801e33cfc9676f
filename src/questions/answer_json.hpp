// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "results/columns.hpp"

namespace salebra {

/// The answer to a question as an object, in the order of its description: numbers of one case,
/// lists of several. Lists without cases and parts that are not there are left out.
///     Quantity  a list of numbers
///     Table     a list of described structs, whose columns are columns of the answer
///     Part      such a list, or one struct that may be missing, as an object of that name
/// nominal_area  m², as in json_of()
template <Described Answer>
Json answer_json(const Answer& answer, double nominal_area = 0) {
  Json object = Json::object();
  const auto rows_of = [&]<class Row>(const std::vector<Row>& rows) {
    if constexpr (Described<Row>)
      return rows.size() == 1 ? json_of(rows.front(), nominal_area) : json_of(rows, nominal_area);
    else
      return rows.size() == 1 ? Json(rows.front()) : Json(rows);
  };
  describe(
      [&]<class Line>(auto member, const Line& line) {
        const auto& value = std::invoke(member, answer);
        using Value = std::remove_cvref_t<decltype(value)>;
        const std::string name(line.name);
        if constexpr (std::derived_from<Line, Quantity>) {
          if (!value.empty()) object[name] = rows_of(value);
        } else if constexpr (std::is_same_v<Line, Table>) {
          if (!value.empty()) object.add(rows_of(value));
        } else if constexpr (detail::is_optional<Value>) {
          if (value) object[name] = json_of(*value);
        } else if constexpr (std::is_same_v<Line, Part>) {
          if (!value.empty()) object[name] = rows_of(value);
        }
      },
      std::type_identity<Answer>{});
  return object;
}

}  // namespace salebra
