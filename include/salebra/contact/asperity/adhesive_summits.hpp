// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

/// Adhesion theory for one summit: Derjaguin–Muller–Toporov or Johnson–Kendall–Roberts.
enum class SummitAdhesion { dmt, jkr };

/// Ensemble of independent adhesive summits [Fuller and Tabor (1975)]:
///     const AdhesiveSummits model(ensemble, material, area, SummitAdhesion::jkr, 0.05, true);
///     const double pull_off = model.pull_off_pressure();
/// A summit of radius R and height z has the indentation δ = z − s at the separation s, the force f
/// and the contact radius a; w is the work of adhesion:
///     jkr  δ = a²/R − √(2πwa/E*), f = 4E*a³/(3R) − √(8πwE*a³)  [Johnson et al. (1971)]
///     dmt  δ = a²/R, f = 4E*a³/(3R) − 2πwR, for summits that touch  [Derjaguin et al. (1975)]
/// F = ηA0 ∫f(z − s)φ(z)dz over the summits that touch, with their density η, the nominal area A0
/// and the height density φ. JKR summits touch at δ = 0 during approach, and separate at δ =
/// −¾(π²w²R/E*²)^{1/3}; DMT summits have no hysteresis. K = Σ2E*a assumes that contact edges do not
/// move, as in boundary elements; F'' is unknown. The relative error of the quadrature is below
/// 1e-9 of the adhesive force.
class AdhesiveSummits final : public AsperityModel {
 public:
  /// work: work of adhesion w > 0, J/m². unloading: true if the summits have touched before and are
  /// being separated. Throws InvalidInput wherever StatisticalSummits does.
  AdhesiveSummits(const SummitEnsemble& ensemble, const Material& material, double nominal_area,
                  SummitAdhesion adhesion, double work, bool unloading);
  ~AdhesiveSummits() override;
  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  /// Returns the pull-off pressure, i.e. the maximum of −F/A0 over all separations, Pa, by golden
  /// section; 0 without attraction.
  double pull_off_pressure() const;

 private:
  struct Summit {
    double radius, modulus, work;
    bool jkr;
    double indentation(double contact_radius) const;
    double slope(double contact_radius) const;  ///< dδ/da
    double force(double contact_radius) const;
  };
  AdhesiveSummits(const SummitEnsemble& ensemble, const Material& material, double nominal_area,
                  const Summit& summit, bool unloading,
                  std::unique_ptr<const detail::HeightDensity> heights);
  static double min_radius(const Summit& summit, bool unloading);
  template <class Function>
  double over_summits(double separation, double scale, const Function& of_radius) const;

  Summit summit_;
  double count_, min_radius_, min_indentation_;
  std::unique_ptr<const detail::HeightDensity> heights_;
};

}  // namespace salebra
