// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/damping/oscillation.hpp>
#include <vector>

namespace salebra {

/// Relaxation damping of all summits of a surface under the motion of one body.
struct AsperityDamping {
  std::vector<double> work;      ///< W_i of each summit, in the order given, J
  double work_per_cycle = 0;     ///< Σ W_i, J
  double intermittent_work = 0;  ///< part of work_per_cycle of summits that open, J
  /// Loss by Eq. (12) or (15) of the paper with F'' summed over all summits at the mean separation,
  /// J.
  double small_amplitude_work = 0;
  int max_contacts = 0;         ///< summits in contact at the smallest separation
  int min_contacts = 0;         ///< summits in contact at the largest separation
  double power = 0;             ///< P, W; NaN where ω is not known
  double damping_constant = 0;  ///< γ, N s/m; NaN where ω or the velocity is not known
};

constexpr void describe(auto&& visit, std::type_identity<AsperityDamping>) {
  using enum Dimension;
  using S = AsperityDamping;
  visit(&S::work, Kept{"work", "energy that each summit dissipates in a cycle", energy});
  visit(&S::work_per_cycle, Kept{"work_per_cycle", "their sum", energy});
  visit(&S::intermittent_work,
        Kept{"intermittent_work", "part of it by summits that lose contact during the cycle",
             energy});
  visit(&S::small_amplitude_work,
        Kept{"small_amplitude_work", "Eq. (12) or (15) with F'' of all summits", energy});
  visit(&S::max_contacts, Kept{"max_contacts", "summits in contact where the body is closest"});
  visit(&S::min_contacts, Kept{"min_contacts", "summits in contact where the body is farthest"});
  visit(&S::power, Kept{"power", "mean dissipated power", Dimension::power});
  visit(&S::damping_constant, Kept{"damping_constant", "damping constant", damping});
}

/// Computes the loss of every summit in full stick as an elastic foundation of its own
/// (docs/theory.md, section 6) for a paraboloid of radius R. A spring of width dx at the distance x
/// from the axis touches at the depth ζ = x²/R and is released by the distance s of Eq. (7) or (13)
/// of the paper, so the loss of summit i with the indentation δ_i is
///     W_i = G* ∫ s(ζ(x) − δ_i)² dx over the springs that open and close, at any amplitude.
/// By the theorem of docs/theory.md, section 7, the sum of these losses equals relaxation_damping()
/// of the GreenwoodWilliamsonLaw of the same summits at a constant mean indentation, although
/// asperity_damping() uses no force law.
///
///     AsperityDamping loss = asperity_damping(summits, material, 3e-8, Drag{1e-9, 1e-6, 1e5});
///
/// separation: its mean over the cycle, measured from the mean of the summits' heights, m. Throws
/// InvalidInput as the constructor of DeterministicSummits does, and for an unknown G*, a normal
/// amplitude < 0, or an angular frequency <= 0 of a Drag. Cost: 50 to 500 evaluations of s per
/// summit.
AsperityDamping asperity_damping(const std::vector<Summit>& summits, const Material& material,
                                 double separation, const Oscillation& motion,
                                 SummitShape shape = SummitShape::circular);

}  // namespace salebra
