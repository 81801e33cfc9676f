// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <initializer_list>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "interop/arrays.hpp"

namespace salebra::python {

/// A Surface whose heights may live in a NumPy array. It stays where it is: copies would own what they do not.
struct BoundSurface {
  Surface surface;
  nb::object array;  ///< that the heights live in; none where the surface owns them

  explicit BoundSurface(Surface&& owned) : surface(std::move(owned)) {}
  BoundSurface(const FieldArgument& heights, double size_x, double size_y, bool periodic,
               std::string origin);
  BoundSurface(const BoundSurface&) = delete;
  BoundSurface& operator=(const BoundSurface&) = delete;
  ~BoundSurface();
};

/// A new Python object of a surface made by the library; its heights are not copied.
BoundSurface* new_surface(Surface surface);

/// "Name(pressure=1.5 MPa, …)": each number with the unit that salebra gives to its name.
std::string describe(std::string_view type,
                     std::initializer_list<std::pair<std::string_view, double>> numbers,
                     std::string_view rest = {});

/// to_xarray() and, if wanted, plot(), which salebra._results and salebra._plots do.
template <class Bound>
void result_methods(nb::class_<Bound>& bound, bool plots);

inline nb::object call_python(const char* module, const char* function, nb::handle self,
                              nb::args arguments, nb::kwargs keywords) {
  return nb::module_::import_(module).attr(function)(self, *arguments, **keywords);
}

/// plot(), which salebra._plots does.
template <class Bound>
void plot_method(nb::class_<Bound>& bound) {
  bound.def(
      "plot",
      [](nb::handle_t<Bound> self, nb::args arguments, nb::kwargs keywords) {
        return call_python("salebra._plots", "plot", self, arguments, keywords);
      },
      nb::sig("def plot(self, ax: matplotlib.axes.Axes | None = None, **kwargs: typing.Any) -> "
              "matplotlib.axes.Axes"),
      "Draws the result with matplotlib, which is imported now, on `ax` or on new axes, and "
      "returns the axes.");
}

template <class Bound>
void result_methods(nb::class_<Bound>& bound, bool plots) {
  bound.def(
      "to_xarray",
      [](nb::handle_t<Bound> self) {
        return nb::module_::import_("salebra._results").attr("to_xarray")(self);
      },
      nb::sig("def to_xarray(self) -> xarray.Dataset"),
      "The result as an xarray.Dataset; every variable has `units` (SI) and `long_name`. Needs "
      "xarray.");
  if (plots) plot_method(bound);
}

}  // namespace salebra::python
