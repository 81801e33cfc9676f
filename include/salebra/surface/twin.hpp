// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/surface/scan_spectrum.hpp>
#include <salebra/surface/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// How C falls from its plateau to its power law.
enum class SpectrumForm {
  corner,  ///< C = A max(q, q_r)^{−2(1+H)}, 0 above q_s
  smooth,  ///< C = A (q_r² + q²)^{−(1+H)}, 0 above q_s
  table    ///< natural cubic spline of ln C over ln q, 0 above q_s
};

template <>
struct EnumNames<SpectrumForm> {
  static constexpr auto values =
      std::to_array<std::pair<SpectrumForm, std::string_view>>({{SpectrumForm::corner, "corner"},
                                                                {SpectrumForm::smooth, "smooth"},
                                                                {SpectrumForm::table, "table"}});
};

/// The spectrum of one surface that the scans allow. Wavelengths λ = 2π/q.
struct TwinDraw {
  SpectrumForm form = SpectrumForm::corner;
  double hurst = 0;         ///< H; NaN for a table
  double rolloff = 0;       ///< λ_r, m; NaN for a table
  double short_cutoff = 0;  ///< λ_s, m
  double rms_height = 0;    ///< of all waves, m; of a table, of those that a scan holds
  double rms_slope = 0;
  double amplitude = 0;  ///< ln C at `reference` of the power law, without plateau; 0 for a table
  double reference = 0;  ///< rad/m
  std::vector<double> knots;    ///< of a table, rad/m
  std::vector<double> log_psd;  ///< ln C there

  /// C, m⁴, of q > 0 in rad/m.
  double density(double q) const;
};

constexpr void describe(auto&& visit, std::type_identity<TwinDraw>) {
  using enum Dimension;
  using S = TwinDraw;
  visit(&S::form, Kept{"form", "how the spectrum falls from its plateau"});
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::rolloff, Quantity{"rolloff", length, "roll-off wavelength"});
  visit(&S::short_cutoff, Quantity{"short_cutoff", length, "shortest wavelength"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::amplitude, Kept{"amplitude", "logarithm of the power law at the reference"});
  visit(&S::reference, Kept{"reference", "wave number of the amplitude", wavenumber});
  visit(&S::knots, Kept{"knots", "wave numbers of a table", wavenumber});
  visit(&S::log_psd, Kept{"log_psd", "logarithm of the spectral density at the knots"});
}

/// C at wave numbers in geometric progression, those of the corner and of the end among them.
struct SpectrumTable {
  std::vector<double> wavenumber;  ///< increasing, rad/m
  std::vector<double> psd;         ///< m⁴
};

constexpr void describe(auto&& visit, std::type_identity<SpectrumTable>) {
  using S = SpectrumTable;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number", Dimension::wavenumber});
  visit(&S::psd, Kept{"psd", "spectral density", Dimension::length_to_the_fourth});
}

/// The spectrum of a draw from `lowest` to its end, straight in ln C over ln q between the points
/// to about 1e-4. Throws InvalidInput unless 0 < lowest < 2π/λ_s.
SpectrumTable tabulated(const TwinDraw& draw, double lowest, int points_per_decade = 60);

/// What is known of one quantity. Where no scan sees it, `seen` is false: a wavelength has then one
/// limit alone, value and the other limit being NaN.
struct TwinParameter : IntervalEstimate {
  bool seen = false;
};

constexpr void describe(auto&& visit, std::type_identity<TwinParameter>) {
  describe(visit, std::type_identity<IntervalEstimate>{});
  visit(&TwinParameter::seen, Kept{"seen", "whether the scans decide on it"});
}

/// The spectrum with its 95 % band.
struct TwinSpectrum {
  std::vector<double> wavenumber;      ///< rad/m
  std::vector<double> psd, low, high;  ///< m⁴
};

constexpr void describe(auto&& visit, std::type_identity<TwinSpectrum>) {
  using enum Dimension;
  using S = TwinSpectrum;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number", Dimension::wavenumber});
  visit(&S::psd, Kept{"psd", "spectral density", length_to_the_fourth});
  visit(&S::low, Kept{"low", "lower 95 % limit", length_to_the_fourth});
  visit(&S::high, Kept{"high", "upper 95 % limit", length_to_the_fourth});
}

