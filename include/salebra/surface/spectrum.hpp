// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/share.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/surface/axis.hpp>
#include <vector>

namespace salebra {

/// Two-dimensional power spectral density of a surface in the convention
///     C(q) = (2π)⁻² ∫⟨h(0)h(x)⟩ e^{−iq·x} d²x,   h_rms² = ∫C d²q,   q in rad/m,
/// on the half-spectrum of wave vectors (i, j), j = 0 … ny/2; C(−q) = C(q). The mean height is left
/// out. That of a surface which is spread over processes is spread by columns. What is made of it
/// has the same bits for every number of processes, and is collective.
struct PowerSpectrum {
  Grid2D grid;
  Field psd;              ///< C, (nx, ny/2+1) or (nx, columns().count()), m⁴
  bool windowed = false;  ///< a window made the heights fade out at the edges
  /// How many neighbouring modes count as one in a mean, since the window mixes them: ⟨w⁴⟩/⟨w²⟩²; 1
  /// without a window.
  double correlated_modes = 1;
  /// Of a surface that is not periodic: waves up to this length may be a tip's, because peaks and
  /// valleys differ (estimate_hurst), m; 0 where they do not differ, infinity where all waves may be.
  double asymmetric_wavelength = 0;
  Communicator ranks = {};  ///< the processes that hold its columns

  Share columns() const { return {ranks, grid.ny / 2 + 1}; }

