// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <numbers>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <string>
#include <utility>
#include <vector>

#include "interop/arrays.hpp"
#include "interop/values.hpp"

namespace salebra::python {

/// The docstring for a line of a description, such as "mean gap of the deformed surfaces, m."
std::string described_text(const auto& line) {
  std::string text;
  if constexpr (requires { line.long_name; })
    text = line.long_name;
  else
    text = line.meaning;
  if constexpr (requires { line.dimension; })
    if (line.dimension != Dimension::dimensionless)
      text += ", " + std::string(si_unit(line.dimension));
  return text + ".";
}

/// Whether values of this type are texts in Python: enumerations and lists of enumerations.
template <class Value>
constexpr bool has_words = std::is_enum_v<Value>;
template <class Item>
constexpr bool has_words<std::vector<Item>> = has_words<Item>;

inline auto words(const auto& value) {
  if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
    return std::string(name_of(value));
  } else {
    std::vector<decltype(words(value.front()))> all;
    for (const auto& item : value) all.push_back(words(item));
    return all;
  }
}

/// Stores the unit of a property, which unit_of_property() returns.
void remember_unit(nb::handle type, std::string_view property, Dimension dimension);

/// Defines a read-only property for one line of a description. `member` is a data member, a member
/// function or a function of const Bound&. An array becomes a view, an enumeration its name, and a
/// table one property for each of its columns.
template <class Bound, class Member, class Line>
void described_property(nb::class_<Bound>& bound, Member member, const Line& line) {
  using Result = std::invoke_result_t<Member, const Bound&>;
  using Value = std::remove_cvref_t<Result>;
  if constexpr (std::is_same_v<Line, Table>) {
    describe(
        [&]<class Column>(Column column, const auto& inner) {
          // If the class already has a property with the name of a column, this property stays.
          const std::string name(inner.name);
          if constexpr (std::is_member_object_pointer_v<Column>)
            if (!nb::hasattr(bound, name.c_str())) {
              remember_unit(bound, name, inner.dimension);
              column_property(bound, name.c_str(), member, column, described_text(inner).c_str());
            }
        },
        std::type_identity<typename Value::value_type>{});
  } else {
    const std::string name(line.name), text = described_text(line);
    if (name.empty()) return;
    if constexpr (requires { line.dimension; }) remember_unit(bound, name, line.dimension);
    if constexpr (!std::is_reference_v<Result> &&
                  requires(Value value) { array_of(std::move(value)); })
      bound.def_prop_ro(
          name.c_str(), [member](const Bound& self) { return array_of(std::invoke(member, self)); },
          nb::rv_policy::automatic, text.c_str());  // moves the numbers into the array
    else if constexpr (requires(const Value& value) { view(value, nb::handle()); })
      view_property(bound, name.c_str(), member, text.c_str());
    else if constexpr (has_words<Value>)
      bound.def_prop_ro(
          name.c_str(), [member](const Bound& self) { return words(std::invoke(member, self)); },
          text.c_str());
    else if constexpr (std::is_member_object_pointer_v<Member>)
      bound.def_ro(name.c_str(), member, text.c_str());
    else
      bound.def_prop_ro(
          name.c_str(), [member](const Bound& self) { return std::invoke(member, self); },
          text.c_str());
  }
}

/// Binds a class with pickle, == and a read-only property for each line of the description of T.
template <Described T>
nb::class_<T> described_class(nb::module_& module, const char* name, const char* meaning,
                              const auto&... extra) {
  nb::class_<T> bound(module, name, extra..., meaning);
  describe([&](auto member, const auto& line) { described_property(bound, member, line); },
           std::type_identity<T>{});
  value_methods(bound);
  return bound;
}

/// Defines a constructor with a keyword for each number in the description of T. The first
/// `required` keywords must be given; the others default to the values of T{}. `frequency` in Hz
/// may be given instead of angular_frequency.
template <Described T>
void keyword_constructor(nb::class_<T>& bound, std::size_t required) {
  std::vector<std::pair<std::string, double T::*>> members;
  describe(
      [&](auto member, const auto& line) {
        if constexpr (std::is_same_v<decltype(member), double T::*>)
          members.emplace_back(line.name, member);
      },
      std::type_identity<T>{});
  constexpr bool oscillates = requires(T made) { made.angular_frequency; };
  std::string signature = "def __init__(self, *";
  for (std::size_t i = 0; i < members.size(); ++i) {
    signature += ", " + members[i].first + ": float";
    const double given = T{}.*members[i].second;
    const bool by_frequency = oscillates && members[i].first == "angular_frequency";
    if (i >= required || by_frequency)
      signature +=
          given == given && i >= required ? fmt::format(" = {:.1f}", given) : " = float('nan')";
    if (by_frequency) signature += ", frequency: float = float('nan')";
  }
  bound.def(
      "__init__",
      [members, required](T* self, const nb::kwargs& given) {
        // The text that nanobind uses when it refuses arguments; salebra._calls replaces it by one
        // that names the argument.
        const auto accept = [](bool right) {
          if (!right) throw nb::type_error("incompatible function arguments");
        };
        std::size_t found = 0;
        const auto take = [&](const std::string& name, double& value) {
          const bool there = given.contains(name.c_str());
          if (there) accept(nb::try_cast(given[name.c_str()], value));
          found += there;
          return there;
        };
        T made;
        bool by_frequency = false;
        if constexpr (oscillates) {
          double frequency = 0;
          by_frequency = take("frequency", frequency);
          const bool both = by_frequency && given.contains("angular_frequency");
          require_that(!both, "frequency", "was given beside angular_frequency; give one of them");
          if (by_frequency) made.angular_frequency = 2 * std::numbers::pi * frequency;
        }
        for (std::size_t i = 0; i < members.size(); ++i) {
          const auto& [name, member] = members[i];
          if (by_frequency && name == "angular_frequency") continue;
          const bool there = take(name, made.*member);
          if (oscillates && !there && i < required && name == "angular_frequency")
            throw nb::type_error("angular_frequency is missing; give it or frequency");
          accept(there || i >= required);
        }
        accept(found == given.size());
        new (self) T(made);
      },
      nb::sig((signature + ") -> None").c_str()));
}

}  // namespace salebra::python
