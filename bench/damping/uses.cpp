// SPDX-License-Identifier: GPL-3.0-or-later
// Stated errors of what joints, dampers and steady sliding of a surface give, on kinds of surfaces
// that no number was chosen with, against contacts on cells of a quarter of the size.
//   damping_uses [surfaces [points [first seed]]]
// One line per surface: kind, pressure over E*h', amplitude over rms height; each number's deviation
// over its stated error. The last lines are results/uses.csv. ν = 0: K_t = K.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/surface/moments.hpp>
#include <string>
#include <vector>

#include "damping/work_by_contacts.hpp"
#include "surface/refine.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double slope = 0.1, friction = 0.3, angular_frequency = 2 * pi * 20e3;
const Material material = Material::of_contact_modulus(1e9, 0);

constexpr std::array kinds{"spherical caps", "Gaussian bumps",   "warped waves",
                           "scratches",      "midpoint fractal", "worn fractal"};

// 0 to 1, of a number of a seed.
double chance(int seed, int which) {
  const double value = std::sqrt(7) * seed + std::sqrt(11) * which + std::sqrt(13) * seed * which;
  return value - std::floor(value);
}

// Distance on the periodic cell, in cells.
double apart(double one, double other, double period) {
  return std::remainder(one - other, period);
}

Field caps(Index points, int seed, bool bumps) {
  Field heights = Field::Constant(points, points, bumps ? 0.0 : -1e9);
  const auto size = double(points);
  for (int i = 0; i < 60; ++i) {
    const double x = size * chance(seed, 3 * i + 5), y = size * chance(seed, 3 * i + 6),
                 width = 3 + 6 * chance(seed, 3 * i + 7);
    for (Index k = 0; k < points; ++k)
      for (Index l = 0; l < points; ++l) {
        const double square =
            std::pow(apart(double(k), x, size), 2) + std::pow(apart(double(l), y, size), 2);
        if (bumps)
          heights(k, l) += width * std::exp(-square / (2 * width * width));
        else
          heights(k, l) = std::max(heights(k, l), width - square / (4 * width));
      }
  }
  return heights;
}

// Midpoints of a periodic square, displaced by chance, smoothed over neighbours.
Field fractal(Index points, int seed) {
  Field heights = Field::Zero(points, points);
  int number = 10;
  for (Index step = points / 2; step >= 2; step /= 2)
    for (Index k = 0; k < points; k += step)
      for (Index l = 0; l < points; l += step) {
        const double bump = (chance(seed, ++number) - 0.5) * std::pow(double(step), 0.7);
        for (Index i = 1 - step; i < step; ++i)
          for (Index j = 1 - step; j < step; ++j)
            heights((k + i + points) % points, (l + j + points) % points) +=
                bump * (0.5 + 0.5 * std::cos(pi * double(i) / double(step))) *
                (0.5 + 0.5 * std::cos(pi * double(j) / double(step)));
      }
  return heights;
}

Surface surface_of(std::size_t kind, int seed, Index points) {
  const Grid2D grid{points, points, 1e-6, 1e-6};
  Surface surface{grid, {}, true, {}};
  Field& h = surface.heights;
  const auto of_place = [&](const auto& height) {
    h = Field::NullaryExpr(points, points, [&](Index k, Index l) {
      return height(2 * pi * double(k) / double(points), 2 * pi * double(l) / double(points));
    });
  };
  if (kind < 2) h = caps(points, seed, kind == 1);
  if (kind == 2)
    of_place([&](double x, double y) {
      const double one = 2 * pi * chance(seed, 1), other = 2 * pi * chance(seed, 2);
      return std::sin(4 * x + 1.3 * std::sin(y + one)) *
                 std::sin(3 * y + 1.7 * std::sin(x + other)) +
             0.3 * std::sin(7 * x - 5 * y + 2 * std::sin(2 * y + one));
    });
  if (kind == 3)
    of_place([&](double x, double y) {
      double height = 0;
      for (int i = 0; i < 6; ++i) {
        const double along = std::floor(1 + 5 * chance(seed, i)),
                     across = std::floor(8 * chance(seed, i + 20)) - 4;
        height -=
            std::exp(-3 * (1 + std::sin(along * x + across * y + 2 * pi * chance(seed, 40 + i))));
      }
      return height;
    });
  if (kind >= 4) h = fractal(points, seed);
  if (kind == 5) {
    const double rms = std::sqrt((h - h.mean()).square().mean());
    h = -((-(h - h.mean()) / rms).exp() + 1).log();
  }
  const auto square_of_steps = [&](const Field& steps) {
    return (steps / grid.dx()).square().mean();
  };
  h *= slope / std::sqrt(square_of_steps(h.bottomRows(points - 1) - h.topRows(points - 1)) +
                         square_of_steps(h.rightCols(points - 1) - h.leftCols(points - 1)));
  return surface;
}

