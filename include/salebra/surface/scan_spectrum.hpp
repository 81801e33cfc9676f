// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/enum_names.hpp>
#include <string>
#include <vector>

namespace salebra {

/// What a scan was made with, and so what stands between the heights and the file.
enum class Instrument {
  ideal,    ///< heights at points, with noise
  optical,  ///< heights blurred by a Gaussian point spread function
  stylus,   ///< heights dilated by a tip, line by line
  afm       ///< the same with a finer tip
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
  double resolution = 0;  ///< full width at half maximum of the point spread, m; optical alone
  double tip_radius = 0;  ///< m; stylus and afm
  /// rms of white noise, m; NaN: found from the spectrum. A given one is a start, free by a factor
  /// of about 1.6 either way.
  double noise = std::numeric_limits<double>::quiet_NaN();
  double height_calibration = 0.05;  ///< relative standard error of all heights of the instrument
  double scan_calibration = 0.02;    ///< the same of one scan, independent of the others
  /// Lines along x are offset from each other by drift: the modes |k_x| <= 2 are left out. None
  /// given: of stylus and afm.
  std::optional<bool> line_drift = {};
  /// Scans of one name share its height calibration; those without a name do where kind,
  /// resolution and tip are the same.
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

/// Heights between two neighbouring lengths: means over blocks of side b less the mean over 3
/// blocks each way, which is half of the amplitude and more for waves of 2b to 5b.
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

/// All that the fit of a surface twin needs of one scan: some hundred numbers.
struct ScanSpectrum {
  ScanInstrument instrument;
  Grid2D grid;  ///< a profile has ny = 1; its ly is of no use
  double weight = 1;
  std::string name;                ///< of the scan, for what is said about it
  std::vector<double> wavenumber;  ///< geometric middle of each bin, rad/m
  std::vector<double> psd;         ///< mean periodogram in the bin; C, m⁴, of a profile C₁, m³
  std::vector<Index> modes;        ///< in the bin, of the full spectrum; 0 where drift took all
  std::vector<HeightBand> bands;   ///< from fine to coarse

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

/// Spectrum of a scan in bins of κ = qL/2π, L = √(lx ly): limits 0.5, 1.5, …, 8.5, then in the
/// ratio 1.15 up to the lower of the two Nyquist wave numbers. The least-squares plane is
/// subtracted. Below κ = 12 the periodogram is the mean over four products of the tapers
/// √2 sin(πkξ), k = 1, 2 (Riedel and Sidorenko (1995)), which keeps twice as many independent
/// modes as a Hann window; above, that of a Hann window, since the tapers leak as q⁻⁴ past a sharp
/// cut-off.
/// heights   (nx, ny), m; lines of a scanned instrument lie along x
/// weight    > 0; how many scans of its kind it counts as
/// Throws InvalidInput unless all heights are defined, nx, ny >= 32, the sides are at most 4 to 1,
/// resolution is > 0 for optical and tip_radius > 0 for stylus and afm, calibrations are >= 0.
/// Cost: one FFT, a product of the heights with 52 columns; 20 bytes for each point. The same bits
/// for any number of threads.
ScanSpectrum scan_spectrum(const Field& heights, const Grid2D& grid,
                           const ScanInstrument& instrument, double weight = 1,
                           std::string name = {});

/// The same of a line of heights, m, over `length` metres, from C₁ = |dx Σ w h e^{−iqx}|²/(2πl):
/// h_rms² = ∫C₁ dq over −∞ < q < ∞. There are at least 64 points.
ScanSpectrum profile_spectrum(const std::vector<double>& heights, double length,
                              const ScanInstrument& instrument, double weight = 1,
                              std::string name = {});

}  // namespace salebra
