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

/// Form of the isotropic spectrum C(q), in particular of the transition from its plateau to its
/// power law, with the Hurst exponent H, the roll-off wave number q_r and the cut-off wave number
/// q_s.
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

/// One surface drawn from the posterior distribution of surfaces that the scans allow. Wavelengths
/// are λ = 2π/q. The spectrum at the wave vector with the components q_across and q_along, at right
/// angles to the lay and along it, is density(q_e) with the elliptic wave number
///     q_e² = q_across² + (stretch·q_along)²,
/// so that density(q) is the spectrum across the lay. An AnisotropicSpectrum with along = stretch
/// and across = 1 is the same surface if its isotropic spectrum is density(q)/stretch.
struct TwinDraw {
  SpectrumForm form = SpectrumForm::corner;
  double hurst = 0;           ///< H; NaN for a table
  double rolloff = 0;         ///< roll-off wavelength λ_r across the lay, m; NaN for a table
  double short_cutoff = 0;    ///< cut-off wavelength λ_s across the lay, m
  double rms_height = 0;      ///< of all waves, m; for a table, of waves in the scans
  double rms_slope = 0;       ///< of the full gradient
  double stretch = 1;         ///< ratio of wavelengths along the lay to those across it; 1: no lay
  double lay_angle = 0;       ///< from the x axis to the lay, rad, in [0, π); 0 without a lay
  double skewness = 0;        ///< of the heights; 0: Gaussian
  double kurtosis = 3;        ///< of the heights; 3: Gaussian
  double amplitude = 0;       ///< ln C of the pure power law at q = `reference`; 0 for a table
  double reference = 0;       ///< wave number that `amplitude` belongs to, rad/m
  std::vector<double> knots;  ///< knots of a table, rad/m
  std::vector<double> log_psd;  ///< ln C at the knots

  /// Returns C in m⁴ at q > 0 in rad/m, across the lay.
  double density(double q) const;
  /// Roll-off wavelength along the lay, m.
  double rolloff_along() const { return stretch * rolloff; }
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
  visit(&S::stretch, Quantity{"stretch", dimensionless, "wavelengths along the lay over across"});
  visit(&S::lay_angle, Quantity{"lay_angle", angle, "direction of the lay against x"});
  visit(&S::skewness, Quantity{"skewness", dimensionless, "skewness of heights"});
  visit(&S::kurtosis, Quantity{"kurtosis", dimensionless, "kurtosis of heights, 3 for a Gaussian"});
  visit(&S::rolloff_along, Quantity{"rolloff_along", length, "roll-off wavelength along the lay"});
  visit(&S::amplitude, Kept{"amplitude", "logarithm of the power law at the reference"});
  visit(&S::reference, Kept{"reference", "wave number of the amplitude", wavenumber});
  visit(&S::knots, Kept{"knots", "wave numbers of a table", wavenumber});
  visit(&S::log_psd, Kept{"log_psd", "logarithm of the spectral density at the knots"});
}

/// A spectrum C tabulated at wave numbers in geometric progression, which include the roll-off and
/// the cut-off.
struct SpectrumTable {
  std::vector<double> wavenumber;  ///< increasing, rad/m
  std::vector<double> psd;         ///< C, m⁴
};

constexpr void describe(auto&& visit, std::type_identity<SpectrumTable>) {
  using S = SpectrumTable;
  visit(&S::wavenumber, Kept{"wavenumber", "wave number", Dimension::wavenumber});
  visit(&S::psd, Kept{"psd", "spectral density", Dimension::length_to_the_fourth});
}

/// Tabulates the spectrum of a draw from the wave number `lowest`, rad/m, to its cut-off, so
/// densely that linear interpolation of ln C over ln q is accurate to about 1e-4. Throws
/// InvalidInput unless 0 < lowest < 2π/λ_s.
SpectrumTable tabulated(const TwinDraw& draw, double lowest, int points_per_decade = 60);

/// Estimate of one parameter with its 95 % interval. If no scan shows the parameter, `seen` is
/// false: a wavelength then has only one limit, low or high, while the opposite limit and the value
/// are NaN.
struct TwinParameter : IntervalEstimate {
  bool seen = false;
};

constexpr void describe(auto&& visit, std::type_identity<TwinParameter>) {
  describe(visit, std::type_identity<IntervalEstimate>{});
  visit(&TwinParameter::seen, Kept{"seen", "whether the scans decide on it"});
}

