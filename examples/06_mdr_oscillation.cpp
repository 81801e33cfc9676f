// SPDX-License-Identifier: GPL-3.0-or-later
// 06_mdr_oscillation — sums the loss spring by spring, as the paper argues: an axisymmetric
// indenter on its one-dimensional foundation oscillates in both directions. The sum is compared
// with Eq. (12) and with the theorem for finite amplitudes.
// Sample runs:  06_mdr_oscillation cone        06_mdr_oscillation paraboloid        06_mdr_oscillation paraboloid 0.9
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <string>

using namespace salebra;

int main(int argc, char** argv) try {
  const std::string shape = argc > 1 ? argv[1] : "cone";
  const double relative_amplitude = argc > 2 ? std::atof(argv[2]) : 0.3;  // u_z/δ

  // 1. Make the indenter with its image g(x), Eqs (3) to (5); one body is elastic with ν = 0.3.
  const std::shared_ptr<const IndenterProfile> profile =
      shape == "cone" ? cone_profile(0.1) : paraboloid_profile(10e-3);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const IndenterLaw law(profile, material);

  // 2. The mean indentation is 1 µm, and both oscillations are in phase quadrature.
  const double indentation = 1e-6;  // m
  const EqualFrequency motion{.normal_amplitude = relative_amplitude * indentation,
                              .tangential_amplitude = 200e-9,
                              .phase = std::numbers::pi / 2};

  // 3. The springs of the foundation are Δx apart, each at its distance z0 = g(x) − δ from first
  //    touch. Eq. (9) says whether a spring loses energy, Eq. (7) gives the distance by which it is
  //    released, and Eq. (8) the energy that it loses.
  const double largest = law.contact_radius(indentation + motion.normal_amplitude);
  const int springs = 100000;  // on one side
  const double width = largest / springs;
  double by_springs = 0;
  for (int i = 0; i < springs; ++i) {
    const double depth = profile->image((i + 0.5) * width) - indentation;
    if (!closed_form::intermittent_contact(depth, motion.normal_amplitude)) continue;
    const double released = closed_form::released_distance(depth, motion);
    by_springs += 2 * closed_form::spring_energy(material.tangential_modulus, released, width);
  }

  // 4. Eq. (12) uses only F'' at the mean indentation; the theorem uses the whole law.
  const double small = closed_form::work_per_cycle(material.modulus_ratio(),
                                                   law.force_curvature(indentation), motion);
  const DampingResult exact = relaxation_damping(law, at_indentation(indentation), motion);
  if (!exact.converged) return 1;
  std::printf("%s, u_z = %.2f δ\n", shape.c_str(), relative_amplitude);
  std::printf("springs     %.6e J\n", by_springs);
  std::printf("theorem     %.6e J   springs/theorem %.5f\n", exact.work_per_cycle,
              by_springs / exact.work_per_cycle);
  std::printf("Eq. (12)    %.6e J   Eq. (12)/theorem %.5f\n", small, small / exact.work_per_cycle);

  // 5. For the cone F'' is constant, and Eq. (12) is exact at any amplitude; for the paraboloid
  //    Eq. (12) is the limit u_z → 0.
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
