// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of reading and writing surfaces and force curves.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "bindings.hpp"
#include "interop/path.hpp"
#include "interop/processes.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {

void bind_files(nb::module_& m) {
  m.def(
      "read_surface",
      [](const std::filesystem::path& file, std::optional<double> size_x,
         std::optional<double> size_y, std::optional<bool> periodic, const std::string& height_unit,
         const ProcessesArgument& comm) {
        const Communicator ranks = comm.ranks();
        std::vector<std::string> remarks;
        Surface surface = unlocked([&] {
          return read_surface(file, {size_x, size_y, periodic, height_unit, &remarks}, ranks);
        });
        for (const std::string& line : remarks) warn_user(line);
        return new_surface(std::move(surface));
      },
      nb::arg("file"), nb::kw_only(), nb::arg("size_x") = nb::none(),
      nb::arg("size_y") = nb::none(), nb::arg("periodic") = nb::none(), nb::arg("height_unit") = "",
      nb::arg("comm") = nb::none(),
      R"(Reads the heights of a surface.

What the file is follows from its first bytes, not from its name: HDF5, NPY, NetCDF in SurfaceTopography's layout, X3P, GWY, GSF,
GXYZF, SUR, text matrices with the headers of Gwyddion and of instruments, XYZ. Other instrument formats:
:meth:`Surface.from_topography`. Undefined points become NaN.

Parameters
----------
file : str or os.PathLike
size_x, size_y : float, optional
    Size in m, in place of the file's; needed where the file does not know it.
periodic : bool, optional
    In place of the file's.
height_unit : str
    Such as "nm", for files that give none; empty: metres.
comm : mpi4py.MPI.Intracomm, optional
    Processes over which the surface is spread, as in :func:`filtered_noise`. Of an HDF5 file each reads its rows; any other is read whole by
    the first one.

Raises
------
InvalidInput
    "<file>: <what is wrong>; <what to do>" for a file that is absent, not one of these, truncated, ambiguous, without a size, or
    with an infinite height.

Warns
-----
UserWarning
    Where a size differs from the file's, or the slopes are those of heights in another unit.
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
    .h5, .hdf5, .npy (with a sidecar .json), .nc, .gwy, .gsf (float32), .txt, .asc or .xyz.
surface : Surface
    One that is spread over processes goes into HDF5 files only, by a call of all processes.
overwrite : bool
    Replace an existing file. The file appears complete or not at all.

Raises
------
InvalidInput
    For another extension, an invalid surface, or an existing file.
IoError
    Where the system refuses.
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
      "Writes a curve: .h5 and .hdf5 with the group `curve`, .csv and .txt as text that "
      ":func:`read_force_curve` takes.");
}

}  // namespace salebra::python
