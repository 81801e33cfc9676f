// SPDX-License-Identifier: GPL-3.0-or-later
// 17_granular_pair — collides two rough spheres as a particle program does. One law puts the sphere
// (Hertz) and its roughness (F = F0 exp(δ/l)) in series, and a pair function keeps a history, like
// the pair styles of DEM programs. The spheres meet at an angle and lose energy of both motions.
// Sample runs:  17_granular_pair        17_granular_pair 2 0.5
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/contact_element.hpp>

using namespace salebra;

namespace {

// Bodies in series carry one force, and their indentations add up.
TabulatedLaw law_of_rough_spheres(double radius, const Material& material, double first_force,
                                  double decay_length, double highest_force) {
  const double hertz = 4.0 / 3 * material.contact_modulus * std::sqrt(radius);
  ForceCurve curve{.model = "rough spheres", .nominal_area = 1, .samples = {}};
  for (double force = first_force; force < highest_force; force *= 1.2)
    curve.samples.push_back({.indentation = std::pow(force / hertz, 2.0 / 3) +
                                            decay_length * std::log(force / first_force),
                             .force = force});
  return TabulatedLaw(curve, material.modulus_ratio());
}

// The arguments of a pair style: the overlap, the relative tangential displacement of the surfaces
// since first contact, and the history of the pair. Returns the force on the first particle.
std::array<double, 3> pair_force(double overlap, const std::array<double, 2>& shear,
                                 ContactElement& history) {
  const ElementForces forces = history.move_to(overlap, shear[0], shear[1]);
  return {forces.normal_force, -forces.tangential_force[0], -forces.tangential_force[1]};
}

}  // namespace

int main(int argc, char** argv) try {
  const double normal_speed = argc > 1 ? std::atof(argv[1]) : 0.5;      // m/s
  const double tangential_speed = argc > 2 ? std::atof(argv[2]) : 0.1;  // m/s
  const double radius = 1e-3, density = 2500;  // of each sphere; the effective radius is R/2
  const double mass = 4.0 / 3 * 3.14159265358979 * std::pow(radius, 3) * density / 2;
  const TabulatedLaw law =
      law_of_rough_spheres(radius / 2, Material::of_contact_modulus(35e9, 0.2), 1e-6, 30e-9, 1e3);

  // All pairs of one kind share a table of springs; each pair that touches has its own element.
  const auto springs = std::make_shared<const LawSprings>(
      law, law.first_touch(), law.indentation_of(2.0),
      LawSpringsOptions{.friction_coefficient = 0.3, .springs = 1000});
  ContactElement history(springs);

  double overlap = history.state()[0], normal = normal_speed, shear = 0,
         tangential = tangential_speed;
  const double dt = 2e-9, out = overlap;
  double largest = 0, duration = 0;
  do {
    overlap += dt * normal, shear += dt * tangential;
    const auto force = pair_force(overlap, {shear, 0}, history);
    normal -= dt * force[0] / mass;
    // Two equal spheres that rotate: the force accelerates their surfaces 7/2 times as much as
    // their centres.
    tangential += 3.5 * dt * force[1] / mass;
    largest = std::max(largest, force[0]), duration += dt;
  } while (overlap > out && duration < 1e-3);
  std::printf("contact of %.2f us with at most %.2f N\n", 1e6 * duration, largest);
  std::printf("normal speed returned: %.4f\n", -normal / normal_speed);
  std::printf("tangential speed of the surfaces returned: %+.4f\n", -tangential / tangential_speed);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
