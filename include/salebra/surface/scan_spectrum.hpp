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

/// The kind of instrument that measured a scan. It determines how the heights in the file differ
/// from the true heights.
enum class Instrument {
  ideal,    ///< true heights at points, with noise
  optical,  ///< heights blurred by a Gaussian point spread function
  stylus,   ///< heights dilated by a tip, line by line
  afm       ///< like stylus, but with a finer tip
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
  /// rms of white noise, m; NaN: estimated from the spectrum. A given value is only a starting
  /// point: the fit may change it by a factor of about 1.6 up or down.
  double noise = std::numeric_limits<double>::quiet_NaN();
  double height_calibration = 0.05;  ///< relative standard error of the instrument's height scale
  double scan_calibration = 0.02;    ///< likewise for one scan, independent of other scans
  /// True if drift shifts the lines along x against each other; modes with at most two waves along
  /// x are then omitted. Empty: true for stylus and afm, false for other instruments.
  std::optional<bool> line_drift = {};
  /// Name of the instrument. Scans with the same name share one height calibration; scans without a
  /// name share it if kind, resolution and tip are equal.
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

/// Statistics of the heights in a band of wavelengths, filtered by taking means over blocks of side
/// b minus means over three blocks in each direction. The filter keeps at least half of the
/// amplitude of waves of length 2b to 5b.
struct HeightBand {
  double wavelength = 0;  ///< 4b, m, with the side b of a block
  double rms_height = 0;  ///< of the filtered heights, m
  double skewness = 0;    ///< 0 for a Gaussian surface
  double kurtosis = 0;    ///< 3 for a Gaussian surface
  Index blocks = 0;       ///< number of blocks
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

/// Everything that the fit of a surface twin needs from one scan: about a hundred numbers and, for a
/// map, the periodogram of its modes, by which the fit finds a lay.
struct ScanSpectrum {
  ScanInstrument instrument;
  Grid2D grid;                     ///< a profile has ny = 1 and ignores ly
  double weight = 1;               ///< number of scans that this one represents
  std::string name;                ///< name of the scan, for messages
  std::vector<double> wavenumber;  ///< geometric middle of each bin, rad/m
  std::vector<double> psd;   ///< mean periodogram in each bin: C, m⁴; for a profile C₁, m³
  std::vector<Index> modes;  ///< number of modes in each bin; 0 if drift removed all
  std::vector<HeightBand> bands;  ///< from fine to coarse
  /// Power C, m⁴, of each mode (k_x, k_y) of a map: under the sine tapers for −K_x <= k_x <= K_x and
  /// 0 <= k_y <= K_y, where K_x and K_y are the modes of κ = 42 along each axis; under the Hann
  /// window for all k_x of the grid, in the order of a Fourier transform, and 0 <= k_y <= ny/2.
  /// Empty for a profile.
  std::vector<double> tapered_powers, hann_powers;
  std::vector<double>
      height_moments;  ///< means of h², h³, h⁴ of the levelled heights h, m², m³, m⁴

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
  visit(&S::tapered_powers, Kept{"tapered_powers", "powers of modes under sine tapers"});
  visit(&S::hann_powers, Kept{"hann_powers", "powers of modes under the Hann window"});
  visit(&S::height_moments,
        Kept{"height_moments", "mean square, cube and fourth power of heights"});
  visit(&S::profile, Kept{"profile", "whether it is a line"});
}

/// Computes the spectrum of a scan for fit_twin:
///     const ScanSpectrum scan = scan_spectrum(surface.heights, surface.grid,
///                                             {.kind = Instrument::afm, .tip_radius = 10e-9});
/// Bins are formed in κ = qL/2π with L = √(lx ly) (waves per side). Their limits are 0.5, 1.5 and
/// so on in steps of 1 up to 8.5, and then grow by the ratio 1.15 up to the smaller of the two
/// Nyquist wave numbers. The least-squares plane is subtracted. Below κ = 12 the periodogram is the
/// mean over four windows, the products along x and y of the tapers √2 sin(πkξ), k = 1, 2, with ξ
/// from 0 to 1 along a side (Riedel and Sidorenko (1995)); this keeps twice as many independent
/// modes as a Hann window. Above κ = 12 it uses a Hann window, because the tapers leak power as q⁻⁴
/// beyond a sharp cut-off of the spectrum.
/// heights   (nx, ny), m; lines of a scanning instrument are along x
/// weight    > 0; number of scans of this kind that this scan represents
/// Throws InvalidInput unless all heights are defined, nx, ny >= 32, the longer side is at most 4
/// times the shorter, resolution is > 0 for optical, tip_radius is > 0 for stylus and afm, and
/// calibrations are >= 0. Cost: one FFT and a product of the heights with 200 columns; 20 bytes per
/// point, of which 4 remain. The bits are the same for any number of threads.
ScanSpectrum scan_spectrum(const Field& heights, const Grid2D& grid,
                           const ScanInstrument& instrument, double weight = 1,
                           std::string name = {});

/// Computes the spectrum for fit_twin of a line of at least 64 heights, m, over the length l =
/// `length`, m, from C₁ = |dx Σ w h e^{−iqx}|²/(2πl) with h_rms² = ∫C₁ dq over −∞ < q < ∞.
ScanSpectrum profile_spectrum(const std::vector<double>& heights, double length,
                              const ScanInstrument& instrument, double weight = 1,
                              std::string name = {});

}  // namespace salebra
