// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/suggestion.hpp"

/// Reads names, units and values from the descriptions of structs (base/describe.hpp).
namespace salebra {

template <class Value>
concept Number = std::is_arithmetic_v<Value> || std::same_as<Value, std::optional<double>>;

/// The value as a double; NaN if an optional value is empty.
template <Number Value>
double as_number(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>)
    return static_cast<double>(value);
  else
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Calls visit(number, quantity) for every column of T that is a real number. number: a function of
/// type NumberOf<T> that reads the column.
template <Described T, class Visitor>
void for_each_number(Visitor&& visit) {
  for_each_column<T>([&](const auto& access, const Quantity& quantity) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(access), const T&>>;
    if constexpr (Number<Value> && !std::integral<Value>)
      visit(NumberOf<T>([access](const T& whole) { return as_number(access(whole)); }), quantity);
  });
}

/// Name, unit and meaning of the column of T with this name.
template <Described T>
Quantity quantity_of(std::string_view name) {
  Quantity found{name, Dimension::dimensionless, name};
  for_each_column<T>([&](const auto&, const Quantity& quantity) {
    if (quantity.name == name) found = quantity;
  });
  return found;
}

/// The function that reads the column of T with this name. field: the input that gave the name, for
/// the error message. Throws InvalidInput "field: 'name' is none of (list of the columns)".
template <Described T>
NumberOf<T> number_of(std::string_view name, std::string_view field) {
  NumberOf<T> found;
  std::string known;
  std::vector<std::string> names;
  for_each_number<T>([&](NumberOf<T> number, const Quantity& quantity) {
    if (quantity.name == name) found = std::move(number);
    names.emplace_back(quantity.name);
    known += (known.empty() ? "" : ", ") + names.back();
  });
  if (!found)
    throw InvalidInput(
        field, "'" + std::string(name) + "'",
        "is not one of " + known + did_you_mean(name, names) + "; choose one of them");
  return found;
}

}  // namespace salebra
