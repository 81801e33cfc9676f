// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>

using namespace salebra;

namespace {

const Material material = Material::of_contact_modulus(4e6, 0.5);

// G∞ belongs to E* = 4 MPa and ν = 1/2; the second series has a broad spectrum.
const PronySeries standard_solid{1e6, {{3e6, 0.02}}};
const PronySeries broad{1e6, {{2e6, 1e-3}, {1e6, 0.03}, {4e6, 0.4}}};

std::vector<std::shared_ptr<const IndenterProfile>> profiles() {
  return {cone_profile(0.2), paraboloid_profile(5e-3), rounded_punch_profile(1e-4, 5e-3)};
}

double relaxation(const PronySeries& prony, double time) {
  double sum = 1;
  for (const PronyTerm& term : prony.terms)
    sum += term.modulus / prony.relaxed_modulus * std::exp(-time / term.relaxation_time);
  return sum;
}

std::vector<double> sampled(const std::function<double(double)>& f,
                            const std::vector<double>& time) {
  std::vector<double> values;
  for (const double t : time) values.push_back(f(t));
  return values;
}

std::vector<double> equal_steps(double end, int steps) {
  std::vector<double> time;
  for (int i = 0; i <= steps; ++i) time.push_back(end * i / steps);
  return time;
}

// Lee and Radok: ∫_0^end E(t − s) dF_el(δ(s))/E*∞, by the midpoint rule in F_el with many steps.
double hereditary(const IndenterLaw& law, const PronySeries& prony,
                  const std::function<double(double)>& indentation, double end, double t) {
  constexpr int steps = 20000;
  double sum = 0, before = law.force(indentation(0));
  for (int i = 0; i < steps; ++i) {
    const double force = law.force(indentation(end * (i + 1) / steps));
    sum += relaxation(prony, t - end * (i + 0.5) / steps) * (force - before);
    before = force;
  }
  return sum;
}

}  // namespace

TEST_CASE("A contact that grows has the force of the correspondence principle", "[viscoelastic]") {
  const double rate = 1e-4, amplitude = 5e-7, omega = 150, end = 0.2;
  // The indenter slows down to a quarter of its mean rate but never rises.
  const auto indentation = [&](double t) { return rate * t - amplitude * std::sin(omega * t); };
  for (const auto& profile : profiles())
    for (const PronySeries& prony : {standard_solid, broad}) {
      CAPTURE(profile->flat_radius(), profile->image(1e-4), prony.terms.size());
      const IndenterLaw law(profile, material);
      const double exact = hereditary(law, prony, indentation, end, end);
      const auto error = [&](int steps) {
        const std::vector<double> time = equal_steps(end, steps);
        const ViscoelasticIndentation found =
            viscoelastic_indentation(law, prony, time, sampled(indentation, time), steps);
        CHECK(found.contact_radius.back() ==
              Approx(law.contact_radius(indentation(end))).epsilon(1e-12));
        return std::abs(found.force.back() / exact - 1);
      };
      // Straight steps and midpoints of springs are both of second order.
      const double coarse = error(120), fine = error(480);
      CHECK(fine < 2e-5);
      CHECK(std::log2(coarse / fine) / 2 == Approx(2).margin(0.15));
    }
}

