// SPDX-License-Identifier: GPL-3.0-or-later
// Loss per cycle of each Hertzian summit of a surface, and their sum.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/closed_form.hpp>

#include "base/numerics/quadrature.hpp"
#include "contact/asperity/given_summits.hpp"

namespace salebra {
namespace {

double normal_amplitude_of(const Oscillation& motion) {
  return std::visit([](const auto& of_kind) { return of_kind.normal_amplitude; }, motion);
}

void validate(const Oscillation& motion) {
  const double amplitude = normal_amplitude_of(motion);
  require(std::isfinite(amplitude) && amplitude >= 0, "normal_amplitude", amplitude,
          "must be finite and >= 0; a negative one is a phase shift of pi");
  if (const Drag* drag = std::get_if<Drag>(&motion)) {
    require_positive(drag->angular_frequency, "angular_frequency");
    require(std::isfinite(drag->drag_velocity), "drag_velocity", drag->drag_velocity,
            "must be finite");
  } else {
    const auto& both = std::get<EqualFrequency>(motion);
    require(std::isfinite(both.tangential_amplitude), "tangential_amplitude",
            both.tangential_amplitude, "must be finite");
    require(std::isfinite(both.phase), "phase", both.phase, "must be finite");
  }
}

/// ∫ s² dx over the springs that open and close, for a paraboloid with radius R at the mean
/// indentation δ. s: stretch at which the spring at the distance x from the axis separates.
double released_square(double radius, double indentation, const Oscillation& motion) {
  const double amplitude = normal_amplitude_of(motion);
  if (amplitude == 0 || indentation + amplitude <= 0) return 0;
  const auto square_at = [&](double spring_depth) {
    const double distance = std::visit(
        [&](const auto& of_kind) { return closed_form::released_distance(spring_depth, of_kind); },
        motion);
    return distance * distance;
  };
  detail::Integral integral;
  if (indentation > amplitude) {
    // Integrates over the phase θ, because s is smooth at θ = 0 and π. The spring that
    // touches at θ has the depth ζ = δ + u_z cosθ, and dx = R dζ/2x.
    integral = detail::integrate(
        [&](double angle) {
          const double spring_depth = amplitude * std::cos(angle);
          const double x = std::sqrt(radius * (indentation + spring_depth));
          return square_at(spring_depth) * radius * amplitude * std::sin(angle) / (2 * x);
        },
        std::array{0.0, std::numbers::pi}, 1e-12);
  } else {
    // A summit that opens in each cycle: integrates over x, because the integrand is smooth at x =
    // 0, where the summit first touches.
    integral =
        detail::integrate([&](double x) { return square_at(x * x / radius - indentation); },
                          std::array{0.0, std::sqrt(radius * (indentation + amplitude))}, 1e-12);
  }
  if (!integral.converged) throw NotConverged("asperity_damping: quadrature over springs");
  return integral.value;
}

}  // namespace

AsperityDamping asperity_damping(const std::vector<Summit>& summits, const Material& material,
                                 double separation, const Oscillation& motion, SummitShape shape) {
  const double ratio = material.modulus_ratio();
  validate(motion);
  require(std::isfinite(separation), "separation", separation, "must be finite");
  const std::vector<detail::HertzCap> caps = detail::hertz_caps(summits, shape);
  const double amplitude = normal_amplitude_of(motion);

  AsperityDamping damping;
  damping.work.resize(caps.size());
  parallel::for_slabs(static_cast<Index>(caps.size()), [&](Index begin, Index end) {
    for (Index index = begin; index < end; ++index) {
      const auto i = static_cast<std::size_t>(index);
      damping.work[i] = material.tangential_modulus *
                        released_square(caps[i].force_radius, caps[i].height - separation, motion);
    }
  });
  double curvature = 0;
  for (std::size_t i = 0; i < caps.size(); ++i) {
    const double indentation = caps[i].height - separation;
    damping.work_per_cycle += damping.work[i];
    if (indentation < amplitude) damping.intermittent_work += damping.work[i];
    damping.max_contacts += indentation + amplitude > 0;
    damping.min_contacts += indentation - amplitude > 0;
    if (indentation > 0)
      curvature += material.contact_modulus * std::sqrt(caps[i].force_radius / indentation);
  }
  damping.small_amplitude_work = std::visit(
      [&](const auto& of_kind) { return closed_form::work_per_cycle(ratio, curvature, of_kind); },
      motion);
  damping.power = closed_form::power(damping.work_per_cycle, motion);
  damping.damping_constant = closed_form::damping_constant(damping.work_per_cycle, motion);
  return damping;
}

}  // namespace salebra
