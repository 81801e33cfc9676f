// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/surface/moments.hpp>

#include "base/fft.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

const Material soft = Material::of_contact_modulus(1.0, 0.3);

/// With E* = R = η = A0 = σ_s = 1, F = (4/3) F_{3/2}(h), K = 2 F_{1/2}, F'' = F_{−1/2}, A_c = π F_1
/// in GW's notation.
StatisticalSummits unit_summits(SummitDistribution distribution) {
  return {
      {.summit_density = 1, .radius = 1, .summit_rms = 1, .distribution = distribution}, soft, 1};
}

double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

double normal(std::mt19937_64& random) {
  const double radius = std::sqrt(-2 * std::log(uniform(random)));
  return radius * std::cos(2 * pi * uniform(random));
}

/// Gaussian isotropic surface of unit square and unit variance, with C(q) constant for |q| <=
/// 2π·modes, hence α = 2.
Surface flat_spectrum_surface(Index points, Index modes, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  RealFft2D<double> fft(points, points);
  Field noise(points, points);
  for (double& value : noise.reshaped()) value = normal(random);
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(points * fft.modes_y()));
  fft.forward(noise.data(), spectrum.data());
  for (Index i = 0; i < points; ++i)
    for (Index j = 0; j < fft.modes_y(); ++j) {
      const Index wave = i <= points / 2 ? i : i - points;
      const Index square = wave * wave + j * j;
      if (square == 0 || square > modes * modes)
        spectrum[static_cast<std::size_t>(i * fft.modes_y() + j)] = 0;
    }
  Surface surface{{points, points, 1, 1}, Field(points, points), true, "test"};
  fft.backward(spectrum.data(), surface.heights.data());
  surface.heights /= std::sqrt(surface.heights.square().mean());
  return surface;
}

}  // namespace

TEST_CASE("Gaussian heights give the integrals F_n(h) of Greenwood and Williamson", "[gw]") {
  // Γ(n+1)/√(2π) exp(−h²/4) D_{−n−1}(h), parabolic cylinder functions to 30 digits (mpmath).
  // Columns: h, then n = −1/2, 1/2, 1, 3/2.
  const double table[][5] = {
      {-6, 0.4127955286824271, 2.44074445142828, 6.000000000156357, 14.8508644729109},
      {-2, 0.7960233788176752, 1.356640598139381, 2.00849070261683, 3.111292885687599},
      {-0.5, 1.002227386868137, 0.6466694535032851, 0.697796557401306, 0.8244484201857112},
      {0, 0.8600399873245195, 0.4110894793312293, 0.3989422804014327, 0.4300199936622598},
      {0.5, 0.6157427891848929, 0.2253355816973116, 0.197796557401306, 0.1952036037437906},
      {1, 0.3596437053976655, 0.1041536753078577, 0.0833154705876863, 0.07566817739097507},
      {2, 0.06321651643293045, 0.01248004029643907, 0.008490702616829638, 0.006648177623587093},
      {3, 0.004379037744630239, 0.0006418504393485508, 0.0003821543170477236,
       0.0002639675542694673},
      {4, 0.0001161316713130498, 1.340666992449641e-5, 7.145258432405667e-6, 4.439155958539252e-6},
      {10, 4.296982728456685e-23, 2.117479299141611e-24, 7.474560254589328e-25,
       3.101206508673169e-25},
      {30, 4.76680035048258e-197, 7.931484587180867e-199, 1.631956734091401e-199,
       3.954799087029981e-200}};
  const StatisticalSummits summits = unit_summits(SummitDistribution::gaussian);
  for (const auto& row : table) {
    // The header promises 1e-10; the quadrature aims at 1e-12, and exp(−h²/2) adds h² times the
    // round-off.
    const AsperityContact contact = summits.at(row[0]);
    CHECK(contact.force_curvature == Approx(row[1]).epsilon(2e-12));
    CHECK(contact.normal_stiffness == Approx(2 * row[2]).epsilon(2e-12));
    CHECK(contact.contact_area == Approx(pi * row[3]).epsilon(2e-12));
    CHECK(contact.force == Approx(4.0 / 3 * row[4]).epsilon(2e-12));
    CHECK(contact.contacts == Approx(std::erfc(row[0] / std::sqrt(2.0)) / 2).epsilon(1e-14));
  }
}

