// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the surface twin: scans with their instruments, the fit, its draws; the plain average.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/study/twin_file.hpp>
#include <salebra/surface/plain_average.hpp>
#include <variant>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/path.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

/// A twin and the scans that it is made of, so that fit() needs no argument.
struct BoundTwin : SurfaceTwin {
  std::vector<ScanSpectrum> measurements;
};

constexpr void describe(auto&& visit, std::type_identity<BoundTwin>) {
  describe(visit, std::type_identity<SurfaceTwin>{});
  visit(&BoundTwin::measurements, Kept{"measurements", "the scans"});
}

ScanSpectrum measured_spectrum(const BoundSurface& bound, const ScanInstrument& instrument,
                               double weight) {
  require_whole(bound, "the spectrum of a scan");
  const Surface& surface = bound.surface;
  const std::string name = std::filesystem::path(surface.origin).filename().string();
  return unlocked([&] {
    if (surface.grid.ny > 1)
      return scan_spectrum(surface.heights, surface.grid, instrument, weight, name);
    const Field& line = surface.heights;
    return profile_spectrum({line.data(), line.data() + line.size()}, surface.grid.lx, instrument,
                            weight, name);
  });
}

void bind_scans(nb::module_& m) {
  described_class<ScanInstrument>(m, "ScanInstrument",
                                  "What a scan was made with; NaN is not known.");
  described_class<HeightBand>(m, "HeightBand", "Heights between two neighbouring lengths.");
  described_class<ScanSpectrum>(
      m, "ScanSpectrum",
      "All that a surface twin needs of one scan: its periodogram in bins, and what it was made "
      "with. wavelength, rms_height, skewness and kurtosis are of the bands of its heights.");
  m.def(
      "scan_spectrum",
      [](const BoundSurface& surface, const Choice<Instrument>& instrument, double resolution,
         double tip_radius, double noise, double height_calibration, double scan_calibration,
         std::optional<bool> line_drift, const std::string& name, double weight) {
        return measured_spectrum(surface,
                                 {instrument.value("instrument"), resolution, tip_radius, noise,
                                  height_calibration, scan_calibration, line_drift, name},
                                 weight);
      },
      nb::arg("surface"), nb::arg("instrument") = "ideal", nb::kw_only(),
      nb::arg("resolution") = 0.0, nb::arg("tip_radius") = 0.0,
      nb::arg("noise") = ScanInstrument{}.noise,
      nb::arg("height_calibration") = ScanInstrument{}.height_calibration,
      nb::arg("scan_calibration") = ScanInstrument{}.scan_calibration,
      nb::arg("line_drift") = nb::none(), nb::arg("name") = "", nb::arg("weight") = 1.0,
      R"(A scan, or a line profile, as :class:`SurfaceTwin` takes it: some hundred numbers, so that one scan is in memory at a time.

Parameters
----------
surface : Surface
    Complete; its plane is subtracted. Lines of a scanned instrument lie along x.
instrument : {"ideal", "optical", "stylus", "afm"}
    "ideal": heights at points, with noise.
resolution : float
    Full width at half maximum of the blur, m; "optical" needs it, and it alone.
tip_radius : float
    m; "stylus" and "afm" need it.
noise : float
    rms of white noise, m; NaN: found from the spectrum.
height_calibration, scan_calibration : float
    Relative standard error of all heights of the instrument, and of those of one scan.
line_drift : bool, optional
    Whether lines are offset from each other; none given: of "stylus" and "afm".
name : str
    Scans of one name share their height calibration; without it those of the same kind, resolution and tip do.
weight : float
    How many scans of its kind it counts as.

Raises
------
InvalidInput
    For undefined heights, fewer than 32 points a side (64 of a profile), sides above 4 to 1, an instrument without its length.
)");
}

