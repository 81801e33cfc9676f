// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of the surface twin (scans with their instruments, the fit, the draws of its spectrum)
// and of the plain average of scans.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <salebra/figures/figures.hpp>
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

/// The Python object of a surface twin. It keeps the spectra of its scans, so that fit() needs no
/// argument.
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
  described_class<ScanInstrument>(m, "ScanInstrument", "The instrument of a scan; NaN: not known.");
  described_class<HeightBand>(m, "HeightBand", "Heights between two neighbouring lengths.");
  described_class<ScanSpectrum>(
      m, "ScanSpectrum",
      "Data of one scan for a surface twin: its binned periodogram and its instrument. wavelength, "
      "rms_height, skewness and kurtosis describe the bands of its heights; tapered_powers and "
      "hann_powers are those of its modes.");
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
      R"(Reduces a scan, or a line profile, to its periodogram for :class:`SurfaceTwin`, half of the size of its heights, so that only one scan is in memory at a time.

Parameters
----------
surface : Surface
    Without undefined points; its plane is subtracted. Scan lines are along x.
instrument : {"ideal", "optical", "stylus", "afm"}
    "ideal": exact heights at points, with noise.
resolution : float
    Full width at half maximum of the blur, m; for "optical", which needs no other length.
tip_radius : float
    Radius of the tip, m; for "stylus" and "afm".
noise : float
    Rms of white noise, m; NaN: estimated from the spectrum.
height_calibration, scan_calibration : float
    Relative standard error common to all heights of the instrument, and that of one scan.
line_drift : bool, optional
    Whether lines are offset from each other; by default for "stylus" and "afm".
name : str
    Scans with the same name share their height calibration; without names, those with the same instrument, resolution and tip do.
weight : float
    Number of scans as which it counts.

Raises
------
InvalidInput
    For undefined heights, fewer than 32 points a side (64 for a profile), sides above 4 to 1, or an instrument without its length.
)");
}

void bind_fit(nb::module_& m) {
  described_class<TwinDraw>(m, "TwinDraw",
                            "The spectrum of one surface that is compatible with the scans.")
      .def(
          "density",
          [](const TwinDraw& self, const Numbers& wavenumber) {
            return for_each_number(wavenumber, [&](double q) { return self.density(q); });
          },
          nb::arg("wavenumber"),
          nb::sig("def density(self, wavenumber: numpy.typing.ArrayLike) -> typing.Any"),
          "C, m⁴, at wave numbers > 0, rad/m, across the lay.")
      .def(
          "tabulated",
          [](const TwinDraw& self, double lowest, int points_per_decade) {
            const SpectrumTable table = tabulated(self, lowest, points_per_decade);
            return TabulatedSpectrum(table.wavenumber, table.psd);
          },
          nb::arg("lowest"), nb::arg("points_per_decade") = 60,
          "The spectrum across the lay from `lowest`, rad/m, to its end, for "
          ":func:`filtered_noise` on a "
          "grid. "
          "π/size, "
          "half of the smallest wave number of the grid, is low enough.");
  described_class<TwinParameter>(
      m, "TwinParameter",
      "Estimate of one quantity: value, low, high (95 %), and whether the scans determine it "
      "(`seen`). "
      "A wavelength that they do not determine has only one limit; the other numbers are NaN.")
      .def("__repr__", [](const TwinParameter& self) {
        return fmt::format("TwinParameter(value={:.4g}, low={:.4g}, high={:.4g}, seen={})",
                           self.value, self.low, self.high, self.seen ? "True" : "False");
      });
  described_class<TwinSpectrum>(m, "TwinSpectrum", "The spectrum with its 95 % band.");
  described_class<TwinGroup>(
      m, "TwinGroup",
      "Scans with one instrument, size and grid, and the range of them that was used.");
  described_class<TwinScan>(m, "TwinScan", "One scan compared with the fit.");
  described_class<TwinWithout>(m, "TwinWithout", "The fit without one instrument.");
  described_class<BoundTwin>(
      m, "SurfaceTwin",
      R"(One surface, with its lay and the skewness of its heights, estimated from several scans by several instruments.

``SurfaceTwin(measurements).fit()`` does the same as `salebra twin`, with the same names; before fit() the numbers are NaN.

Parameters
----------
measurements : list of ScanSpectrum, str or os.PathLike
    Results of :func:`scan_spectrum`; or a TOML file of tables [[measurement]], as `salebra twin init` writes it, whose scans are read at
    once, one after the other.
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
          R"(Fits the twin to its scans, with joint 95 % limits of the parameters, and returns the same object.

Parameters
----------
seed : int
    Seed of the draws.
draws : int
    Number of draws to keep, >= 100.
form : {"corner", "smooth", "table"}, optional
    How the spectrum falls from its plateau; none given: by likelihood.
drop_bad_scans : bool
    Leave out a scan that is far from the fit of all; `warnings` names it.
leave_one_out : bool
    Fit once more without each instrument, as a check, into `without`.

Raises
------
InvalidInput
    Without scans, with fewer than 8 usable bins, or for two lays, or a lay that depends on the wavelength.
)")
      .def(
          "draw", [](const BoundTwin& self, std::uint64_t seed) { return self.draw(seed); },
          nb::arg("seed"), "One of `draws`, selected by the seed: the parameters of one surface.")
      .def(
          "write",
          [](const BoundTwin& self, const std::filesystem::path& file, bool overwrite) {
            unlocked([&] { write_twin(file, self, {}, {overwrite}); });
          },
          nb::arg("file"), nb::kw_only(), nb::arg("overwrite") = false,
          "Writes the HDF5 file for `[surface] twin` of a study.")
      .def("__repr__", [](const BoundTwin& self) {
        if (self.draws.empty())
          return fmt::format("SurfaceTwin({} scans, not fitted)", self.measurements.size());
        return fmt::format("SurfaceTwin({} scans, form='{}', misfit={:.2g})",
                           self.measurements.size(), name_of(self.form), self.misfit);
      });
  auto twin = nb::borrow<nb::class_<BoundTwin>>(nb::type<BoundTwin>());
  figure_methods(twin, [](const BoundTwin& self) { return figures::figure_of(self); });
}

void bind_average(nb::module_& m) {
  described_class<PlainSpectrum>(
      m, "PlainSpectrum",
      "Spectrum of the profiles of one scan, or its unweighted mean over "
      "several scans, in ten bins per decade.");
  m.def(
      "plain_spectrum",
      [](const BoundSurface& surface) {
        require_whole(surface, "a spectrum");
        return unlocked(
            [&] { return plain_spectrum(surface.surface.heights, surface.surface.grid); });
      },
      nb::arg("surface"),
      "C₁ of the profiles along x with a Hann window, in the bins of SurfaceTopography, whose C is "
      "2πC₁. No plane is subtracted.");
  m.def(
      "plain_average", &plain_average, nb::arg("scans"),
      "Mean of :func:`plain_spectrum` over scans in each bin, without instruments, weights or "
      "variance. For comparison with :class:`SurfaceTwin`, which corrects for the power that a tip "
      "or a lens removes.");
}

}  // namespace

void bind_twin(nb::module_& m) {
  bind_scans(m);
  bind_fit(m);
  bind_average(m);
}

}  // namespace salebra::python
