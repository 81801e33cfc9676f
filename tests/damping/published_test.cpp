// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <salebra/damping/contact_element.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <vector>

// Results of others (docs/published.md) from sums over springs of this file, which take nothing but
// K_t(δ) from the library.

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double ratio = 1.4 / 1.7;  // G*/E* of ν = 0.3
constexpr double friction = 0.4;

// Loss of harmonic loads F0 + F1 cosωt and T cos(ωt + φ) that are small, in units of
// μ²F1³|d²δ/dF²|/g, g = G*/E*, at s = T/(μF1): springs of equal stiffness at all depths z, which
// slip at the stretch y − z, under y = cosωt and x = s cos(ωt + φ). Springs deeper than 1 + 2s never
// slip.
double small_loss(double s, double phase) {
  constexpr int springs = 400, steps = 1600;
  const double lowest = -1 - 2 * s, width = (1 - lowest) / springs;
  double sum = 0;
  for (int i = 0; i < springs; ++i) {
    const double depth = lowest + (i + 0.5) * width;
    double before = s * std::cos(phase), anchor = before, stretch = 0, gap = depth - 1, work = 0;
    for (int k = 1; k <= 3 * steps; ++k) {
      const double t = 2 * pi * k / steps, x = s * std::cos(t + phase);
      const double limit = std::cos(t) - depth;
      if (limit > 0 && gap > 0) anchor = before + (x - before) * gap / (gap + limit);
      gap = -limit;
      const double stuck = x - anchor, held = std::min(std::abs(stuck), std::max(limit, 0.0));
      const double now = std::copysign(held, stuck);
      if (k > 2 * steps) work += (stretch + now) / 2 * (x - before);  // the third period is steady
      if (limit > 0) anchor = x - now;
      before = x, stretch = now;
    }
    sum += work * width;
  }
  return sum;
}

// Mean force along x of a contact at constant indentation that moves by `drift` in a period and
// vibrates by `swing` along x or, if `across`, along y.
double mean_force(const ContactLaw& law, double indentation, double drift, double swing,
                  bool across) {
  constexpr int springs = 400, steps = 2000;
  const double width = indentation / springs;
  double sum = 0;
  for (int i = -1; i < springs; ++i) {
    // The spring -1 is a flat face, which touches as a whole.
    const double touch = 1e-12 * indentation;
    const double depth = i < 0 ? 0 : (i + 0.5) * width;
    const double stiffness = i < 0 ? law.tangential_stiffness(touch)
                                   : law.tangential_stiffness((i + 1) * width) -
                                         law.tangential_stiffness(std::max(touch, i * width));
    const double limit = friction / ratio * (indentation - depth);
    std::array<double, 2> anchor = {(across ? 0 : swing) - limit, 0};
    double mean = 0;
    for (int k = 1; k <= 3 * steps; ++k) {
      const double t = 2 * pi * k / steps,
                   x = drift * k / steps + (across ? 0 : swing * std::cos(t));
      const double y = across ? swing * std::sin(t) : 0;
      const double stretch = std::hypot(x - anchor[0], y - anchor[1]);
      if (stretch > limit)
        anchor = {x - (x - anchor[0]) * limit / stretch, y - (y - anchor[1]) * limit / stretch};
      if (k > 2 * steps) mean += (x - anchor[0]) / steps;
    }
    sum += stiffness * mean;
  }
  return sum;
}

double path_mean_force(const ContactLaw& law, double indentation, double drift, double swing) {
  constexpr int steps = 2000;
  SampledMotion path;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    path.time.push_back(t);
    path.indentation.push_back(indentation);
    path.displacement.push_back(drift * t + swing * std::cos(2 * pi * (k % steps) / steps));
  }
  const std::vector<double> force =
      trajectory_damping(law, path, {.friction_coefficient = friction}).tangential_force;
  double mean = 0;
  for (int k = 1; k <= steps; ++k) mean += force[k] / steps;
  return mean;
}

double element_mean_force(const ContactLaw& law, double indentation, double drift, double swing,
                          int periods = 3) {
  constexpr int steps = 2000;
  ContactElement element(std::make_shared<const LawSprings>(
      law, 0, 1.01 * indentation,
      LawSpringsOptions{.friction_coefficient = friction, .springs = 512}));
  element.start(indentation, -2 * friction / ratio * indentation, 0);
  double mean = 0;
  for (int k = 0; k <= periods * steps; ++k) {
    const ElementForces forces = element.move_to(indentation, drift * k / steps,
                                                 swing * std::sin(2 * pi * (k % steps) / steps));
    if (k > (periods - 1) * steps) mean += forces.tangential_force[0] / steps;
  }
  return mean;
}

}  // namespace

