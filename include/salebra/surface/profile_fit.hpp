// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra {

/// A line profile, and the isotropic self-affine surface of whose profiles it can be one. A profile
/// is a surface of one row, ny = 1.
struct ProfileFit {
  double rms_height = 0;  ///< Rq, of the profile less its straight line, m
  double rms_slope = 0;   ///< Rdq, of neighbouring points
  /// √2 times rms_slope: of the isotropic surface.
  double surface_slope = 0;
  IntervalEstimate hurst;
  double rolloff = IntervalEstimate::unknown;  ///< λ_r, m; NaN unless a plateau is seen
  double short_cutoff =
      IntervalEstimate::unknown;  ///< λ_s, m; NaN unless the spectrum ends within the profile
};

constexpr void describe(auto&& visit, std::type_identity<ProfileFit>) {
  using enum Dimension;
  using S = ProfileFit;
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::surface_slope,
        Kept{"surface_slope", "rms slope of the isotropic surface with these profiles"});
  visit(&S::hurst, Kept{"hurst", "Hurst exponent"});
  visit(&S::rolloff, Kept{"rolloff", "wavelength; NaN unless a plateau is seen", length});
  visit(
      &S::short_cutoff,
      Kept{"short_cutoff", "wavelength; NaN unless the spectrum ends within the profile", length});
}

/// Power spectral density of the profiles of an isotropic surface with
///     C = C0 (q < q_r),  C0 (q/q_r)^{−2(1+H)} (q_r <= q <= q_s),  0 beyond:
///     C₁(q) = ∫C dq_y = 2 C0 [√(q_r² − q²)]_{q < q_r} + 2 C0 q_r^{2+2H} q^{−1−2H} ∫cos^{2H}θ dθ
/// from θ = arccos(q/max(q, q_r)) to arccos(q/q_s), over C0, in 1/m. q > 0.
double profile_density(double q, double hurst, double q_rolloff, double q_short);

/// Fits A·C₁(q)·exp(−g q²) + floor to the spectrum of a profile under Hann's window, less its straight
/// line, as estimate_hurst() does to that of a surface: C follows from integrating a model, never from
/// inverting what was measured. Powers are exponentially distributed. The three longest waves, into
/// which the window mixes others, are left out, and so are those of less than 2.5 cells, those shorter
/// than shortest_wavelength (m), and of an interpolated profile those shorter than twice its longest
/// straight piece. Where shortest_wavelength is 0, those up to which peaks and valleys differ are left
/// out too, as estimate_hurst() says. The interval of H is that of a likelihood-ratio test at 5 %, the roll-off, floor
/// and g being free. A roll-off counts as seen where a law without it is less likely by more than
/// that, a shortest wavelength where the power falls to a twentieth of the law within a factor of
/// 1.6. H is not found of less than 32 points, of a straight line, where a wave has no power, and
/// where no range of a factor of four in q follows the law.
/// Throws InvalidInput unless the profile is complete, with one row and two points at least. Cost:
/// some 10⁴ evaluations of the spectrum in sixty bins, 0.3 s.
ProfileFit fit_profile(const Surface& profile, double shortest_wavelength = 0);

}  // namespace salebra
