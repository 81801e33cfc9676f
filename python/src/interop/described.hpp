// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <string>
#include <utility>
#include <vector>

#include "interop/arrays.hpp"
#include "interop/values.hpp"

namespace salebra::python {

/// "mean gap of the deformed surfaces, m."
inline std::string described_text(std::string_view meaning, Dimension dimension) {
  std::string text(meaning);
  if (dimension != Dimension::dimensionless) text += ", " + std::string(si_unit(dimension));
  return text + ".";
}
inline std::string described_text(const Quantity& quantity) {
  return described_text(quantity.long_name, quantity.dimension);
}
inline std::string described_text(const Kept& kept) {
  return described_text(kept.meaning, kept.dimension);
}
inline std::string described_text(const Part& part) {
  return described_text(part.meaning, Dimension::dimensionless);
}

/// Words of an enumeration, or of lists of them.
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

/// A read-only property of a described member: views of arrays, words of enumerations, the columns
/// of a table.
template <class Bound, class Member, class Line>
void described_property(nb::class_<Bound>& bound, Member member, const Line& line) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, const Bound&>>;
  if constexpr (std::is_same_v<Line, Table>) {
    describe(
        [&]<class Column>(Column column, const auto& inner) {
          // A name that the whole has already is the whole's.
          const std::string name(inner.name);
          if constexpr (std::is_member_object_pointer_v<Column>)
            if (!nb::hasattr(bound, name.c_str()))
              column_property(bound, name.c_str(), member, column, described_text(inner).c_str());
        },
        std::type_identity<typename Value::value_type>{});
  } else {
    const std::string name(line.name), text = described_text(line);
    if (name.empty()) return;
    if constexpr (!std::is_member_object_pointer_v<Member> &&
                  requires(Value value) { array_of(std::move(value)); })
      bound.def_prop_ro(
          name.c_str(), [member](const Bound& self) { return array_of((self.*member)()); },
          nb::rv_policy::automatic, text.c_str());  // it owns what it returns
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
          name.c_str(), [member](const Bound& self) { return (self.*member)(); }, text.c_str());
  }
}

/// A class with pickle, == and a read-only property for every line of the description of T: its
/// name, its meaning and its unit.
template <Described T>
nb::class_<T> described_class(nb::module_& module, const char* name, const char* meaning) {
  nb::class_<T> bound(module, name, meaning);
  describe([&](auto member, const auto& line) { described_property(bound, member, line); },
           std::type_identity<T>{});
  value_methods(bound);
  return bound;
}

/// A constructor of keywords, one for each number that is described: the first `required` of them
/// must be given, the others are those of T{}.
template <Described T>
void keyword_constructor(nb::class_<T>& bound, std::size_t required) {
  std::vector<std::pair<std::string, double T::*>> members;
  describe(
      [&](auto member, const auto& line) {
        if constexpr (std::is_same_v<decltype(member), double T::*>)
          members.emplace_back(line.name, member);
      },
      std::type_identity<T>{});
  std::string signature = "def __init__(self, *";
  for (std::size_t i = 0; i < members.size(); ++i) {
    signature += ", " + members[i].first + ": float";
    const double given = T{}.*members[i].second;
    if (i >= required)
      signature += given == given ? fmt::format(" = {:.1f}", given) : " = float('nan')";
  }
  bound.def(
      "__init__",
      [members, required](T* self, const nb::kwargs& given) {
        // What nanobind says of other arguments, which salebra._calls explains.
        const auto accept = [](bool right) {
          if (!right) throw nb::type_error("incompatible function arguments");
        };
        T made;
        std::size_t found = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
          const auto& [name, member] = members[i];
          const bool there = given.contains(name.c_str());
          accept(there ? nb::try_cast(given[name.c_str()], made.*member) : i >= required);
          found += there;
        }
        accept(found == given.size());
        new (self) T(made);
      },
      nb::sig((signature + ") -> None").c_str()));
}

}  // namespace salebra::python