  double wavenumber_x(Index i) const;         ///< q_x, rad/m; −π/dx < q_x <= π/dx
  double wavenumber_y(Index j) const;         ///< q_y >= 0, rad/m
  std::vector<double> wavenumbers_x() const;  ///< of all rows
  std::vector<double> wavenumbers_y() const;  ///< of the columns of this process
  double multiplicity(Index j) const;  ///< 1 where column j holds its own conjugates, 2 elsewhere
  double cell() const;                 ///< d²q of one mode, (2π)²/(lx ly), m⁻²
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
  visit(&S::ranks, Kept{});
  visit(&S::wavenumbers_x, Quantity{"wavenumber_x", Dimension::wavenumber, "wave number along x"});
  visit(&S::wavenumbers_y, Quantity{"wavenumber_y", Dimension::wavenumber, "wave number along y"});
  visit(&S::cell,
        Kept{"cell", "area of one mode in the plane of wave vectors", inverse_length_squared});
}

/// What the heights are multiplied by before they are transformed, ξ = (i+½)/nx and η = (j+½)/ny
/// from edge to edge. A window takes the leakage of the steps between opposite edges out of the
/// spectrum.
enum class Window {
  automatic,  ///< none for a periodic surface, hann for any other
  none,       ///< 1
  hann,       ///< v(ξ)·v(η), v(ξ) = ½(1 − cos 2πξ)
  blackman,   ///< the same with v(ξ) = 0.42 − 0.5 cos 2πξ + 0.08 cos 4πξ: less leakage, less
              ///< resolution
  welch,  ///< the same with v(ξ) = 1 − (2ξ − 1)²: a finer resolution, leakage that falls as q⁻⁴
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

/// C of a periodic surface is exact on its modes: Σ C d²q = h_rms². Under a window the weighted
/// mean is subtracted, and C is divided by ⟨w²⟩, so that the expectation of a short-waved C is
/// kept, and Σ C d²q = ⟨w²(h − ⟨wh⟩/⟨w⟩)²⟩/⟨w²⟩; tilt should be subtracted before.
/// Throws InvalidInput unless the surface is complete. Cost: one FFT; 12 bytes for each point, and
/// over processes 8 more. Collective.
PowerSpectrum power_spectrum(const Surface& surface, Window window = Window::automatic);

/// Power spectral density of profiles along one axis, C₁(q) = ∫C dq_y, so that h_rms² = ∫C₁ dq over
/// −∞ < q < ∞: mean of |dx Σ w h e^{−iqx}|²/(2π l ⟨w²⟩) over all profiles, each less its (weighted)
/// mean.
struct ProfilePsd {
  std::vector<double> wavenumber;  ///< 2πk/l, k = 1 … n/2, rad/m
  std::vector<double> psd;         ///< C₁, m³
  std::vector<Index>
      modes;  ///< q and −q of all profiles; at the Nyquist wave number of an even n they are one
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

/// radial_hann is as hann here. Throws InvalidInput unless the surface is complete. The surface may
/// be spread over processes. Collective. Cost: transforms of all profiles.
ProfilePsd profile_psd(const Surface& surface, Axis axis, Window window = Window::automatic);

/// C averaged over rings of wave vectors. Every bin holds at least one mode.
struct RadialSpectrum {
  std::vector<double> wavenumber;  ///< mean |q| of the modes in the bin, rad/m, increasing
  std::vector<double> psd;         ///< mean C, m⁴
  std::vector<Index> modes;  ///< in the bin, of the full spectrum; h_rms² = Σ modes·C·d²q
};

constexpr void describe(auto&& visit, std::type_identity<RadialSpectrum>) {
  using enum Dimension;
  using S = RadialSpectrum;
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Quantity{"psd", length_to_the_fourth,
                          "power spectral density C, rms_height^2 = integral of C d^2q"});
  visit(&S::modes, Quantity{"modes", dimensionless, "modes in the mean"});
}

/// Rings whose limits are in the ratio 2^(1/bins_per_octave), from the longest wave on; empty ones
/// are left out. All modes are in: beyond π/max(dx, dy) only those in the corners of the lattice
/// remain.
RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave = 4);

/// A value with its 95 % interval; NaN where there is none.
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
/// NaN where the spectrum has no such range.
struct HurstEstimate : IntervalEstimate {
  double wavenumber_min = unknown;  ///< the range that was fitted, rad/m
  double wavenumber_max = unknown;
  Index modes = 0;  ///< in it
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

/// A spectrum without a window, of a periodic surface: the range is the middle of up to three pieces
/// (plateau, power law, and a tail of other slope: noise, or what a tip or filter left) that describe
/// ln C of the radial spectrum up to π/max(dx, dy) best by Bayes' information criterion, deviations
/// of 10 % in C being forgiven; bins without power end it, and a bin at either limit is left out. In
/// it, ln C = a − 2(1+H) ln q is fitted to all modes by maximum quasi-likelihood, the power of a
/// mode being exponentially distributed about C (as for a Gaussian surface). The interval is
/// Student's, from the scatter of the bins about the fit; it does not hold the choice of the range.
///
/// Under a window, of a surface that goes on beyond its edges: A·C(q)·exp(−g q²) + floor is fitted
/// to the rings, C having a plateau or none and being seen through Hann's window. The floor >= 0 is
/// noise and the waves shorter than two cells, which points fold into the spectrum; g >= 0 is what
/// pixels, lenses and tips take away. The range is the longest one that this law describes (90 %
/// point of the deviance), above the four longest waves and below 0.8 of π/max(dx, dy). The interval
/// is that of a likelihood-ratio test at 5 % in which floor, g and roll-off are free, and holds the
/// most likely H of the range without its shortest half octave. The powers of neighbouring modes
/// count as correlated.
///
/// shortest_wavelength: shorter waves take no part, m; such as ReliabilityLimit::wavelength(). Where
/// it is 0, nothing is known of the instrument, and waves up to asymmetric_wavelength take no part:
/// second differences over s of Gaussian heights are as often positive as negative, those of heights
/// that a tip scanned are not, and H would be wrong by up to 0.3. Their third moment tells, with the
/// error of a mean over 36 parts of the surface (t > 4); waves up to 4s count as asymmetric.
/// No range (less than a factor of three in q, or H outside −0.2 … 1.5) is a result with NaN, not an
/// error. Cost: some ten passes over the modes of the range.
HurstEstimate estimate_hurst(const PowerSpectrum& spectrum, double shortest_wavelength = 0);

}  // namespace salebra
