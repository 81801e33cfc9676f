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

/// What faces read from descriptions (base/describe.hpp).
namespace salebra {

template <class Value>
concept Number = std::is_arithmetic_v<Value> || std::same_as<Value, std::optional<double>>;

/// NaN where there is none.
template <Number Value>
double as_number(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>)
    return static_cast<double>(value);
  else
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Calls visit(number, quantity) for every column of T that is a real number; number: NumberOf<T>.
template <Described T, class Visitor>
void for_each_number(Visitor&& visit) {
  for_each_column<T>([&](const auto& access, const Quantity& quantity) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(access), const T&>>;
    if constexpr (Number<Value> && !std::integral<Value>)
      visit(NumberOf<T>([access](const T& whole) { return as_number(access(whole)); }), quantity);
  });
}

/// Name, unit and meaning of the column of that name.
template <Described T>
Quantity quantity_of(std::string_view name) {
  Quantity found{name, Dimension::dimensionless, name};
  for_each_column<T>([&](const auto&, const Quantity& quantity) {
    if (quantity.name == name) found = quantity;
  });
  return found;
}

/// The column of that name. Throws InvalidInput "field: 'name' is none of …".
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
    throw InvalidInput(field, "'" + std::string(name) + "'",
                       "is none of " + known + did_you_mean(name, names) + "; choose one of them");
  return found;
}

}  // namespace salebra
