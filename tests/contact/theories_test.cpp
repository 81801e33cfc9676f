// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/theories.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

/// Self-affine with a plateau, H = 0.8, q from 1 to 64, roll-off at 4 = 64^{1/3}, so that the
/// plateau is a third of the range of ln q.
double self_affine(double q) { return 0.01 * (q < 4 ? 1 : std::pow(q / 4, -3.6)); }

PerssonTheory theory_of(int shells, double energy_factor = 0.45) {
  return {roughness_shells(self_affine, 1, 64, shells), 1.0, energy_factor};
}

}  // namespace

TEST_CASE("Area theories: Persson's slope √(8/π) is 2/π of BGT's, and ends in full contact",
          "[theories]") {
  const double modulus = 3e9, slope = 0.1, small = 1e-6 * modulus * slope;
  CHECK(bgt_area_fraction(small, modulus, slope) == Approx(2.50662827e-6).epsilon(1e-8));
  // erf deviates from a straight line by x²/3 = 1e-12 at this pressure.
  CHECK(persson_area_fraction(small, modulus, slope) == Approx(1.59576912e-6).epsilon(1e-8));
  CHECK(persson_area_fraction(10 * modulus * slope, modulus, slope) == 1);
  CHECK(bearing_area_fraction(0, 2e-7) == 0.5);
  CHECK(bearing_area_fraction(2e-7, 2e-7) == Approx(0.158655253931457).epsilon(1e-14));
  CHECK_THROWS_AS(bgt_area_fraction(1, 1, 0), InvalidInput);
  CHECK_THROWS_AS(persson_area_fraction(-1, 1, 1), InvalidInput);
  CHECK_THROWS_AS(bearing_area_fraction(1, std::nan("")), InvalidInput);
}

TEST_CASE("Persson's mean gap is his double integral, at second order in the shells",
          "[theories]") {
  // ū from √π∫q²C w ∫_p^∞ … dp'/p' dq by nested quadrature in q and p' (mpmath), E* = 1, γ = 0.45.
  // Columns: p, ū.
  const double table[][2] = {{0.01, 3.04540756112}, {0.3, 1.14543817718}, {2, 0.22131270724}};
  for (const auto& row : table) {
    const double coarse = theory_of(300).mean_gap(row[0]) / row[1] - 1;
    const double fine = theory_of(1200).mean_gap(row[0]) / row[1] - 1;
    CHECK(std::abs(fine) < 2e-5);
    CHECK(std::log(coarse / fine) / std::log(4.0) == Approx(2).margin(0.2));
  }
}

TEST_CASE("Persson's gap, integrated over pressure, is the energy of complete contact",
          "[theories]") {
  // ∫ū dp = U/A0 = (E*/4)∫q C d²q for any γ.
  const double energy_factor = GENERATE(0.3, 0.45, 1.0);
  const auto shells = roughness_shells(self_affine, 1, 64, 60);
  double energy = 0;
  for (const RoughnessShell& shell : shells) energy += shell.wavenumber * shell.power / 4;
  const PerssonTheory theory(shells, 1.0, energy_factor);
  // The trapezoidal rule in ln p is spectrally accurate: the integrand p ū is smooth and vanishes
  // on both sides; at p = e^−30 the rest below is about 30 e^−30.
  double integral = 0;
  const double step = 0.1;
  for (double log_pressure = -30; log_pressure < 5; log_pressure += step)
    integral += std::exp(log_pressure) * theory.mean_gap(std::exp(log_pressure)) * step;
  CHECK(integral == Approx(energy).epsilon(1e-10));
}

TEST_CASE("Persson's stiffness is −dp/dū", "[theories]") {
  const PerssonTheory theory = theory_of(90);
  const double pressure = GENERATE(1e-4, 0.1, 1.0, 4.0);
  // Central difference in ln p: error 1e-8 of the third derivative, round-off 1e-12/1e-4.
  const double step = 1e-4;
  const double compliance =
      (theory.mean_gap(pressure * std::exp(-step)) - theory.mean_gap(pressure * std::exp(step))) /
      (2 * step * pressure);
  CHECK(1 / theory.stiffness_per_area(pressure) == Approx(compliance).epsilon(1e-6));
}

TEST_CASE("At small pressure Persson's law is exponential with K/A0 = p/u0", "[theories]") {
  const PerssonTheory theory = theory_of(300);
  const PerssonTheory::Asymptote limit = theory.asymptote();
  const double pressure = 1e-7;
  // All corrections are of relative order (w p/E*)², or w p/E* for the lowest shell alone.
  CHECK(theory.mean_gap(pressure) ==
        Approx(limit.decay_length * std::log(limit.factor / pressure)).epsilon(1e-6));
  CHECK(theory.stiffness_per_area(pressure) == Approx(pressure / limit.decay_length).epsilon(1e-5));
  // Campañá, Persson and Müser give 0.4 to 0.5 of the rms height.
  CHECK(limit.decay_length > 0.35 * theory.rms_height());
  CHECK(limit.decay_length < 0.55 * theory.rms_height());
}

TEST_CASE("Persson's pressure inverts his mean gap", "[theories]") {
  const PerssonTheory theory = theory_of(90);
  for (double gap : {1e-5, 0.01, 0.5, 2.0, 6.0, 30.0})
    CHECK(theory.mean_gap(theory.pressure(gap)) == Approx(gap).epsilon(1e-11));
}

TEST_CASE("Shells carry the rms height and slope of the spectrum", "[theories]") {
  const PerssonTheory theory = theory_of(3000);
  // √(2π∫qC dq), √(2π∫q³C dq) by quadrature (mpmath); the midpoint rule in ln q has the error (ln
  // 64/3000)²·(2…4)²/24 = 1e-6.
  CHECK(theory.rms_height() == Approx(1.04504410072452).epsilon(2e-6));
  CHECK(theory.rms_slope() == Approx(9.25712179040424).epsilon(2e-6));
  CHECK(theory.contact_area_fraction(1) == persson_area_fraction(1, 1, theory.rms_slope()));
  const Material material = Material::of_contact_modulus(1.0, 0.3);
  const ForceCurve curve = persson_curve(theory, material, 2, {0.3, 0.1});
  REQUIRE(curve.samples.size() == 2);
  CHECK(curve.samples[0].pressure == 0.1);
  CHECK(curve.samples[0].force == 0.2);
  CHECK(curve.samples[0].mean_gap > curve.samples[1].mean_gap);
  CHECK(curve.samples[1].mean_gap == theory.mean_gap(0.3));
  CHECK(curve.samples[1].contact_area_fraction == theory.contact_area_fraction(0.3));
  CHECK(curve.samples[1].normal_stiffness == 2 * theory.stiffness_per_area(0.3));
  CHECK(curve.samples[1].tangential_stiffness ==
        material.modulus_ratio() * curve.samples[1].normal_stiffness);
}

TEST_CASE("Theories refuse spectra without roughness", "[theories]") {
  CHECK_THROWS_AS(PerssonTheory({}, 1), InvalidInput);
  CHECK_THROWS_AS(PerssonTheory({{1, 0}}, 1), InvalidInput);
  CHECK_THROWS_WITH(PerssonTheory({{1, -1}}, 1), Catch::Contains("shells.power"));
  CHECK_THROWS_WITH(PerssonTheory({{1, 1}}, 1, 1.5), Catch::Contains("energy_factor"));
  CHECK_THROWS_AS(roughness_shells(self_affine, 4, 4), InvalidInput);
  CHECK_THROWS_AS(theory_of(10).pressure(0), InvalidInput);
}
