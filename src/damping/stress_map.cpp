// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure and shear stress under an oscillating axisymmetric indenter, over phase and radius.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/stress_map.hpp>

#include "base/numerics/quadrature.hpp"
#include "max_motion.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

double half_angle(double above, double below) {
  return 2 * std::atan2(std::sqrt(std::max(above, 0.0)), std::sqrt(std::max(below, 0.0)));
}

}  // namespace

OscillatingStress::OscillatingStress(const IndenterLaw& law, double mean_indentation,
                                     const Oscillation& motion)
    : law_(law),
      motion_(motion),
      mean_indentation_(mean_indentation),
      amplitude_(std::visit([](const auto& m) { return m.normal_amplitude; }, motion)),
      tangential_modulus_(law.modulus_ratio() * law.contact_modulus()) {
  require(std::isfinite(mean_indentation), "indentation", mean_indentation, "must be finite");
  require(std::isfinite(amplitude_) && amplitude_ > 0, "normal_amplitude", amplitude_,
          "must be finite and > 0");
  require(mean_indentation + amplitude_ > 0, "indentation", mean_indentation,
          "m is too low: the contact never closes");
  if (const auto* drag = std::get_if<Drag>(&motion))
    require_positive(drag->angular_frequency, "angular_frequency");
  // An indenter profile that ends inside the largest contact is refused now, not in the middle of a
  // map.
  static_cast<void>(law.contact_radius(mean_indentation + amplitude_));
  detail::require_possible(law, mean_indentation, amplitude_);
  // Phase θ at which the contact opens: cosθ = −δ0/u_z
  open_angle_ = mean_indentation_ < amplitude_
                    ? half_angle(amplitude_ + mean_indentation_, amplitude_ - mean_indentation_)
                    : pi;
}

double OscillatingStress::indentation(double angle) const {
  return mean_indentation_ + amplitude_ * std::cos(angle);
}

double OscillatingStress::position(double angle) const {
  if (const auto* drag = std::get_if<Drag>(&motion_))
    return drag->drag_velocity / drag->angular_frequency * angle;
  const auto& equal = std::get<EqualFrequency>(motion_);
  return equal.tangential_amplitude * std::cos(angle + equal.phase);
}

double OscillatingStress::speed(double angle) const {
  if (const auto* drag = std::get_if<Drag>(&motion_))
    return drag->drag_velocity / drag->angular_frequency;
  const auto& equal = std::get<EqualFrequency>(motion_);
  return -equal.tangential_amplitude * std::sin(angle + equal.phase);
}

double OscillatingStress::contact_radius(double angle) const {
  return std::abs(angle) < open_angle_ || open_angle_ == pi
             ? law_.contact_radius(indentation(angle))
             : 0;
}

double OscillatingStress::min_contact_radius() const {
  return open_angle_ < pi ? 0 : law_.contact_radius(mean_indentation_ - amplitude_);
}

double OscillatingStress::displacement(double angle) const {
  return position(angle) - position(-pi);
}

double OscillatingStress::touch_angle(double radius) const {
  const double spring_depth = law_.profile().image(radius);
  return half_angle(mean_indentation_ + amplitude_ - spring_depth,
                    spring_depth - (mean_indentation_ - amplitude_));
}

double OscillatingStress::pressure(double angle, double r) const {
  return law_.pressure(indentation(angle), r);
}

