// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

struct InteractionOptions {
  /// The largest error of a summit's indentation, over the largest indentation.
  double tolerance = 1e-10;
  int max_iterations = 100;  ///< Newton steps, >= 1
  /// "interacting summits", after every sum over the summits; step: Newton steps done. A stop
  /// throws Interrupted. For what has no `progress` of its own, such as at() and what rests on it.
  Progress on_progress = {};
};

/// The given summits of a periodic surface, each pressed down by all the others: Hertz's force of a
/// summit,
///     P_i = (4/3)E*√R_i δ_i^{3/2},   δ_i = z_i − s − Σ_j G(x_i − x_j) P_j,
/// G the periodic displacement under a point force (own 1/(πE*r) left out) relative to the deformed
/// mean plane [Ciavarella et al. (2006)]. ū is therefore the mean gap in the sense of boundary
/// elements, which that of independent summits is not. A contact counts as a point outside of
/// itself, which is good beyond about two contact radii; contacts do not merge, but a summit close
/// to a larger contact is pressed out of contact. Solved by Newton's method on the energy with
/// conjugate gradients among the summits in contact, at a given separation or under a given force;
/// sums by Ewald's method, N log N. K and F'' follow from one more linear solve each, with the
/// state's own interactions. Cost of a state: a dozen sums over all N summits, 0.5 µs a summit
/// each, and some hundred over those in contact.
class InteractingSummits final : public AsperityModel {
 public:
  /// grid: of the periodic surface; its period and area are used. mean_plane as for
  /// DeterministicSummits.
  /// Throws InvalidInput as DeterministicSummits does, and where two summits lie at one place.
  InteractingSummits(const std::vector<Summit>& summits, const Material& material,
                     const Grid2D& grid, double mean_plane = 0,
                     double rms_height = ForceSample::unknown,
                     SummitShape shape = SummitShape::circular,
                     const InteractionOptions& options = {});
  ~InteractingSummits() override;

  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  /// Throws NotConverged where no state was found, beside InvalidInput for a force that is not > 0.
  double separation_of(double force) const override;

  struct State {
    double separation = 0;            ///< s, m
    std::vector<double> loads;        ///< P_i, N, in the order of the summits given
    std::vector<double> indentation;  ///< δ_i, m; negative where there is a gap
    double residual = 0;              ///< as InteractionOptions::tolerance
    int iterations = 0;
    bool converged = false;
  };
  /// progress: takes the place of InteractionOptions::on_progress, in what follows too.
  State solve(double separation, const Progress& progress = {}) const;
  /// The state under a force > 0, N, which it carries to round-off; near: a state to start from,
  /// such as that of the load before.
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

/// curve_at_pressures() of other models, each load from the state of the load before. A load for
/// which no state was found has converged = false. progress: "interacting summits", also within a
/// load; a stop returns the samples so far.
ForceCurve curve_at_pressures(const InteractingSummits& model, std::vector<double> pressures,
                              const Progress& progress = {});

}  // namespace salebra