TEST_CASE("The curvature of Gaussian heights is a Bessel function", "[gw]") {
  // F_{−1/2}(h) = ½√(h/π) exp(−h²/4) K_{1/4}(h²/4): a route without any integral, at values of h
  // that are not in the table.
  const StatisticalSummits summits = unit_summits(SummitDistribution::gaussian);
  const double h = GENERATE(0.013, 0.7, 1.9, 5.3);
  const double exact =
      std::sqrt(h / pi) / 2 * std::exp(-h * h / 4) * std::cyl_bessel_k(0.25, h * h / 4);
  CHECK(summits.force_curvature(h) == Approx(exact).epsilon(1e-11));
}

TEST_CASE("K = −dF/ds and F'' = −dK/ds for both height densities, deep and far", "[gw]") {
  const auto distribution = GENERATE(SummitDistribution::gaussian, SummitDistribution::exponential);
  const StatisticalSummits summits = unit_summits(distribution);
  const double separation = GENERATE(-30.0, -3.0, -0.4, 0.3, 3.0);
  // Fourth-order central difference: its error is step⁴ = 1e-8 times a fifth derivative of the
  // order of F, its round-off 1e-12/step.
  const double step = 1e-2;
  auto slope = [&](auto&& f) {
    return (8 * (f(separation + step) - f(separation - step)) -
            (f(separation + 2 * step) - f(separation - 2 * step))) /
           (12 * step);
  };
  const AsperityContact contact = summits.at(separation);
  CHECK(-slope([&](double s) { return summits.force(s); }) ==
        Approx(contact.normal_stiffness).epsilon(1e-6));
  CHECK(-slope([&](double s) { return summits.normal_stiffness(s); }) ==
        Approx(contact.force_curvature).epsilon(1e-6));
}

TEST_CASE("Exponential heights carry an exactly exponential force with l = σ_s", "[gw]") {
  const SummitEnsemble ensemble{.summit_density = 3e9,
                                .radius = 2e-6,
                                .summit_rms = 1.3e-8,
                                .distribution = SummitDistribution::exponential};
  const double modulus = 115e9, area = 1e-6;
  const GreenwoodWilliamsonLaw law(ensemble, Material::of_contact_modulus(modulus, 0.3), area);
  const double sigma = ensemble.summit_rms;
  // (4/3)E*√R ηA0 Γ(5/2) σ^{3/2} e^{−s/σ}
  const double reference = modulus * std::sqrt(ensemble.radius * pi * sigma * sigma * sigma) *
                           ensemble.summit_density * area;
  for (double separation : {0.0, 0.3e-8, 5e-8, 40e-8}) {
    const double force = law.force(-separation);
    CHECK(force == Approx(reference * std::exp(-separation / sigma)).epsilon(1e-13));
    CHECK(law.normal_stiffness(-separation) == Approx(force / sigma).epsilon(1e-13));
    CHECK(law.force_curvature(-separation) == Approx(force / (sigma * sigma)).epsilon(1e-13));
    CHECK(law.tangential_curvature(-separation) ==
          Approx(law.modulus_ratio() * force / (sigma * sigma)).epsilon(1e-13));
    CHECK(law.indentation_of(force) == Approx(-separation).margin(1e-13 * sigma));
  }
}