// Shear stress q_x at the phase `angle` and the radius r. At the edge of the contact q_x jumps by
// G*(x(θ) − x(−|θ|)), which is 0 while δ grows (x(θ): tangential position at the phase θ). Inside,
// the springs that touched at the phase −β have the anchor x(−β), and Eq. (17) becomes an integral
// over β. Springs inside the smallest contact (radius a_min) share one anchor and do not
// contribute.
//
// With Y = π − β the radius a of a spring grows like a² = a_min² + BY² at first (B: a constant of
// the profile). Therefore 1/√(a² − r²) in the integrand is singular at Y_r, where a = r, if r lies
// outside the smallest contact; inside it has a peak of width √((a_min² − r²)/B). The substitutions
// Y = Y_r cosh t and Y = width · sinh t make both integrands smooth, however close r is to a_min.
double OscillatingStress::shear(double angle, double r) const {
  require(r >= 0, "radius", r, "must be >= 0");
  const double edge = contact_radius(angle), now = std::abs(angle);
  if (!(r < edge)) return 0;
  const IndenterProfile& profile = law_.profile();
  const double inner = law_.contact_radius(indentation(open_angle_));
  const double span = pi - now, base = std::max(r, inner);
  const double base_offset = r > inner ? std::min(pi - touch_angle(r), span) : pi - open_angle_;
  const double base_depth = profile.image(base), base_slope = profile.image_slope(base);
  double width = 1;
  if (r < inner && base_slope > 0)
    width = std::min(1.0, std::sqrt((inner - r) * (inner + r) * base_slope / (inner * amplitude_)));
  const double first = r > inner ? 0 : std::asinh(base_offset / width);
  const double last = r > inner ? std::acosh(span / base_offset) : std::asinh(span / width);

  auto integrand = [&](double t) {
    const double offset = r > inner ? base_offset * std::cosh(t) : width * std::sinh(t);
    const double stretch = r > inner ? base_offset * std::sinh(t) : width * std::cosh(t);
    const double beyond =
        r > inner ? 2 * base_offset * std::pow(std::sinh(t / 2), 2) : offset - base_offset;
    // Height of a spring above the base of the integral, computed without the difference of two
    // cosines. If spring and base are close, the difference of their radii would also be lost in
    // that of two inversions of the profile.
    const double climb =
        2 * amplitude_ * std::sin(0.5 * (offset + base_offset)) * std::sin(0.5 * beyond);
    double growth = climb / base_slope;
    if (growth < 1e-5 * base)
      growth = climb / profile.image_slope(base + 0.5 * growth);
    else
      growth = law_.contact_radius(base_depth + climb) - base;
    const double square = (growth + (base - r)) * (growth + (base + r));
    return square > 0 ? stretch * speed(offset - pi) / std::sqrt(square) : 0;
  };
  const double jump = tangential_modulus_ * (position(angle) - position(-now));
  const double reach = std::sqrt((edge - r) * (edge + r));
  const std::array<double, 2> range{first, last};
  const auto integral =
      detail::integrate(integrand, range, 1e-8, 1e-12 * std::abs(speed(-open_angle_)) / edge);
  return (jump / reach + tangential_modulus_ * integral.value) / pi;
}

// Tangential force, after integration by parts: F_x = 2G*∫_0^a (x − x0) dX = 2G*[a(θ)(x(θ) −
// x(−|θ|)) + ∫ a(β) x'(−β) dβ], integrated from |θ| to the phase at which the contact opens. a:
// contact radius, x0: anchor of the spring at the radius X.
double OscillatingStress::tangential_force(double angle) const {
  const double edge = contact_radius(angle), now = std::abs(angle);
  if (!(edge > 0)) return 0;
  const std::array<double, 2> range{now, open_angle_};
  const auto integral = detail::integrate(
      [&](double touched) { return law_.contact_radius(indentation(touched)) * speed(-touched); },
      range, 1e-11);
  return 2 * tangential_modulus_ * (edge * (position(angle) - position(-now)) + integral.value);
}

StressMap stress_map(const IndenterLaw& law, double mean_indentation, const Oscillation& motion,
                     int phases, int radii, const Progress& on_progress) {
  require(phases >= 2 && phases <= 100000, "phases", phases, "must lie between 2 and 100000");
  require(radii >= 2 && radii <= 100000, "radii", radii, "must lie between 2 and 100000");
  const OscillatingStress stress(law, mean_indentation, motion);
  StressMap map;
  const double largest = 1.05 * stress.contact_radius(0);
  for (int j = 0; j < radii; ++j) map.radial_position.push_back(largest * (j + 0.5) / radii);
  for (int i = 0; i <= phases; ++i) {
    const double angle = -pi + 2 * pi * i / phases;
    map.angle.push_back(angle);
    map.contact_radius.push_back(stress.contact_radius(angle));
    map.tangential_force.push_back(stress.tangential_force(angle));
  }
  map.shear.resize(phases + 1, radii);
  map.contact_pressure.resize(phases + 1, radii);
  constexpr Index block = 16;
  for (Index first = 0; first <= phases; first += block) {
    const Index count = std::min<Index>(block, phases + 1 - first);
    parallel::for_slabs(count, [&](Index begin, Index end) {
      for (Index i = first + begin; i < first + end; ++i)
        for (Index j = 0; j < radii; ++j) {
          const double angle = map.angle[static_cast<std::size_t>(i)];
          const double r = map.radial_position[static_cast<std::size_t>(j)];
          map.shear(i, j) = stress.shear(angle, r);
          map.contact_pressure(i, j) = stress.pressure(angle, r);
        }
    });
    const double done = static_cast<double>(first + count) / (phases + 1);
    if (on_progress && !on_progress({"stress map", done, static_cast<int>(first + count), 0}))
      throw Interrupted("stress map: stopped before it was complete");
  }
  return map;
}

}  // namespace salebra