TEST_CASE("One rise and fall is Ting's solution: force, contact radius and the end of contact",
          "[viscoelastic]") {
  // δ = vt up to T, v(2T − t) after it. Ting (1966): the edge at t lies where it was at the time t1
  // on its way out,
  //     ∫_{t1}^t E(t − s) δ'(s) ds = 0,    F = ∫_0^{t1} E(t − s) dF_el(δ(s))/E*∞,
  // in closed form for the standard linear solid.
  const double rate = 1e-4, turn = 0.05;
  const double ratio = standard_solid.terms[0].modulus / standard_solid.relaxed_modulus;
  const double tau = standard_solid.terms[0].relaxation_time;
  const auto indentation = [&](double t) { return rate * (t < turn ? t : 2 * turn - t); };
  const auto edge_load = [&](double t1, double t) {
    const double since = std::exp(-(t - turn) / tau);
    return (turn - t1) + ratio * tau * (since - std::exp(-(t - t1) / tau)) -
           ((t - turn) + ratio * tau * (1 - since));
  };
  const auto touched_at = [&](double t) {
    double low = 0, high = turn;
    if (edge_load(low, t) <= 0) return 0.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (edge_load(middle, t) > 0 ? low : high) = middle;
    }
    return low;
  };
  const double parting = [&] {
    double low = turn, high = 2 * turn;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (edge_load(0, middle) > 0 ? low : high) = middle;
    }
    return low;
  }();
  CHECK(parting < 1.7 * turn);  // the body lags behind: the indenter leaves it while δ > 0
  const int steps = 1000;
  const std::vector<double> time = equal_steps(2 * turn, steps);
  for (const auto& profile : profiles()) {
    const IndenterLaw law(profile, material);
    const ViscoelasticIndentation found =
        viscoelastic_indentation(law, standard_solid, time, sampled(indentation, time), 400);
    const double largest = *std::ranges::max_element(found.force);
    for (const int i : {200, 500, 520, 560, 600, 650, 700, 740}) {
      const double t = time[std::size_t(i)];
      CAPTURE(t, parting);
      const double t1 = t < turn ? t : touched_at(t);
      // 400 springs give (1/400)² of the maximum force, and the radius to a tenth of their
      // distance.
      CHECK(found.force[std::size_t(i)] ==
            Approx(hereditary(law, standard_solid, indentation, t1, t)).margin(1e-5 * largest));
      const double radius = t1 > 0 ? law.contact_radius(indentation(t1)) : 0;
      CHECK(found.contact_radius[std::size_t(i)] ==
            Approx(radius).margin(0.1 / 400 * law.contact_radius(rate * turn)));
    }
    for (int i = 0; i <= steps; ++i)
      if (time[std::size_t(i)] > parting * 1.001) CHECK(found.force[std::size_t(i)] == 0);
  }
}

TEST_CASE(
    "Repeated contact: each spring is that of a fine integration, and the half-space's "
    "inequalities hold",
    "[viscoelastic]") {
  // With several unlike rises and falls the indenter meets a surface that has not recovered. q
  // falls with x and the gap of the foundation is >= 0; hence p >= 0 within one circle and no
  // penetration outside it, by the transforms of docs/theory.md, section 9.
  const auto indentation = [](double t) {
    return 3e-6 * (0.4 + std::sin(40 * t) + 0.7 * std::sin(97 * t + 1) + 0.3 * t);
  };
  const double ratios[]{2, 1, 4}, unrelaxed = 8;
  for (const auto& profile : profiles()) {
    const IndenterLaw law(profile, material);
    int recovering = 0;
    for (const double end : {0.05, 0.11, 0.17, 0.26, 0.31}) {
      const std::vector<double> time = equal_steps(end, 4000);
      const ViscoelasticIndentation found =
          viscoelastic_indentation(law, broad, time, sampled(indentation, time), 60);
      const double at = indentation(end);
      double load_within = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < found.spring_position.size(); k += 3) {
        const double x = found.spring_position[k], load = found.spring_load[k];
        const double spring_depth = profile->image(x),
                     gap = found.spring_displacement[k] - (at - spring_depth);
        CAPTURE(end, x, spring_depth, at);
        CHECK(load <= load_within);
        load_within = load;
        CHECK(load >= 0);
        CHECK(gap >= -1e-18);
        CHECK((load == 0 || std::abs(gap) < 1e-18));
        recovering += load == 0 && found.spring_displacement[k] > 1e-9;

        // z_i' = (w − z_i)/τ_i with w = max(D, Σ κ_i z_i), by Heun's method in 40000 steps.
        double z[3]{}, w = 0;
        const auto surface = [&](const double* state, double t) {
          double sum = 0;
          for (int i = 0; i < 3; ++i) sum += ratios[i] / unrelaxed * state[i];
          return std::max(indentation(t) - spring_depth, sum);
        };
        constexpr int fine = 40000;
        const double h = end / fine;
        for (int n = 0; n < fine; ++n) {
          double trial[3], rate[3];
          const double begin = surface(z, n * h);
          for (int i = 0; i < 3; ++i) {
            rate[i] = (begin - z[i]) / broad.terms[std::size_t(i)].relaxation_time;
            trial[i] = z[i] + h * rate[i];
          }
          const double then = surface(trial, (n + 1) * h);
          for (int i = 0; i < 3; ++i)
            z[i] +=
                h / 2 * (rate[i] + (then - trial[i]) / broad.terms[std::size_t(i)].relaxation_time);
        }
        w = surface(z, end);
        double force = unrelaxed * w;
        for (int i = 0; i < 3; ++i) force -= ratios[i] * z[i];
        // 4000 straight steps of the path give 1e-5 of its height; the maximum load is E*(0) times
        // that.
        CHECK(found.spring_displacement[k] == Approx(w).margin(2e-5 * 6e-6));
        CHECK(load == Approx(2 * law.contact_modulus() * force)
                          .margin(2e-5 * 6e-6 * 2 * unrelaxed * law.contact_modulus()));
      }
    }
    CHECK(recovering > 5);
  }
}

