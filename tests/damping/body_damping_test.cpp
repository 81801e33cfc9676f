// SPDX-License-Identifier: GPL-3.0-or-later
// Losses on bodies that are no half-spaces: by contacts inside the oscillation, by quadrature and by
// direct simulation.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/damping/surface_damping.hpp>

#include "../contact/normal/rough_surface.hpp"
#include "damping/surface_contacts.hpp"

using namespace salebra;
using namespace salebra::test;
using salebra::detail::SurfaceContacts;

namespace {

constexpr double pi = std::numbers::pi, side = 1e-3, slope = 0.1;

/// Bodies whose compliance at waves of an eighth of the side is of the order of 1/GPa.
Body body_of(int number) {
  switch (number) {
    case 0:  // a rubbery film on steel
      return Body::layered({{0.02 * side, 1e9, 0.45}}, {210e9, 0.3});
    case 1:  // the same on a rigid base, from which the motion is measured
      return Body::layered({{0.05 * side, 1e9, 0.4}}).measured_from(Datum::base);
    case 2:  // a hard coating
      return Body::layered({{0.02 * side, 10e9, 0.2}}, {1e9, 0.3});
    case 3:
      return Body::graded({.modulus = 1e9, .depth = 0.1 * side, .exponent = 0.4, .poisson = 0.3});
    case 4:  // a cubic crystal, askew
      return Body::anisotropic(
          AnisotropicStiffness::cubic(3e9, 2.4e9, 1.6e9).of_surface({1, 1, 0}, {1, -1, 2}));
    default:
      return Body::transversely_isotropic(
          {.c11 = 3e9, .c33 = 1.5e9, .c13 = 0.8e9, .c44 = 0.4e9, .c66 = 1e9});
  }
}

/// The pressure under which about a twelfth of the cells are in contact.
double pressure_of(const Surface& surface, const Body& body) {
  double pressure = 1e6;
  for (int k = 0; k < 20; ++k) {
    const double area = press(surface, body, at_pressure(pressure)).contact_area_fraction;
    pressure *= std::clamp(0.08 / area, 0.5, 2.0);
  }
  return pressure;
}

}  // namespace

TEST_CASE("A material has the losses of its half-space as a body", "[body]") {
  const Surface surface = rough_surface({48, 48, side, side});
  const ElasticBody elastic{2e9, 0.3};
  const Material material = Material::of_bodies(elastic);
  const Body body = Body::half_space(elastic);
  const ForceCurve curve = sweep_pressures(surface, material, {2e6, 4e6}, {.stick = true});
  const Drag motion{3e-7, 1e-6, 1e5};
  const auto one = surface_damping(surface, material, motion, curve);
  const auto other = surface_damping(surface, body, motion, curve);
  for (std::size_t k = 0; k < 2; ++k) {
    REQUIRE(one[k].converged);
    CHECK(one[k].work_per_cycle == other[k].work_per_cycle);
    CHECK(one[k].leaving_share == 0);
  }
  // The constants of both are the same; only those of the body know the coupling.
  for (const double q : {1e3, 1e6}) {
    const SurfaceCompliance a = Body(material).compliance(q), b = body.compliance(q);
    CHECK(a.normal == Approx(b.normal).epsilon(1e-13));
    CHECK(a.in_plane == Approx(b.in_plane).epsilon(1e-13));
    CHECK(a.across == Approx(b.across).epsilon(1e-13));
    CHECK(std::isnan(a.coupling));
  }
  CHECK_FALSE(Body(Material::of_contact_modulus(1e9)).has_tangential_response());
}