/// Scans of one instrument, size and grid, and what was used of them.
struct TwinGroup {
  std::string instrument;
  Index scans = 0;
  double shortest = 0;  ///< wavelength that was used, m
  double longest = 0;   ///< m
  Index bins = 0;
  double gain = 1;    ///< factor of heights that the fit found
  double misfit = 0;  ///< χ² over what is expected
};

constexpr void describe(auto&& visit, std::type_identity<TwinGroup>) {
  using enum Dimension;
  using S = TwinGroup;
  visit(&S::instrument, Kept{"instrument", "name of the instrument"});
  visit(&S::scans, Kept{"scans", "scans in the mean"});
  visit(&S::shortest, Kept{"shortest", "shortest wavelength that was used", length});
  visit(&S::longest, Kept{"longest", "longest wavelength that was used", length});
  visit(&S::bins, Kept{"bins", "bins that were used"});
  visit(&S::gain, Kept{"gain", "factor of heights that the fit found"});
  visit(&S::misfit, Kept{"misfit", "deviance over what is expected"});
}

struct TwinScan {
  std::string name;
  double misfit = 0;  ///< χ² of this scan against the fit over what is expected, 1 for a good one
  double gain = 1;    ///< factor of its heights over those of its group
  bool left_out = false;
};

constexpr void describe(auto&& visit, std::type_identity<TwinScan>) {
  using S = TwinScan;
  visit(&S::name, Kept{"name", "name of the scan"});
  visit(&S::misfit, Kept{"misfit", "deviance of the scan over what is expected"});
  visit(&S::gain, Kept{"gain", "factor of heights over those of the group"});
  visit(&S::left_out, Kept{"left_out", "whether it was left out"});
}

/// The fit of the likelier self-affine law without one instrument; intervals are those of the curvature of the likelihood.
struct TwinWithout {
  std::string instrument;
  TwinParameter hurst, rolloff, short_cutoff, rms_height, rms_slope;
  double misfit = 0;   ///< χ² of the fit over what is expected
  bool agrees = true;  ///< no parameter that both see moved by more than chance explains (1 %)
};

constexpr void describe(auto&& visit, std::type_identity<TwinWithout>) {
  using enum Dimension;
  using S = TwinWithout;
  visit(&S::instrument, Quantity{"instrument", dimensionless, "name of the instrument"});
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::rolloff, Quantity{"rolloff", length, "roll-off wavelength"});
  visit(&S::short_cutoff, Quantity{"short_cutoff", length, "shortest wavelength"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::misfit,
        Quantity{"misfit", dimensionless, "deviance of the spectra over what is expected"});
  visit(&S::agrees,
        Quantity{"agrees", dimensionless, "whether nothing moved by more than chance explains"});
}

struct TwinOptions {
  std::uint64_t seed = 1;
  Index draws = 1000;                     ///< of the posterior that are kept
  std::optional<SpectrumForm> form = {};  ///< none: chosen by likelihood
  bool drop_bad_scans = true;             ///< a scan far from the fit of all is left out
  bool leave_one_out = true;              ///< fit without each instrument
};

constexpr void describe(auto&& visit, std::type_identity<TwinOptions>) {
  using S = TwinOptions;
  visit(&S::seed, Kept{"seed", "seed of the draws"});
  visit(&S::draws, Kept{"draws", "draws that are kept"});
  visit(&S::form, Kept{"form", "how the spectrum falls from its plateau"});
  visit(&S::drop_bad_scans, Kept{"drop_bad_scans", "whether bad scans are left out"});
  visit(&S::leave_one_out, Kept{"leave_one_out", "whether it is fitted without each instrument"});
}

/// One isotropic surface that several scans by several instruments are pieces of.
struct SurfaceTwin {
  static constexpr double refused_above = 2.2;  ///< misfit of a law that the scans do not have

