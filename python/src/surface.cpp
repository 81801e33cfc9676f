// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the surface class, its statistics, summits and areal parameters.
#include "interop/surface.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/base/units.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/peaks.hpp>
#include <salebra/surface/plausibility.hpp>
#include <salebra/surface/summits.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/running.hpp"

namespace salebra::python {
namespace {

BoundSurface* detrended_surface(const BoundSurface& surface, const Choice<Detrend>& method) {
  const Detrend chosen = method.value("method");
  return new_surface(unlocked([&] { return detrended(Surface(surface.surface), chosen); }));
}

void bind_surface_class(nb::module_& m) {
  nb::class_<BoundSurface> surface(
      m, "Surface", R"(Heights of the rough side. A hill is positive; hills touch first.

Parameters
----------
heights : array_like
    (nx, ny). Heights in m, `heights[ix, iy]`, x first; NaN where the instrument has no value. A C-contiguous float64 array is not
    copied: the surface looks at the same memory. An xarray.DataArray over "x" and "y" is taken in either order, with the sizes of its
    coordinates where none are given and the units of its attributes.
size_x, size_y : float
    Size, m. Point (ix, iy) lies at (ix·size_x/nx, iy·size_y/ny).
periodic : bool
    Whether the surface repeats itself. Generated surfaces do, measured ones do not.
origin : str
    Where it comes from; for provenance only.

Examples
--------
>>> heights = numpy.zeros((64, 64))
>>> surface = salebra.Surface(heights, 1e-3, 1e-3)
>>> numpy.shares_memory(surface.heights, heights)
True
)");
  surface
      .def(nb::init<const FieldArgument&, double, double, bool, std::string>(), nb::arg("heights"),
           nb::arg("size_x"), nb::arg("size_y"), nb::kw_only(), nb::arg("periodic") = false,
           nb::arg("origin") = "")
      .def_prop_ro(
          "heights",
          [](nb::handle_t<BoundSurface> self) -> nb::object {
            const auto& bound = nb::cast<const BoundSurface&>(nb::handle(self));
            return bound.array.is_valid() ? bound.array
                                          : nb::cast(view(bound.surface.heights, self));
          },
          nb::sig("def heights(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Heights (nx, ny), m: the memory of the surface, not a copy. Of a surface that is spread "
          "over processes: its `rows` alone.")
      .def_prop_ro(
          "rows", [](const BoundSurface& self) { return range_of(self.surface.share()); },
          nb::sig("def rows(self) -> range"),
          "Rows ix that this process holds: all of them, unless the surface is spread over "
          "processes.")
      .def(
          "gather",
          [](nb::handle_t<BoundSurface> self, int root) {
            const Surface& mine = nb::cast<const BoundSurface&>(nb::handle(self)).surface;
            return gather(self, root, mine.ranks, [&] {
              return std::make_unique<BoundSurface>(unlocked([&] {
                return Surface{mine.grid, gathered(mine.share(), mine.heights, root), mine.periodic,
                               mine.origin};
              }));
            });
          },
          nb::arg("root") = 0, nb::sig("def gather(self, root: int = 0) -> Surface | None"),
          R"(The whole surface in one process, None in the others. All processes that hold rows of it make this call.

Parameters
----------
root : int
    The process, counted from 0. A surface that one process holds is returned as it is.
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
          "numpy.asarray(surface) is its heights.")
      .def_prop_ro(
          "grid", [](const BoundSurface& self) { return self.surface.grid; }, "Points and size.")
      .def_prop_ro(
          "nx", [](const BoundSurface& self) { return self.surface.grid.nx; }, "Points along x.")
      .def_prop_ro(
          "ny", [](const BoundSurface& self) { return self.surface.grid.ny; }, "Points along y.")
      .def_prop_ro(
          "size_x", [](const BoundSurface& self) { return self.surface.grid.lx; },
          "Size along x, m.")
      .def_prop_ro(
          "size_y", [](const BoundSurface& self) { return self.surface.grid.ly; },
          "Size along y, m.")
      .def_prop_ro(
          "area", [](const BoundSurface& self) { return self.surface.grid.area(); },
          "Nominal area, m².")
      .def_prop_ro(
          "periodic", [](const BoundSurface& self) { return self.surface.periodic; },
          "Whether the surface repeats itself.")
      .def_prop_ro(
          "origin", [](const BoundSurface& self) { return self.surface.origin; },
          "File, or generator with its seed.")
      .def_prop_ro(
          "undefined_points",
          [](const BoundSurface& self) { return self.surface.undefined_points(); },
          "Number of NaN heights, among the rows of this process.")
      .def("detrended", &detrended_surface, nb::arg("method") = "plane",
           R"(The surface less its trend.

Parameters
----------
method : {"plane", "mean", "quadratic", "lines", "median_differences", "none"}
    What is subtracted: the least-squares plane a + b·x + c·y, the mean, the least-squares paraboloid, of each scan line (along x) its
    least-squares straight line, of each scan line its offset by the median of its differences from the line before and then the plane,
    nothing. Both ways of flattening lines change statistics along y, and leave a seam between the first and the last line.

Returns
-------
Surface
    A new surface; undefined points stay undefined and take no part.
)")
      .def(
          "filled",
          [](const BoundSurface& self) {
            return new_surface(unlocked([&] { return filled(Surface(self.surface)); }));
          },
          R"(The surface with its undefined points filled by the smoothest heights that fit (discrete Laplace equation).

What is filled has no summits and takes power from short waves, so count `undefined_points` first.
)")
      .def(
          "with_periodic",
          [](const BoundSurface& self, bool periodic) {
            Surface copy = self.surface;
            copy.periodic = periodic;
            return new_surface(std::move(copy));
          },
          nb::arg("periodic") = true,
          "A copy that counts as periodic, or not: boundary elements with periodic boundaries "
          "continue it either way.")
      .def_prop_ro(
          "height_statistics",
          [](const BoundSurface& self) {
            // A table of one process in a notebook must not wait for the others.
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
          "Spectral moments of a periodic surface, those of finite differences of any other, see "
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
  result_methods(surface, true);
}

void bind_height_statistics(nb::module_& m) {
  nb::class_<HeightStatistics>(
      m, "HeightStatistics",
      "Moments of the height distribution over all defined points; no filter is applied.")
      .def_ro("defined_points", &HeightStatistics::defined_points, "Number of defined points.")
      .def_ro("minimum", &HeightStatistics::minimum, "m")
      .def_ro("maximum", &HeightStatistics::maximum, "m")
      .def_ro("mean", &HeightStatistics::mean, "⟨h⟩, m")
      .def_ro("rms_height", &HeightStatistics::rms_height, "√⟨(h − ⟨h⟩)²⟩, m")
      .def_ro("skewness", &HeightStatistics::skewness, "NaN for a flat surface.")
      .def_ro("kurtosis", &HeightStatistics::kurtosis,
              "3 for a Gaussian surface; NaN for a flat one.")
      .def("__repr__", [](const HeightStatistics& s) {
        return describe(
            "HeightStatistics",
            {{"rms_height", s.rms_height}, {"skewness", s.skewness}, {"kurtosis", s.kurtosis}});
      });
  m.def(
      "height_statistics",
      [](const BoundSurface& surface) {
        return unlocked([&] { return height_statistics(surface.surface); });
      },
      nb::arg("surface"),
      "Moments of the heights; undefined points take no part. Of a surface that is spread over "
      "processes all of them make this call. Cost: two passes.");
  m.def(
      "spectral_moments",
      [](const BoundSurface& surface) {
        return unlocked([&] { return spectral_moments(surface.surface); });
      },
      nb::arg("surface"),
      R"(Moments of a periodic surface from its spectrum: those of its trigonometric interpolant.

.. math:: m_{2,x} = \sum_q q_x^2 |\hat h|^2/N^2, \quad m_{4,x} = \sum_q q_x^4 |\hat h|^2/N^2

Raises
------
InvalidInput
    Unless the surface is periodic and complete.
)");
  m.def(
      "difference_moments",
      [](const BoundSurface& surface) {
        return unlocked([&] { return difference_moments(surface.surface); });
      },
      nb::arg("surface"),
      R"(Moments by finite differences of neighbouring points, for measured surfaces.

Where the surface has structure at the scale of the grid they are smaller than the spectral moments: a mode of wave number q
counts with (2 sin(q dx/2)/dx)² in place of q².
)");
  m.def(
      "surface_moments",
      [](const BoundSurface& surface) {
        return unlocked([&] { return surface_moments(surface.surface); });
      },
      nb::arg("surface"),
      ":func:`spectral_moments` of a periodic surface, :func:`difference_moments` of any other.");
  m.def(
      "_doubt_of_heights",
      [](const BoundSurface& surface) {
        return unlocked([&] { return doubt_of_heights(surface.surface); });
      },
      nb::arg("surface"), "What is most likely a slip in the unit of the heights, or None.");
  m.def("detrended", &detrended_surface, nb::arg("surface"), nb::arg("method") = "plane",
        "The surface less its trend, see :meth:`Surface.detrended`.");
  m.def(
      "default_detrend",
      [](const BoundSurface& surface) {
        return std::string(word_of(default_detrend(surface.surface)));
      },
      nb::arg("surface"),
      "\"plane\" for a measured surface, which carries the tilt of its stage; \"mean\" for a "
      "periodic one.");
}

void bind_summits(nb::module_& m) {
  nb::class_<Summit>(m, "Summit", "A local maximum and the paraboloid that osculates it.")
      .def_ro("x", &Summit::x, "m")
      .def_ro("y", &Summit::y, "m")
      .def_ro("height", &Summit::height, "Of the vertex, from the zero of the heights, m.")
      .def_ro("curvature1", &Summit::curvature1, "The larger principal curvature, 1/m.")
      .def_ro("curvature2", &Summit::curvature2, "The smaller one, 1/m.")
      .def_prop_ro("mean_radius", &Summit::mean_radius, "2/(curvature1 + curvature2), m.")
      .def("__repr__", [](const Summit& s) {
        return describe(
            "Summit",
            {{"x", s.x}, {"y", s.y}, {"mean_height", s.height}, {"mean_radius", s.mean_radius()}});
      });

  nb::class_<SummitList> list(m, "SummitList", "The summits of a surface; its columns are views.");
  list.def_ro("searched_area", &SummitList::searched_area,
              "Cells whose eight neighbours exist and are defined, m².")
      .def("__len__", [](const SummitList& self) { return self.summits.size(); })
      .def(
          "__getitem__",
          [](const SummitList& self, Py_ssize_t index) {
            const auto size = static_cast<Py_ssize_t>(self.summits.size());
            if (index < 0) index += size;
            if (index < 0 || index >= size) throw nb::index_error();
            return self.summits[static_cast<std::size_t>(index)];
          },
          nb::arg("index"))
      .def("__repr__", [](const SummitList& self) {
        return "SummitList(" + std::to_string(self.summits.size()) + " summits)";
      });
  column_property(list, "x", &SummitList::summits, &Summit::x, "m");
  column_property(list, "y", &SummitList::summits, &Summit::y, "m");
  column_property(list, "height", &SummitList::summits, &Summit::height, "m");
  column_property(list, "curvature1", &SummitList::summits, &Summit::curvature1, "1/m");
  column_property(list, "curvature2", &SummitList::summits, &Summit::curvature2, "1/m");

  nb::class_<SummitStatistics>(m, "SummitStatistics",
                               "An ensemble of summits as the Greenwood–Williamson theory uses it.")
      .def_ro("summit_density", &SummitStatistics::density, "Summits per searched area, 1/m².")
      .def_ro("mean_height", &SummitStatistics::mean_height, "From the zero of the heights, m.")
      .def_ro("rms_height", &SummitStatistics::rms_height,
              "Standard deviation of the summit heights, m.")
      .def_ro("mean_radius", &SummitStatistics::mean_radius, "1/⟨mean curvature⟩, m.")
      .def("__repr__", [](const SummitStatistics& s) {
        return describe("SummitStatistics", {{"summit_density", s.density},
                                             {"mean_height", s.mean_height},
                                             {"rms_height", s.rms_height},
                                             {"mean_radius", s.mean_radius}});
      });
  m.def(
      "find_summits",
      [](const BoundSurface& surface) {
        return unlocked([&] { return find_summits(surface.surface); });
      },
      nb::arg("surface"),
      R"(Every point that is higher than its eight neighbours, with the least-squares paraboloid through the 3 × 3 points.

Neighbours wrap where the surface is periodic; elsewhere the border is not searched, nor are points beside undefined ones.
Of a surface that is spread over processes each gets the summits of its rows; :func:`summit_statistics` are those of all.
)");
  m.def(
      "summit_statistics", [](const SummitList& summits) { return summit_statistics(summits); },
      nb::arg("summits"), "Density, mean and standard deviation of the heights, and mean radius.");

  nb::class_<Peak>(m, "Peak", "A peak by ISO 25178-2: the highest point of a hill.")
      .def_ro("ix", &Peak::ix)
      .def_ro("iy", &Peak::iy)
      .def_ro("height", &Peak::height, "m")
      .def_ro("prominence", &Peak::prominence,
              "Above the highest saddle that leads to a higher peak, m.")
      .def_ro("mean_curvature", &Peak::mean_curvature, "1/m");
  m.def(
      "significant_peaks",
      [](const BoundSurface& surface, double min_prominence) {
        return unlocked([&] { return significant_peaks(surface.surface, min_prominence); });
      },
      nb::arg("surface"), nb::arg("min_prominence"),
      "Peaks that stand at least `min_prominence` (m) above the saddle to a higher one: Wolf's "
      "pruning of ISO 25178-2.");
}

void bind_areal_parameters(nb::module_& m) {
  nb::class_<ArealParameters> areal(
      m, "ArealParameters",
      "Areal parameters by the definitions of ISO 25178-2, under their names there.");
#define SALEBRA_AREAL(name, text) areal.def_ro(#name, &ArealParameters::name, text)
  SALEBRA_AREAL(Sa, "``⟨|h|⟩``, m");
  SALEBRA_AREAL(Sq, "√⟨h²⟩, m");
  SALEBRA_AREAL(Ssk, "Skewness.");
  SALEBRA_AREAL(Sku, "Kurtosis.");
  SALEBRA_AREAL(Sp, "Highest peak, m.");
  SALEBRA_AREAL(Sv, "Deepest pit, > 0, m.");
  SALEBRA_AREAL(Sz, "Sp + Sv, m.");
  SALEBRA_AREAL(Sal,
                "Shortest distance at which the autocorrelation has fallen to 0.2, m; NaN where it "
                "does not.");
  SALEBRA_AREAL(Str, "Sal over the longest such distance, 0 … 1.");
  SALEBRA_AREAL(Std, "Direction of the greatest angular spectrum, [0, π) rad.");
  SALEBRA_AREAL(Sdq, "Root mean square gradient.");
  SALEBRA_AREAL(Sdr, "Developed area over its projection, less 1.");
  SALEBRA_AREAL(Sk, "Core height, m.");
  SALEBRA_AREAL(Spk, "Reduced peak height, m.");
  SALEBRA_AREAL(Svk, "Reduced valley depth, m.");
  SALEBRA_AREAL(Smr1, "Material ratio of the peaks, 0 … 1.");
  SALEBRA_AREAL(Smr2, "Material ratio of the core, 0 … 1.");
  SALEBRA_AREAL(Spd, "Peaks per area, 1/m².");
  SALEBRA_AREAL(Spc, "Mean curvature of the peaks, 1/m.");
#undef SALEBRA_AREAL
  m.def(
      "areal_parameters",
      [](const BoundSurface& surface) {
        return unlocked([&] { return areal_parameters(surface.surface); });
      },
      nb::arg("surface"),
      "ISO 25178-2 parameters of the surface as it is given: form is removed by "
      ":meth:`Surface.detrended` alone, no S- or "
      "L-filter is applied.");
}

}  // namespace

void bind_surface(nb::module_& m) {
  bind_surface_class(m);
  bind_height_statistics(m);
  bind_summits(m);
  bind_areal_parameters(m);
}

}  // namespace salebra::python