TEST_CASE("Below the lowest exponential summit the force grows as all of them deepen", "[gw]") {
  // e^x Γ(n+1, x) with x = −s/σ (mpmath). Columns: s, then n = −1/2, 1/2, 3/2.
  const double table[][4] = {{-0.5, 0.9272709014592499, 1.170742231916172, 2.109666738467532},
                             {-3, 0.5092991042595773, 1.986700359698666, 8.176202962254631},
                             {-20, 0.2183910225940261, 4.581331466296592, 96.31471629943648}};
  const StatisticalSummits summits = unit_summits(SummitDistribution::exponential);
  for (const auto& row : table) {
    CHECK(summits.force_curvature(row[0]) == Approx(row[1]).epsilon(2e-12));
    CHECK(summits.normal_stiffness(row[0]) == Approx(2 * row[2]).epsilon(2e-12));
    CHECK(summits.force(row[0]) == Approx(4.0 / 3 * row[3]).epsilon(2e-12));
    CHECK(summits.at(row[0]).contacts == 1);
    CHECK(summits.at(row[0]).contact_area == Approx(pi * (1 - row[0])).epsilon(1e-14));
  }
}

TEST_CASE("Moments of a flat spectrum give the summits that its surfaces have", "[gw]") {
  const Index modes = 24;
  const double cutoff = 2 * pi * static_cast<double>(modes);
  // C = const below q_s: m2 = m0 q_s²/4, m4 = m0 q_s⁴/8, hence α = 2.
  const SummitEnsemble theory =
      summit_ensemble(1, std::pow(cutoff, 2) / 4, std::pow(cutoff, 4) / 8);
  CHECK(theory.summit_density ==
        Approx(cutoff * cutoff / (12 * std::sqrt(3.0) * pi)).epsilon(1e-14));
  CHECK(theory.summit_rms == Approx(std::sqrt(1 - 0.4484)).epsilon(1e-14));
  CHECK(theory.mean_height == Approx(4 / std::sqrt(2 * pi)).epsilon(1e-14));
  CHECK(theory.rms_height == 1);

  double density = 0, height = 0, square = 0, curvature = 0;
  const int surfaces = 4;
  for (int seed = 1; seed <= surfaces; ++seed) {
    const SummitList list =
        find_summits(flat_spectrum_surface(384, modes, static_cast<std::uint64_t>(seed)));
    const SummitStatistics statistics = summit_statistics(list);
    density += statistics.summit_density / surfaces;
    height += statistics.mean_height / surfaces;
    square += statistics.rms_height * statistics.rms_height / surfaces;
    curvature += 1 / statistics.mean_radius / surfaces;
  }
  // With 350 summits on each of four surfaces σ_s is known to 1/√(2·1400) = 2 %, the mean height to
  // σ_s/√1400 = 2 % of σ_s, and the density better than the Poisson value of 3 %. The test allows
  // three standard errors, and 1 % for 16 cells per wave.
  CHECK(density == Approx(theory.summit_density).epsilon(0.08));
  CHECK(height == Approx(theory.mean_height).margin(0.07 * theory.summit_rms));
  CHECK(std::sqrt(square) == Approx(theory.summit_rms).epsilon(0.07));
  CHECK(1 / curvature == Approx(theory.radius).epsilon(0.05));
}

TEST_CASE("Counted summits stand over the mean plane that is given", "[gw]") {
  const SummitStatistics counted{
      .summit_density = 3, .mean_height = 5.5, .rms_height = 0.25, .mean_radius = 2};
  const SummitEnsemble ensemble = summit_ensemble(counted, 5);
  CHECK(ensemble.mean_height == 0.5);
  CHECK(ensemble.summit_density == 3);
  CHECK(ensemble.radius == 2);
  CHECK(ensemble.summit_rms == 0.25);
}

