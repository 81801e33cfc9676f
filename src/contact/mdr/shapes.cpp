// SPDX-License-Identifier: GPL-3.0-or-later
// Indenter profiles whose images have a closed form: cone, paraboloid, power, sphere, flat, rounded
// punch.
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>

namespace salebra {
namespace {

using std::numbers::pi;

class PowerProfile final : public IndenterProfile {
 public:
  PowerProfile(double coefficient, double exponent)
      : coefficient_(coefficient),
        exponent_(exponent),
        image_coefficient_(coefficient * std::sqrt(pi) * exponent / 2 *
                           std::exp(std::lgamma(exponent / 2) - std::lgamma((exponent + 1) / 2))) {}
  double height(double r) const override { return coefficient_ * std::pow(r, exponent_); }
  double image(double x) const override { return image_coefficient_ * std::pow(x, exponent_); }
  double image_slope(double x) const override {
    return image_coefficient_ * exponent_ * std::pow(x, exponent_ - 1);
  }
  double image_integral(double x) const override {
    return image_coefficient_ * std::pow(x, exponent_ + 1) / (exponent_ + 1);
  }
  double contact_radius(double indentation) const override {
    require_positive(indentation, "indentation");
    return std::pow(indentation / image_coefficient_, 1 / exponent_);
  }

 private:
  double coefficient_, exponent_, image_coefficient_;
};

class SphereProfile final : public IndenterProfile {
 public:
  explicit SphereProfile(double radius) : radius_(radius) {}
  double height(double r) const override {
    // R − √(R² − r²) as r²/(R + √(R² − r²)): the difference would lose all digits for a shallow
    // contact.
    return r * r / (radius_ + std::sqrt((radius_ - r) * (radius_ + r)));
  }
  double image(double x) const override { return x * std::atanh(x / radius_); }
  double image_slope(double x) const override {
    const double u = x / radius_;
    return std::atanh(u) + u / ((1 - u) * (1 + u));
  }
  double image_integral(double x) const override {
    const double u = x / radius_;
    if (u > 0.3) return 0.5 * radius_ * radius_ * (u - (1 - u) * (1 + u) * std::atanh(u));
    // For u = x/R <= 0.3 the series R² Σ_{n>=1} u^{2n+1}/((2n − 1)(2n + 1)): in the closed form all
    // terms below third order cancel.
    double sum = 0, power = u * u * u;
    for (int n = 1; n < 20; ++n, power *= u * u) sum += power / ((2 * n - 1) * (2 * n + 1));
    return radius_ * radius_ * sum;
  }
  // The image g is infinite at the equator r = R, where the half-space theory does not apply
  // anyway.
  double max_radius() const override { return 0.999999 * radius_; }

 private:
  double radius_;
};

class FlatPunchProfile final : public IndenterProfile {
 public:
  explicit FlatPunchProfile(double radius) : radius_(radius) {}
  double height(double) const override { return 0; }
  double image(double) const override { return 0; }
  double image_slope(double) const override { return 0; }
  double image_integral(double) const override { return 0; }
  double flat_radius() const override { return radius_; }
  double max_radius() const override { return radius_; }
  bool has_side() const override { return true; }
  double contact_radius(double) const override { return radius_; }

 private:
  double radius_;
};

class RoundedPunchProfile final : public IndenterProfile {
 public:
  RoundedPunchProfile(double flat_radius, double edge_radius)
      : flat_(flat_radius), edge_(edge_radius) {}
  double height(double r) const override {
    return r > flat_ ? (r - flat_) * (r - flat_) / (2 * edge_) : 0;
  }
  // Flat radius b, edge radius R. With t = √(x² − b²)/b the image is g = (b x/R)(t − arctan t), its
  // slope g' = (b/R)(2t − arctan t), and ∫g = (b³/R)[t³/3 + t/2 − (1 + t²)arctan(t)/2].
  double image(double x) const override {
    const double t = reduced(x);
    return flat_ * x / edge_ * (t > 0.3 ? t - std::atan(t) : arctan_series(t, 0));
  }
  double image_slope(double x) const override {
    const double t = reduced(x);
    return flat_ / edge_ * (2 * t - std::atan(t));
  }
  double image_integral(double x) const override {
    const double t = reduced(x), scale = flat_ * flat_ * flat_ / edge_;
    if (t > 0.3) return scale * (t * t * t / 3 + 0.5 * t - 0.5 * (1 + t * t) * std::atan(t));
    return scale * arctan_series(t, 1);
  }
  double flat_radius() const override { return flat_; }
  std::vector<double> breaks() const override { return {flat_}; }

 private:
  double reduced(double x) const {
    return x > flat_ ? std::sqrt((x - flat_) * (x + flat_)) / flat_ : 0;
  }
  // Series for small t, where the closed forms cancel.
  // order 0: t − arctan t = Σ_{n>=1} (−1)^{n+1} t^{2n+1}/(2n + 1);
  // order 1: the bracket of ∫g above = Σ_{n>=2} (−1)ⁿ t^{2n+1}/((2n − 1)(2n + 1)).
  static double arctan_series(double t, int order) {
    double sum = 0, power = order == 0 ? t * t * t : std::pow(t, 5);
    double sign = 1;
    for (int n = order + 1; n < 24; ++n, power *= t * t, sign = -sign)
      sum += sign * power / (order == 0 ? 2 * n + 1 : (2 * n - 1) * (2 * n + 1));
    return sum;
  }
  double flat_, edge_;
};

}  // namespace

std::unique_ptr<IndenterProfile> cone_profile(double angle) {
  require(angle > 0 && angle < pi / 2, "angle", angle, "must lie between 0 and pi/2");
  return std::make_unique<PowerProfile>(std::tan(angle), 1);
}

std::unique_ptr<IndenterProfile> paraboloid_profile(double radius) {
  require_positive(radius, "radius");
  return std::make_unique<PowerProfile>(1 / (2 * radius), 2);
}

std::unique_ptr<IndenterProfile> power_profile(double coefficient, double exponent) {
  require_positive(coefficient, "coefficient");
  require_positive(exponent, "exponent");
  return std::make_unique<PowerProfile>(coefficient, exponent);
}

std::unique_ptr<IndenterProfile> sphere_profile(double radius) {
  require_positive(radius, "radius");
  return std::make_unique<SphereProfile>(radius);
}

std::unique_ptr<IndenterProfile> flat_punch_profile(double radius) {
  require_positive(radius, "radius");
  return std::make_unique<FlatPunchProfile>(radius);
}

std::unique_ptr<IndenterProfile> rounded_punch_profile(double flat_radius, double edge_radius) {
  require_positive(flat_radius, "flat_radius");
  require_positive(edge_radius, "edge_radius");
  return std::make_unique<RoundedPunchProfile>(flat_radius, edge_radius);
}

}  // namespace salebra
