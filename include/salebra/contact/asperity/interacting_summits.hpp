// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/progress.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

struct InteractionOptions {
  /// Maximum error of a summit's indentation, relative to the maximum indentation.
  double tolerance = 1e-10;
  int max_iterations = 100;  ///< Newton steps, >= 1
  /// Called with stage "interacting summits" after every sum over the summits; step counts Newton
  /// steps. A stop throws Interrupted. It serves calls without their own `progress`, such as at().
  Progress on_progress = {};
};

/// Elastically interacting summits of a periodic surface [Ciavarella et al. (2006)]:
///     const InteractingSummits model(find_summits(surface).summits, material, surface.grid);
///     const ForceCurve curve = curve_at_pressures(model, {1e6, 1e7});
/// Each summit is pressed down by all others:
///     P_i = (4/3)E*√R_i δ_i^{3/2},   δ_i = z_i − s − Σ_j G(x_i − x_j) P_j,
/// where G is the periodic displacement under a point force (without its own 1/(πE*r)) relative to
/// the deformed mean plane. ū is therefore the mean gap as in boundary elements, unlike that of
/// independent summits. A contact acts as a point force outside itself, which is accurate beyond
/// about two contact radii; contacts do not merge, but a summit close to a larger contact is
/// pressed out of contact. Newton's method on the energy, with conjugate gradients among the
/// summits in contact, solves for a given separation or force; Ewald sums cost N log N. K and F''
/// need one more linear solve each, with the interactions of the state. Cost of a state: a dozen
/// sums over all N summits, 0.5 µs per summit each, and some hundred over those in contact.
class InteractingSummits final : public AsperityModel {
 public:
  /// grid: grid of the periodic surface, whose period and area are used. mean_plane: as for
  /// DeterministicSummits. Throws InvalidInput as DeterministicSummits does, and if two summits
  /// coincide.
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
    double residual = 0;              ///< as InteractionOptions::tolerance
    int iterations = 0;
    bool converged = false;
  };
  /// progress replaces InteractionOptions::on_progress, also in the functions below.
  State solve(double separation, const Progress& progress = {}) const;
  /// Solves for a force > 0, N, which the state carries to round-off. near: an initial state, such
  /// as that of the previous load.
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

/// Computes a curve like curve_at_pressures() of other models, each load starting from the previous
/// state. A load without a state has converged = false. progress has the stage "interacting
/// summits", also within a load; a stop returns the samples so far.
ForceCurve curve_at_pressures(const InteractingSummits& model, std::vector<double> pressures,
                              const Progress& progress = {});

}  // namespace salebra