TEST_CASE("Given summits drawn from a density agree with the integral over it", "[gw]") {
  const double separation = GENERATE(-0.5, 0.5, 1.5);
  std::mt19937_64 random(11);
  const int count = 20000;
  const double radius = 2, mean = 7;
  std::vector<Summit> summits;
  for (int i = 0; i < count; ++i)
    summits.push_back(
        {.height = mean + normal(random), .curvature1 = 1.2 / radius, .curvature2 = 0.8 / radius});
  const DeterministicSummits given(summits, soft, 1, mean - 3);
  const StatisticalSummits drawn(
      {.summit_density = count, .radius = radius, .summit_rms = 1, .mean_height = 3}, soft, 1);
  const AsperityContact sum = given.at(separation), expected = drawn.at(separation);
  // A sum of `count` equal variables f(z) has at most the variance count·⟨f²⟩. ⟨f²⟩ of force and
  // stiffness are the polynomial moments ∫(z−s)³φ and ∫(z−s)φ. The test allows four standard
  // errors; the mean of the drawn heights moves s by 1/√count in addition.
  const double s = separation, tail = std::erfc(s / std::sqrt(2.0)) / 2,
               density = std::exp(-s * s / 2) / std::sqrt(2 * pi);
  const double first = density - s * tail,
               third = density * (s * s + 2) - tail * (s * s * s + 3 * s);
  const double shift = 1 / std::sqrt(count);
  CHECK(sum.contacts == Approx(expected.contacts).margin(4 * std::sqrt(count * tail)));
  CHECK(sum.force == Approx(expected.force)
                         .margin(4 * std::sqrt(count * 16.0 / 9 * radius * third) +
                                 4 * shift * expected.normal_stiffness));
  CHECK(sum.normal_stiffness == Approx(expected.normal_stiffness)
                                    .margin(4 * std::sqrt(count * 4 * radius * first) +
                                            4 * shift * expected.force_curvature));
  CHECK(given.mean_gap(s) == Approx(drawn.mean_gap(s)).margin(4 * shift));
}

TEST_CASE("One summit is Hertz's contact, counted from first touch", "[gw]") {
  const double modulus = 2e9, radius = 3e-6;
  const Summit summit{.height = 5e-7, .curvature1 = 1 / radius, .curvature2 = 1 / radius};
  const auto model = std::make_shared<DeterministicSummits>(
      std::vector{summit}, Material::of_contact_modulus(modulus, 0.3), 1e-10, 1e-7);
  const GreenwoodWilliamsonLaw law(model);
  const PowerLaw hertz(4.0 / 3 * modulus * std::sqrt(radius), 1.5, law.modulus_ratio());
  for (double indentation : {1e-9, 1e-8}) {
    CHECK(law.force(indentation) == Approx(hertz.force(indentation)).epsilon(1e-13));
    CHECK(law.normal_stiffness(indentation) ==
          Approx(hertz.normal_stiffness(indentation)).epsilon(1e-13));
    CHECK(law.force_curvature(indentation) ==
          Approx(hertz.force_curvature(indentation)).epsilon(1e-13));
    CHECK(law.indentation_of(law.force(indentation)) == Approx(indentation).epsilon(1e-13));
    CHECK(model->at(-indentation).contact_area == Approx(pi * radius * indentation).epsilon(1e-13));
  }
  CHECK(law.force(-1e-9) == 0);
  CHECK(law.break_points() == std::vector{0.0});
  CHECK(model->mean_gap(0) == Approx(4e-7).epsilon(1e-13));
}

TEST_CASE("Curves at given pressures have those pressures, in ascending order", "[gw]") {
  const SummitEnsemble ensemble = summit_ensemble(1e-14, 1e-2, 1e12);
  const Material material = Material::of_contact_modulus(1e9, 0.25);
  const StatisticalSummits summits(ensemble, material, 4e-8);
  // The planes range from the far tail of the heights to below all summits.
  const ForceCurve curve = curve_at_pressures(summits, {1e9, 1e6, 1e-60});
  REQUIRE(curve.samples.size() == 3);
  CHECK(curve.rms_height == Approx(1e-7));
  double pressure = 1e-60;
  for (const ForceSample& sample : curve.samples) {
    // s is found to round-off; the slope of ln F over ln s is at most 37·37.
    CHECK(sample.pressure == Approx(pressure).epsilon(1e-12));
    CHECK(sample.force == Approx(sample.pressure * 4e-8).epsilon(1e-15));
    CHECK(sample.mean_gap == Approx(sample.separation + ensemble.mean_height).epsilon(1e-15));
    CHECK(sample.indentation == -sample.separation);
    CHECK(sample.tangential_stiffness ==
          Approx(material.modulus_ratio() * sample.normal_stiffness).epsilon(1e-15));
    pressure = pressure < 1 ? 1e6 : 1e9;
  }
  const ForceCurve normal_only = curve_at_separations(
      StatisticalSummits(ensemble, Material::of_contact_modulus(1e9), 4e-8), {1e-7, 2e-7});
  CHECK(normal_only.samples[0].separation == 2e-7);
  CHECK(std::isnan(normal_only.samples[0].tangential_stiffness));
}

