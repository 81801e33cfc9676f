// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <string>
#include <vector>

#include "rough_surface.hpp"

namespace salebra::test {

// A contact with E* = 1 of a kind on which solvers have failed.
struct AwkwardContact {
  std::string name;
  Surface surface;
  double pressure;
};

// Random surfaces: H 0.3 … 0.9, shortest wave 2 … 16 cells, pressure 1e-4 … 2 times E*·(rms slope).
inline AwkwardContact awkward_surface(int k, Index n) {
  Lcg random(static_cast<std::uint64_t>(1000 + k));
  const double hurst = 0.3 + 0.6 * random.uniform(), cutoff = std::pow(2, 1 + 3 * random.uniform());
  const double load = 1e-4 * std::pow(2e4, random.uniform());
  const Surface surface =
      rough_surface({n, n, 1, 1}, {hurst, 4, cutoff, 0.1, static_cast<std::uint64_t>(k)});
  return {"surface " + std::to_string(k) + ", H " + std::to_string(hurst) + ", cut-off " +
              std::to_string(cutoff) + ", load " + std::to_string(load),
          surface, 0.1 * load};
}

// Shapes with corners, plateaus and isolated cells, from first touch to full contact.
inline std::vector<AwkwardContact> awkward_shapes(Index n) {
  using std::numbers::pi;
  using Height = std::function<double(double, double)>;
  Lcg noise(5);
  const double cell = 1.0 / static_cast<double>(n);
  const std::vector<std::pair<std::string, Height>> shapes{
      {"sinusoids",
       [](double x, double y) { return 0.02 * std::cos(2 * pi * x) * std::cos(2 * pi * y); }},
      {"one sinusoid", [](double x, double) { return 0.02 * std::cos(2 * pi * x); }},
      {"flat punch",
       [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 0.2 ? 0.0 : -1.0; }},
      {"white noise", [&](double, double) { return 0.001 * noise.uniform(); }},
      {"paraboloid",
       [](double x, double y) { return -0.5 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)); }},
      {"cone", [](double x, double y) { return -std::hypot(x - 0.5, y - 0.5); }},
      {"checkerboard",
       [](double x, double y) {
         return 0.01 * ((static_cast<int>(8 * x) + static_cast<int>(8 * y)) & 1) +
                1e-4 * std::cos(2 * pi * x);
       }},
      {"one high cell",
       [=](double x, double y) { return x < cell / 2 && y < cell / 2 ? 1e-3 : 0.0; }},
      {"ridge", [](double x, double) { return -std::abs(x - 0.5); }},
      {"two levels", [](double x, double) { return x < 0.25 ? 0.0 : -1e-3; }},
  };
  std::vector<AwkwardContact> contacts;
  for (const auto& [name, height] : shapes) {
    const Surface surface = surface_of({n, n, 1, 1}, height);
    for (const double load : {1e-4, 1e-2, 0.1, 0.5, 1.0, 3.0, 30.0})
      contacts.push_back({name + ", pressure over E*·h_rms/side " + std::to_string(load), surface,
                          load * rms_height(surface)});
  }
  return contacts;
}

}  // namespace salebra::test
