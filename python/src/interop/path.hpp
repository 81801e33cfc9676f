// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <filesystem>

namespace nanobind::detail {

/// Converts a path given as str or os.PathLike[str]. The caster of nanobind declares os.PathLike
/// without its type argument, which mypy --strict refuses.
template <>
struct type_caster<std::filesystem::path> {
  NB_TYPE_CASTER(std::filesystem::path, const_name("str | os.PathLike[str]"))

  bool from_python(handle source, uint32_t, cleanup_list*) noexcept {
    PyObject* bytes = nullptr;
    if (!PyUnicode_FSConverter(source.ptr(), &bytes)) {
      PyErr_Clear();
      return false;
    }
    const object held = steal(bytes);
    value = PyBytes_AsString(held.ptr());
    return true;
  }
  static handle from_cpp(const std::filesystem::path& path, rv_policy, cleanup_list*) noexcept {
    return PyUnicode_DecodeFSDefault(path.c_str());
  }
};

}  // namespace nanobind::detail
