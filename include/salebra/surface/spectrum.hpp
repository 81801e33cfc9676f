// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/axis.hpp>
#include <vector>

namespace salebra {

/// Two-dimensional power spectral density C of a surface with heights h, in the convention
///     C(q) = (2π)⁻² ∫⟨h(0)h(x)⟩ e^{−iq·x} d²x,   h_rms² = ∫C d²q,   q in rad/m,
/// stored for the wave vectors (i, j) with j from 0 to ny/2 only, because C(−q) = C(q). The mean
/// height is omitted. For a surface distributed over processes the columns are distributed; results
/// computed from it are collective and have the same bits for any number of processes.
struct PowerSpectrum {
  Grid2D grid;
  Field psd;              ///< C, (nx, ny/2+1) or (nx, columns().count()), m⁴
  bool windowed = false;  ///< true if a window tapered the heights at the edges
  /// Number of neighbouring modes that count as one independent mode, because the window w mixes
  /// them: ⟨w⁴⟩/⟨w²⟩²; 1 without a window.
  double correlated_modes = 1;
  /// For a surface that is not periodic: wavelength, m, below which peaks and valleys differ, so
  /// that these waves may be the work of a tip (see estimate_hurst); 0 if peaks and valleys do not
  /// differ at any wavelength, infinity if every wave may come from a tip.
  double asymmetric_wavelength = 0;
  Communicator communicator = {};  ///< the processes that hold its columns

  RowPartition columns() const { return {communicator, grid.ny / 2 + 1}; }

  double wavenumber_x(Index i) const;         ///< q_x, rad/m; −π/dx < q_x <= π/dx
  double wavenumber_y(Index j) const;         ///< q_y >= 0, rad/m
  std::vector<double> wavenumbers_x() const;  ///< q_x of all rows
  std::vector<double> wavenumbers_y() const;  ///< q_y of the columns of this process
  /// Number of modes of the full spectrum that an entry of column j stands for: 1 if the column
  /// contains its own conjugates, otherwise 2.
  double multiplicity(Index j) const;
  double cell() const;  ///< area d²q of one mode, (2π)²/(lx ly), m⁻²
};

constexpr void describe(auto&& visit, std::type_identity<PowerSpectrum>) {
  using enum Dimension;
  using S = PowerSpectrum;
  visit(&S::grid, Kept{"grid", "points and size of the surface"});
  visit(&S::psd, Kept{"psd", "C, (nx, ny/2+1)", length_to_the_fourth});
  visit(&S::windowed, Kept{"windowed", "whether a window made the heights fade out at the edges"});
  visit(&S::correlated_modes, Kept{});
  visit(&S::asymmetric_wavelength,
        Kept{"asymmetric_wavelength", "wavelength up to which peaks and valleys differ", length});
  visit(&S::communicator, Kept{});
  visit(&S::wavenumbers_x, Quantity{"wavenumber_x", Dimension::wavenumber, "wave number along x"});
  visit(&S::wavenumbers_y, Quantity{"wavenumber_y", Dimension::wavenumber, "wave number along y"});
  visit(&S::cell,
        Kept{"cell", "area of one mode in the plane of wave vectors", inverse_length_squared});
}

/// The window that multiplies the heights before the transform, as a function of ξ = (i+½)/nx and η
/// = (j+½)/ny, both between 0 and 1. It suppresses leakage due to steps between opposite edges of
/// the surface.
enum class Window {
  automatic,  ///< none for a periodic surface, hann for any other
  none,       ///< no window
  hann,       ///< v(ξ)·v(η), v(ξ) = ½(1 − cos 2πξ)
  blackman,   ///< v(ξ)·v(η), v(ξ) = 0.42 − 0.5 cos 2πξ + 0.08 cos 4πξ: less leakage, less
              ///< resolution
  welch,  ///< v(ξ)·v(η), v(ξ) = 1 − (2ξ − 1)²: a finer resolution, leakage that falls as q⁻⁴
  radial_hann,  ///< ½(1 + cos 2πr/min(lx, ly)) in the inscribed circle and 0 outside, r from point
                ///< (nx/2, ny/2), as SurfaceTopography has it
};

template <>
struct EnumNames<Window> {
  static constexpr auto values =
      std::to_array<std::pair<Window, std::string_view>>({{Window::automatic, "default"},
                                                          {Window::none, "none"},
                                                          {Window::hann, "hann"},
                                                          {Window::blackman, "blackman"},
                                                          {Window::welch, "welch"},
                                                          {Window::radial_hann, "radial_hann"}});
};

/// Computes the power spectrum of a surface:
///     const RadialSpectrum psd = radial_spectrum(power_spectrum(surface));
/// For a periodic surface C is exact at each mode: Σ C d²q = h_rms². With a window w the weighted
/// mean ⟨wh⟩/⟨w⟩ is subtracted from the heights and C is divided by ⟨w²⟩, which preserves the
/// expectation of C at short waves; then Σ C d²q = ⟨w²(h − ⟨wh⟩/⟨w⟩)²⟩/⟨w²⟩. Subtract any tilt of
/// the surface first, with detrended(). Throws InvalidInput unless the surface is complete.
/// Collective. Cost: one FFT; 12 bytes per point, and 8 more if the surface is distributed over
/// processes.
PowerSpectrum power_spectrum(const Surface& surface, Window window = Window::automatic);

/// Power spectral density of profiles along one axis, C₁(q) = ∫C dq_y, so that h_rms² = ∫C₁ dq over
/// −∞ < q < ∞: the mean of |dx Σ w h e^{−iqx}|²/(2π l ⟨w²⟩) over all profiles of length l with the
/// window w, after subtracting from each profile its (weighted) mean.
struct ProfilePsd {
  std::vector<double> wavenumber;  ///< 2πk/l for k from 1 to n/2 (n points), rad/m
  std::vector<double> psd;         ///< C₁, m³
  std::vector<Index>
      modes;  ///< number of modes, q and −q of all profiles; one per profile at the Nyquist wave
              ///< number of an even n
  Index profiles = 0;
  double length = 0;  ///< l, m

