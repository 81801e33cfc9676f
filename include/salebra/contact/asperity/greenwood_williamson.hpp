// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <vector>

/// Contact as a sum over independent Hertzian summits: Greenwood and Williamson (1966).
///     const StatisticalSummits model(summit_ensemble(m0, m2, m4), material, area);
///     const ForceCurve curve = curve_at_pressures(model, {1e6, 1e7});
namespace salebra {

namespace detail {
class HeightDensity;
}

enum class SummitDistribution { gaussian, exponential, tabulated };

template <>
struct EnumNames<SummitDistribution> {
  static constexpr auto values = std::to_array<std::pair<SummitDistribution, std::string_view>>(
      {{SummitDistribution::gaussian, "gaussian"},
       {SummitDistribution::exponential, "exponential"},
       {SummitDistribution::tabulated, "tabulated"}});
};

/// One point of a height density that is piecewise linear and zero outside its points.
struct HeightDensityPoint {
  double height = 0;   ///< z, m
  double density = 0;  ///< φ(z), 1/m, or any multiple: tables are normalised
};

constexpr void describe(auto&& visit, std::type_identity<HeightDensityPoint>) {
  visit(&HeightDensityPoint::height, Kept{"height", "height, m"});
  visit(&HeightDensityPoint::density, Kept{"density", "summits per height, 1/m"});
}

/// Statistical ensemble of spherical caps of equal radius whose heights z have the probability
/// density φ(z):
///     gaussian      exp(−z²/2σ_s²)/(√(2π)σ_s); z = 0 is the mean plane of the summits
///     exponential   exp(−z/σ_s)/σ_s for z >= 0; z = 0 is the plane of the lowest summits, which
///                   lies σ_s below the mean summit height
///     tabulated     given by `table`
struct SummitEnsemble {
  double summit_density = 0;  ///< η, 1/m²
  double radius = 0;          ///< R, m
  /// σ_s, m: standard deviation of the heights (gaussian) or decay length of their density
  /// (exponential); not used for `tabulated`.
  double summit_rms = 0;
  double mean_height = 0;  ///< height of the plane z = 0 above the mean plane of the surface, m
  SummitDistribution distribution = SummitDistribution::gaussian;
  double rms_height = ForceSample::unknown;    ///< h_rms of the surface, m; NaN without a surface
  std::vector<HeightDensityPoint> table = {};  ///< heights increasing, at least two
};

constexpr void describe(auto&& visit, std::type_identity<SummitEnsemble>) {
  using enum Dimension;
  using S = SummitEnsemble;
  visit(&S::summit_density, Quantity{"summit_density", inverse_length_squared, "summits per area"});
  visit(&S::radius, Quantity{"radius", length, "radius of summits"});
  visit(&S::summit_rms, Quantity{"summit_rms", length, "standard deviation of summit heights"});
  visit(&S::mean_height,
        Quantity{"mean_height", length, "mean summit height above the mean plane"});
  visit(&S::distribution, Kept{"distribution", "'gaussian', 'exponential' or 'tabulated'"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::table, Kept{});
}

/// Returns the ensemble of a Gaussian isotropic surface from its profile moments m0 (m²), m2, m4
/// (1/m²) by Nayak (1971) and McCool (1986):
///     η = m4/(6√3 π m2), R = (3/8)√(π/m4), σ_s² = (1 − 0.8968/α) m0, mean height 4√(m0/(πα)),
///     α = m0 m4/m2².
/// Throws InvalidInput unless the moments are > 0 with α >= 1, which holds for any surface.
SummitEnsemble summit_ensemble(double moment0, double moment2, double moment4);

/// Returns a Gaussian ensemble with the density, the mean radius, and the mean and standard
/// deviation of height of detected summits. mean_plane: mean height of the surface, m, in the
/// coordinate in which the summit heights are given.
SummitEnsemble summit_ensemble(const SummitStatistics& statistics, double mean_plane = 0);

/// Sums over the summits in contact at a separation s. K = −dF/ds and F'' = d²F/ds², because the
/// indentation is δ = const − s.
struct AsperityContact {
  double contacts = 0;          ///< number in contact; expected number for an ensemble
  double contact_area = 0;      ///< A_c, m²
  double force = 0;             ///< F, N
  double normal_stiffness = 0;  ///< K, N/m
  double force_curvature = 0;   ///< F'', N/m²
  bool converged = true;        ///< false only for models that iterate
};

constexpr void describe(auto&& visit, std::type_identity<AsperityContact>) {
  using S = AsperityContact;
  visit(&S::contacts, Kept{"contacts", "summits in contact; an expectation for an ensemble"});
  visit(&S::contact_area, Kept{"contact_area", "contact area", Dimension::length_squared});
  visit(&S::force, Kept{"force", "normal force", Dimension::force});
  visit(&S::normal_stiffness,
        Kept{"normal_stiffness", "normal stiffness dF/d(indentation)", Dimension::stiffness});
  visit(&S::force_curvature, Kept{"force_curvature", "second derivative of force by indentation",
                                  Dimension::force_curvature});
  visit(&S::converged, Kept{"converged", "only a model that iterates may say no"});
}

/// Contact of summits with a smooth rigid plane at the separation s from the plane z = 0 of the
/// summit heights. Immutable.
class AsperityModel {
 public:
  struct Common {
    std::string name;             ///< becomes ForceCurve::model
    Material material;            ///< if G* is unknown, so is K_t
    double nominal_area = 0;      ///< A0 > 0, m²
    double mean_height = 0;       ///< height of z = 0 above the mean plane of the surface, m
    double first_touch = 0;       ///< s of first touch, m; 0 for a statistical ensemble
    double upper_separation = 0;  ///< separation s above which there is no force, m
    /// A step of s, > 0, m, over which the force changes by a factor of a few.
    double height_scale = 0;
    double rms_height = ForceSample::unknown;  ///< h_rms of the surface, m
  };
  /// Throws InvalidInput unless material.contact_modulus and nominal_area are > 0.
  explicit AsperityModel(Common common);
  virtual ~AsperityModel();

  virtual AsperityContact at(double separation) const = 0;
  /// F, K or F'' alone, as in at(separation); a model may compute one of them faster than all.
  virtual double force(double separation) const { return at(separation).force; }
  virtual double normal_stiffness(double separation) const {
    return at(separation).normal_stiffness;
  }
  virtual double force_curvature(double separation) const { return at(separation).force_curvature; }
  /// Separations at which F, K or F'' is not smooth: where a summit of given height touches, or
  /// where the height density begins or has a kink.
  virtual std::vector<double> break_separations() const { return {}; }

  /// Returns the separation s at which the summits carry `force` > 0, N, exact to round-off.
  virtual double separation_of(double force) const;
  /// Indentation δ = first_touch − s. For given summits it is measured from first touch; for a
  /// statistical ensemble it is −s.
  double indentation(double separation) const { return common_.first_touch - separation; }
  /// ū = s + mean_height, the distance of the smooth plane from the *undeformed* mean plane of the
  /// surface. The theory does not include the displacement of the material between the summits, so
  /// ū is too small by the mean displacement of the surface, which matters if the contact area is
  /// not small.
  double mean_gap(double separation) const { return separation + common_.mean_height; }
  const Common& common() const { return common_; }

 private:
  Common common_;
};

/// Greenwood–Williamson model of a statistical ensemble, with the number N of summits in contact
/// and the contact area A_c:
///     N = ηA0∫_s^∞φ, A_c = πRηA0∫(z−s)φ, F = (4/3)E*√R ηA0∫(z−s)^{3/2}φ,
///     K = 2E*√R ηA0∫(z−s)^{1/2}φ, F'' = E*√R ηA0∫(z−s)^{−1/2}φ.
/// Here η is the summit density, R the radius, A0 the nominal area and φ the height density. For
/// tabulated heights, and for exponential heights with s >= 0, it uses closed forms; otherwise
/// quadrature over t = √(z−s), in which no integrand is singular, with a relative error below
/// 1e-10.
class StatisticalSummits final : public AsperityModel {
 public:
  /// Throws InvalidInput unless density, radius, summit_rms, nominal_area and E* are > 0, and for
  /// an invalid table of a tabulated density.
  StatisticalSummits(const SummitEnsemble& ensemble, const Material& material, double nominal_area);
  ~StatisticalSummits() override;
  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  double normal_stiffness(double separation) const override;
  double force_curvature(double separation) const override;
  std::vector<double> break_separations() const override;

 private:
  StatisticalSummits(const SummitEnsemble& ensemble, const Material& material, double nominal_area,
                     std::unique_ptr<const detail::HeightDensity> heights);

  double count_, radius_;  ///< ηA0, R
  double scale_;           ///< E*√R ηA0
  std::unique_ptr<const detail::HeightDensity> heights_;
};

/// How the two principal curvatures of a summit enter its contact.
enum class SummitShape {
  circular,   ///< a sphere with R = 1/(mean curvature)
  elliptical  ///< Hertz's exact elliptical contact; curvature ratios below 1e-3 count as 1e-3
};

template <>
struct EnumNames<SummitShape> {
  static constexpr auto values = std::to_array<std::pair<SummitShape, std::string_view>>(
      {{SummitShape::circular, "circular"}, {SummitShape::elliptical, "elliptical"}});
};

/// Contact of the summits of one surface, each with its own height z_i and radius R_i:
///     F = Σ(4/3)E*√R_i (z_i−s)^{3/2}, K = −dF/ds, F'' = d²F/ds², over the summits with z_i > s.
/// The separation s is measured from the mean of the summit heights. F'' is infinite where a summit
/// just touches, but integrable over s. Cost: one pass over the summits in contact.
class DeterministicSummits final : public AsperityModel {
 public:
  /// mean_plane: mean height of the surface, m, in the coordinate in which the summit heights are
  /// given. nominal_area: area of the region that was searched for summits, m². Throws InvalidInput
  /// without summits, or for a curvature that is not > 0.
  DeterministicSummits(const std::vector<Summit>& summits, const Material& material,
                       double nominal_area, double mean_plane = 0,
                       double rms_height = ForceSample::unknown,
                       SummitShape shape = SummitShape::circular);
  AsperityContact at(double separation) const override;
  std::vector<double> break_separations() const override;

 private:
  struct Cap {
    double height, force_radius, area_radius;
  };
  std::vector<Cap> caps_;  ///< highest first, heights from their mean
};

/// Converts the contact of a model at a separation to a sample of a curve.
ForceSample force_sample(const AsperityModel& model, double separation,
                         const AsperityContact& contact);

/// Compute curves at the given separations (m, any order) or pressures (Pa, > 0, any order), sorted
/// from the lowest force to the highest. Every quantity is set, except K_t if G* is unknown; δ and
/// ū are those of AsperityModel.
ForceCurve curve_at_separations(const AsperityModel& model, const std::vector<double>& separations);
ForceCurve curve_at_pressures(const AsperityModel& model, const std::vector<double>& pressures);

/// Exact law F(δ) of an asperity model, without table or fit. δ is AsperityModel::indentation().
class GreenwoodWilliamsonLaw final : public ContactLaw {
 public:
  /// Throws InvalidInput if G* of the model's material is unknown.
  explicit GreenwoodWilliamsonLaw(std::shared_ptr<const AsperityModel> model);
  GreenwoodWilliamsonLaw(const SummitEnsemble& ensemble, const Material& material,
                         double nominal_area);
  double force(double indentation) const override;
  double normal_stiffness(double indentation) const override;
  double force_curvature(double indentation) const override;
  /// That of the highest summit; of a statistical ensemble where its force is below round-off.
  double first_touch() const override;
  double indentation_of(double force) const override;
  std::vector<double> break_points() const override;
  const AsperityModel& model() const { return *model_; }

 private:
  double separation(double indentation) const;

  std::shared_ptr<const AsperityModel> model_;
};

/// Contact of two rough sides by Greenwood and Tripp (1970). Two summits of radii R1 and R2 whose
/// axes are a distance r apart overlap by w = z − s − r²/(2(R1+R2)), where z is the sum of their
/// heights, and carry Hertz's force for the radius R = R1R2/(R1+R2); the tilt of the contact is
/// neglected. Summed over all pairs, with independent positions, densities η1, η2, a Gaussian
/// density φ of z with σ² = σ1² + σ2², and the moments M_n = ∫(z−s)^n φ, the number N of contacts,
/// the contact area A_c and F are
///     N = 2π(R1+R2)η1η2A0 M_1,   A_c = π²R1R2η1η2A0 M_2,
///     F = (4/3)E*√R·(2/5)·2π(R1+R2)η1η2A0 M_{5/2},
/// and K and F'' are derivatives of F. s is the distance between the mean planes of the summits of
/// the two sides.
class GreenwoodTripp final : public AsperityModel {
 public:
  /// Throws InvalidInput unless density, radius and summit_rms of both sides are > 0 and both are
  /// Gaussian.
  GreenwoodTripp(const SummitEnsemble& first, const SummitEnsemble& second,
                 const Material& material, double nominal_area);
  ~GreenwoodTripp() override;
  AsperityContact at(double separation) const override;
  double force(double separation) const override;
  double normal_stiffness(double separation) const override;
  double force_curvature(double separation) const override;

 private:
  std::unique_ptr<const detail::HeightDensity> heights_;  ///< of the sum of two heights
  double pairs_, area_, scale_;  ///< factors of M_1, M_2, M_{5/2} in N, A_c, F
};

}  // namespace salebra
