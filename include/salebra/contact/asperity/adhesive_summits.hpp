// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/asperity/greenwood_williamson.hpp>

namespace salebra {

/// How one summit adheres.
enum class SummitAdhesion { dmt, jkr };

/// Summits of an ensemble that adhere, each for itself [Fuller and Tabor (1975)]. A summit of the
/// height z has δ = z − s, the force f and the contact radius a:
///     jkr  δ = a²/R − √(2πwa/E*), f = 4E*a³/(3R) − √(8πwE*a³)  [Johnson et al. (1971)]
///     dmt  δ = a²/R, f = 4E*a³/(3R) − 2πwR, of summits that touch  [Derjaguin et al. (1975)]
/// F = ηA0 ∫f(z − s)φ(z)dz over the summits that touch. Those of jkr touch at δ = 0 when they come
/// closer, and come off at δ = −¾(π²w²R/E*²)^{1/3} when they are drawn apart; dmt has no hysteresis.
/// K is that of contacts whose edges stay, Σ2E*a, as boundary elements have it; F'' is not known.
/// Relative error of the quadrature below 1e-9 of what pulls.
class AdhesiveSummits final : public AsperityModel {
 public:
  /// work: w > 0, J/m². unloading: the summits touched before and are drawn apart. Throws
  /// InvalidInput as StatisticalSummits.
  AdhesiveSummits(const SummitEnsemble& ensemble, const Material& material, double nominal_area,
                  SummitAdhesion adhesion, double work, bool unloading);
  ~AdhesiveSummits() override;
  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  /// The largest −F/A0 over all separations, Pa, by golden section; 0 where nothing pulls.
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
  static double least_radius(const Summit& summit, bool unloading);
  template <class Function>
  double over_summits(double separation, double scale, const Function& of_radius) const;

  Summit summit_;
  double count_, least_radius_, least_indentation_;
  std::unique_ptr<const detail::HeightDensity> heights_;
};

}  // namespace salebra