  double step()
      const;  ///< dq = 2π/l, rad/m; ⟨h²⟩ of the profiles less their means = Σ modes·C₁·dq/profiles
};

constexpr void describe(auto&& visit, std::type_identity<ProfilePsd>) {
  using enum Dimension;
  using S = ProfilePsd;
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd,
        Quantity{"profile_psd", length_cubed,
                 "power spectral density C1 of profiles, rms_height^2 = integral of C1 dq over all "
                 "q"});
  visit(&S::modes, Quantity{"modes", dimensionless, "modes in the mean"});
  visit(&S::profiles, Kept{"profiles", "profiles in the mean"});
  visit(&S::length, Kept{"length", "length of a profile", length});
  visit(&S::step, Kept{"step", "from one wave number to the next", Dimension::wavenumber});
}

/// Computes the profile spectrum, e.g. `profile_psd(surface, Axis::x)`; Window::radial_hann gives
/// the same as Window::hann. Throws InvalidInput unless the surface is complete. The surface may be
/// distributed over processes. Collective. Cost: FFTs of all profiles.
ProfilePsd profile_psd(const Surface& surface, Axis axis, Window window = Window::automatic);

/// C averaged over rings of wave vectors. Every bin has at least one mode.
struct RadialSpectrum {
  std::vector<double> wavenumber;  ///< mean |q| of the modes in the bin, rad/m, increasing
  std::vector<double> psd;         ///< mean C of the modes in the bin, m⁴
  std::vector<Index> modes;  ///< number of modes of the full spectrum; h_rms² = Σ modes·C·d²q
};

constexpr void describe(auto&& visit, std::type_identity<RadialSpectrum>) {
  using enum Dimension;
  using S = RadialSpectrum;
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Quantity{"psd", length_to_the_fourth,
                          "power spectral density C, rms_height^2 = integral of C d^2q"});
  visit(&S::modes, Quantity{"modes", dimensionless, "modes in the mean"});
}

