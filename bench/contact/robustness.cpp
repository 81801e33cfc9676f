// SPDX-License-Identifier: GPL-3.0-or-later
// contact_robustness — every awkward contact that we could think of, by pressure and by gap or
// indentation, in both precisions: float inner iterations to e_c <= 1e-8, double to 1e-12. Prints a
// table of them and the failures, and ends with status 1 if there are any.
//   contact_robustness [random surfaces [points [folder of measured surfaces]]]
// e_c is found again from the pressures by transforms that the solver does not use.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string>
#include <vector>

#include "../../tests/contact/normal/awkward_contacts.hpp"
#include "../../tests/contact/normal/independent_residual.hpp"
#include "../../tests/contact/normal/measured_surfaces.hpp"

namespace {

using namespace salebra;

struct Tally {
  std::string family;
  int runs = 0, failures = 0, on_multilevel = 0, iterations = 0, most = 0;
  double residual = 0, balance = 0;
};

constexpr double tolerance_of(Precision precision) {
  return precision == Precision::mixed ? 1e-8 : 1e-12;
}
const char* name_of(Precision precision) {
  return precision == Precision::mixed ? "float" : "double";
}

class Outcomes {
 public:
  // balance: how far the contact is from its target, relative; allowed: how far it may be.
  void add(const std::string& family, Precision precision, const std::string& name,
           const NormalContactState& state, double residual, double balance, double allowed) {
    Tally& tally = row(family, precision);
    ++tally.runs;
    tally.on_multilevel += state.multilevel_count > 0 ? 1 : 0;
    tally.iterations += state.iterations;
    tally.most = std::max(tally.most, state.iterations);
    tally.residual = std::max(tally.residual, residual);
    tally.balance = std::max(tally.balance, balance);
    // The other transform rounds differently: 1e-15 of the heights.
    if (state.converged() && residual < 1.1 * tolerance_of(precision) && balance < allowed) return;
    ++tally.failures;
    failures_.push_back(family + ", " + name_of(precision) + ": " + name);
    std::printf(
        "FAILED %s: converged %d, e_c %.2e (found again %.2e), off by %.2e, %d iterations\n",
        failures_.back().c_str(), state.converged(), state.residual, residual, balance,
        state.iterations);
    std::fflush(stdout);
  }

  void print() const {
    std::printf("\n%-42s %-7s %5s %8s %9s  %10s %6s  %9s  %10s\n", "contacts", "inner", "runs",
                "failures", "on multilevel kernels", "iterations", "most", "worst e_c",
                "target off");
    for (const Tally& tally : rows_)
      std::printf("%-50s %5d %8d %9d  %10.1f %6d  %9.1e  %10.1e\n", tally.family.c_str(),
                  tally.runs, tally.failures, tally.on_multilevel,
                  static_cast<double>(tally.iterations) / tally.runs, tally.most, tally.residual,
                  tally.balance);
    std::printf("%zu failures\n", failures_.size());
  }
  bool failed() const { return !failures_.empty(); }

