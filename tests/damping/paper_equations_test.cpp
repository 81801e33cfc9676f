// SPDX-License-Identifier: GPL-3.0-or-later
// Each numbered equation of Popov, Popov, Pohrt, "Relaxation damping in oscillating contacts",
// under its number, by at least two methods that share no code: the closed form, quadratures
// written out here, the engine of turning points, the foundation of springs.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <salebra/damping/trajectory_damping.hpp>

#include "spring_foundation.hpp"

using namespace salebra;
namespace cf = salebra::closed_form;
using std::numbers::pi;

namespace {

constexpr double contact_modulus = 1e9, tangential_modulus = 8e8;
constexpr double modulus_ratio = tangential_modulus / contact_modulus;
const Material material = Material::of_moduli(contact_modulus, tangential_modulus);
const EqualFrequency equal{
    .normal_amplitude = 3e-7, .tangential_amplitude = 2e-7, .phase = 0.7, .angular_frequency = 50};
const Drag drag{.normal_amplitude = 3e-7, .drag_velocity = 1e-4, .angular_frequency = 300};
constexpr double cone_angle = 0.02, cone_indentation = 1e-6;

// Composite Gauss–Legendre rule with six points per panel.
double gauss(const std::function<double(double)>& f, double low, double high, int panels) {
  const std::array<double, 3> node{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  const std::array<double, 3> weight{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double half = 0.5 * (high - low) / panels;
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double middle = low + (2 * i + 1) * half;
    for (std::size_t j = 0; j < node.size(); ++j)
      sum += weight[j] * (f(middle - half * node[j]) + f(middle + half * node[j]));
  }
  return sum * half;
}

// Zero of a function that changes sign once in [low, high].
double bisect(const std::function<double(double)>& f, double low, double high) {
  const bool rising = f(high) > f(low);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

// Height of a point of the body at the distance z0 from the surface, and its position along the
// surface; angle = ωt.
double height(double level, double angle) { return -level + 3e-7 * std::cos(angle); }
double position(const EqualFrequency& motion, double angle) {
  return motion.tangential_amplitude * std::cos(angle + motion.phase);
}
double position(const Drag& motion, double angle) {
  return motion.drag_velocity / motion.angular_frequency * angle;
}

// x1 − x2 found on the path itself.
template <class Motion>
double distance_on_path(double level, const Motion& motion) {
  const auto above = [&](double angle) { return height(level, angle); };
  return position(motion, bisect(above, -pi, 0)) - position(motion, bisect(above, 0, pi));
}

// W of the engine, which is exact for straight steps, extrapolated at second order from two numbers
// of steps.
double work_of_engine(const ContactLaw& law, double indentation, const Oscillation& motion) {
  const double coarse = trajectory_damping(law, sample(motion, indentation, 4000)).work_per_cycle;
  const double fine = trajectory_damping(law, sample(motion, indentation, 8000)).work_per_cycle;
  return fine + (fine - coarse) / 3;
}

double work_of_springs(const ContactLaw& law, double indentation, const Oscillation& motion,
                       int levels) {
  const SampledMotion path = sample(motion, indentation, 4 * levels);
  const double reach = 3e-7;
  salebra_test::SpringFoundation springs(law, indentation - reach, indentation + reach, levels);
  springs.start(path.indentation[0], path.displacement[0]);
  for (std::size_t i = 1; i < path.time.size(); ++i)
    springs.move_to(path.indentation[i], path.displacement[i]);
  return springs.released();
}

IndenterLaw cone() { return {cone_profile(cone_angle), material}; }

}  // namespace

TEST_CASE("Eq (1): E* is the stiffness of both bodies under one point force, and of the springs",
          "[paper]") {
  const ElasticBody first{2e9, 0.3}, second{7e9, 0.45};
  const double composite = Material::of_bodies(first, second).contact_modulus;
  // Boussinesq: each surface moves by (1 − ν)F/(2πGr) at the distance r.
  const double moved =
      (1 - 0.3) / (2 * pi * first.shear()) + (1 - 0.45) / (2 * pi * second.shear());
  CHECK(composite == Approx(1 / (pi * moved)).epsilon(1e-14));
  // Springs of E*Δx under x²/R, by the midpoint rule, against Hertz: second order.
  const double radius = 1e-2, indentation = 1e-6;
  const IndenterLaw law(paraboloid_profile(radius), material);
  const double edge = std::sqrt(radius * indentation);
  const auto error = [&](int springs) {
    double force = 0;
    const double width = edge / springs;
    for (int i = 0; i < springs; ++i) {
      const double x = (i + 0.5) * width;
      force += 2 * contact_modulus * width * (indentation - x * x / radius);
    }
    return force / law.force(indentation) - 1;
  };
  CHECK(error(1000) == Approx(0.125e-6).epsilon(0.01));
  CHECK(error(1000) / error(2000) == Approx(4).epsilon(1e-3));
}

TEST_CASE(
    "Eq (2): G* is the stiffness of both bodies under one tangential point force, and of the "
    "springs",
    "[paper]") {
  const ElasticBody first{2e9, 0.3}, second{7e9, 0.45};
  const double composite = Material::of_bodies(first, second).tangential_modulus;
  // Cerruti: u_x = F/(2πGr)[(1 − ν) + ν cos²φ], averaged over the direction.
  const auto mean = [&](const ElasticBody& body) {
    return gauss(
               [&](double angle) {
                 return (1 - body.poisson) + body.poisson * std::cos(angle) * std::cos(angle);
               },
               0, pi, 8) /
           pi / (2 * pi * body.shear());
  };
  CHECK(composite == Approx(1 / (pi * (mean(first) + mean(second)))).epsilon(1e-12));
  // Springs of G*Δx over the diameter of the contact: K_t = 2G*a, and F_x of the engine for a small
  // shift.
  const IndenterLaw law = cone();
  const double shift = 1e-9;
  TangentialContact contact(law, cone_indentation, cone_indentation);
  contact.start(cone_indentation, 0);
  contact.move_to(cone_indentation, shift);
  CHECK(
      contact.tangential_force() ==
      Approx(2 * tangential_modulus * law.contact_radius(cone_indentation) * shift).epsilon(1e-9));
}

TEST_CASE("Eq (3): the image of rⁿ is κ_n xⁿ, and its inverse transform gives the profile back",
          "[paper]") {
  const double exponent = GENERATE(0.7, 1.0, 2.0, 3.5), x = 2e-3;
  const double kappa =
      std::sqrt(pi) * exponent / 2 * std::tgamma(exponent / 2) / std::tgamma((exponent + 1) / 2);
  const auto slope = [&](double r) { return exponent * std::pow(r, exponent - 1); };
  CHECK(mdr_transform(slope, x).value == Approx(kappa * std::pow(x, exponent)).epsilon(1e-9));
  const auto image = [&](double at) { return kappa * std::pow(at, exponent); };
  CHECK(mdr_inverse(image, x).value == Approx(std::pow(x, exponent)).epsilon(1e-9));
}

TEST_CASE("Eq (4): the profile of the cone is what the wedge of Eq (5) transforms back to",
          "[paper]") {
  const auto profile = cone_profile(cone_angle);
  for (const double r : {1e-6, 3e-4}) {
    CHECK(profile->height(r) == Approx(r * std::tan(cone_angle)).epsilon(1e-14));
    const auto wedge = [](double x) { return pi / 2 * std::tan(cone_angle) * x; };
    CHECK(mdr_inverse(wedge, r).value == Approx(profile->height(r)).epsilon(1e-9));
  }
}

TEST_CASE("Eq (5): the image of the cone is the wedge of slope c = (π/2)tanθ", "[paper]") {
  const auto profile = cone_profile(cone_angle);
  const double slope = pi / 2 * std::tan(cone_angle);
  for (const double x : {1e-6, 3e-4}) {
    CHECK(profile->image(x) == Approx(slope * x).epsilon(1e-14));
    CHECK(profile->image_slope(x) == Approx(slope).epsilon(1e-14));
    CHECK(mdr_transform([](double) { return std::tan(cone_angle); }, x).value ==
          Approx(slope * x).epsilon(1e-9));
  }
}

TEST_CASE("Eq (6): F'' of Hertz gives the slope 2a/R of the image at the edge", "[paper]") {
  const double radius = 0.01, indentation = 1e-6, edge = std::sqrt(radius * indentation);
  // F = (4/3)E*√R δ^{3/2}
  const double curvature = contact_modulus * std::sqrt(radius / indentation);
  CHECK(cf::edge_slope(contact_modulus, curvature) == Approx(2 * edge / radius).epsilon(1e-14));
  const IndenterLaw law(paraboloid_profile(radius), material);
  CHECK(cf::edge_slope(contact_modulus, law.force_curvature(indentation)) ==
        Approx(law.profile().image_slope(law.contact_radius(indentation))).epsilon(1e-12));
}

TEST_CASE("Eq (7): case (a) releases a spring by the way between touching and leaving", "[paper]") {
  const double level = GENERATE(-2.9e-7, -1e-7, 0.0, 2e-7);
  CHECK(cf::released_distance(level, equal) ==
        Approx(distance_on_path(level, equal)).epsilon(1e-12));
}

TEST_CASE("Eq (8): a released spring loses the work that stretched it", "[paper]") {
  const double width = 1e-6, distance = 3e-7;
  const double work =
      gauss([&](double x) { return tangential_modulus * width * x; }, 0, distance, 1);
  CHECK(cf::spring_energy(tangential_modulus, distance, width) == Approx(work).epsilon(1e-14));
  // A flat punch that lifts off is one spring of width 2a.
  const IndenterLaw punch(flat_punch_profile(width / 2), material);
  TangentialContact contact(punch, -1e-8, 1e-8);
  contact.start(-1e-8, 0);
  for (const auto& [indentation, x] : {std::pair{1e-8, 0.0}, {1e-8, distance}, {-1e-8, distance}})
    contact.move_to(indentation, x);
  CHECK(contact.dissipated() ==
        Approx(cf::spring_energy(tangential_modulus, distance, width)).epsilon(1e-9));
}

TEST_CASE("Eq (9): only springs between −u_z and u_z let go", "[paper]") {
  const double amplitude = equal.normal_amplitude;
  for (const double level : {-1.01, -0.99, -0.3, 0.0, 0.99, 1.01}) {
    const bool inside = std::abs(level) < 1;
    CHECK(cf::intermittent_contact(level * amplitude, amplitude) == inside);
    CHECK(cf::intermittent_contact(level * amplitude, -amplitude) == inside);
    CHECK((cf::released_distance(level * amplitude, equal) != 0) == inside);
    CHECK((cf::released_distance(level * amplitude, drag) != 0) == inside);
    // In a flat punch all springs touch at one depth: at the indentation −z0 it is z0 below the
    // surface.
    const IndenterLaw punch(flat_punch_profile(1e-4), material);
    const double lost =
        trajectory_damping(punch, sample(Oscillation(equal), -level * amplitude, 400))
            .work_per_cycle;
    const double stretch = cf::released_distance(level * amplitude, equal);
    CHECK(lost ==
          Approx(tangential_modulus * 1e-4 * stretch * stretch).epsilon(1e-3).margin(1e-25));
  }
}

TEST_CASE("Eq (10): the sum of all springs' energies", "[paper]") {
  const IndenterLaw law = cone();
  const double slope = pi / 2 * std::tan(cone_angle);
  for (const Oscillation& motion : {Oscillation(equal), Oscillation(drag)}) {
    const auto released = [&](double level) {
      return std::visit([&](const auto& m) { return cf::released_distance(level, m); }, motion);
    };
    const double sum =
        cf::work_per_cycle(tangential_modulus, slope, equal.normal_amplitude, released);
    // z0 = u_z cosψ removes the roots at the ends of the interval.
    const double by_hand = tangential_modulus / slope *
                           gauss(
                               [&](double psi) {
                                 const double s = released(3e-7 * std::cos(psi));
                                 return s * s * 3e-7 * std::sin(psi);
                               },
                               0, pi, 50);
    CHECK(sum == Approx(by_hand).epsilon(1e-9));
    // The foundation of springs has order 2 in (a) and at least 5/4 in (b), where s² is a root at
    // the ends.
    const double coarse = std::abs(work_of_springs(law, cone_indentation, motion, 100) / sum - 1);
    const double fine = std::abs(work_of_springs(law, cone_indentation, motion, 400) / sum - 1);
    CHECK(fine < 1e-3);
    CHECK(std::log(coarse / fine) / std::log(4.0) > (motion.index() == 0 ? 1.8 : 1.1));
  }
}

TEST_CASE("Eq (11): case (a) for the cone at any amplitude", "[paper]") {
  const double slope = pi / 2 * std::tan(cone_angle);
  const double closed = cf::work_per_cycle_by_slope(tangential_modulus, slope, equal);
  CHECK(closed ==
        Approx(cf::work_per_cycle(tangential_modulus, slope, equal.normal_amplitude,
                                  [](double level) { return cf::released_distance(level, equal); }))
            .epsilon(1e-9));
  CHECK(closed == Approx(work_of_engine(cone(), cone_indentation, equal)).epsilon(1e-9));
}

TEST_CASE("Eq (12): case (a) by F'', for the cone at any amplitude", "[paper]") {
  const IndenterLaw law = cone();
  const double closed =
      cf::work_per_cycle(modulus_ratio, law.force_curvature(cone_indentation), equal);
  CHECK(closed ==
        Approx(relaxation_damping(law, at_indentation(cone_indentation), equal).work_per_cycle)
            .epsilon(1e-9));
  CHECK(closed == Approx(work_of_engine(law, cone_indentation, equal)).epsilon(1e-9));
  EqualFrequency downwards = equal;
  downwards.normal_amplitude = -equal.normal_amplitude;
  CHECK(cf::work_per_cycle(modulus_ratio, 1e9, downwards) ==
        cf::work_per_cycle(modulus_ratio, 1e9, equal));
}

TEST_CASE("Eq (13): case (b) releases a spring by the way between touching and leaving",
          "[paper]") {
  const double level = GENERATE(-2.9e-7, -1e-7, 0.0, 2e-7);
  CHECK(cf::released_distance(level, drag) ==
        Approx(-distance_on_path(level, drag)).epsilon(1e-12));
  // With −u_z the path is that of u_z half a period later: the point touches within (0, π) and
  // separates within (π, 2π).
  Drag downwards = drag;
  downwards.normal_amplitude = -drag.normal_amplitude;
  const auto above = [&](double angle) { return height(level, angle + pi); };
  // The tolerance is the error of the bisection, 1e-16 for a phase of order 1, over the smallest
  // distance here, 0.26.
  CHECK(cf::released_distance(level, downwards) ==
        Approx(position(drag, bisect(above, pi, 2 * pi)) - position(drag, bisect(above, 0, pi)))
            .epsilon(1e-12));
}

TEST_CASE("Eq (14): case (b) for the cone at any amplitude, and its power and γ", "[paper]") {
  const double slope = pi / 2 * std::tan(cone_angle);
  const double closed = cf::work_per_cycle_by_slope(tangential_modulus, slope, drag);
  CHECK(
      closed ==
      Approx(cf::work_per_cycle(tangential_modulus, slope, drag.normal_amplitude, [](double level) {
        return cf::released_distance(level, drag);
      })).epsilon(1e-9));
  // ∫s² has a root at its ends, so the chords of the path leave a term of order 3 after that of
  // order 2.
  CHECK(closed == Approx(work_of_engine(cone(), cone_indentation, drag)).epsilon(1e-9));
  // The two lines of the paper below Eq. (15).
  const double damping = 2 * (pi * pi - 4) * tangential_modulus * drag.normal_amplitude /
                         (pi * slope * drag.angular_frequency);
  CHECK(cf::damping_constant(closed, drag) == Approx(damping).epsilon(1e-14));
  CHECK(cf::power(closed, drag) ==
        Approx(damping * drag.drag_velocity * drag.drag_velocity).epsilon(1e-14));
}

TEST_CASE("Eq (15): case (b) by F'', for the cone at any amplitude", "[paper]") {
  const IndenterLaw law = cone();
  const double closed =
      cf::work_per_cycle(modulus_ratio, law.force_curvature(cone_indentation), drag);
  CHECK(closed ==
        Approx(relaxation_damping(law, at_indentation(cone_indentation), drag).work_per_cycle)
            .epsilon(1e-9));
  CHECK(closed == Approx(work_of_engine(law, cone_indentation, drag)).epsilon(1e-9));
}

TEST_CASE("Eq (16): the rough surface is the limit of small amplitudes on the exponential law",
          "[paper]") {
  const double decay_length = 2e-7, force = 3.0;
  const ExponentialLaw law(force, decay_length, modulus_ratio);
  // The ratio of the loss by the engine to Eq. (16) is 1 − 0.42k + …: its deviation is of first
  // order in the amplitude, and two amplitudes extrapolate to 1.
  const auto ratio = [&](double k) {
    Drag motion = drag;
    motion.normal_amplitude = k * decay_length;
    return work_of_engine(law, 0, motion) /
           cf::work_per_cycle_rough(modulus_ratio, force, decay_length, motion);
  };
  const double coarse = ratio(2e-3), fine = ratio(1e-3), finest = ratio(5e-4);
  CHECK((1 - coarse) / (1 - fine) == Approx(2).epsilon(1e-3));
  // Third-order extrapolation in k: k³ is 1e-10.
  CHECK((coarse - 6 * fine + 8 * finest) / 3 == Approx(1).epsilon(1e-9));
  // F'' of the law by differences of F, in Eq. (15).
  const double step = 1e-3 * decay_length;
  const double curvature = (law.force(step) - 2 * law.force(0) + law.force(-step)) / (step * step);
  CHECK(cf::work_per_cycle_rough(modulus_ratio, force, decay_length, drag) ==
        Approx(cf::work_per_cycle(modulus_ratio, curvature, drag)).epsilon(1e-6));
}

TEST_CASE("Eq (17): shear stress of a uniform line load is Mindlin's stuck disc, and carries F_x",
          "[paper]") {
  const double edge = 1e-4, shift = 1e-8, load = tangential_modulus * shift;
  for (const double part : {0.0, 0.5, 0.99}) {
    const double r = part * edge;
    CHECK(line_load_stress([](double) { return 0.0; }, load, edge, r).value ==
          Approx(load / (pi * std::sqrt(edge * edge - r * r))).epsilon(1e-9));
  }
  // A load that falls to 0 at the edge: Hertz's pressure (2E*/πR)√(a² − r²) from q = E*(δ − x²/R).
  const double radius = 1e-2;
  for (const double part : {0.0, 0.5, 0.99}) {
    const double r = part * edge;
    const auto slope = [&](double x) { return -2 * contact_modulus * x / radius; };
    CHECK(
        line_load_stress(slope, 0, edge, r).value ==
        Approx(2 * contact_modulus / (pi * radius) * std::sqrt(edge * edge - r * r)).epsilon(1e-9));
  }
  // A paraboloid in motion: ∫2πrτ dr against the engine's F_x, while the contact grows.
  const IndenterLaw law(paraboloid_profile(radius), material);
  const double indentation = 1e-6, angle = -0.8;
  EqualFrequency motion = equal;
  motion.phase = pi / 2;
  const OscillatingStress stress(law, indentation, motion);
  const double least = stress.min_contact_radius(), most = stress.contact_radius(angle);
  // r = least ∓ (…)t⁴ removes the logarithm on both sides of the smallest radius; at the edge there
  // is a root.
  const auto inner = gauss(
      [&](double t) {
        const double r = least * (1 - std::pow(t, 4));
        return 2 * pi * r * stress.shear(angle, r) * 4 * least * std::pow(t, 3);
      },
      0, 1, 40);
  const double middle = 0.5 * (least + most);
  const auto outer = gauss(
      [&](double t) {
        const double r = least + (middle - least) * std::pow(t, 4);
        return 2 * pi * r * stress.shear(angle, r) * 4 * (middle - least) * std::pow(t, 3);
      },
      0, 1, 40);
  const auto rim = gauss(
      [&](double t) {
        const double r = most - (most - middle) * t * t;
        return 2 * pi * r * stress.shear(angle, r) * 2 * (most - middle) * t;
      },
      0, 1, 40);
  TangentialContact contact(law, indentation - motion.normal_amplitude,
                            indentation + motion.normal_amplitude);
  contact.start(indentation - motion.normal_amplitude, stress.displacement(-pi));
  const int steps = 20000;
  for (int i = 1; i <= steps; ++i) {
    const double at = -pi + (angle + pi) * i / steps;
    contact.move_to(indentation + motion.normal_amplitude * std::cos(at), stress.displacement(at));
  }
  const double force = inner + outer + rim;
  CHECK(force == Approx(stress.tangential_force(angle)).epsilon(1e-6));
  // Second order in the step: (2.3/20000)²/12.
  CHECK(contact.tangential_force() == Approx(stress.tangential_force(angle)).epsilon(1e-7));
}
