// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <salebra/base/units.hpp>
#include <string_view>
#include <type_traits>

/// Each result struct is described once, below its declaration: every member with name, unit and
/// meaning. Files, JSON, tables, Python, pickle, ==, the glossary and the stored realisations of a
/// study all use the description:
///     constexpr void describe(auto&& visit, std::type_identity<SpotStatistics>) {
///       visit(&SpotStatistics::spot_count, Quantity{"spot_count", Dimension::dimensionless,
///       "number of contact spots"}); …
///     }
/// It calls visit(member, line) in the order of the declarations. A line is
///     Quantity   a column: a number, a word, or a list of them, with its name, unit and meaning
///     Extensive  a column proportional to the nominal area; NAME_per_area is a column too
///     WhereKnown a column that answers omit if no row has a value
///     Part       a described struct, whose columns are columns of this one too
///     Table      a list of described structs, whose columns are columns of this one too
///     Kept       any other part of the result; without a name it is no property in Python
/// A const member function without arguments may be a column too: it is computed and not stored. A
/// struct with a base calls the description of the base first.
namespace salebra {

/// Meaning of a name that salebra uses in options, JSON and files: one meaning and one unit
/// everywhere.
struct Quantity {
  std::string_view name;  ///< "decay_length"
  Dimension dimension = Dimension::dimensionless;
  std::string_view long_name;  ///< "decay length of force with mean gap"
};

struct Extensive : Quantity {};

struct WhereKnown : Quantity {};

struct Part {
  std::string_view name, meaning;
};

struct Table {
  std::string_view name, meaning;
};

struct Kept {
  std::string_view name, meaning;
  Dimension dimension = Dimension::dimensionless;
};

/// Describes members with an empty Kept{}.
constexpr void keep(auto&& visit, auto... members) { (visit(members, Kept{}), ...); }

template <class T>
concept Described = requires { describe([](auto&&...) {}, std::type_identity<T>{}); };

/// Returns true if the description lists all members in the order of their declarations. A
/// static_assert on it fails when a struct gains a member that is not described.
template <Described T>
consteval bool describes_all() {
  std::size_t end = 0;
  const auto rounded = [](std::size_t size, std::size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
  };
  describe(
      [&]<class Member, class Owner>(Member Owner::*, const auto&) {
        if constexpr (!std::is_function_v<Member>)
          end = rounded(end, alignof(Member)) + sizeof(Member);
      },
      std::type_identity<T>{});
  return rounded(end, alignof(T)) == sizeof(T);
}

/// Calls visit(member) for every stored member of T.
template <Described T, class Visitor>
void for_each_member(Visitor&& visit) {
  describe(
      [&](auto member, const auto&) {
        if constexpr (std::is_member_object_pointer_v<decltype(member)>) visit(member);
      },
      std::type_identity<T>{});
}

/// A number derived from a T: a member, a member function, or a function of it.
template <class T>
using NumberOf = std::function<double(const T&)>;

/// Calls visit(access, quantity) for every column of T, including those of its parts; access(const
/// T&) returns its value.
template <Described T, class Visitor>
void for_each_column(Visitor&& visit) {
  describe(
      [&]<class Line>(auto member, const Line& line) {
        const auto access = [member](const T& whole) -> decltype(auto) {
          return std::invoke(member, whole);
        };
        if constexpr (std::derived_from<Line, Quantity>) {
          visit(access, static_cast<const Quantity&>(line));
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

}  // namespace salebra
