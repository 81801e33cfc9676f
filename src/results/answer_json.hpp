// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"

namespace salebra {

/// In a description: a list of described structs that becomes an array of JSON objects, and not one
/// column for each member.
struct Objects : Kept {};

/// JSON object of all members of a described struct, such as the mean and the limits of an
/// estimate. several: each member of the object is a list with one entry for each struct in
/// `values`; false: a single value.
template <Described T>
Json to_json(const std::vector<T>& values, bool several = true) {
  Json object = Json::object();
  describe(
      [&](auto member, const auto& line) {
        if constexpr (std::is_member_object_pointer_v<decltype(member)>) {
          Json list = Json::array();
          for (const T& value : values) list.push_back(detail::json_value(value.*member));
          object[line.name] = several ? list : list[0];
        }
      },
      std::type_identity<T>{});
  return object;
}
template <Described T>
Json to_json(const T& value) {
  return to_json(std::vector<T>{value}, false);
}

/// JSON object of the solution of a problem, in the order of its description. A quantity is a
/// number for one case and a list for several cases. Absent values and empty lists are left out.
/// Kinds of lines in the description, and what becomes of them:
///     Quantity  a value, an object with the members of an estimate, or a list; texts are always a
///               list
///     Table     a list of described structs; its columns become members of the object
///     Part      a described struct or a list of them: an object with the name of the part or, if
///               it has no name, members of the whole object
///     Objects   an array of objects with the name of the line
/// nominal_area  m²; 0 if unknown, so that columns per area are left out
template <Described Answer>
Json answer_json(const Answer& answer, double nominal_area = 0) {
  Json object = Json::object();
  const auto add = [&]<class Line, class Value>(const auto& again, const Line& line,
                                                const Value& value) {
    constexpr bool quantity = std::derived_from<Line, Quantity>;
    Json json;
    if constexpr (detail::is_optional<Value>) {
      if (value) again(again, line, *value);
      return;
    } else if constexpr (std::is_same_v<Line, Objects>) {
      json = Json::array();
      for (const auto& row : value) json.push_back(answer_json(row, nominal_area));
    } else if constexpr (detail::is_list<Value>) {
      using Item = typename Value::value_type;
      constexpr bool words = std::is_same_v<Item, std::string>;
      if (value.empty() && !words) return;
      if constexpr (!Described<Item>)
        json = words || value.size() > 1 ? Json(value) : Json(value[0]);
      else if constexpr (quantity)
        json = to_json(value);
      else
        json = value.size() > 1 ? json_of(value, nominal_area) : json_of(value[0], nominal_area);
    } else if constexpr (Described<Value>) {
      json = quantity ? to_json(value) : json_of(value, nominal_area);
    } else if constexpr (detail::has_json<Value>) {
      json = detail::json_value(value);
    } else {
      return;
    }
    if (std::is_same_v<Line, Table> || line.name.empty())
      object.add(json);
    else
      object[line.name] = json;
  };
  describe(
      [&]<class Line>(auto member, const Line& line) {
        if constexpr (std::derived_from<Line, Quantity> || std::is_same_v<Line, Table> ||
                      std::is_same_v<Line, Part> || std::is_same_v<Line, Objects>)
          add(add, line, std::invoke(member, answer));
      },
      std::type_identity<Answer>{});
  return object;
}

}  // namespace salebra