struct Cases {
  int all = 0, unknown = 0, held = 0, far = 0;
  double largest = 0;
  std::vector<double> stated;

  double add(double value, double error, double converged) {
    ++all;
    if (!std::isfinite(value)) return ++unknown, std::nan("");
    const double ratio = std::abs(value - converged) / (error + 1e-6 * std::abs(converged));
    held += ratio <= 1;
    far += ratio > 1.6;
    largest = std::max(largest, ratio);
    stated.push_back(error / std::abs(value));
    return ratio;
  }
  void print(const std::string& name) {
    if (stated.empty()) return;
    std::ranges::sort(stated);
    std::printf("| %s | %d | %d | %.0f %% | %d | %.2f | %.2g %% |\n", name.c_str(), all, unknown,
                100.0 * held / double(stated.size()), far, largest,
                100 * stated[stated.size() / 2]);
  }
};

// Numbers of the first velocity, whose others but those of the velocity are the same.
constexpr std::array names{"mean force",         "critical velocity", "static friction coefficient",
                           "low-speed damping",  "tangential force",  "friction coefficient",
                           "damping of sliding", "relaxation work",   "slip work",
                           "damping constant γ"};

}  // namespace

int main(int count, char** words) {
  const int surfaces = count > 1 ? std::atoi(words[1]) : 60;
  const Index points = count > 2 ? std::atoi(words[2]) : 64;
  const int seed = count > 3 ? std::atoi(words[3]) : 1;
  std::array<Cases, names.size()> by_number;
  std::array<Cases, kinds.size()> by_kind, joints_by_kind;
  Cases joints, all;
  for (int i = seed; i < seed + surfaces; ++i) {
    const auto kind = static_cast<std::size_t>(i) % kinds.size();
    const Surface surface = surface_of(kind, i, points), fine = refined(surface, 4);
    const double load = 2e-3 * std::pow(75, chance(i, 101)),
                 pressure = load * slope * material.contact_modulus,
                 rms = height_statistics(surface).rms_height;
    SweepOptions sweep;
    sweep.stick = true;
    sweep.contact.tolerance = 1e-8;
    const ForceCurve curve = sweep_pressures(surface, material, {pressure}, sweep);
    // No contact opens as a whole: below first touch the reference has no law.
    const double amplitude = std::min(0.01 * std::pow(30, chance(i, 102)) * rms,
                                      0.8 * curve.samples.front().indentation);
    const NormalOscillation normal{amplitude, angular_frequency};
    const double critical = friction * amplitude * angular_frequency;
    const std::vector<double> velocities{critical * std::pow(0.01, chance(i, 103))};
    const auto [found, error] =
        surface_sliding(surface, material, curve, 0, {normal, velocities, friction})[0];
    const auto [law, center] = law_by_contacts(fine, material, pressure, amplitude, 32);
    const SteadySliding converged =
        steady_sliding(*law, at_indentation(center), normal, velocities, friction)[0];
    std::printf("%zu %.4f %.4f ", kind, load, amplitude / rms);
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto [number, off] = sliding_errors[k];
      const double ratio = by_number[k].add(found.*number, error.*off, converged.*number);
      if (number != &SteadySliding::critical_velocity) {  // exact at ν = 0
        by_kind[kind].add(found.*number, error.*off, converged.*number);
        all.add(found.*number, error.*off, converged.*number);
      }
      std::printf("%.2f ", ratio);
    }

    const double force =
        friction * pressure * surface.grid.area() * 0.03 * std::pow(20, chance(i, 104));
    std::vector<double> pressures;
    for (int k = -7; k <= 5; ++k) pressures.push_back(pressure * std::pow(1.6, k));
    const TabulatedLaw through(sweep_pressures(surface, material, pressures, sweep),
                               material.modulus_ratio());
    const JointLoss joint =
        surface_joint_loss(surface, material, through, at_force(pressure * surface.grid.area()),
                           {TangentialForce{force}}, friction)[0];
    const double work = joint_work_by_contacts(fine, material, pressure, force, friction);
    joints_by_kind[kind].add(joint.work_per_cycle, joint.work_error, work);
    std::printf("joint %.2f\n", joints.add(joint.work_per_cycle, joint.work_error, work));
    std::fflush(stdout);
  }
  std::puts(
      "| of | numbers | n/a | error holds | missed by over 1.6 times | largest ratio | stated, "
      "median |\n|---|---|---|---|---|---|---|");
  joints.print("W of a joint");
  for (std::size_t i = 0; i < kinds.size(); ++i)
    joints_by_kind[i].print(std::string("W of a joint, ") + kinds[i]);
  all.print("steady sliding");
  for (std::size_t k = 0; k < names.size(); ++k) by_number[k].print(names[k]);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    by_kind[i].print(std::string("steady sliding, ") + kinds[i]);
}
