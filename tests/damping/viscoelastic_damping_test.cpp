// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const Material material = Material::of_contact_modulus(4e6, 0.5);
const double tau = 0.02;
const PronySeries standard_solid{1e6, {{3e6, tau}}};
const PronySeries broad{1e6, {{2e6, 2e-3}, {1e6, 0.03}, {4e6, 0.4}}};
constexpr double indentation = 4e-6;

std::vector<IndenterLaw> sphere_and_cone() {
  return {IndenterLaw(paraboloid_profile(5e-3), material),
          IndenterLaw(cone_profile(0.2), material)};
}

EqualFrequency equal_frequency(double amplitude, double omega) {
  return {.normal_amplitude = amplitude,
          .tangential_amplitude = 3e-7,
          .phase = 0.9,
          .angular_frequency = omega};
}
Drag slow_drag(double amplitude, double omega) {
  return {.normal_amplitude = amplitude, .drag_velocity = 1e-5, .angular_frequency = omega};
}

ViscoelasticDamping damping(const IndenterLaw& law, const PronySeries& prony,
                            const Oscillation& motion, int steps, int springs = 200) {
  const ViscoelasticDamping found =
      viscoelastic_damping(law, prony, sample(motion, indentation, steps), springs);
  CHECK(found.converged);
  return found;
}

}  // namespace

TEST_CASE("A flat punch loses by the complex modulus, at second order in the steps",
          "[viscoelastic]") {
  const IndenterLaw law(flat_punch_profile(1e-4), material);
  for (const PronySeries& prony : {standard_solid, broad})
    for (const double omega : {1.0, 50.0, 3000.0}) {
      CAPTURE(prony.terms.size(), omega);
      const EqualFrequency motion = equal_frequency(2e-7, omega);
      const double loss = prony.complex_modulus(omega).imag() / prony.relaxed_modulus;
      const double normal = pi * loss * law.normal_stiffness(indentation) * 4e-14;
      const double tangential = pi * loss * law.tangential_stiffness(indentation) * 9e-14;
      const auto error = [&](int steps) {
        const ViscoelasticDamping found = damping(law, prony, motion, steps);
        CHECK(found.relaxation_work == 0);
        // Both directions have the same steps.
        CHECK(found.normal_material_work / normal ==
              Approx(found.tangential_material_work / tangential).epsilon(1e-9));
        CHECK(found.mean_force == Approx(law.force(indentation)).epsilon(1e-9));
        return std::abs(found.normal_material_work / normal - 1);
      };
      const double coarse = error(64), fine = error(256);
      // A circle in 256 straight steps has (2π/256)²/6 = 1.004e-4 less area.
      CHECK(fine < 1.01e-4);
      CHECK(std::log2(coarse / fine) / 2 == Approx(2).margin(0.1));

      // Under steady shear the branches are stretched by vτ_i and lose K_t (G_i/G∞) τ_i v² per
      // second.
      double viscosity = 0;
      for (const PronyTerm& term : prony.terms)
        viscosity += term.modulus / prony.relaxed_modulus * term.relaxation_time;
      const ViscoelasticDamping dragged = damping(law, prony, slow_drag(2e-7, omega), 64);
      CHECK(dragged.damping_constant ==
            Approx(law.tangential_stiffness(indentation) * viscosity).epsilon(1e-9));
    }
}

TEST_CASE(
    "Small oscillations of a cone and a sphere lose by the complex modulus of a constant contact",
    "[viscoelastic]") {
  for (const IndenterLaw& law : sphere_and_cone()) {
    const double omega = 40;
    const double loss = broad.complex_modulus(omega).imag() / broad.relaxed_modulus;
    const auto error = [&](double amplitude) {
      const ViscoelasticDamping found =
          damping(law, broad, equal_frequency(amplitude, omega), 1024);
      return std::abs(found.normal_material_work /
                          (pi * loss * law.normal_stiffness(indentation) * amplitude * amplitude) -
                      1);
    };
    // The springs that open form a ring whose width is proportional to the amplitude.
    const double large = error(0.016 * indentation), small = error(0.004 * indentation);
    CHECK(small < 0.02);
    CHECK(std::log2(large / small) / 2 == Approx(1).margin(0.1));
  }
}

