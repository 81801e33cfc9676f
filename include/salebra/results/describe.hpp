// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/results/quantity.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Each struct of results is described once: every member with its name, unit and meaning. Files,
/// JSON, tables, Python and the kept realisations of a study are all made from the description
///     template <class Visitor>
///     constexpr void describe(Visitor&& visit, std::type_identity<SpotStatistics>) {
///       visit(&SpotStatistics::spot_count, Quantity{"spot_count", Dimension::dimensionless,
///       "number of contact spots"}); …
///     }
/// which calls visit(member, line) in the order of the declarations. A line is
///     Quantity  a column: a number, or a list of them, with its name, unit and meaning
///     Part      a described struct, whose columns are columns of this one too
///     Kept      anything else that belongs to the result
/// A const member function without arguments may be a column too: it is computed, and nowhere
/// stored. The structs of a study are described beside their declarations, those of lower layers in
/// salebra/results/.
namespace salebra {

struct Part {
  std::string_view name, meaning;
};

struct Kept {
  std::string_view name, meaning;
};

template <class T>
concept Described = requires {
  describe([](auto&&...) {}, std::type_identity<T>{});
};

/// Any number of a T: a member, a member function, or a function of it.
template <class T>
using NumberOf = std::function<double(const T&)>;

/// Whether the description lists all members, in the order of their declarations: what a struct
/// that grows is reminded by.
template <Described T>
consteval bool describes_all() {
  std::size_t end = 0;
  const auto rounded = [](std::size_t size, std::size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
  };
  describe(
      [&]<class Member>(Member T::*, const auto&) {
        if constexpr (!std::is_function_v<Member>)
          end = rounded(end, alignof(Member)) + sizeof(Member);
      },
      std::type_identity<T>{});
  return rounded(end, alignof(T)) == sizeof(T);
}

/// Calls visit(member) for everything that a T stores.
template <Described T, class Visitor>
void for_each_member(Visitor&& visit) {
  describe(
      [&](auto member, const auto&) {
        if constexpr (std::is_member_object_pointer_v<decltype(member)>) visit(member);
      },
      std::type_identity<T>{});
}

/// Calls visit(access, quantity) for every column of T, those of its parts included; access(const
/// T&) is its value.
template <Described T, class Visitor>
void for_each_column(Visitor&& visit) {
  describe(
      [&]<class Line>(auto member, const Line& line) {
        const auto access = [member](const T& whole) -> decltype(auto) {
          return std::invoke(member, whole);
        };
        if constexpr (std::is_same_v<Line, Quantity>) {
          visit(access, line);
        } else if constexpr (std::is_same_v<Line, Part>) {
          using Inner = std::remove_cvref_t<std::invoke_result_t<decltype(member), const T&>>;
          for_each_column<Inner>([&](const auto& inner, const Quantity& quantity) {
            visit(
                [access, inner](const T& whole) -> decltype(auto) { return inner(access(whole)); },
                quantity);
          });
        }
      },
      std::type_identity<T>{});
}

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
  for_each_number<T>([&](NumberOf<T> number, const Quantity& quantity) {
    if (quantity.name == name) found = std::move(number);
    known += (known.empty() ? "" : ", ") + std::string(quantity.name);
  });
  if (!found)
    throw InvalidInput(field, "'" + std::string(name) + "'",
                       "is none of " + known + "; choose one of them");
  return found;
}

}  // namespace salebra
