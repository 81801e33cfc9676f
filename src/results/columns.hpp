// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "io/json.hpp"

/// Described structs as tables of columns, for code that does not know their types: the output of
/// the program, the glossary.
namespace salebra {

/// A column of a described struct.
struct Column {
  std::string name;
  Dimension dimension = Dimension::dimensionless;
  std::string long_name;
  bool list = false;         ///< the member is a list, a column of a table
  bool per_area = false;     ///< the value must be divided by the nominal area
  bool where_known = false;  ///< the output omits the column if its value is unknown in all rows
  /// Reads the value of this column from a struct of the described type at the address `whole`: a
  /// number, a boolean, a text or a list of these; null if there is none. The function is empty for
  /// fields, which are not printed.
  std::function<Json(const void* whole)> value;
};

namespace detail {

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

template <class Value>
Json json_value(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return Json(std::string(name_of(value)));
  else if constexpr (is_optional<Value>)
    return value ? json_value(*value) : Json();
  else
    return Json(value);
}

template <class Value>
constexpr bool has_json = std::is_enum_v<Value> || std::is_convertible_v<const Value&, Json>;
template <class Value>
constexpr bool has_json<std::optional<Value>> = has_json<Value>;
template <class Item>
constexpr bool has_json<std::vector<Item>> = has_json<Item>;

template <class Value>
constexpr bool is_list = false;
template <class Item>
constexpr bool is_list<std::vector<Item>> = true;

/// Adds the column of a quantity. For an extensive quantity (such as a force) it also adds the
/// column divided by the nominal area.
void add_column(std::vector<Column>& columns, const Quantity& quantity, bool list, bool extensive,
                bool where_known, std::function<Json(const void*)> value);

template <class Whole>
std::vector<Column> all_columns() {
  std::vector<Column> all;
  describe(
      [&]<class Line>(auto member, const Line& line) {
        using Value = std::remove_cvref_t<std::invoke_result_t<decltype(member), const Whole&>>;
        if constexpr (std::derived_from<Line, Quantity>) {
          std::function<Json(const void*)> value;
          if constexpr (has_json<Value>)
            value = [member](const void* whole) {
              return json_value(std::invoke(member, *static_cast<const Whole*>(whole)));
            };
          add_column(all, line, is_list<Value>, std::is_same_v<Line, Extensive>,
                     std::is_same_v<Line, WhereKnown>, std::move(value));
        } else if constexpr (std::is_same_v<Line, Part> && Described<Value>) {
          for (Column column : all_columns<Value>()) {
            column.value = [member, inner = column.value](const void* whole) {
              return inner(&std::invoke(member, *static_cast<const Whole*>(whole)));
            };
            all.push_back(std::move(column));
          }
        }
      },
      std::type_identity<Whole>{});
  return all;
}

struct Rows {
  const void* first;
  std::size_t count, stride;
};
Json numbers_of(const std::vector<Column>& columns, const Rows& rows, bool several,
                double nominal_area);
Json lists_of(const std::vector<Column>& columns, const void* whole);

}  // namespace detail

/// The columns of T and of the structs that are parts of it, in the order of the descriptions.
template <Described T>
const std::vector<Column>& columns_of() {
  static const std::vector<Column> columns = detail::all_columns<T>();
  return columns;
}

/// The first column with this name in the given structs; nullptr if there is none.
template <Described... Structs>
const Column* find_column(std::string_view name) {
  for (const std::vector<Column>* columns : {&columns_of<Structs>()...})
    for (const Column& column : *columns)
      if (column.name == name) return &column;
  return nullptr;
}

/// JSON object with the columns of a result, except those that are lists. nominal_area: m²; 0:
/// unknown, so columns per area are left out.
template <Described T>
Json json_of(const T& result, double nominal_area = 0) {
  return detail::numbers_of(columns_of<T>(), {&result, 1, sizeof(T)}, false, nominal_area);
}
/// JSON object that has, for each column, a list with one value per result.
template <Described T>
Json json_of(const std::vector<T>& results, double nominal_area = 0) {
  return detail::numbers_of(columns_of<T>(), {results.data(), results.size(), sizeof(T)}, true,
                            nominal_area);
}
/// JSON object of those columns of a result that are lists.
template <Described T>
Json lists_of(const T& result) {
  return detail::lists_of(columns_of<T>(), &result);
}

}  // namespace salebra
