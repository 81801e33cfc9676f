// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <salebra/base/enum_names.hpp>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>
#include <utility>

/// Enumerations of the library are texts in Python, as in boundary="free". The type stubs declare
/// them as typing.Literal.
namespace salebra::python {

namespace nb = nanobind;

/// A text argument that names a value of the enumeration.
template <class Enum>
struct Choice {
  std::string text;

  /// The value of the enumeration. Throws InvalidInput, with `field` and the allowed names, for
  /// another text.
  Enum value(std::string_view field) const {
    if (const auto value = parse_enum<Enum>(text)) return *value;
    std::string allowed;
    for (const std::string& word : names_of<Enum>())
      allowed += (allowed.empty() ? "" : ", ") + word;
    throw InvalidInput(field, "'" + text + "'", "is none of " + allowed + "; choose one of them");
  }
};

/// The text typing.Literal['periodic', 'free'], with the names of the enumeration, for type stubs.
template <class Enum>
constexpr auto literal_of() {
  constexpr std::string_view before = "typing.Literal[";
  constexpr std::size_t size = [&] {
    std::size_t all = before.size();
    // 4: two quotation marks, and ", " or "]".
    for (const auto& [value, word] : EnumNames<Enum>::values) all += word.size() + 4;
    return all - 1;
  }();
  nb::detail::descr<size> text;
  std::size_t end = 0;
  const auto add = [&](std::string_view part) {
    for (const char c : part) text.text[end++] = c;
  };
  add(before);
  for (const auto& [value, word] : EnumNames<Enum>::values) {
    add(end == before.size() ? "'" : ", '");
    add(word);
    add("'");
  }
  add("]");
  return text;
}

}  // namespace salebra::python

namespace nanobind::detail {

template <class Enum>
struct type_caster<salebra::python::Choice<Enum>> {
  NB_TYPE_CASTER(salebra::python::Choice<Enum>, salebra::python::literal_of<Enum>())

  bool from_python(handle source, uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<std::string> text;
    if (!text.from_python(source, flags, cleanup)) return false;
    value.text = std::move(text.value);
    return true;
  }
  static handle from_cpp(const salebra::python::Choice<Enum>& choice, rv_policy policy,
                         cleanup_list* cleanup) noexcept {
    return make_caster<std::string>::from_cpp(choice.text, policy, cleanup);
  }
};

}  // namespace nanobind::detail