void bind_fit(nb::module_& m) {
  described_class<TwinDraw>(m, "TwinDraw", "The spectrum of one surface that the scans allow.")
      .def(
          "density",
          [](const TwinDraw& self, const Numbers& wavenumber) {
            return for_each_number(wavenumber, [&](double q) { return self.density(q); });
          },
          nb::arg("wavenumber"),
          nb::sig("def density(self, wavenumber: numpy.typing.ArrayLike) -> typing.Any"),
          "C, m⁴, of q > 0 in rad/m.")
      .def(
          "tabulated",
          [](const TwinDraw& self, double lowest, int points_per_decade) {
            const SpectrumTable table = tabulated(self, lowest, points_per_decade);
            return TabulatedSpectrum(table.wavenumber, table.psd);
          },
          nb::arg("lowest"), nb::arg("points_per_decade") = 60,
          "The spectrum from `lowest`, rad/m, to its end, for :func:`filtered_noise` on a grid: "
          "π/size, half of its least wave number, is low enough.");
  described_class<TwinParameter>(
      m, "TwinParameter",
      "What is known of one quantity: value, low, high (95 %) and whether the scans decide on it; "
      "a wavelength that they do not has one limit alone, the others being NaN.")
      .def("__repr__", [](const TwinParameter& self) {
        return fmt::format("TwinParameter(value={:.4g}, low={:.4g}, high={:.4g}, seen={})",
                           self.value, self.low, self.high, self.seen ? "True" : "False");
      });
  described_class<TwinSpectrum>(m, "TwinSpectrum", "The spectrum with its 95 % band.");
  described_class<TwinGroup>(m, "TwinGroup",
                             "Scans of one instrument, size and grid, and what was used of them.");
  described_class<TwinScan>(m, "TwinScan", "One scan against the fit.");
  described_class<TwinWithout>(m, "TwinWithout", "The fit without one instrument.");
  described_class<BoundTwin>(
      m, "SurfaceTwin",
      R"(One isotropic surface that several scans by several instruments are pieces of.

``SurfaceTwin(measurements).fit()`` is the twin that `salebra twin` finds, with the same names; before fit() its numbers are NaN.

Parameters
----------
measurements : list of ScanSpectrum, str or os.PathLike
    Of :func:`scan_spectrum`; or a TOML file of tables [[measurement]] as `salebra twin init` writes it, whose scans are read now, one
    after the other.
)")
      .def(
          "__init__",
          [](BoundTwin* self,
             const std::variant<std::filesystem::path, std::vector<ScanSpectrum>>& measurements) {
            BoundTwin made;
            std::vector<std::string> warnings;
            if (const auto* file = std::get_if<std::filesystem::path>(&measurements))
              made.measurements = unlocked(
                  [&] { return spectra_of(read_twin_measurements(*file), signals(), &warnings); });
            else
              made.measurements = std::get<std::vector<ScanSpectrum>>(measurements);
            for (const std::string& line : warnings) warn_user(line);
            new (self) BoundTwin(std::move(made));
          },
          nb::arg("measurements"))
      .def(
          "fit",
          [](nb::handle_t<BoundTwin> self, std::uint64_t seed, Index draws,
             const std::optional<Choice<SpectrumForm>>& form, bool drop_bad_scans,
             bool leave_one_out) {
            cite({"riedel1995"});
            TwinOptions options{.seed = seed,
                                .draws = draws,
                                .drop_bad_scans = drop_bad_scans,
                                .leave_one_out = leave_one_out};
            if (form) options.form = form->value("form");
            auto& twin = nb::cast<BoundTwin&>(nb::handle(self));
            static_cast<SurfaceTwin&>(twin) =
                unlocked([&] { return fit_twin(twin.measurements, options); });
            return self;
          },
          nb::kw_only(), nb::arg("seed") = TwinOptions{}.seed,
          nb::arg("draws") = TwinOptions{}.draws, nb::arg("form") = nb::none(),
          nb::arg("drop_bad_scans") = true, nb::arg("leave_one_out") = true,
          nb::sig(
              "def fit(self, *, seed: int = 1, draws: int = 1000, form: typing.Literal['corner', "
              "'smooth', 'table'] | None = None, drop_bad_scans: bool = True, leave_one_out: bool "
              "= True) -> SurfaceTwin"),
          R"(Finds the twin of these scans, with joint 95 % limits of its parameters. Returns the object itself, whose numbers it now has.

Parameters
----------
seed : int
    Of the draws.
draws : int
    How many are kept, >= 100.
form : {"corner", "smooth", "table"}, optional
    How the spectrum falls from its plateau; none given: by likelihood.
drop_bad_scans : bool
    Leave out a scan far from the fit of all; `warnings` names it.
leave_one_out : bool
    Fit once more without each instrument, as a check, into `without`.

Raises
------
InvalidInput
    For no scan, or fewer than 8 usable bins.
)")
      .def(
          "draw", [](const BoundTwin& self, std::uint64_t seed) { return self.draw(seed); },
          nb::arg("seed"), "One of `draws`, chosen by the seed: the parameters of one surface.")
      .def(
          "write",
          [](const BoundTwin& self, const std::filesystem::path& file, bool overwrite) {
            unlocked([&] { write_twin(file, self, {}, {overwrite}); });
          },
          nb::arg("file"), nb::kw_only(), nb::arg("overwrite") = false,
          "Writes the HDF5 file that a study takes: `[surface] twin`.")
      .def("__repr__", [](const BoundTwin& self) {
        if (self.draws.empty())
          return fmt::format("SurfaceTwin({} scans, not fitted)", self.measurements.size());
        return fmt::format("SurfaceTwin({} scans, form='{}', misfit={:.2g})",
                           self.measurements.size(), name_of(self.form), self.misfit);
      });
}

void bind_average(nb::module_& m) {
  described_class<PlainSpectrum>(m, "PlainSpectrum",
                                 "Spectrum of the profiles of one scan, or its plain mean over "
                                 "several, in ten bins a decade.");
  m.def(
      "plain_spectrum",
      [](const BoundSurface& surface) {
        require_whole(surface, "a spectrum");
        return unlocked(
            [&] { return plain_spectrum(surface.surface.heights, surface.surface.grid); });
      },
      nb::arg("surface"),
      "C₁ of the profiles along x under Hann's window, as SurfaceTopography bins it, whose C is "
      "2πC₁. No plane is subtracted.");
  m.def("plain_average", &plain_average, nb::arg("scans"),
        "In each bin the mean over scans of :func:`plain_spectrum`, without instruments, weights "
        "or "
        "variance: a comparison for :class:`SurfaceTwin`, which knows that a tip or a lens takes "
        "power away.");
}

}  // namespace

void bind_twin(nb::module_& m) {
  bind_scans(m);
  bind_fit(m);
  bind_average(m);
}

}  // namespace salebra::python
