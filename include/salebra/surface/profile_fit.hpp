// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra {

/// Roughness of a line profile, and parameters of the isotropic self-affine surface that would have
/// such profiles. A profile is a Surface with ny = 1.
struct ProfileFit {
  double rms_height = 0;  ///< Rq of the profile minus its straight line, m
  double rms_slope = 0;   ///< Rdq, from differences of neighbouring points
  /// √2 times rms_slope: rms slope of the isotropic surface.
  double surface_slope = 0;
  IntervalEstimate hurst;  ///< Hurst exponent H
  /// Roll-off wavelength λ_r, m; NaN if no plateau is seen.
  double rolloff = IntervalEstimate::unknown;
  /// Shortest wavelength λ_s, m; NaN unless the spectrum ends within the resolution of the profile.
  double short_cutoff = IntervalEstimate::unknown;
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

/// Computes the profile spectrum C₁ of an isotropic self-affine surface with the Hurst exponent H,
/// divided by the plateau C0 of its spectrum C, in 1/m, for q > 0, e.g. `profile_density(1e6, 0.8,
/// 1e5, 1e8)`. With q_r = q_rolloff and q_s = q_short, C = C0 for q < q_r, C = C0 (q/q_r)^{−2(1+H)}
/// for q_r <= q <= q_s, and C = 0 for q > q_s:
///     C₁(q) = ∫C dq_y = 2 C0 [√(q_r² − q²)]_{q < q_r} + 2 C0 q_r^{2+2H} q^{−1−2H} ∫cos^{2H}θ dθ
/// with θ from arccos(q/max(q, q_r)) to arccos(q/q_s).
double profile_density(double q, double hurst, double q_rolloff, double q_short);

/// Fits the roughness parameters of a profile:
///     const IntervalEstimate hurst = fit_profile(profile).hurst;
/// The model A·C₁(q)·exp(−g q²) + floor is fitted to the spectrum of the profile (Hann window,
/// straight line subtracted), as estimate_hurst() does for a surface. A, g and the floor are fitted
/// constants, and C₁ is profile_density(). The measured power of each wave is taken as
/// exponentially distributed about the model. The fit omits the three longest waves, which the
/// window mixes with their neighbours; waves shorter than 2.5 cells or than shortest_wavelength
/// (m); and, for an interpolated profile, waves shorter than twice its longest straight piece. With
/// shortest_wavelength = 0 it also omits all waves so short that peaks and valleys differ at their
/// scale (a sign of a tip), as estimate_hurst() does. The interval of H comes from a
/// likelihood-ratio test at 5 % with free roll-off, floor and g. A roll-off counts as seen if the
/// model without it is rejected by the same test; a shortest wavelength counts as seen if the power
/// falls to a twentieth of the law within a factor of 1.6 in q. H is NaN for fewer than 32 points,
/// for a straight line, if a wave has no power, and if no range of a factor of four in q follows
/// the law. Throws InvalidInput unless the profile is complete, with one row and at least two
/// points. Cost: about 10⁴ evaluations of the model spectrum in sixty bins, 0.3 s.
ProfileFit fit_profile(const Surface& profile, double shortest_wavelength = 0);

}  // namespace salebra
