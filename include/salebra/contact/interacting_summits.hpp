// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/greenwood_williamson.hpp>

namespace salebra {

struct InteractionOptions {
  /// Of the greatest error of a summit's indentation, over the greatest indentation.
  double tolerance = 1e-10;
  int max_iterations = 100;  ///< Newton steps, >= 1
};

/// The given summits of a periodic surface, each pressed down by all the others: Hertz's force of a summit,
///     P_i = (4/3)E*√R_i δ_i^{3/2},   δ_i = z_i − s − Σ_j G(x_i − x_j) P_j,
/// G the periodic displacement under a point force (own 1/(πE*r) left out) relative to the deformed mean plane
/// [Ciavarella, Delfine, Demelio, J. Mech. Phys. Solids 54 (2006) 2569]. ū is therefore the mean gap in the sense of boundary elements,
/// which that of independent summits is not. A contact counts as a point outside of itself, which is good beyond about
/// two contact radii; contacts do not merge, but a summit close to a larger contact is pressed out of contact.
/// Solved by Newton's method on the energy with conjugate gradients; sums by Ewald's method, N log N.
/// K and F'' follow from one more linear solve each, with the state's own interactions. Cost of at(): some hundred sums over N summits, each
/// about 0.3 s for N = 10⁵ on one core.
class InteractingSummits final : public AsperityModel {
 public:
  /// grid: of the periodic surface; its period and area are used. mean_plane as for DeterministicSummits.
  /// Throws InvalidInput as DeterministicSummits does, and where two summits lie at one place.
  InteractingSummits(const std::vector<Summit>& summits, const Material& material,
                     const Grid2D& grid, double mean_plane = 0,
                     double rms_height = ForceSample::unknown,
                     SummitShape shape = SummitShape::circular,
                     const InteractionOptions& options = {});
  ~InteractingSummits() override;

  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  /// Newton's method in ln F, each step from the state of the last; to 1e-9 of the force.
  /// Throws NotConverged where no state was found, beside InvalidInput for a force that is not > 0.
  double separation_of(double force) const override;

  struct State {
    std::vector<double> loads;        ///< P_i, N, in the order of the summits given
    std::vector<double> indentation;  ///< δ_i, m; negative where there is a gap
    double residual = 0;              ///< as InteractionOptions::tolerance
    int iterations = 0;
    bool converged = false;
  };
  State solve(double separation) const;

 private:
  struct System;
  struct Iterate;
  State solve_from(double separation, std::vector<double> indentation) const;
  AsperityContact sums_of(const State& state) const;

  InteractionOptions options_;
  std::unique_ptr<const System> system_;
};

}  // namespace salebra
