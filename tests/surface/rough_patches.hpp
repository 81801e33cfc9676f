// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <salebra/base/grid.hpp>
#include <type_traits>
#include <vector>

#include "base/fft.hpp"

/// Patches of an infinite Gaussian surface with a given spectrum. They are made without the
/// library's generators, whose surfaces have no wave longer than themselves: short waves come from
/// a periodic box of twice the size, long ones from plane waves of any wave vector.
class RoughPatches {
 public:
  explicit RoughPatches(unsigned seed) : engine_(seed) {}

  std::mt19937_64& engine() { return engine_; }
  double normal() { return normal_(engine_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  /// n × n heights on a square of the given side; density(q) or density(q_x, q_y) is C. Waves beyond
  /// the Nyquist wave number are missing: for points that alias them, take every_second() of a finer
  /// patch.
  template <class Density>
  salebra::Field patch(salebra::Index n, double side, const Density& density) {
    using salebra::Index;
    const Index box = 2 * n, columns = box / 2 + 1;
    const double step = std::numbers::pi / side;  // of a mode of the box
    salebra::RealFft2D<double> transform(box, box);
    std::vector<std::complex<double>> modes(static_cast<std::size_t>(box * columns));
    for (Index i = 0; i < box; ++i)
      for (Index j = 0; j < columns; ++j) {
        const double kx = static_cast<double>(2 * i <= box ? i : i - box),
                     ky = static_cast<double>(j), k = std::hypot(kx, ky);
        auto& mode = modes[static_cast<std::size_t>(i * columns + j)];
        mode = 0;
        if (k < longest_of_box) continue;
        // Compilers evaluate function arguments in different orders.
        const double imaginary = normal(), real = normal();
        mode = std::sqrt(value_of(density, step * kx, step * ky, step * k) / 2) * step *
               std::complex<double>(real, imaginary);
      }
    for (Index i = 1; i < box / 2; ++i)
      modes[static_cast<std::size_t>((box - i) * columns)] =
          std::conj(modes[static_cast<std::size_t>(i * columns)]);
    salebra::Field heights(box, box);
    transform.backward(modes.data(), heights.data());
    salebra::Field cut = heights.topLeftCorner(n, n);
    add_long_waves(side, density, cut);
    return cut;
  }

 private:
  static constexpr double longest_of_box = 3;  ///< in modes of the box, 1.5 of the patch

  template <class Density>
  static double value_of(const Density& density, double qx, double qy, double q) {
    if constexpr (std::is_invocable_v<Density, double, double>)
      return density(qx, qy);
    else
      return density(q);
  }

  template <class Density>
  void add_long_waves(double side, const Density& density, salebra::Field& heights) {
    using salebra::Index;
    constexpr int shells = 40, directions = 12, coarse = 96, margin = 3;
    constexpr double highest = longest_of_box / 2, lowest = 1e-4;
    const Index n = heights.rows();
    const double spacing = 1.0 / coarse;
    const int points = coarse + 2 * margin + 1;
    Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(points, points);
    for (int shell = 0; shell < shells; ++shell)
      for (int direction = 0; direction < directions; ++direction) {
        const double ratio = std::log(highest / lowest) / shells;
        const double low = lowest * std::exp(ratio * shell), high = low * std::exp(ratio);
        const double kappa = std::sqrt(uniform(low * low, high * high)),
                     angle = (direction + uniform(0, 1)) / directions * std::numbers::pi;
        const double q = 2 * std::numbers::pi * kappa / side;
        // A half-plane of directions carries the power of the whole plane, because each wave has
        // ±q.
        const double area = std::numbers::pi * (high * high - low * low) / directions *
                            std::pow(2 * std::numbers::pi / side, 2);
        const double amplitude =
            std::sqrt(value_of(density, q * std::cos(angle), q * std::sin(angle), q) * area);
        const double a = amplitude * normal(), b = amplitude * normal();
        const auto wave = [&](double cycles) {
          Eigen::ArrayXcd values(points);
          for (int k = 0; k < points; ++k)
            values[k] = std::polar(1.0, 2 * std::numbers::pi * cycles * (k - margin) * spacing);
          return values;
        };
        const Eigen::ArrayXcd x = wave(kappa * std::cos(angle)), y = wave(kappa * std::sin(angle));
        for (int j = 0; j < points; ++j)
          for (int i = 0; i < points; ++i) {
            const std::complex<double> value = x[i] * y[j];
            sum(i, j) += a * value.real() + b * value.imag();
          }
      }
    // Lagrange interpolation over six points; for waves of 64 cells the error is 1e-8.
    const Eigen::MatrixXd between = [&] {
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, points);
      for (Index i = 0; i < n; ++i) {
        const double place = static_cast<double>(i) / static_cast<double>(n) / spacing + margin;
        const int first = static_cast<int>(place) - 2;
        for (int k = 0; k < 6; ++k) {
          double weight = 1;
          for (int m = 0; m < 6; ++m)
            if (m != k) weight *= (place - first - m) / (k - m);
          matrix(i, first + k) = weight;
        }
      }
      return matrix;
    }();
    const Eigen::MatrixXd rows = between * sum.matrix();
    heights += (rows * between.transpose()).array();
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// The heights as scanned by a paraboloid of this radius; cell is the distance of points.
inline salebra::Field dilated(salebra::Field heights, double cell, double radius) {
  using salebra::Index;
  const double range = heights.maxCoeff() - heights.minCoeff();
  const auto reach =
      std::min<Index>(60, static_cast<Index>(std::sqrt(2 * radius * range) / cell) + 1);
  for (int axis = 0; axis < (heights.cols() > 1 ? 2 : 1); ++axis) {
    salebra::Field out = heights;
    const Index nx = out.rows(), ny = out.cols();
    for (Index k = 1; k <= reach; ++k) {
      const double drop = std::pow(static_cast<double>(k) * cell, 2) / (2 * radius);
      if (axis == 0) {
        out.topRows(nx - k) = out.topRows(nx - k).max(heights.bottomRows(nx - k) - drop);
        out.bottomRows(nx - k) = out.bottomRows(nx - k).max(heights.topRows(nx - k) - drop);
      } else {
        out.leftCols(ny - k) = out.leftCols(ny - k).max(heights.rightCols(ny - k) - drop);
        out.rightCols(ny - k) = out.rightCols(ny - k).max(heights.leftCols(ny - k) - drop);
      }
    }
    heights = out;
  }
  return heights;
}

/// Every second point along each axis.
inline salebra::Field every_second(const salebra::Field& fine) {
  using salebra::Index;
  salebra::Field coarse(fine.rows() / 2, fine.cols() / 2);
  for (Index i = 0; i < coarse.rows(); ++i)
    for (Index j = 0; j < coarse.cols(); ++j) coarse(i, j) = fine(2 * i, 2 * j);
  return coarse;
}