 private:
  Tally& row(const std::string& family, Precision precision) {
    char title[64];
    std::snprintf(title, sizeof title, "%-42s %-7s", family.c_str(), name_of(precision));
    for (Tally& tally : rows_)
      if (tally.family == title) return tally;
    rows_.push_back({title});
    return rows_.back();
  }
  std::vector<Tally> rows_;
  std::vector<std::string> failures_;
};

// Presses to a pressure, then to the approach that this gives, and compares.
void press(Outcomes& table, const std::string& family, const test::AwkwardContact& contact,
           Boundary boundary = Boundary::periodic) {
  const Surface& surface = contact.surface;
  for (const Precision precision : {Precision::mixed, Precision::full}) {
    NormalContactOptions options;
    options.boundary = boundary;
    options.precision = precision;
    options.tolerance = tolerance_of(precision);
    const auto again = [&](const NormalContactState& state) {
      return test::independent_residual(state.contact_pressure, surface, 1, boundary);
    };
    const auto state = press(surface, 1, at_pressure(contact.pressure), options);
    table.add(family + ", by pressure", precision, contact.name, state, again(state),
              std::abs(state.contact_pressure.mean() / contact.pressure - 1), 1e-10);
    const double first_touch = surface.heights.maxCoeff() - surface.heights.mean();
    const bool periodic = boundary == Boundary::periodic;
    // In full contact the gap tells the pressure no more.
    if (periodic &&
        !(state.mean_gap > 1e-6 * first_touch && state.mean_gap < (1 - 1e-9) * first_touch))
      continue;
    const auto back = periodic ? press(surface, 1, at_mean_gap(state.mean_gap), options)
                               : press(surface, 1, at_indentation(state.indentation), options);
    // e_c is an energy; pressures differ by its root.
    table.add(family + (periodic ? ", by mean gap" : ", by indentation"), precision, contact.name,
              back, again(back), std::abs(back.mean_pressure / contact.pressure - 1),
              10 * std::sqrt(options.tolerance));
  }
}

// Westergaard's sinusoid, from 1e-3 of the pressure of full contact to above it.
void press_sinusoids(Outcomes& table) {
  using std::numbers::pi;
  const Index n = 1024;
  const double amplitude = 0.01, full = pi * amplitude;
  const Surface surface =
      test::surface_of({n, 1, 1, 1.0 / static_cast<double>(n)},
                       [&](double x, double) { return amplitude * std::cos(2 * pi * x); });
  for (const double load :
       {1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 0.999, 1.0, 1.001, 1.5})
    for (const Precision precision : {Precision::mixed, Precision::full}) {
      NormalContactOptions options;
      options.precision = precision;
      options.tolerance = tolerance_of(precision);
      const auto state = press(surface, 1, at_pressure(load * full), options);
      const double gap = load < 1 ? amplitude * (1 - load * (1 - std::log(load))) : 0;
      const double area = load < 1 ? 2 / pi * std::asin(std::sqrt(load)) : 1;
      const double residual = test::independent_residual(state.contact_pressure, surface, 1);
      const std::string name = std::to_string(load) + " of the pressure of full contact";
      table.add("sinusoid, mean gap by Westergaard", precision, name, state, residual,
                std::abs(state.mean_gap - gap) / amplitude,
                std::max(1e-4, 10 * std::sqrt(options.tolerance)));
      // Cells of the two edges count whole.
      table.add("sinusoid, contact area by Westergaard", precision, name, state, residual,
                std::abs(state.contact_area_fraction - area), 4.0 / static_cast<double>(n));
    }
}

}  // namespace

int main(int argc, char** argv) {
  const int surfaces = argc > 1 ? std::atoi(argv[1]) : 200;
  const Index n = argc > 2 ? std::atol(argv[2]) : 128;
  parallel::set_threads(1);
  Outcomes table;
  for (int k = 0; k < surfaces; ++k) press(table, "random surfaces", test::awkward_surface(k, n));
  for (const auto& contact : test::awkward_shapes(n)) press(table, "shapes", contact);
  press_sinusoids(table);

  const Surface point = test::surface_of({1, 1, 1, 1}, [](double, double) { return 0.5; });
  const Surface plane = test::surface_of({n, n, 1, 1}, [](double, double) { return 0.5; });
  for (const double pressure : {1e-4, 1.0, 1e4}) {
    for (const Surface* flat : {&point, &plane})
      for (const Precision precision : {Precision::mixed, Precision::full}) {
        NormalContactOptions options;
        options.precision = precision;
        options.tolerance = tolerance_of(precision);
        const auto state = press(*flat, 1, at_pressure(pressure), options);
        table.add("constant height, periodic", precision, "pressure " + std::to_string(pressure),
                  state, state.gap.abs().maxCoeff(),
                  std::abs(state.contact_pressure.mean() / pressure - 1), 1e-10);
        options.boundary = Boundary::free;
        const auto alone = press(*flat, 1, at_pressure(pressure), options);
        table.add("constant height, free", precision, "pressure " + std::to_string(pressure), alone,
                  alone.residual, std::abs(alone.contact_pressure.mean() / pressure - 1), 1e-10);
      }
  }

  if (argc > 3) {
    const auto measured = test::measured_surfaces(argv[3], 100000);
    for (const auto& why : measured.unusable) std::printf("not usable: %s\n", why.c_str());
    for (const auto& [name, surface, slope, undefined] : measured.usable) {
      std::printf("measured: %s, %ld x %ld%s\n", name.c_str(), static_cast<long>(surface.grid.nx),
                  static_cast<long>(surface.grid.ny),
                  undefined ? ", undefined points put on the mean plane" : "");
      std::fflush(stdout);
      for (const double load : {1e-3, 0.02, 0.3})
        for (const Boundary boundary : {Boundary::periodic, Boundary::free})
          press(table,
                std::string("measured, ") + (boundary == Boundary::periodic ? "periodic" : "free"),
                {name + ", pressure over E*·(rms slope) " + std::to_string(load), surface,
                 load * slope},
                boundary);
    }
  }
  table.print();
  return table.failed();
}