TEST_CASE("Without terms, fast and slow: the elastic contact of the relaxed or the unrelaxed body",
          "[viscoelastic]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const std::vector<double> shape = equal_steps(1, 200);
  const auto rise_and_fall = [](double s) { return 4e-6 * std::sin(2.5 * s); };
  const auto force = [&](const PronySeries& prony, double duration) {
    std::vector<double> time = shape;
    for (double& t : time) t *= duration;
    return viscoelastic_indentation(law, prony, time, sampled(rise_and_fall, shape), 400).force;
  };
  const std::vector<double> elastic = force({1e6, {}}, 1), slow = force(standard_solid, 1e5),
                            fast = force(standard_solid, 1e-9);
  for (const std::size_t i : {20, 60, 100, 150, 190}) {
    const double exact = law.force(rise_and_fall(shape[i]));
    // Error of the midpoints of 400 springs.
    CHECK(elastic[i] == Approx(exact).epsilon(1e-5));
    // The errors are of first order in τ/duration and duration/τ: 2e-7 and 5e-8, times the ratio of
    // moduli.
    CHECK(slow[i] == Approx(elastic[i]).epsilon(1e-5));
    CHECK(fast[i] == Approx(4 * elastic[i]).epsilon(1e-6));
  }
}

TEST_CASE("A series is refused by the number of its term", "[viscoelastic]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  const std::vector<double> time{0, 1}, indentation{0, 1e-6};
  const auto press = [&](const PronySeries& prony) {
    return viscoelastic_indentation(law, prony, time, indentation);
  };
  CHECK_THROWS_WITH(
      press({1e6, {{1e6, 1}, {-2e5, 1}}}),
      "prony: -200000 Pa, the modulus of term 2 of the series must be > 0; leave the term out");
  CHECK_THROWS_WITH(
      press({1e6, {{1e6, 0}}}),
      "prony: 0 s, the relaxation time of term 1 of the series must be > 0; leave the term out");
  CHECK_THROWS_AS(press({0, {{1e6, 1}}}), InvalidInput);
  CHECK_THROWS_AS(viscoelastic_indentation(law, standard_solid, time, std::vector{0.0}),
                  InvalidInput);
  CHECK_THROWS_AS(viscoelastic_indentation(law, standard_solid, std::vector{1.0, 1.0}, indentation),
                  InvalidInput);
}

TEST_CASE("Complex modulus of a standard solid", "[viscoelastic]") {
  // G∞ + G iωτ/(1 + iωτ): at ωτ = 1 one half of G is stored and one half is lost.
  const std::complex<double> modulus = standard_solid.complex_modulus(50);
  CHECK(modulus.real() == Approx(2.5e6));
  CHECK(modulus.imag() == Approx(1.5e6));
  CHECK(standard_solid.unrelaxed_modulus() == 4e6);
}
