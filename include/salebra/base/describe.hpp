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
/// A description calls visit(member, line) for each member, in the order of the declarations. A
/// line is
///     Quantity   a column: a number, a word, or a list of them, with its name, unit and meaning
///     Extensive  a column proportional to the nominal area; NAME_per_area is a column too
///     WhereKnown a column that solutions omit if no row has a value
///     Part       a described struct, whose columns are columns of this one too
///     Table      a list of described structs, whose columns are columns of this one too
///     Kept       any other member; without a name it does not become a property in Python
/// A const member function without arguments may be a column too; its value is computed when
/// needed, not stored. A struct with a base calls the description of the base first.
namespace salebra {

/// Name, dimension and meaning of a quantity. A name in options, JSON and files has the same
/// meaning and unit everywhere.
struct Quantity {
  std::string_view name;  ///< e.g. "decay_length"
  Dimension dimension = Dimension::dimensionless;
  std::string_view long_name;  ///< meaning, e.g. "decay length of force with mean gap"
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

/// Describes several members that have neither name nor meaning (with an empty Kept{}).
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

/// A number derived from an object of type T: a member, a member function, or any function of the
/// object.
template <class T>
using NumberOf = std::function<double(const T&)>;

/// Calls visit(access, quantity) for every column of T, including the columns of its Parts;
/// access(const T&) returns the value of the column.
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