TEST_CASE("Slow oscillation is relaxation damping of the relaxed body", "[viscoelastic]") {
  for (const IndenterLaw& law : sphere_and_cone()) {
    for (const double amplitude : {0.3 * indentation, 1.5 * indentation}) {
      const auto compare = [&](const auto& motion_of) {
        const double exact =
            relaxation_damping(law, at_indentation(indentation), motion_of(1.0)).work_per_cycle;
        const auto excess = [&](double product) {
          // In case (b) only the square of v/ω enters.
          const double omega = product / tau;
          const ViscoelasticDamping found =
              damping(law, standard_solid, motion_of(omega), 512, 400);
          const double scale = exact * (motion_of(1.0).index() == 1 ? 1 / (omega * omega) : 1);
          CHECK(found.relaxation_work == Approx(scale).epsilon(20 * product + 1e-4));
          return found.tangential_material_work / scale;
        };
        // The loss in the material is of first order in ωτ.
        CHECK(std::log2(excess(4e-4) / excess(1e-4)) / 2 == Approx(1).margin(0.02));
      };
      compare([&](double omega) -> Oscillation { return equal_frequency(amplitude, omega); });
      compare([&](double omega) -> Oscillation { return slow_drag(amplitude, omega); });
    }
  }
}

TEST_CASE("Fast oscillation is relaxation damping of the unrelaxed body over a wider ring",
          "[viscoelastic]") {
  // The branches are frozen at their means. With R = G(0)/G∞ − 1, a depth above δ_0 − h in the
  // frozen shape lies R times the mean overlap lower in the relaxed one. The depths of the springs
  // that open are therefore spread by 1 + Rθ/π, with θ half the time of contact:
  //     (a) 1 + R/2,    (b) 1 + R(π² − 6)/(π² − 4)    of the elastic loss with G(0), constant F''.
  const IndenterLaw law(cone_profile(0.2), material);
  const double amplitude = 0.05 * indentation, omega = 1e5 / tau, R = 3;
  const auto elastic = [&](const Oscillation& motion) {
    return relaxation_damping(law, at_indentation(indentation), motion).work_per_cycle;
  };
  for (const auto& [motion, spread] :
       {std::pair<Oscillation, double>(equal_frequency(amplitude, omega), 1 + R / 2),
        {slow_drag(amplitude, omega), 1 + R * (pi * pi - 6) / (pi * pi - 4)}}) {
    const ViscoelasticDamping found = damping(law, standard_solid, motion, 512, 400);
    // Tolerance: 1/(ωτ), and the square of 2π/512.
    CHECK(found.relaxation_work == Approx(4 * spread * elastic(motion)).epsilon(2e-4));
    CHECK(found.min_contact_radius ==
          Approx(law.contact_radius(indentation - (1 + R) * amplitude)).epsilon(1e-4));
    // The loss in the material falls as 1/(ωτ), on the scale of K and u_z².
    CHECK(found.normal_material_work <
          1e-3 * law.normal_stiffness(indentation) * amplitude * amplitude);
  }
}

TEST_CASE("Without terms the loss is that of the elastic springs", "[viscoelastic]") {
  const IndenterLaw law(rounded_punch_profile(1e-4, 5e-3), material);
  // At the second amplitude the flat end lifts off too, and separates as a whole.
  for (const double amplitude : {0.4 * indentation, 1.2 * indentation}) {
    const SampledMotion path =
        sample(Oscillation(equal_frequency(amplitude, 50)), indentation, 400);
    const ViscoelasticDamping found = viscoelastic_damping(law, {1e6, {}}, path, 400);
    const TrajectoryDamping elastic = trajectory_damping(law, path);
    CHECK(found.converged);
    CHECK(found.relaxation_work == Approx(elastic.work_per_cycle).epsilon(2e-5));
    CHECK(found.tangential_material_work == Approx(0).margin(1e-12 * elastic.work_per_cycle));
    CHECK(found.normal_material_work == Approx(0).margin(1e-9 * elastic.work_per_cycle));
    CHECK(found.force[130] == Approx(law.force(path.indentation[130])).epsilon(1e-5));
    CHECK(found.damping_constant == Approx(elastic.damping_constant).epsilon(2e-5));
  }
}