/// Averages C over rings whose limits have the ratio 2^(1/bins_per_octave), starting at the longest
/// wave; empty rings are omitted. All modes count; rings beyond π/max(dx, dy) contain modes in the
/// corners of the wave-number grid only.
RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave = 4);

/// A value with its 95 % interval; NaN if unknown.
struct IntervalEstimate {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double value = unknown, low = unknown, high = unknown;

  bool found() const { return value == value; }
};

constexpr void describe(auto&& visit, std::type_identity<IntervalEstimate>) {
  using S = IntervalEstimate;
  visit(&S::value, Kept{"value", "best estimate"});
  visit(&S::low, Kept{"low", "lower 95 % limit"});
  visit(&S::high, Kept{"high", "upper 95 % limit"});
  visit(&S::found, Kept{"found", "whether there is one"});
}

/// Hurst exponent of the self-affine range of a surface, C ∝ q^{−2(1+H)}, with its 95 % interval;
/// NaN if the spectrum has no such range.
struct HurstEstimate : IntervalEstimate {
  double wavenumber_min = unknown;  ///< lower end of the fitted range, rad/m
  double wavenumber_max = unknown;  ///< upper end of the fitted range, rad/m
  Index modes = 0;                  ///< number of modes in the range
};

constexpr void describe(auto&& visit, std::type_identity<HurstEstimate>) {
  using S = HurstEstimate;
  describe(visit, std::type_identity<IntervalEstimate>{});
  visit(&S::wavenumber_min,
        Kept{"wavenumber_min", "lower end of the range that was fitted", Dimension::wavenumber});
  visit(&S::wavenumber_max,
        Kept{"wavenumber_max", "upper end of the range that was fitted", Dimension::wavenumber});
  visit(&S::modes, Kept{"modes", "modes in the range"});
}

/// Estimates the Hurst exponent:
///     const HurstEstimate hurst = estimate_hurst(power_spectrum(surface));
/// Without a window (periodic surface), ln C of the radial spectrum up to π/max(dx, dy) is
/// described by up to three pieces: a plateau, a power law, and a tail of another slope (noise, tip
/// or filter). The Bayesian information criterion selects the number of pieces, allowing deviations
/// of 10 % in C. Bins without power end the range, and one bin at each end of the power law is
/// omitted. In the power-law piece, ln C = a − 2(1+H) ln q is fitted to all modes by maximum
/// quasi-likelihood, with powers exponentially distributed about C (as for a Gaussian surface). The
/// 95 % interval of H comes from the scatter of the bins about the fit (Student's t); it does not
/// include the uncertainty of the choice of the range.
///
/// With a window (a surface that continues beyond its edges), the model A·C(q)·exp(−g q²) + floor
/// is fitted to the radial spectrum, where C is a power law with or without a plateau, seen through
/// a Hann window. The floor >= 0 covers noise and aliased waves shorter than two cells; g >= 0
/// covers losses by pixels, lenses and tips. The fitted range is the longest range of q that this
/// model describes (90 % point of the deviance), without the four longest waves and below 0.8 of
/// π/max(dx, dy). The 95 % interval is that of a likelihood-ratio test at 5 % with free floor, g
/// and roll-off, relative to the deviance of the fit; it is extended to include the most likely H if the shortest half octave of the
/// range is left out. Powers of neighbouring modes count as correlated.
///
/// Waves shorter than shortest_wavelength, m, are excluded; a good choice is
/// ReliabilityLimit::wavelength(). The value 0 means that nothing is known of the instrument; then
/// waves shorter than PowerSpectrum::asymmetric_wavelength are excluded. The reason: second
/// differences of Gaussian heights are as often positive as negative, those of heights scanned by a
/// tip are not, and H would be wrong by up to 0.3. The test compares the third moment of the second
/// differences at each spacing s with its standard error from 36 parts of the surface (t > 4); if
/// it is significant, waves up to 4s count as asymmetric. If no range is found (less than a factor
/// of three in q, or H outside −0.2 to 1.5), the result is NaN; this is not an error. Cost: about
/// ten passes over the modes of the range.
HurstEstimate estimate_hurst(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

}  // namespace salebra