TEST_CASE("Small harmonic loads lose the same function of ratio and phase on every law",
          "[published]") {
  // The abstracts of Putignano et al. (2011), Patil and Eriten (2015) and Ahn (2024): the loss is
  // the cube of the amplitudes times d²δ/dF², larger out of phase, quadratic in T at 90°, and zero
  // in phase below sliding of every spring. In phase springs have (2/3) s (s² − 1) in closed form.
  CHECK(small_loss(0.9, 0) == Approx(0).margin(1e-12));
  CHECK(small_loss(2, 0) == Approx(4).epsilon(1e-4));
  CHECK(small_loss(2, pi / 2) > 2 * small_loss(2, 0));
  const double small = 1e-3;  // F1/F, and the error of the limit of small amplitudes
  const PowerLaw sphere(1e9, 1.5, ratio);
  const PowerLaw rough(1e7, 1 / 0.8, ratio);
  const ExponentialLaw summits(1, 1e-7, ratio);
  for (const ContactLaw* law :
       std::initializer_list<const ContactLaw*>{&sphere, &rough, &summits}) {
    const double indentation = law->indentation_of(1);
    const double stiffness = law->normal_stiffness(indentation);
    // d²δ/dF² = −K'/K³
    const double unit = friction * friction * std::pow(small / stiffness, 3) *
                        law->force_curvature(indentation) / ratio;
    for (const double s : {0.1, 0.5, 2.0})
      for (const double phase : {0.0, pi / 3, pi / 2}) {
        CAPTURE(s, phase);
        const JointLoss loss =
            joint_loss(*law, at_force(1),
                       JointMotion{TangentialForce{s * friction * small}, small / stiffness, phase},
                       friction, 400);
        // Steps of 400 to the period displace the ends of slip: 0.3 %, of the largest loss where the
        // loss vanishes.
        CHECK(loss.work_per_cycle / unit ==
              Approx(small_loss(s, phase)).epsilon(3e-3).margin(1e-4 * s * s));
      }
  }
}

TEST_CASE("Vibration along or across the motion lowers friction as springs have it",
          "[published]") {
  // The model of M. Popov (2020): Amontons friction with normal and tangential contact stiffness.
  // The limit v → 0, static friction, has closed forms in c = gu/μ: along the motion a spring whose
  // limit μ(δ − ζ)/g is below u goes to and fro, which leaves μF(δ − c); across it the spring bends
  // the way of a triangle, ∫K_t'[(μ(δ − ζ)/g)² − u²]^½dζ. From v = uω on vibration along the motion
  // has no effect.
  const double indentation = 1e-6, limit = friction / ratio * indentation;
  const PowerLaw punch(2e6, 1, ratio), sphere(2e9, 1.5, ratio);
  for (const ContactLaw* law : {&punch, &sphere})
    for (const double swing : {0.2 * limit, 0.7 * limit, 1.5 * limit}) {
      CAPTURE(law == &punch, swing / limit);
      const double sliding = friction * law->force(indentation);
      for (const double speed : {0.1, 0.5, 1.01}) {
        CAPTURE(speed);
        const double drift = 2 * pi * speed * swing;
        const double along = path_mean_force(*law, indentation, drift, swing);
        // The 400 springs of the sum err by 1e-4 of sliding friction.
        CHECK(along ==
              Approx(mean_force(*law, indentation, drift, swing, false)).margin(1e-3 * sliding));
        if (speed > 1) CHECK(along == Approx(sliding).epsilon(1e-9));
        const double across = element_mean_force(*law, indentation, drift, swing);
        CHECK(across ==
              Approx(mean_force(*law, indentation, drift, swing, true)).margin(2e-3 * sliding));
        CHECK(across < sliding);
      }
      const double slow = 1e-5 * swing;
      const double depth = std::max(0.0, indentation - ratio * swing / friction);
      CHECK(path_mean_force(*law, indentation, slow, swing) ==
            Approx(friction * law->force(depth)).margin(1e-3 * sliding));
    }
  // One spring that bends by three fifths of its limit: a triangle of 3, 4 and 5. A drift of a
  // hundredth of the limit in a period turns it by as much.
  CHECK(element_mean_force(punch, indentation, 1e-2 * limit, 0.6 * limit, 40) ==
        Approx(0.8 * friction * punch.force(indentation)).epsilon(1e-2));
}