TEST_CASE("The three losses are those of springs followed until they repeat", "[viscoelastic]") {
  // Heun's method on z_i' = (w − z_i)/τ_i in both directions; 40 periods of 2000 steps, 60 springs.
  const PronySeries prony{1e6, {{2e6, 4e-3}, {3e6, 0.03}}};
  const double ratios[]{2, 3}, times[]{4e-3, 0.03}, unrelaxed = 6;
  const double omega = 100, amplitude = 0.5 * indentation;
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const auto motion = GENERATE(Oscillation(equal_frequency(0.5 * indentation, 100)),
                               Oscillation(slow_drag(0.5 * indentation, 100)));
  const auto tangential = [&](double t) {
    if (const auto* drag = std::get_if<Drag>(&motion)) return drag->drag_velocity * t;
    const auto& equal = std::get<EqualFrequency>(motion);
    return equal.tangential_amplitude * std::cos(equal.angular_frequency * t + equal.phase);
  };
  struct Direction {
    double w = 0, z[2]{};
    double force() const {
      double sum = 6 * w;
      for (int i = 0; i < 2; ++i) sum -= (i == 0 ? 2 : 3) * z[i];
      return sum;
    }
    double energy() const {
      double sum = w * w;
      for (int i = 0; i < 2; ++i) sum += (i == 0 ? 2 : 3) * (w - z[i]) * (w - z[i]);
      return sum / 2;
    }
  };
  constexpr int springs = 60, steps = 2000, periods = 40;
  const double largest = law.contact_radius(indentation + amplitude), width = largest / springs;
  const double h = 2 * pi / omega / steps;
  double normal_work = 0, closed_work = 0, relaxation = 0, drifting = 0;
  for (int k = 0; k < springs; ++k) {
    const double spring_depth = law.profile().image((k + 0.5) * width);
    const auto overlap = [&](double t) {
      return indentation + amplitude * std::cos(omega * t) - spring_depth;
    };
    const auto rest = [&](const double* z) {
      return ratios[0] / unrelaxed * z[0] + ratios[1] / unrelaxed * z[1];
    };
    Direction normal, shear;
    bool closed = false;
    for (int n = 0; n < periods * steps; ++n) {
      const bool counts = n >= (periods - 1) * steps;
      const double t = n * h, dx = tangential(t + h) - tangential(t);
      const double normal_before = normal.force(), shear_before = shear.force();
      const double w_before = normal.w, x_before = shear.w;
      const auto step = [&](Direction& one, const auto& surface) {
        const Direction from = one;
        double rate[2];
        for (int i = 0; i < 2; ++i) {
          rate[i] = (from.w - from.z[i]) / times[i];
          one.z[i] = from.z[i] + h * rate[i];
        }
        const double then = surface(one.z);
        for (int i = 0; i < 2; ++i)
          one.z[i] = from.z[i] + h / 2 * (rate[i] + (then - one.z[i]) / times[i]);
        one.w = surface(one.z);
      };
      step(normal, [&](const double* z) { return std::max(overlap(t + h), rest(z)); });
      const bool now = overlap(t + h) > rest(normal.z);
      if (closed) {
        step(shear, [&](const double*) { return x_before + dx; });
        if (counts) closed_work += width * dx * (shear_before + shear.force()) / 2;
        if (!now) {
          if (counts) relaxation += width * shear.energy();
          shear.w = rest(shear.z);
        }
      } else {
        step(shear, rest);
        if (now && counts) relaxation -= width * shear.energy();
      }
      if (counts && (closed || now))
        normal_work += width * (normal.w - w_before) * (normal_before + normal.force()) / 2;
      closed = now;
    }
    // In a drift a spring that is always closed ends with more energy than it began with.
    if (indentation - spring_depth > 6 * amplitude && std::holds_alternative<Drag>(motion))
      drifting += 1;
  }
  CHECK(drifting == 0);  // with six times the relaxed modulus every spring opens
  const ViscoelasticDamping found = damping(law, prony, motion, 1000);
  const double stiffness = 2 * law.contact_modulus(), shear = stiffness * law.modulus_ratio();
  // 2000 steps place each touch and release up to a step late; midpoints of 60 springs.
  CHECK(found.normal_material_work == Approx(stiffness * normal_work).epsilon(3e-3));
  CHECK(found.relaxation_work == Approx(shear * relaxation).epsilon(5e-3));
  CHECK(found.tangential_material_work == Approx(shear * (closed_work - relaxation)).epsilon(5e-3));
}

