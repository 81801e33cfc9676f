// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/results/describe.hpp>
#include <salebra/study/contact_models.hpp>
#include <string>

#include "interop/arrays.hpp"

namespace salebra::python {

/// "mean gap of the deformed surfaces, m."
inline std::string described_text(const Quantity& quantity) {
  std::string text(quantity.long_name);
  if (quantity.dimension != Dimension::dimensionless)
    text += ", " + std::string(si_unit(quantity.dimension));
  return text + ".";
}
inline std::string described_text(const auto& line) { return std::string(line.meaning) + "."; }

/// A class with a read-only property for every line of the description of T: its name, its meaning
/// and its unit.
template <Described T>
nb::class_<T> described_class(nb::module_& module, const char* name, const char* meaning) {
  nb::class_<T> bound(module, name, meaning);
  describe(
      [&](auto member, const auto& line) {
        using Value = std::remove_cvref_t<std::invoke_result_t<decltype(member), const T&>>;
        const std::string property(line.name);
        const std::string text = described_text(line);
        if constexpr (std::is_same_v<Value, std::vector<double>>)
          view_property(bound, property.c_str(), member, text.c_str());
        else if constexpr (std::is_same_v<Value, ContactModel>)
          bound.def_prop_ro(
              property.c_str(), [member](const T& self) { return name_of(self.*member); },
              text.c_str());
        else if constexpr (std::is_member_object_pointer_v<decltype(member)>)
          bound.def_ro(property.c_str(), member, text.c_str());
        else
          bound.def_prop_ro(
              property.c_str(), [member](const T& self) { return (self.*member)(); }, text.c_str());
      },
      std::type_identity<T>{});
  return bound;
}

}  // namespace salebra::python