/// The fitted spectrum C with its 95 % band, from `low` to `high`.
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

/// Scans with the same instrument, size and grid, and how the fit used them.
struct TwinGroup {
  std::string instrument;  ///< name of the instrument
  Index scans = 0;         ///< number of scans
  double shortest = 0;     ///< shortest wavelength used, m
  double longest = 0;      ///< longest wavelength used, m
  Index bins = 0;          ///< number of bins of the spectrum used
  double gain = 1;         ///< fitted factor of the heights
  double misfit = 0;       ///< χ² over its expectation
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
  double misfit = 0;      ///< χ² of the scan against the fit over its expectation; 1: good
  double gain = 1;        ///< factor of its heights relative to its group
  bool left_out = false;  ///< true if the fit did not use this scan
};

constexpr void describe(auto&& visit, std::type_identity<TwinScan>) {
  using S = TwinScan;
  visit(&S::name, Kept{"name", "name of the scan"});
  visit(&S::misfit, Kept{"misfit", "deviance of the scan over what is expected"});
  visit(&S::gain, Kept{"gain", "factor of heights over those of the group"});
  visit(&S::left_out, Kept{"left_out", "whether it was left out"});
}

/// Fit to all scans except those of one instrument, with the more likely of the two self-affine
/// forms; intervals come from the curvature of the likelihood.
struct TwinWithout {
  std::string instrument;  ///< the instrument that was left out
  TwinParameter hurst, rolloff, short_cutoff, rms_height, rms_slope;
  double misfit = 0;  ///< χ² of the fit over its expectation
  /// True if no parameter that this fit and the full fit both see differs significantly (1 %).
  bool agrees = true;
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
  Index draws = 1000;                     ///< number of posterior draws to keep
  std::optional<SpectrumForm> form = {};  ///< empty: chosen by likelihood
  bool drop_bad_scans = true;             ///< true: omits scans far from the common fit
  bool leave_one_out = true;              ///< true: also fits without each instrument in turn
};

constexpr void describe(auto&& visit, std::type_identity<TwinOptions>) {
  using S = TwinOptions;
  visit(&S::seed, Kept{"seed", "seed of the draws"});
  visit(&S::draws, Kept{"draws", "draws that are kept"});
  visit(&S::form, Kept{"form", "how the spectrum falls from its plateau"});
  visit(&S::drop_bad_scans, Kept{"drop_bad_scans", "whether bad scans are left out"});
  visit(&S::leave_one_out, Kept{"leave_one_out", "whether it is fitted without each instrument"});
}

/// Surface twin: the surface from which several scans by several instruments are samples. It may have
/// a lay and heights that are not Gaussian.
struct SurfaceTwin {
  /// Misfit above which a form is rejected, of skew heights twice that.
  static constexpr double refused_above = 2.2;

  SpectrumForm form = SpectrumForm::corner;
  TwinParameter hurst, rolloff, short_cutoff;  ///< NaN for SpectrumForm::table
  TwinParameter rms_height, rms_slope;
  /// Ratio of wavelengths along the lay to those across it, to which the roll-off and the cut-off
  /// above belong; without a lay 1, with the upper limit of a lay that would be seen.
  TwinParameter stretch;
  TwinParameter lay_angle;      ///< from the x axis to the lay, rad; NaN without a lay
  TwinParameter rolloff_along;  ///< roll-off wavelength along the lay, m
  /// Of the heights of all waves, 0 and 3 with their limits if Gaussian heights explain the scans;
  /// NaN if the roll-off is not seen.
  TwinParameter skewness, kurtosis;
  Index bins = 0;
  double chi_square = 0;  ///< χ² of the fit: its deviance, summed over all bins
  /// χ² of the fit over its expectation: 1 for the right form of the spectrum. A form is rejected
  /// if its misfit exceeds refused_above.
  double misfit = 0;
  double form_ratio = 0;     ///< 2 ln(likelihood ratio) to the other self-affine form
  double rolloff_ratio = 0;  ///< likewise, to a roll-off at 30 times the largest scan
  double cutoff_ratio = 0;   ///< likewise, to a cut-off far below the finest wave
  TwinSpectrum spectrum;
  std::vector<TwinGroup> groups;
  std::vector<TwinScan> scans;
  std::vector<TwinWithout> without;
  std::vector<std::string> warnings;  ///< what was omitted or not seen, and why
  std::vector<TwinDraw> draws;