TEST_CASE("A table of a GW curve is the GW law", "[gw]") {
  const SummitEnsemble ensemble{.summit_density = 1, .radius = 1, .summit_rms = 1};
  const GreenwoodWilliamsonLaw exact(ensemble, soft, 1);
  std::vector<double> separations;
  for (int i = 0; i <= 40; ++i) separations.push_back(0.1 * i);
  const TabulatedLaw table(curve_at_separations(exact.model(), separations), exact.modulus_ratio());
  // The interpolant is cubic in ln F with exact slopes: its error is h⁴/384 times the fourth
  // derivative of ln F, which is below 1/2.
  for (double indentation : {-3.456, -2.1, -0.77})
    CHECK(table.force(indentation) == Approx(exact.force(indentation)).epsilon(2e-7));
}

TEST_CASE("A tabulated density is integrated exactly", "[gw]") {
  // A triangle from −1 over 0 to 2 (m), given three times too high: φ(0) = 2/3 after normalisation.
  SummitEnsemble ensemble{.summit_density = 1,
                          .radius = 1,
                          .distribution = SummitDistribution::tabulated,
                          .table = {{-1, 0}, {0, 2}, {2, 0}}};
  const StatisticalSummits triangle(ensemble, soft, 1);
  // Above the peak φ = (2−z)/3, so that ∫(z−s)^n φ = (2−s)^{n+2}/(3(n+1)(n+2)).
  const double s = 0.6, reach = 2 - s;
  const AsperityContact contact = triangle.at(s);
  CHECK(contact.contacts == Approx(reach * reach / 6).epsilon(1e-14));
  CHECK(contact.contact_area == Approx(pi * std::pow(reach, 3) / 18).epsilon(1e-14));
  CHECK(contact.force == Approx(4.0 / 3 * std::pow(reach, 3.5) / (3 * 2.5 * 3.5)).epsilon(1e-14));
  CHECK(contact.normal_stiffness ==
        Approx(2 * std::pow(reach, 2.5) / (3 * 1.5 * 2.5)).epsilon(1e-14));
  CHECK(contact.force_curvature == Approx(std::pow(reach, 1.5) / (3 * 0.5 * 1.5)).epsilon(1e-14));
  CHECK(triangle.at(-1.5).contacts == Approx(1).epsilon(1e-14));
  CHECK(triangle.force(2) == 0);
  CHECK(triangle.force(triangle.separation_of(1e-3)) == Approx(1e-3).epsilon(1e-12));

  // A Gaussian sampled every σ/50 is interpolated with a mean error of φ''/50²/12, which is
  // F''/50²/12 for F: 2.4e-4 F at s = 2.
  ensemble.table.clear();
  for (int i = -400; i <= 400; ++i) ensemble.table.push_back({0.02 * i, std::exp(-0.0002 * i * i)});
  const StatisticalSummits table(ensemble, soft, 1);
  const StatisticalSummits gaussian = unit_summits(SummitDistribution::gaussian);
  for (double separation : {-1.0, 0.3, 2.0})
    CHECK(table.force(separation) == Approx(gaussian.force(separation)).epsilon(3e-4));

  ensemble.table = {{0, 1}};
  CHECK_THROWS_WITH(StatisticalSummits(ensemble, soft, 1), Catch::Contains("table"));
  ensemble.table = {{0, 1}, {0, 1}};
  CHECK_THROWS_WITH(StatisticalSummits(ensemble, soft, 1), Catch::Contains("table.height"));
  ensemble.table = {{0, 1}, {1, -1}};
  CHECK_THROWS_WITH(StatisticalSummits(ensemble, soft, 1), Catch::Contains("table.density"));
}

