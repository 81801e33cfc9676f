// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of reading and writing surfaces and force curves.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "bindings.hpp"
#include "interop/path.hpp"
#include "interop/processes.hpp"
#include "interop/reading.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"
#include "io/surface_importer.hpp"

namespace salebra::python {
namespace {

/// Imports a file of unknown format by the code of salebra-import, but in the process of the user.
std::vector<std::string> import_here(const std::filesystem::path& from,
                                     const std::filesystem::path& to, const std::string& channel,
                                     const UnknownFormat& refusal) {
  const nb::gil_scoped_acquire held;
  try {
    return nb::cast<std::vector<std::string>>(
        nb::module_::import_("salebra._importing").attr("imported")(from, to, channel));
  } catch (nb::python_error& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw InvalidInput(from.string(),
                       refusal.statement() + "; " + nb::cast<std::string>(nb::str(error.value())));
  }
}

}  // namespace

void bind_files(nb::module_& m) {
  set_surface_importer(import_here);
  m.def(
      "read_surface",
      [](const std::filesystem::path& file, std::optional<double> size_x,
         std::optional<double> size_y, std::optional<bool> periodic, const std::string& height_unit,
         bool transpose, const PixelSize& pixel_size, const std::string& lateral_unit,
         std::optional<double> despike, const std::optional<std::vector<double>>& crop, bool fill,
         bool profiles, const std::string& channel, const ProcessesArgument& comm) {
        const Communicator communicator = comm.communicator();
        std::vector<std::string> warnings;
        ReadOptions options;
        options.size_x = size_x;
        options.size_y = size_y;
        options.periodic = periodic;
        options.height_unit = height_unit;
        options.transpose = transpose;
        options.pixel_size = pixel_size_of(pixel_size);
        options.lateral_unit = lateral_unit;
        options.channel = channel;
        options.despike = despike;
        options.crop = rectangle_of(crop);
        if (fill) options.undefined = Undefined::fill;
        options.profiles = profiles;
        options.warnings = &warnings;
        Surface surface = unlocked([&] { return read_surface(file, options, communicator); });
        for (const std::string& line : warnings) warn_user(line);
        return new_surface(std::move(surface));
      },
      nb::arg("file"), nb::kw_only(), nb::arg("size_x") = nb::none(),
      nb::arg("size_y") = nb::none(), nb::arg("periodic") = nb::none(), nb::arg("height_unit") = "",
      nb::arg("transpose") = false, nb::arg("pixel_size") = nb::none(),
      nb::arg("lateral_unit") = "", nb::arg("despike") = nb::none(), nb::arg("crop") = nb::none(),
      nb::arg("fill") = false, nb::arg("profiles") = false, nb::arg("channel") = "",
      nb::arg("comm") = nb::none(),
      R"(Reads the heights of a surface.

The first bytes of the file, not its name, decide the format: HDF5, NPY, X3P, GWY, GSF, SUR,
text matrices with the headers of Gwyddion and of instruments, XYZ; text may be packed by gzip. SurfaceTopography reads other formats of
instruments if it is installed (``pip install 'salebra[formats]'``). Undefined points become NaN.

Parameters
----------
file : str or os.PathLike
size_x, size_y : float, optional
    Size in m, instead of the size in the file; required if the file has none.
periodic : bool, optional
    Whether the surface repeats itself, instead of the value in the file.
height_unit : str
    Unit of the heights, such as "nm", for files that have none; empty: metres.
transpose : bool
    Exchange x and y of the file, before all other options apply.
pixel_size : float or (float, float), optional
    Distance of points along x and y in m, instead of sizes.
lateral_unit : str
    Unit of XYZ points, such as "um", for files that have none; empty: metres.
despike : float, optional
    Makes points undefined that are this many robust standard deviations from their neighbours, see :meth:`Surface.despiked`.
crop : (float, float, float, float), optional
    x0, y0, x1, y1 of the part to use, m; applied after `despike`.
fill : bool
    Fill undefined points in the end, see :meth:`Surface.filled`.
profiles : bool
    Accept line profiles too, as a surface of one row, for :func:`fit_profile`.
channel : str
    Number or name of one of several surfaces in a file of GWY, HDF5 (a dataset) or an instrument; empty: the first whose unit is a length.
comm : mpi4py.MPI.Intracomm, optional
    Processes over which the surface is distributed, as in :func:`filtered_noise`. Each process reads its rows of an HDF5 file; the first
    process reads files of other formats.

Raises
------
InvalidInput
    "<file>: <what is wrong>; <what to do>" for a file that is absent, not one of these, truncated, ambiguous, without a size, or
    with an infinite height.

Warns
-----
UserWarning
    If a size differs from that in the file, if the slopes suggest another unit of the heights, if single points are isolated, or
    if one of several channels was chosen.
)");
  m.def(
      "write_surface",
      [](const std::filesystem::path& file, const BoundSurface& surface, bool overwrite) {
        unlocked([&] { write_surface(file, surface.surface, {}, {overwrite}); });
      },
      nb::arg("file"), nb::arg("surface"), nb::kw_only(), nb::arg("overwrite") = false,
      R"(Writes heights in metres, in the format that the extension names.

Parameters
----------
file : str or os.PathLike
    .h5, .hdf5, .npy (with a sidecar .json), .gwy, .gsf (float32), .txt, .asc or .xyz.
surface : Surface
    If the surface is distributed over processes, the file must be HDF5, and all processes make the call.
overwrite : bool
    Replace an existing file. The file appears complete or not at all.

Raises
------
InvalidInput
    For another extension, an invalid surface, or an existing file.
IoError
    If the operating system refuses.
)");
  m.def(
      "read_force_curve",
      [](const std::filesystem::path& file) {
        return unlocked([&] { return read_force_curve(file); });
      },
      nb::arg("file"),
      R"(Reads a force–gap curve from HDF5 (group `curve`) or from a table with named columns and units.

A table begins with the names of :class:`ForceCurve`'s columns, each with a unit in brackets unless it is SI::

    # nominal_area: 1 mm^2
    pressure [MPa], mean_gap [nm], normal_stiffness [N/um], converged
    0.1, 350, 12, 1
)");
  m.def(
      "write_force_curve",
      [](const std::filesystem::path& file, const ForceCurve& curve, bool overwrite) {
        unlocked([&] { write_force_curve(file, curve, {}, {overwrite}); });
      },
      nb::arg("file"), nb::arg("curve"), nb::kw_only(), nb::arg("overwrite") = false,
      "Writes a curve: .h5 and .hdf5 with the group `curve`, .csv and .txt as text for "
      ":func:`read_force_curve`.");
}

}  // namespace salebra::python
