// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the surface class, its statistics, summits and areal parameters.
#include "interop/surface.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/base/units.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/axis.hpp>
#include <salebra/surface/crop.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/peaks.hpp>
#include <salebra/surface/profile_parameters.hpp>
#include <salebra/surface/spikes.hpp>
#include <salebra/surface/summits.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "surface/plausibility.hpp"

namespace salebra::python {
namespace {

BoundSurface* detrended_surface(const BoundSurface& surface, const Choice<Detrend>& method) {
  const Detrend chosen = method.value("method");
  return new_surface(unlocked([&] { return detrended(Surface(surface.surface), chosen); }));
}

BoundSurface* filtered_surface(const BoundSurface& surface, std::optional<double> s_filter,
                               std::optional<double> l_filter) {
  return new_surface(
      unlocked([&] { return filtered(Surface(surface.surface), {s_filter, l_filter}); }));
}

void bind_surface_class(nb::module_& m) {
  nb::class_<BoundSurface> surface(
      m, "Surface", R"(Heights of the rough side. A hill is positive; hills touch first.

Parameters
----------
heights : array_like
    Heights (nx, ny) in m, `heights[ix, iy]`, x first; NaN where the instrument has no value. A C-contiguous float64 array is not
    copied: the surface shares its memory. An xarray.DataArray over "x" and "y" may have either order; its coordinates give the sizes
    if none are given, and its attributes the units.
size_x, size_y : float
    Size, m. Point (ix, iy) lies at (ix·size_x/nx, iy·size_y/ny).
periodic : bool
    Whether the surface repeats itself. Generated surfaces do, measured surfaces do not.
origin : str
    Origin of the surface, for provenance only.

Examples
--------
>>> heights = numpy.zeros((64, 64))
>>> surface = salebra.Surface(heights, 1e-3, 1e-3)
>>> numpy.shares_memory(surface.heights, heights)
True
)");
  const auto property = [&surface](const char* name, auto value, const char* description) {
    surface.def_prop_ro(
        name, [value](const BoundSurface& self) { return value(self.surface); }, description);
  };
  property("grid", [](const Surface& s) { return s.grid; }, "Points and size.");
  property("nx", [](const Surface& s) { return s.grid.nx; }, "Points along x.");
  property("ny", [](const Surface& s) { return s.grid.ny; }, "Points along y.");
  property("size_x", [](const Surface& s) { return s.grid.lx; }, "Size along x, m.");
  property("size_y", [](const Surface& s) { return s.grid.ly; }, "Size along y, m.");
  described_property(
      surface, [](const BoundSurface& self) { return self.surface.grid.area(); },
      Kept{"area", "nominal area", Dimension::length_squared});
  described_property(
      surface,
      [](const BoundSurface& self) -> std::optional<std::array<double, 4>> {
        const auto part = unlocked([&] { return max_defined_part(self.surface); });
        if (!part) return {};
        return std::array{part->x0, part->y0, part->x1, part->y1};
      },
      Kept{"max_defined_part",
           "x0, y0, x1, y1 of the largest rectangle without undefined points, for :meth:`cropped`; "
           "None if no point is defined",
           Dimension::length});
  property(
      "periodic", [](const Surface& s) { return s.periodic; },
      "Whether the surface repeats itself.");
  property(
      "origin", [](const Surface& s) { return s.origin; }, "File, or generator with its seed.");
  property(
      "undefined_points", [](const Surface& s) { return s.undefined_points(); },
      "Number of NaN heights, among the rows of this process.");
  surface
      .def(nb::init<const FieldArgument&, double, double, bool, std::string>(), nb::arg("heights"),
           nb::arg("size_x"), nb::arg("size_y"), nb::kw_only(), nb::arg("periodic") = false,
           nb::arg("origin") = "")
      .def_prop_ro(
          "heights",
          [](nb::handle_t<BoundSurface> self) -> nb::object {
            const nb::handle object = self;
            const auto& bound = nb::cast<const BoundSurface&>(object);
            return bound.array.is_valid() ? bound.array
                                          : nb::cast(view(bound.surface.heights, self));
          },
          nb::sig("def heights(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Heights (nx, ny), m: the memory of the surface, not a copy. If the surface is "
          "distributed over "
          "processes: its `rows` only.")
      .def_prop_ro(
          "rows", [](const BoundSurface& self) { return range_of(self.surface.partition()); },
          nb::sig("def rows(self) -> range"),
          "Rows ix that this process has: all of them, unless the surface is distributed over "
          "processes.")
      .def(
          "gather",
          [](nb::handle_t<BoundSurface> self, int root) {
            const Surface& mine = nb::cast<const BoundSurface&>(nb::handle(self)).surface;
            return gather(self, root, mine.communicator, [&] {
              return std::make_unique<BoundSurface>(unlocked([&] {
                return Surface{mine.grid, gathered(mine.partition(), mine.heights, root),
                               mine.periodic, mine.origin};
              }));
            });
          },
          nb::arg("root") = 0, nb::sig("def gather(self, root: int = 0) -> Surface | None"),
          R"(The whole surface in one process, None in the others. All processes of the surface must call this method.

Parameters
----------
root : int
    The process, counted from 0. A surface of a single process is returned as it is.
)")
      .def(
          "__array__",
          [](nb::handle self, nb::handle dtype, nb::handle copy) {
            const nb::object heights = self.attr("heights");
            if (!copy.is_none() && nb::cast<bool>(copy))
              return nb::module_::import_("numpy").attr("array")(heights, dtype);
            return nb::module_::import_("numpy").attr("asarray")(heights, dtype);
          },
          nb::arg("dtype") = nb::none(), nb::arg("copy") = nb::none(),
          nb::sig("def __array__(self, dtype: typing.Any = None, copy: bool | None = None) -> "
                  "numpy.typing.NDArray[typing.Any]"),
          "numpy.asarray(surface) returns the heights.")
      .def("detrended", &detrended_surface, nb::arg("method") = "plane",
           R"(Subtracts the trend of the surface.

Parameters
----------
method : {"plane", "mean", "quadratic", "lines", "median_differences", "none"}
    "plane": subtract the least-squares plane a + b·x + c·y; "mean": the mean; "quadratic": the least-squares paraboloid; "lines": the
    least-squares straight line of each scan line (along x); "median_differences": the median difference of each scan line to the previous
    line, and then the plane; "none": nothing. Both line corrections change statistics along y and leave a seam between the first and the
    last line.

Returns
-------
Surface
    A new surface. Undefined points stay undefined and do not count.
)")
      .def(
          "filtered", &filtered_surface, nb::arg("s_filter") = nb::none(),
          nb::arg("l_filter") = nb::none(),
          R"(Applies the Gaussian filters of ISO 16610-61 to the surface; subtract tilt and form first.

A plane wave of length λ keeps the fraction 2^−(λc/λ)² of its amplitude, half of it at the cut-off λc. A periodic surface is continued
periodically. At the edges of any other surface, and around undefined points, the weights are divided by their sum over the defined points
(zero-order Gaussian regression).

Parameters
----------
s_filter : float, optional
    Cut-off of the S-filter, m: removes shorter waves.
l_filter : float, optional
    Cut-off of the L-filter, m, applied to the result of the S-filter: removes longer waves.

Returns
-------
Surface
    A new surface. Undefined points stay undefined.

Raises
------
InvalidInput
    For a cut-off shorter than two cells or longer than the surface, and unless s_filter < l_filter.

Examples
--------
>>> heights = numpy.random.default_rng(1).normal(size=(64, 64))
>>> rough = salebra.Surface(heights, 1e-3, 1e-3).filtered(l_filter=0.25e-3)
)")
      .def(
          "filled",
          [](const BoundSurface& self) {
            return new_surface(unlocked([&] { return filled(Surface(self.surface)); }));
          },
          R"(The surface with its undefined points filled by the smoothest heights that fit (discrete Laplace equation).

Filled points have no summits and reduce the power of short waves, so check `undefined_points` first.
)")
      .def(
          "despiked",
          [](const BoundSurface& self, double threshold) {
            return new_surface(
                unlocked([&] { return despiked(Surface(self.surface), threshold); }));
          },
          nb::arg("threshold") = 6.0,
          R"(Makes spikes undefined: dust, and errors of the instrument.

Parameters
----------
threshold : float
    In robust standard deviations of the neighbours of a point about their median, but at least those of all points about the median of
    their neighbours. Points beyond the threshold are spikes if at most four are adjacent; steps, scratches and summits remain.
)")
      .def(
          "cropped",
          [](const BoundSurface& self, double x0, double y0, double x1, double y1) {
            return new_surface(
                unlocked([&] { return cropped(self.surface, Rectangle{x0, y0, x1, y1}); }));
          },
          nb::arg("x0"), nb::arg("y0"), nb::arg("x1"), nb::arg("y1"),
          "The part between two corners, m, which move to the nearest borders of cells. It is not "
          "periodic.")
      .def(
          "with_periodic",
          [](const BoundSurface& self, bool periodic) {
            Surface copy = self.surface;
            copy.periodic = periodic;
            return new_surface(std::move(copy));
          },
          nb::arg("periodic") = true,
          "A copy that is marked as periodic or not. Boundary elements with periodic boundaries "
          "continue "
          "either periodically.")
      .def_prop_ro(
          "height_statistics",
          [](const BoundSurface& self) {
            // The table that a notebook shows in one process must not wait for the other processes.
            require_whole(self, "its property height_statistics");
            return unlocked([&] { return height_statistics(self.surface); });
          },
          "Moments of the heights, see :func:`height_statistics`.")
      .def_prop_ro(
          "moments",
          [](const BoundSurface& self) {
            require_whole(self, "its property moments");
            return unlocked([&] { return surface_moments(self.surface); });
          },
          "Spectral moments of a periodic surface, moments by finite differences of any other, see "
          ":func:`surface_moments`.")
      .def_static(
          "from_topography",
          [](nb::handle topography) {
            return nb::module_::import_("salebra._topography").attr("from_topography")(topography);
          },
          nb::arg("topography"), nb::sig("def from_topography(topography: typing.Any) -> Surface"),
          R"(The surface of a SurfaceTopography object, in metres.

SurfaceTopography reads about a hundred instrument formats.

Examples
--------
>>> import SurfaceTopography
>>> surface = salebra.Surface.from_topography(SurfaceTopography.read_topography("scan.di"))
)")
      .def(
          "to_topography",
          [](nb::handle_t<BoundSurface> self) {
            require_whole(nb::cast<const BoundSurface&>(nb::handle(self)), "a Topography");
            return nb::module_::import_("salebra._topography").attr("to_topography")(self);
          },
          nb::sig("def to_topography(self) -> typing.Any"),
          "A SurfaceTopography.Topography of the same heights, unit m. Needs SurfaceTopography.")
      .def("__repr__", [](const BoundSurface& self) {
        const Grid2D& grid = self.surface.grid;
        return "Surface(" + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " points, " + format_quantity(grid.lx, Dimension::length) + " x " +
               format_quantity(grid.ly, Dimension::length) +
               (self.surface.periodic ? ", periodic" : ", not periodic") + ")";
      });
  result_methods(surface);
}

void bind_height_statistics(nb::module_& m) {
  described_class<HeightStatistics>(
      m, "HeightStatistics",
      "Moments of the height distribution over all defined points; no filter is applied. Skewness "
      "and kurtosis of a flat surface are NaN.");
  m.def("height_statistics", &of_surface<height_statistics>, nb::arg("surface"),
        "Moments of the heights, without undefined points. If the surface is distributed over "
        "processes, all of them make this call. Cost: two passes.");
  m.def("spectral_moments", &of_surface<spectral_moments>, nb::arg("surface"),
        R"(Moments of a periodic surface from its spectrum: those of its trigonometric interpolant.

.. math:: m_{2,x} = \sum_q q_x^2 |\hat h|^2/N^2, \quad m_{4,x} = \sum_q q_x^4 |\hat h|^2/N^2

Raises
------
InvalidInput
    Unless the surface is periodic and complete.
)");
  m.def("difference_moments", &of_surface<difference_moments>, nb::arg("surface"),
        R"(Moments by finite differences of neighbouring points, for measured surfaces.

If the surface has structure at the scale of the grid, these moments are smaller than the spectral moments: a mode of wave number q
counts as (2 sin(q dx/2)/dx)² instead of q².
)");
  m.def("surface_moments", &of_surface<surface_moments>, nb::arg("surface"),
        ":func:`spectral_moments` of a periodic surface, :func:`difference_moments` of any other.");
  m.def(
      "_warning_of_heights",
      [](const BoundSurface& surface) {
        return unlocked([&] { return warning_of_heights(surface.surface); });
      },
      nb::arg("surface"), "Warning about a probable mistake in the unit of the heights, or None.");
  m.def("detrended", &detrended_surface, nb::arg("surface"), nb::arg("method") = "plane",
        "Subtracts the trend of a surface, see :meth:`Surface.detrended`.");
  m.def("filtered", &filtered_surface, nb::arg("surface"), nb::arg("s_filter") = nb::none(),
        nb::arg("l_filter") = nb::none(),
        "Applies the Gaussian S- and L-filter of ISO 16610-61, see :meth:`Surface.filtered`.");
  m.def(
      "default_detrend",
      [](const BoundSurface& surface) {
        return std::string(name_of(default_detrend(surface.surface)));
      },
      nb::arg("surface"),
      "\"plane\" for a measured surface, which has the tilt of its stage; \"mean\" for a periodic "
      "surface.");
}

void bind_summits(nb::module_& m) {
  described_class<Summit>(m, "Summit", "A local maximum and its osculating paraboloid.");

  described_class<SummitList>(m, "SummitList", "The summits of a surface; its columns are views.")
      .def("__len__", [](const SummitList& self) { return self.summits.size(); })
      .def(
          "__getitem__",
          [](const SummitList& self, Py_ssize_t index) {
            const auto size = static_cast<Py_ssize_t>(self.summits.size());
            if (index < 0) index += size;
            if (index < 0 || index >= size) throw nb::index_error();
            return self.summits[static_cast<std::size_t>(index)];
          },
          nb::arg("index"));

  described_class<SummitStatistics>(m, "SummitStatistics",
                                    "Statistics of summits for the Greenwood–Williamson theory; "
                                    "heights have the zero of the heights "
                                    "of the surface.");
  m.def(
      "find_summits", &of_surface<find_summits>, nb::arg("surface"),
      R"(Finds every point that is higher than its eight neighbours, with the least-squares paraboloid through the 3 × 3 points.

Neighbours wrap on periodic surfaces. On other surfaces the border is not searched, nor are points next to undefined points.
If the surface is distributed over processes, each gets the summits of its rows; :func:`summit_statistics` uses the summits of all.
)");
  m.def(
      "summit_statistics", [](const SummitList& summits) { return summit_statistics(summits); },
      nb::arg("summits"), "Density, mean and standard deviation of the heights, and mean radius.");

  described_class<Peak>(m, "Peak", "A peak by ISO 25178-2: the highest point of a hill.");
  m.def(
      "significant_peaks",
      [](const BoundSurface& surface, double min_prominence) {
        return unlocked([&] { return significant_peaks(surface.surface, min_prominence); });
      },
      nb::arg("surface"), nb::arg("min_prominence"),
      "Peaks at least `min_prominence` (m) above the saddle to a higher peak: Wolf's "
      "pruning of ISO 25178-2.");
}

void bind_lay(nb::module_& m) {
  described_class<SurfaceLay>(
      m, "SurfaceLay",
      "The lay of a surface, i.e. the direction of its grooves, with the rms slopes along and "
      "across "
      "it; NaN if unknown. The lay is that of a ground surface if `has_lay` is true.")
      .def("in_words", &lay_in_words,
           "Text such as \"ground-like: lay 12° from x, 6 to 1\"; empty if `has_lay` is false.");
  m.def("surface_lay", &of_surface<surface_lay>, nb::arg("surface"),
        R"(Finds the lay of a surface from the mean products of its gradient.

The slope along a direction is least along the lay. The matrix is taken over the waves longer than four cells of the coarser axis. The
difference of the slopes is significant if it exceeds what an isotropic surface of as many hills has by chance. Subtract any tilt first.

Raises
------
InvalidInput
    For fewer than 3 × 3 points, and unless the surface is complete.
)");
}

void bind_areal_parameters(nb::module_& m) {
  described_class<ArealParameters>(
      m, "ArealParameters",
      "Areal parameters by the definitions of ISO 25178-2, under their names there.");
  m.def("areal_parameters",
        &of_surface<[](const Surface& surface) { return areal_parameters(surface); }>,
        nb::arg("surface"),
        "ISO 25178-2 parameters of the surface as it is. Remove form by "
        ":meth:`Surface.detrended`, and noise and waviness by :meth:`Surface.filtered`.");
  described_class<ProfileParameters>(
      m, "ProfileParameters",
      "Profile parameters of ISO 21920-2, means over the profiles of a surface, with the standard "
      "deviations between them; NaN if unknown.");
  m.def(
      "profile_parameters",
      [](const BoundSurface& surface, const Choice<Axis>& axis, std::optional<double> s_filter,
         std::optional<double> l_filter) {
        const Axis chosen = axis.value("axis");
        return unlocked(
            [&] { return profile_parameters(surface.surface, chosen, {s_filter, l_filter}); });
      },
      nb::arg("surface"), nb::arg("axis") = "x", nb::arg("s_filter") = nb::none(),
      nb::arg("l_filter") = nb::none(),
      R"(The parameters Ra, Rq, Rz and Rsm of the profiles along an axis, by ISO 21920-2.

Ra and Rq are taken over the whole profile, from its mean. Rz is the mean over sections of the highest minus the lowest point; with an
L-filter the sections are as long as its cut-off, otherwise the profile is one section. Rsm is the mean spacing of the rises through the
mean line between dales and hills that reach 10 % of Rz. Profiles with undefined points are left out.

Parameters
----------
surface : Surface
    Subtract its tilt first.
axis : {"x", "y"}
    Direction of the profiles.
s_filter, l_filter : float, optional
    Cut-offs, m, of Gaussian filters of each profile (ISO 16610-21). Without l_filter the parameters are those of the primary profile.

Returns
-------
ProfileParameters
    Means over the profiles, and standard deviations between them.
)");
}

}  // namespace

void bind_surface(nb::module_& m) {
  bind_surface_class(m);
  bind_height_statistics(m);
  bind_summits(m);
  bind_areal_parameters(m);
  bind_lay(m);
}

}  // namespace salebra::python
