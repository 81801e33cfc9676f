// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

struct InteractionOptions {
  /// Largest error of the indentation of any summit, divided by the largest indentation.
  double tolerance = 1e-10;
  int max_iterations = 100;  ///< Newton steps, >= 1
  /// Called with stage "interacting summits" after every sum over the summits; step counts Newton
  /// steps. A stop throws Interrupted. It is used by calls without a `progress` argument, such as
  /// at().
  Progress on_progress = {};
};

/// Elastically interacting summits of a periodic surface [Ciavarella et al. (2006)]:
///     const InteractingSummits model(find_summits(surface).summits, material, surface.grid);
///     const ForceCurve curve = curve_at_pressures(model, {1e6, 1e7});
/// Each summit is pressed down by all others:
///     P_i = (4/3)E*√R_i δ_i^{3/2},   δ_i = z_i − s − Σ_j G(x_i − x_j) P_j,
/// where P_i is the force and δ_i the indentation of summit i with height z_i and radius R_i, and G
/// is the displacement due to a periodic point force, relative to the deformed mean plane and
/// without the term 1/(πE*r) of the point force itself. The mean gap ū is therefore that of
/// boundary elements, unlike the ū of independent summits. Each contact acts on other summits as a
/// point force, which is accurate beyond about two contact radii; contacts do not merge, but a
/// summit close to a larger contact is pressed out of contact. Newton's method on the energy, with
/// conjugate gradients among the summits in contact, solves for a given separation or force; Ewald
/// sums cost N log N. K and F'' need one more linear solve each. Cost of a state: a dozen sums over
/// all N summits, at 0.5 µs per summit and sum, and some hundred sums over the summits in contact.
class InteractingSummits final : public AsperityModel {
 public:
  /// grid: grid of the periodic surface, whose period and area are used. mean_plane: as for
  /// DeterministicSummits. Throws InvalidInput wherever DeterministicSummits does, and if two
  /// summits coincide.
  InteractingSummits(const std::vector<Summit>& summits, const Material& material,
                     const Grid2D& grid, double mean_plane = 0,
                     double rms_height = ForceSample::unknown,
                     SummitShape shape = SummitShape::circular,
                     const InteractionOptions& options = {});
  ~InteractingSummits() override;

  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  /// Throws NotConverged if no state was found, and InvalidInput for a force that is not > 0.
  double separation_of(double force) const override;

  struct State {
    double separation = 0;            ///< s, m
    std::vector<double> loads;        ///< P_i, N, in the order of the summits given
    std::vector<double> indentation;  ///< δ_i, m; negative where there is a gap
    double residual = 0;              ///< error reached, defined as InteractionOptions::tolerance
    int iterations = 0;
    bool converged = false;
  };
  /// Solves for a separation, m. progress replaces InteractionOptions::on_progress, here and in
  /// solve_for_force() and contact_of().
  State solve(double separation, const Progress& progress = {}) const;
  /// Solves for a force > 0, N, which the resulting state carries to round-off. near: a state to
  /// start from, such as that of the previous load.
  State solve_for_force(double force, const State* near = nullptr,
                        const Progress& progress = {}) const;
  AsperityContact contact_of(const State& state, const Progress& progress = {}) const;

 private:
  struct System;
  struct Iterate;
  struct Goal {
    double separation;           ///< where no load is given
    std::optional<double> load;  ///< F/E*, m²
  };
  Iterate evaluated(std::vector<double> indentation, const Goal& goal) const;
  State equilibrium(std::vector<double> indentation, const Goal& goal,
                    const Progress& progress) const;

  InteractionOptions options_;
  std::unique_ptr<const System> system_;
};

/// Computes a force curve at the given pressures (Pa, > 0, any order), each load starting from the
/// state of the previous load. A load for which no state was found has converged = false. progress
/// is called with the stage "interacting summits", also within a load; if it says stop, the samples
/// computed so far are returned.
ForceCurve curve_at_pressures(const InteractingSummits& model, std::vector<double> pressures,
                              const Progress& progress = {});

}  // namespace salebra
