// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

namespace salebra {

/// The kind of instrument of a scan, which determines how the file differs from the true heights.
enum class Instrument {
  ideal,    ///< heights at points, with noise
  optical,  ///< heights blurred by a Gaussian point spread function
  stylus,   ///< heights dilated by a tip, line by line
  afm       ///< like stylus, with a finer tip
};

template <>
struct EnumNames<Instrument> {
  static constexpr auto values =
      std::to_array<std::pair<Instrument, std::string_view>>({{Instrument::ideal, "ideal"},
                                                              {Instrument::optical, "optical"},
                                                              {Instrument::stylus, "stylus"},
                                                              {Instrument::afm, "afm"}});
};

struct ScanInstrument {
  Instrument kind = Instrument::ideal;
  double resolution = 0;  ///< full width at half maximum of the point spread function, m; only for
                          ///< optical
  double tip_radius = 0;  ///< m; stylus and afm
  /// rms of white noise, m; NaN estimates it from the spectrum. A given value is a starting point,
  /// free by a factor of about 1.6 either way.
  double noise = std::numeric_limits<double>::quiet_NaN();
  double height_calibration = 0.05;  ///< relative standard error of all heights of the instrument
  double scan_calibration = 0.02;    ///< the same for one scan, independent of the others
  /// True if drift shifts lines along x against each other: the modes |k_x| <= 2 are then omitted.
  /// By default true for stylus and afm.
  std::optional<bool> line_drift = {};
  /// Scans with the same instrument name share its height calibration; without a name, scans with
  /// the same kind, resolution and tip do.
  std::string name = {};

  bool has_tip() const { return kind == Instrument::stylus || kind == Instrument::afm; }
  bool drifts() const { return line_drift.value_or(has_tip()); }
};

constexpr void describe(auto&& visit, std::type_identity<ScanInstrument>) {
  using enum Dimension;
  using S = ScanInstrument;
  visit(&S::kind, Kept{"kind", "what the scan was made with"});
  visit(&S::resolution, Kept{"resolution", "full width at half maximum of the blur", length});
  visit(&S::tip_radius, Kept{"tip_radius", "radius of the tip", length});
  visit(&S::noise, Kept{"noise", "root mean square of white noise", length});
  visit(&S::height_calibration,
        Kept{"height_calibration", "relative standard error of heights of the instrument"});
  visit(&S::scan_calibration,
        Kept{"scan_calibration", "relative standard error of heights of one scan"});
  visit(&S::line_drift, Kept{"line_drift", "whether lines along x drift"});
  visit(&S::name, Kept{"name", "name of the instrument"});
}

/// Heights in a band of wavelengths: means over blocks of side b minus the mean over 3 blocks in
/// each direction, which keeps at least half of the amplitude of waves of 2b to 5b.
struct HeightBand {
  double wavelength = 0;  ///< 4b, m
  double rms_height = 0;  ///< m
  double skewness = 0;
  double kurtosis = 0;  ///< 3 for a Gaussian surface
  Index blocks = 0;
};

constexpr void describe(auto&& visit, std::type_identity<HeightBand>) {
  using enum Dimension;
  using S = HeightBand;
  visit(&S::wavelength, Kept{"wavelength", "middle wavelength of the band", length});
  visit(&S::rms_height, Kept{"rms_height", "root mean square height in the band", length});
  visit(&S::skewness, Kept{"skewness", "skewness of heights in the band"});
  visit(&S::kurtosis, Kept{"kurtosis", "kurtosis of heights in the band, 3 for a Gaussian"});
  visit(&S::blocks, Kept{"blocks", "means that were taken"});
}

/// Everything that the fit of a surface twin needs from one scan: about a hundred numbers.
struct ScanSpectrum {
  ScanInstrument instrument;
  Grid2D grid;  ///< a profile has ny = 1 and ignores ly
  double weight = 1;
  std::string name;                ///< name of the scan, for messages
  std::vector<double> wavenumber;  ///< geometric middle of each bin, rad/m
  std::vector<double> psd;        ///< mean periodogram in the bin: C, m⁴; for a profile C₁, m³
  std::vector<Index> modes;       ///< number of modes of the full spectrum; 0 if drift removed all
  std::vector<HeightBand> bands;  ///< from fine to coarse

  bool profile() const { return grid.ny == 1; }
};

constexpr void describe(auto&& visit, std::type_identity<ScanSpectrum>) {
  using enum Dimension;
  using S = ScanSpectrum;
  visit(&S::instrument, Part{"instrument", "what the scan was made with"});
  visit(&S::grid, Part{"grid", "points and size of the scan"});
  visit(&S::weight, Kept{"weight", "how many scans it counts as"});
  visit(&S::name, Kept{"name", "name of the scan"});
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Kept{"psd", "mean periodogram", length_to_the_fourth});
  visit(&S::modes, Quantity{"modes", dimensionless, "modes in the mean"});
  visit(&S::bands, Table{"bands", "heights by wavelength"});
  visit(&S::profile, Kept{"profile", "whether it is a line"});
}

/// Computes the spectrum of a scan for fit_twin:
///     const ScanSpectrum scan = scan_spectrum(surface.heights, surface.grid,
///                                             {.kind = Instrument::afm, .tip_radius = 10e-9});
/// Bins of κ = qL/2π, L = √(lx ly), have the limits 0.5, 1.5, …, 8.5, then grow by the ratio 1.15
/// up to the lower Nyquist wave number. The least-squares plane is subtracted. Below κ = 12 the
/// periodogram is the mean over four products of the tapers √2 sin(πkξ), k = 1, 2 (Riedel and
/// Sidorenko (1995)), which keeps twice as many independent modes as a Hann window; above, it uses
/// a Hann window, since the tapers leak as q⁻⁴ past a sharp cut-off.
/// heights   (nx, ny), m; lines of a scanning instrument are along x
/// weight    > 0; the number of such scans that this one represents
/// Throws InvalidInput unless all heights are defined, nx, ny >= 32, the sides are at most 4 to 1,
/// resolution is > 0 for optical and tip_radius > 0 for stylus and afm, and calibrations are >= 0.
/// Cost: one FFT and a product of the heights with 52 columns; 20 bytes per point. The bits are the
/// same for any number of threads.
ScanSpectrum scan_spectrum(const Field& heights, const Grid2D& grid,
                           const ScanInstrument& instrument, double weight = 1,
                           std::string name = {});

/// Does the same for a line of at least 64 heights, m, over `length` metres, from C₁ = |dx Σ w h
/// e^{−iqx}|²/(2πl) with h_rms² = ∫C₁ dq over −∞ < q < ∞.
ScanSpectrum profile_spectrum(const std::vector<double>& heights, double length,
                              const ScanInstrument& instrument, double weight = 1,
                              std::string name = {});

}  // namespace salebra
