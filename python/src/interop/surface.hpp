// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <concepts>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/figures/figure.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <utility>

#include "interop/arrays.hpp"
#include "interop/running.hpp"

namespace salebra::python {

/// The Python object of a surface, whose heights may lie in the memory of a NumPy array. It cannot
/// be copied, because destroying the copy would free this memory.
struct BoundSurface {
  Surface surface;
  nb::object array;  ///< the NumPy array that holds the heights; invalid if the surface owns them

  explicit BoundSurface(Surface&& owned) : surface(std::move(owned)) {}
  BoundSurface(const FieldArgument& heights, double size_x, double size_y, bool periodic,
               std::string origin);
  BoundSurface(const BoundSurface&) = delete;
  BoundSurface& operator=(const BoundSurface&) = delete;
  ~BoundSurface();
};

/// Throws InvalidInput if the surface is distributed over processes. purpose: what needs it as a
/// whole.
inline void require_whole(const BoundSurface& surface, const std::string& purpose) {
  surface.surface.require_whole(purpose);
}

/// Throws InvalidInput for spectra and summits of a distributed surface, of which each process only
/// has those of its columns or rows.
template <class Part>
  requires std::same_as<Part, PowerSpectrum> || std::same_as<Part, SummitList>
void require_whole(const Part& part, const std::string& purpose) {
  if (!part.communicator.alone())
    throw InvalidInput(std::same_as<Part, SummitList> ? "summits" : "spectrum", "",
                       "is spread over " + std::to_string(part.communicator.size()) +
                           " processes, and " + purpose +
                           " needs it whole; gather its surface first");
}

/// Calls require_whole() for classes that can be distributed, and does nothing for others.
template <class Bound>
void require_whole_if_spread(const Bound& bound, const char* purpose) {
  if constexpr (requires { require_whole(bound, purpose); }) require_whole(bound, purpose);
}

/// The Python object range(begin, end) of the rows that this process holds.
nb::object range_of(const RowPartition& rows);

/// The method gather(root): returns the object itself if one process holds all rows. Otherwise it
/// returns the result of `whole` in process `root`, and None in the others.
template <class Bound, class Whole>
nb::object gather(nb::handle_t<Bound> self, int root, const Communicator& communicator,
                  Whole&& whole) {
  if (communicator.alone()) {
    require(root == 0, "root", root, "must be one of the processes, counted from 0");
    return nb::borrow(self);
  }
  std::unique_ptr<Bound> gathered = std::forward<Whole>(whole)();
  if (communicator.rank() != root) return nb::none();
  return nb::cast(gathered.release(), nb::rv_policy::take_ownership);
}

/// Calls function(surface) without the interpreter's lock, and returns its result.
template <auto function>
auto of_surface(const BoundSurface& surface) {
  return unlocked([&] { return function(surface.surface); });
}

/// Makes a Python object of a surface; heights are not copied.
BoundSurface* new_surface(Surface surface);

inline nb::object call_python(const char* module, const char* function, nb::handle self,
                              nb::args arguments, nb::kwargs keywords) {
  return nb::module_::import_(module).attr(function)(self, *arguments, **keywords);
}

/// Defines the methods figure(), which is what drawn(const Bound&) or the function of with_figure()
/// makes, and plot(), by which salebra._plots draws a panel of it.
template <class Bound, class Drawn>
void figure_methods(nb::class_<Bound>& bound, Drawn drawn) {
  if constexpr (std::invocable<Drawn, const Bound&>)
    bound.def(
        "figure",
        [drawn](nb::handle_t<Bound> self) {
          const auto& result = nb::cast<const Bound&>(nb::handle(self));
          require_whole_if_spread(result, "a figure");
          return figures::with_limits(nb::hasattr(self, "_draw")
                                          ? nb::cast<figures::Figure>(self.attr("_draw")(self))
                                          : drawn(result));
        },
        "What is drawn of the result, as data.");
  bound.def(
      "plot",
      [](nb::handle self, nb::args arguments, nb::kwargs keywords) {
        return call_python("salebra._plots", "plot", self, arguments, keywords);
      },
      nb::sig("def plot(self, ax: matplotlib.axes.Axes | None = None, panel: int | str = 0, "
              "**kwargs: typing.Any) -> matplotlib.axes.Axes"),
      "Draws a panel of figure() with matplotlib on `ax`, or on new axes, and returns the axes. "
      "panel: its number, or the name of its quantity.");
}

/// Defines the method to_xarray(), which calls salebra._results.
template <class Bound>
void result_methods(nb::class_<Bound>& bound) {
  bound.def(
      "to_xarray",
      [](nb::handle_t<Bound> self) {
        require_whole_if_spread(nb::cast<const Bound&>(nb::handle(self)), "a dataset");
        return nb::module_::import_("salebra._results").attr("to_xarray")(self);
      },
      nb::sig("def to_xarray(self) -> xarray.Dataset"),
      "The result as an xarray.Dataset; every variable has `units` (SI) and `long_name`. Needs "
      "xarray.");
}

}  // namespace salebra::python
