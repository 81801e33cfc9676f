// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>
#include <string_view>

#include "base/archive.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

namespace nb = nanobind;

/// The content of a pickle: the present version of salebra, and the bytes.
nb::tuple pickled(const std::string& bytes);
/// The bytes in a pickle. Throws InvalidInput if another version of salebra wrote it.
std::string_view unpickled(const nb::tuple& state);

/// Defines pickle, copies and == for the class Bound. value(const Bound&) returns its value of a
/// described type T, and make(Bound*, T&&) constructs a Bound from such a value.
template <class Bound, class Value, class Make>
void value_methods(nb::class_<Bound>& bound, Value value, Make make) {
  bound.def(
      "__getstate__",
      [value](const Bound& self) {
        require_whole_if_spread(self, "a pickle");
        return pickled(detail::bytes_of(value(self)));
      },
      nb::sig("def __getstate__(self) -> tuple[str, bytes]"));
  using T = std::remove_cvref_t<decltype(value(std::declval<const Bound&>()))>;
  bound.def(
      "__setstate__",
      [make](Bound* self, const nb::tuple& state) {
        make(self, detail::from_bytes<T>(unpickled(state), "pickle"));
      },
      nb::sig("def __setstate__(self, state: tuple[str, bytes], /) -> None"));
  bound.def(
      "__eq__",
      [value](const Bound& self, nb::handle other) {
        const Bound* known = nullptr;
        return nb::try_cast(other, known) && known != nullptr &&
               (known == &self || detail::bytes_of(value(self)) == detail::bytes_of(value(*known)));
      },
      nb::arg("other").none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
}

template <class T>
void value_methods(nb::class_<T>& bound) {
  value_methods(
      bound, [](const T& self) -> const T& { return self; },
      [](T* self, T&& value) { new (self) T(std::move(value)); });
}

}  // namespace salebra::python