TEST_CASE("The loss on a body by contacts, by quadrature and by simulation", "[body]") {
  const int number = GENERATE(0, 1, 2, 3, 4, 5);
  const Body body = body_of(number);
  const Surface surface = rough_surface({48, 48, side, side}, {.seed = 2});
  const double pressure = pressure_of(surface, body);
  const ForceCurve curve =
      sweep_pressures(surface, body, {0.8 * pressure, pressure, 1.2 * pressure}, {.stick = true});
  const ForceSample& load = curve.samples[1];
  REQUIRE(load.converged);
  // An amplitude of a third of F/K keeps the contact closed.
  const double amplitude = 0.3 * load.force / load.normal_stiffness;
  const EqualFrequency motion{amplitude, 1e-7, pi / 2, 1e5};
  const SurfaceDamping loss =
      surface_damping(surface, body, motion, curve, {.keep_cells = true})[1];
  CAPTURE(number, pressure, loss.leaving_share);
  REQUIRE(loss.converged);
  CHECK(loss.leaving_share < 0.01);

  const ContactSets contacts = boundary_element_contact_sets(surface, body);
  const double center = press(surface, body, at_pressure(pressure)).indentation;
  const IntervalQuadratureResult quadrature =
      interval_quadrature(contacts, surface.grid, body, motion, center, {.intervals = 32});
  REQUIRE(quadrature.converged());
  CHECK(std::isnan(quadrature.small_amplitude_work));
  const CycleResult cycle =
      simulate_cycle(contacts, surface.grid, body, trajectory_of(motion, center), {.steps = 128});
  CAPTURE(loss.work_per_cycle, loss.work_per_cycle_error(), quadrature.work_per_cycle,
          cycle.work_per_cycle, cycle.step_error);
  // The theorem against direct stepping, which does not assume that contact sets are nested.
  CHECK(std::abs(cycle.work_per_cycle - quadrature.work_per_cycle) <
        cycle.step_error + 0.03 * quadrature.work_per_cycle);
  CHECK(std::abs(loss.work_per_cycle - quadrature.work_per_cycle) <
        loss.work_per_cycle_error() + 0.03 * quadrature.work_per_cycle);
}

TEST_CASE("Cells that leave under a thin stiff coating are counted", "[body]") {
  // A stiff plate on a soft base tilts away from its load, so that cells beside it may leave.
  const Body coated = Body::layered({{0.02 * side, 300e9, 0.2}}, {1e9, 0.3});
  const Surface surface = rough_surface({64, 64, side, side}, {.seed = 2});
  const auto count = [&](const Body& body) {
    SurfaceContacts contacts(surface, body, {});
    const double deepest = contacts.indentation_at(pressure_of(surface, body));
    for (int k = 1; k < 64; ++k) contacts.at(deepest * k / 64);
    REQUIRE(contacts.usable());
    return contacts.leaving_share();
  };
  const double share = count(coated);
  CHECK(share > 0);
  CHECK(share < 0.1);
  CHECK(count(Material::of_contact_modulus(1e9)) == 0);
}

TEST_CASE("A thin soft layer on a rigid base loses like its springs", "[body]") {
  // A compressible layer much thinner than the patches is a foundation of springs: K and K_t are
  // proportional to the contact area with the stiffnesses per area 2µ(1−ν)/(t(1−2ν)) and µ/t. Then W
  // = ½∮ s² dK_t = (µ/t)·½∮ s² dA.
  const double t = 2e-4 * side, young = 1e6, poisson = 0.2;
  const Body film = Body::layered({{t, young, poisson}}).measured_from(Datum::base);
  const double shear = ElasticBody{young, poisson}.shear();
  const Surface surface = rough_surface({96, 96, side, side}, {.rolloff = 3, .cutoff = 16});
  const NormalContactState state = press(surface, film, at_pressure(2e6));
  const double area = state.contact_area_fraction * surface.grid.area();
  REQUIRE(state.contact_area_fraction > 0.05);
  // The edges of the patches carry more than their area by a few per cent.
  CHECK(normal_stiffness(state, surface.grid, film) ==
        Approx(2 * shear * (1 - poisson) / (t * (1 - 2 * poisson)) * area).epsilon(0.05));
  CHECK(stick_stiffness(contact_set(state), surface.grid, film).xx ==
        Approx(shear / t * area).epsilon(0.05));
}