TEST_CASE("An elliptical summit is Hertz's ellipse", "[gw]") {
  // For axes b/a = 0.9, 0.5, 0.1: κ2/κ1, then κ1 times the radii of spheres with the same force and
  // with the same area, from the potential integrals of the ellipsoidal pressure by quadrature
  // (mpmath).
  const double table[][3] = {{1, 1, 1},
                             {0.85379937586943844, 1.083363009906183, 1.081861206408608},
                             {0.35177164228418607, 1.763326782966357, 1.661759926413666},
                             {0.027370194883873699, 9.668646646767473, 5.35185863015945}};
  for (const auto& row : table) {
    const double curvature = 3e5;
    const Summit summit{.curvature1 = curvature, .curvature2 = row[0] * curvature};
    const DeterministicSummits ellipse({summit}, soft, 1, 0, 1, SummitShape::elliptical);
    const DeterministicSummits sphere(
        {{.curvature1 = curvature / row[1], .curvature2 = curvature / row[1]}}, soft, 1);
    const double separation = -1e-9;
    const AsperityContact contact = ellipse.at(separation), same = sphere.at(separation);
    CHECK(contact.force == Approx(same.force).epsilon(1e-13));
    CHECK(contact.normal_stiffness == Approx(same.normal_stiffness).epsilon(1e-13));
    CHECK(contact.force_curvature == Approx(same.force_curvature).epsilon(1e-13));
    CHECK(contact.contact_area == Approx(pi * row[2] / curvature * 1e-9).epsilon(1e-13));
  }
  // A ridge has the force of a summit that is a thousand times as long as wide.
  auto force = [](double ratio) {
    return DeterministicSummits({{.curvature1 = 1, .curvature2 = ratio}}, soft, 1, 0, 1,
                                SummitShape::elliptical)
        .force(-1);
  };
  CHECK(force(0) == force(1e-3));
  CHECK(force(1e-3) > force(2e-3));
}

TEST_CASE("Mildly elliptical summits carry what spheres of their mean curvature carry", "[gw]") {
  // The first correction is of second order in (κ1−κ2)/(κ1+κ2): here 0.2² times a number below 1/2.
  const Summit summit{.curvature1 = 1.2, .curvature2 = 0.8};
  const DeterministicSummits circular({summit}, soft, 1);
  const DeterministicSummits elliptical({summit}, soft, 1, 0, 1, SummitShape::elliptical);
  CHECK(elliptical.force(-0.1) == Approx(circular.force(-0.1)).epsilon(0.02));
  CHECK(elliptical.force(-0.1) != circular.force(-0.1));
}

TEST_CASE("Summits that cannot be pressed are refused", "[gw]") {
  const SummitEnsemble good{.summit_density = 1, .radius = 1, .summit_rms = 1};
  CHECK_THROWS_WITH(StatisticalSummits(good, soft, 0), Catch::Contains("nominal_area"));
  SummitEnsemble bad = good;
  bad.radius = -1;
  CHECK_THROWS_WITH(StatisticalSummits(bad, soft, 1), Catch::Contains("radius"));
  bad = good;
  bad.summit_rms = std::nan("");
  CHECK_THROWS_WITH(StatisticalSummits(bad, soft, 1), Catch::Contains("summit_rms"));
  CHECK_THROWS_WITH(summit_ensemble(1, 2, 1), Catch::Contains("nayak"));
  CHECK_THROWS_AS(DeterministicSummits({}, soft, 1), InvalidInput);
  const StatisticalSummits summits(good, soft, 1);
  CHECK_THROWS_WITH(curve_at_pressures(summits, {1, -1}), Catch::Contains("pressures: -1"));
  CHECK_THROWS_AS(summits.separation_of(0), InvalidInput);
  CHECK_THROWS_WITH(GreenwoodWilliamsonLaw(good, Material::of_contact_modulus(1), 1),
                    Catch::Contains("tangential_modulus"));
}