  SpectrumForm form = SpectrumForm::corner;
  TwinParameter hurst, rolloff, short_cutoff;  ///< not found for a table
  TwinParameter rms_height, rms_slope;
  Index bins = 0;
  double chi_square = 0;  ///< deviance of the fit over all bins
  /// χ² over what is expected of it: 1 for the right law. Above refused_above a law is refused.
  double misfit = 0;
  double form_ratio = 0;     ///< 2 ln of the likelihood of the form over that of the other
  double rolloff_ratio = 0;  ///< the same over that of a roll-off 30 times the largest scan
  double cutoff_ratio = 0;   ///< the same over that of a cut-off far below the finest wave
  TwinSpectrum spectrum;
  std::vector<TwinGroup> groups;
  std::vector<TwinScan> scans;
  std::vector<TwinWithout> without;
  std::vector<std::string> notes;  ///< what was left out or not seen, and why
  std::vector<TwinDraw> draws;

  /// One of the draws, chosen by the seed: the parameters of a realisation.
  const TwinDraw& draw(std::uint64_t seed) const;
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceTwin>) {
  using enum Dimension;
  using S = SurfaceTwin;
  visit(&S::form, Quantity{"form", dimensionless,
                           "how the spectrum falls from its plateau: corner, smooth or table"});
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::rolloff, Quantity{"rolloff", length, "roll-off wavelength"});
  visit(&S::short_cutoff, Quantity{"short_cutoff", length, "shortest wavelength"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::bins, Kept{"bins", "bins that were used"});
  visit(&S::chi_square, Kept{"chi_square", "deviance of the fit"});
  visit(&S::misfit,
        Quantity{"misfit", dimensionless, "deviance of the spectra over what is expected"});
  visit(&S::form_ratio, Kept{"form_ratio", "twice the log likelihood over the other form"});
  visit(&S::rolloff_ratio,
        Kept{"rolloff_ratio", "twice the log likelihood over that without a roll-off"});
  visit(&S::cutoff_ratio,
        Kept{"cutoff_ratio", "twice the log likelihood over that without a cut-off"});
  visit(&S::spectrum, Kept{"spectrum", "spectral density with its band"});
  visit(&S::groups, Kept{"groups", "scans of one instrument and size"});
  visit(&S::scans, Kept{"scans", "each scan against the fit"});
  visit(&S::without, Kept{"without", "fits without one instrument"});
  visit(&S::notes, Kept{"notes", "what was left out or not seen"});
  visit(&S::draws, Kept{"draws", "draws of the posterior"});
}

/// Joint posterior of one self-affine spectrum, given scans at independent random places of one
/// isotropic surface. The mean periodogram of a group (scans of one instrument, size and grid) in
/// bin b is expected to be
///     E_b = e^{2g} Σ_j R_bj M²(q_j) C(q_j) + N e^{2ν} + T_b,   M = exp(−½(qσ)²), σ = FWHM/2.355,
/// R the response of tapers, plane removal and sampling, N the noise, T = N e^τ (q/q_c)⁻⁵ above the
/// cut-off for a tip, q_c a quarter of the Nyquist wave number. Its ratio to E_b is Gamma with m
/// degrees, 1/m = 1/m_c + s²: m_c the independent modes, with the correlation of bins in them, s =
/// 0.03 for what the law does not know, 0.5 about the cut-off and beyond. Of a tip, bins up to
/// R·κ_rms(q) = 0.08 are used, κ_rms² = ⅜∫q⁴C d²q from the scans themselves, and s² grows by (0.75 R·κ_rms)². Priors: H flat in 0.02
/// … 1.2, ln λ_r up to 30 times the largest scan, ln λ_s from a twentieth of the finest wavelength
/// used, g normal as the calibrations say, ν with 0.5 (1.5 where the noise was found), ln σ with
/// 0.05. Roll-off and cut-off are seen where twice the log likelihood ratio exceeds 6; else a limit
/// is given by the profile likelihood, down by 1.353.
/// scans   at least one; those of one group need not be neighbours
/// Throws InvalidInput for no scan, fewer than 8 usable bins, or draws < 100.
/// Cost: 0.1 s for the response of each kind of grid, 0.3 s for fits and draws; independent of the
/// threads in every bit.
SurfaceTwin fit_twin(const std::vector<ScanSpectrum>& scans, const TwinOptions& options = {});

}  // namespace salebra