TEST_CASE("The area of the loop of the normal force is what the normal motion loses",
          "[viscoelastic]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const SampledMotion path = sample(Oscillation(equal_frequency(2e-6, 30)), indentation, 2000);
  const ViscoelasticDamping found = viscoelastic_damping(law, broad, path);
  double area = 0;
  for (std::size_t i = 1; i < found.force.size(); ++i)
    area += 0.5 * (found.force[i] + found.force[i - 1]) *
            (path.indentation[i] - path.indentation[i - 1]);
  // Trapezoidal rule with 2000 steps.
  CHECK(area == Approx(found.normal_material_work).epsilon(1e-4));
  CHECK(found.force.front() == Approx(found.force.back()).epsilon(1e-9));
  CHECK(found.work_per_cycle == Approx(found.normal_material_work + found.tangential_material_work +
                                       found.relaxation_work));
  CHECK(found.power == Approx(found.work_per_cycle * 30 / (2 * pi)));
  CHECK(*std::ranges::min_element(found.force) >= 0);
}

TEST_CASE("Springs of the ring converge at second order or faster", "[viscoelastic]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const SampledMotion path = sample(Oscillation(equal_frequency(2e-6, 30)), indentation, 256);
  const auto work = [&](int springs) { return viscoelastic_damping(law, broad, path, springs); };
  const ViscoelasticDamping best = work(2048), coarse = work(32), fine = work(128);
  for (const auto member :
       {&ViscoelasticDamping::normal_material_work, &ViscoelasticDamping::tangential_material_work,
        &ViscoelasticDamping::relaxation_work}) {
    const double far = std::abs(coarse.*member / (best.*member) - 1);
    const double near = std::abs(fine.*member / (best.*member) - 1);
    CHECK(near < 2e-4);
    CHECK(std::log2(far / near) / 2 > 1.8);
  }
}

TEST_CASE(
    "Relaxation times from far below to far above the period: each part of the series is relaxed "
    "or frozen",
    "[viscoelastic]") {
  // The branch of 1e-9 s has no effect, and that of 1e8 s is frozen: the result is that of a fast
  // standard solid, (V2) of docs/theory.md, section 9.
  const IndenterLaw law(cone_profile(0.2), material);
  const EqualFrequency motion = equal_frequency(0.05 * indentation, 10);
  const ViscoelasticDamping found =
      damping(law, {1e6, {{5e6, 1e-9}, {3e6, 1e8}}}, motion, 512, 400);
  const double elastic =
      relaxation_damping(law, at_indentation(indentation), motion).work_per_cycle;
  CHECK(found.relaxation_work == Approx(4 * 2.5 * elastic).epsilon(2e-4));
}

TEST_CASE("A body that is never touched loses nothing", "[viscoelastic]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const SampledMotion path = sample(Oscillation(equal_frequency(1e-6, 30)), -2e-6, 64);
  const ViscoelasticDamping found = viscoelastic_damping(law, broad, path);
  CHECK(found.work_per_cycle == 0);
  CHECK(found.mean_force == 0);
}
