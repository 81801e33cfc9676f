// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "interop/described.hpp"
#include "interop/surface.hpp"
#include "results/describe.hpp"

namespace salebra::python {

/// Results for several values of one quantity. In Python it is a sequence of Item, with an array
/// for each number of Item.
template <class Item>
struct CurveOf {
  std::string coordinate;  ///< name of the quantity: "pressure", "force" and so on
  std::vector<double> values;
  std::vector<Item> results;
  /// Name of the quantity of the means, if Item is a mean; otherwise empty.
  std::string quantity = {};
  /// What all results have in common, for the end of a caption.
  std::string setting = {};
};

template <class Item>
constexpr void describe(auto&& visit, std::type_identity<CurveOf<Item>>) {
  using Curve = CurveOf<Item>;
  keep(visit, &Curve::coordinate, &Curve::values, &Curve::results, &Curve::quantity,
       &Curve::setting);
}

/// Defines the Python class of a curve: a sequence with its coordinate, tables and pictures, and an
/// array for each number in the description of T, which is a base of Item. If Item is described,
/// its curves have pickle and ==.
template <class Item, Described T = Item>
nb::class_<CurveOf<Item>> curve_class(nb::module_& module, const char* name, const char* meaning) {
  using Curve = CurveOf<Item>;
  nb::class_<Curve> bound(module, name, meaning);
  bound.def("__len__", [](const Curve& self) { return self.results.size(); })
      .def(
          "__getitem__",
          [](const Curve& self, Py_ssize_t index) {
            const auto count = static_cast<Py_ssize_t>(self.results.size());
            if (index < -count || index >= count) throw nb::index_error();
            return self.results[static_cast<std::size_t>(index < 0 ? index + count : index)];
          },
          nb::arg("index"))
      .def_prop_ro(
          "coordinate", [](const Curve& self) { return self.coordinate; },
          "Name of the quantity along the curve, such as pressure, force or case.")
      .def_prop_ro(
          "values", [](const Curve& self) { return array_of(std::vector(self.values)); },
          nb::rv_policy::automatic, "The coordinate of each result.")
      .def(
          "__getattr__",
          [name = std::string(name)](const Curve& self, const std::string& attribute) {
            if (attribute != self.coordinate)
              throw nb::attribute_error(
                  ("'" + name + "' has no attribute '" + attribute + "'").c_str());
            return array_of(std::vector(self.values));
          },
          nb::arg("name"), "The coordinate by its name, such as ``curve.pressure``.");
  const auto column = [&bound](NumberOf<T> number, const auto& line) {
    const std::string column_name(line.name);
    remember_unit(bound, column_name, line.dimension);
    bound.def_prop_ro(
        column_name.c_str(),
        [number](const Curve& self) {
          std::vector<double> values;
          for (const Item& one : self.results) values.push_back(number(one));
          return array_of(std::move(values));
        },
        nb::rv_policy::automatic, described_text(line).c_str());
  };
  salebra::for_each_number<T>(column);
  describe(
      [&]<class Member>(Member member, const auto& line) {
        using Value = std::remove_cvref_t<std::invoke_result_t<Member, const T&>>;
        if constexpr (std::same_as<std::remove_cvref_t<decltype(line)>, Kept> &&
                      std::same_as<Value, double>)
          if (!line.name.empty())
            column(NumberOf<T>([member](const T& one) { return std::invoke(member, one); }), line);
      },
      std::type_identity<T>{});
  if constexpr (requires(Item one) { one.mean; })
    bound.def_prop_ro(
        "quantity", [](const Curve& self) { return self.quantity; },
        "Name of the quantity of the means, which decides their unit.");
  if constexpr (Described<Item>) value_methods(bound);
  result_methods(bound);
  return bound;
}

/// Replaces a property that is a list of results by a curve of these results. Its coordinate is the
/// pressure, from pressures(const Bound&).
template <class Bound, class Class, class Item, class Pressures>
void curve_property(nb::class_<Bound>& bound, const char* name, std::vector<Item> Class::*results,
                    Pressures pressures) {
  const auto text = nb::cast<std::string>(bound.attr(name).attr("__doc__"));
  bound.def_prop_ro(
      name,
      [results, pressures, name = std::string(name)](const Bound& self) {
        CurveOf<Item> curve{"pressure", pressures(self), self.*results, name};
        curve.values.resize(curve.results.size(), std::numeric_limits<double>::quiet_NaN());
        return curve;
      },
      text.c_str());
}

}  // namespace salebra::python