  /// Returns the draw that the seed selects, for the parameters of one realisation.
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
  visit(&S::stretch, Quantity{"stretch", dimensionless, "wavelengths along the lay over across"});
  visit(&S::lay_angle, Quantity{"lay_angle", angle, "direction of the lay against x"});
  visit(&S::rolloff_along, Quantity{"rolloff_along", length, "roll-off wavelength along the lay"});
  visit(&S::skewness, Quantity{"skewness", dimensionless, "skewness of heights"});
  visit(&S::kurtosis, Quantity{"kurtosis", dimensionless, "kurtosis of heights, 3 for a Gaussian"});
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
  visit(&S::warnings, Kept{"warnings", "what was left out or not seen"});
  visit(&S::draws, Kept{"draws", "draws of the posterior"});
}

/// Fits one self-affine spectrum to scans at independent random positions on one surface:
///     const SurfaceTwin twin = fit_twin({optical_scan, afm_scan});
///     const TwinDraw& realisation = twin.draw(1);
/// The mean periodogram of a group (scans of one instrument, size and grid) in bin b has the
/// expectation
///     E_b = e^{2g} Σ_j R_bj M²(q_j) C(q_j) + N e^{2ν} + T_b,   M = exp(−½(qσ)²), σ = FWHM/2.355,
/// where e^g is the gain of the heights, R is the response of tapers, plane removal and sampling, M
/// the transfer function of a lens with the width FWHM = resolution, N the noise with its factor
/// e^{2ν}, and, for a tip, T = N e^τ (q/q_c)⁻⁵ the power that a tip adds above the cut-off, with
/// q_c a quarter of the Nyquist wave number. The ratio of the mean periodogram to E_b has a Gamma
/// distribution with m degrees of freedom, 1/m = 1/m_c + s²: m_c is the number of independent
/// modes, reduced for the correlation of bins; s is the relative model error, 0.03, and 0.5 near
/// and above the cut-off. For a tip of radius R_t, only bins with R_t·κ_rms(q) <= 0.08 are used,
/// where κ_rms² = ⅜∫q⁴C d²q is the curvature of all waves up to q, computed from the scans
/// themselves; s² grows by (0.75 R_t·κ_rms)². Prior distributions: H uniform between 0.02 and 1.2;
/// ln λ_r uniform, λ_r up to 30 times the largest scan; ln λ_s uniform, λ_s from a twentieth of the
/// finest wavelength used; g normal with the calibration errors as standard deviation; ν normal
/// with 0.5 (1.5 if the noise was estimated); ln σ normal with 0.05. Roll-off and cut-off count as
/// seen if twice the log likelihood ratio (rolloff_ratio, cutoff_ratio) exceeds 6; otherwise the
/// wavelength at which the log profile likelihood lies 1.353 below its maximum is a limit. scans
/// must have at least one entry; scans of one group need not be adjacent in the list.
///
/// Lay: with the elliptic wave number u² = q_across²/s + s·q_along², s the stretch, the spectrum is
/// C(u). s and the angle of the lay are those at which the second harmonics of the power in
/// elliptic rings vanish; if they differ significantly (99 %) from an isotropic surface, bins are
/// elliptic rings, whose response is that of the ellipse, and the draws have s and angle with their
/// errors. Otherwise the fit is the isotropic one. The surface is refused if the fourth harmonic,
/// or a trend of the second one with the wavelength, shows two lays that cross or two processes. A
/// scan whose lay differs from that of its group, and profiles of a surface with a lay, are left
/// out.
///
/// Heights: skewness and kurtosis are those at which simulated scans, transforms of Gaussian fields
/// of the fitted spectrum by Johnson's distribution, have the third and fourth moments of the
/// largest scans. If Gaussian heights do not explain them (99 %), the draws have skewness and
/// kurtosis, and the fit allows for power beyond the cut-off, of sums of waves. They are unknown if
/// the roll-off is not seen.
///
/// Throws InvalidInput for no scan, fewer than 8 usable bins, draws < 100, two lays or processes,
/// or a lay of which the grids show too little. Cost: 0.1 s for the response of each kind of grid
/// (0.5 s with a lay), 0.3 s for fits and draws, 0.5 s for the heights. The bits do not depend on
/// the number of threads.
SurfaceTwin fit_twin(const std::vector<ScanSpectrum>& scans, const TwinOptions& options = {});

}  // namespace salebra
