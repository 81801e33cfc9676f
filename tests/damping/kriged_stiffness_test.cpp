// SPDX-License-Identifier: GPL-3.0-or-later
#include "damping/kriged_stiffness.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using salebra::Index;
using salebra::detail::KrigedStiffness;
using salebra::detail::StiffnessSample;
using salebra::detail::VarianceScales;

namespace {

using std::numbers::pi;

// 65 indentations between δ = 1 and 3.
Eigen::VectorXd places() {
  return Eigen::VectorXd::NullaryExpr(65,
                                      [](Index k) { return 2 + std::cos(pi * double(k) / 64); });
}

// W of a drag without constant factors: ∫θ[K − K(π)]dθ.
Eigen::VectorXd weights_of_loss(const KrigedStiffness& kriged) {
  constexpr int steps = 2000;
  Eigen::VectorXd weights = -pi * pi / 2 * kriged.weights_at(1);
  for (int k = 0; k < steps; ++k) {
    const double theta = pi * (k + 0.5) / steps;
    weights += theta * pi / steps * kriged.weights_at(2 + std::cos(theta));
  }
  return weights;
}

}  // namespace

TEST_CASE("A stiffness that is a parabola is kriged without an error of its form") {
  const auto stiffness = [](double x) { return 3 + 2 * x + 0.4 * x * x; };
  const auto force = [](double x) { return 3 * x + x * x + 0.4 / 3 * x * x * x; };
  std::vector<StiffnessSample> samples;
  for (int k = 0; k <= 4; ++k) {
    const double at = 2 + std::cos(pi * k / 4);
    samples.push_back({at, force(at), stiffness(at), 1000 * at, 50, 400, 1});
  }
  const KrigedStiffness kriged(samples, places());
  // The forces are those of parabolas, and K is linear between 65 places: an error of 1e-3 of its
  // curvature.
  for (const double at : {1.0, 1.3, 2.0, 2.9}) {
    CHECK(kriged.stiffness(at) == Approx(stiffness(at)).epsilon(1e-4));
    CHECK(kriged.force(at) == Approx(force(at)).epsilon(1e-4));
  }
}

TEST_CASE("The deviation of a kriged loss is that of spots and cells that enter at chance") {
  // Contact patches of an exponential law, 60 at the mean, K = ΣK_i with K_i ∝ √(δ − δᵢ). On the
  // grid the area of each is that of the lattice points in a disc at a random place. Z = (kriged −
  // true)/deviation must have the variance 1.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr double decay = 1.5, highest = 3, cells_of_area = 40;
  struct Spot {
    double touch;
    std::vector<double> enter;  // indentations at which its cells enter
  };
  constexpr int runs = 60, steps = 400;
  double squares = 0;
  int misses = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<Spot> spots;
    for (double touch = highest; touch > highest - 10 * decay;) {
      touch += decay / 60 * std::exp((2 - touch) / decay) * std::log(uniform(random));
      Spot& spot = spots.emplace_back(Spot{touch, {}});
      const double x = uniform(random), y = uniform(random);
      const double reach = std::sqrt(cells_of_area * (highest - touch) / pi);
      for (double i = -std::ceil(reach) - 1; i <= reach + 1; ++i)
        for (double j = -std::ceil(reach) - 1; j <= reach + 1; ++j)
          spot.enter.push_back(touch +
                               pi * (std::pow(i - x, 2) + std::pow(j - y, 2)) / cells_of_area);
      std::ranges::sort(spot.enter);
    }
    const auto cells_of = [](const Spot& spot, double at) {
      return double(std::ranges::upper_bound(spot.enter, at) - spot.enter.begin());
    };
    const auto on_grid = [&](double at) {
      double sum = 0;
      for (const Spot& spot : spots) sum += std::sqrt(cells_of(spot, at) / cells_of_area);
      return sum;
    };
    const auto exact = [&](double at) {
      double sum = 0;
      for (const Spot& spot : spots) sum += std::sqrt(std::max(0.0, at - spot.touch));
      return sum;
    };
    std::vector<StiffnessSample> samples;
    double force = 190;  // about K × decay
    for (int k = 0; k <= 4; ++k) {
      StiffnessSample sample;
      sample.indentation = 2 + std::cos(pi * k / 4);
      sample.stiffness = on_grid(sample.indentation);
      const double width = k > 0 ? samples.back().indentation - sample.indentation : 0;
      for (int i = 0; i < steps; ++i)
        force -= on_grid(sample.indentation + width * (i + 0.5) / steps) * width / steps;
      sample.force = force;
      for (const Spot& spot : spots) {
        const double cells = cells_of(spot, sample.indentation);
        sample.cells += cells;
        sample.spots += cells > 0;
        sample.perimeter += 2 * std::sqrt(pi * cells);
      }
      samples.push_back(sample);
    }
    const KrigedStiffness kriged(samples, places());
    VarianceScales scales;
    scales.add(kriged.log_likelihood());
    const auto [value, deviation] = kriged.estimate(weights_of_loss(kriged), scales);
    double truth = -pi * pi / 2 * exact(1);
    for (int k = 0; k < 4000; ++k) {
      const double theta = pi * (k + 0.5) / 4000;
      truth += theta * pi / 4000 * exact(2 + std::cos(theta));
    }
    const double z = (value - truth) / deviation;
    squares += z * z / runs;
    misses += std::abs(z) > 1.8;
  }
  INFO(squares << ' ' << misses);
  // The mean of 60 squares varies by 18 %. The variance of the lattice is a mean over discs of all
  // sizes, and the uncertainty of the variance scales makes the deviation larger.
  CHECK(squares < 1.5);
  CHECK(squares > 0.1);
  CHECK(misses <= 8);
}
