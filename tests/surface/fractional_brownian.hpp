// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <salebra/base/grid.hpp>
#include <vector>

#include "base/fft.hpp"

/// Fractional Brownian profiles and surfaces by exact circulant embedding, independent of the
/// library's generators. They are not periodic, have no longest wave, and alias all waves shorter
/// than two cells.
class FractionalBrownian {
 public:
  explicit FractionalBrownian(unsigned seed) : engine_(seed) {}

  /// A profile of `points` points by Davies and Harte (1987); its increments have variance 1.
  salebra::Field profile(salebra::Index points, double hurst) {
    using salebra::Index;
    const Index n = 2 * points;
    const auto covariance = [&](Index lag) {
      const auto power = [&](double k) { return std::pow(std::abs(k), 2 * hurst); };
      const double k = double(std::min(lag, n - lag));
      return 0.5 * (power(k + 1) - 2 * power(k) + power(k - 1));
    };
    salebra::Field circulant(1, n);
    for (Index k = 0; k < n; ++k) circulant(0, k) = covariance(k);
    const salebra::Field increments = embedded(circulant);
    salebra::Field heights(points, 1);
    double sum = 0;
    for (Index k = 0; k < points; ++k) heights(k, 0) = sum += increments(0, k);
    return heights;
  }

  /// n × n points of a surface by Stein (2002), as described by Kroese and Botev (2015). ⟨Δh²⟩ = 2
  /// r^2H within the unit circle; the surface is the largest square in a quarter of it.
  salebra::Field surface(salebra::Index n, double hurst) {
    using salebra::Index;
    const double alpha = 2 * hurst, range = alpha <= 1.5 ? 1 : 2;
    const double beta = alpha <= 1.5 ? 0 : alpha * (2 - alpha) / (3 * range * (range * range - 1));
    const double square =
        alpha <= 1.5 ? alpha / 2 : (alpha - beta * (range - 1) * (range - 1) * (range + 2)) / 2;
    const double constant = beta * std::pow(range - 1, 3) + 1 - square;
    const double step = 1 / (std::numbers::sqrt2 * double(n));
    const auto half = Index(std::ceil(range / step)) + 1;
    salebra::Field circulant(2 * half, 2 * half);
    for (Index i = 0; i < 2 * half; ++i)
      for (Index j = 0; j < 2 * half; ++j) {
        const double r =
            step * std::hypot(double(std::min(i, 2 * half - i)), double(std::min(j, 2 * half - j)));
        circulant(i, j) = r <= 1       ? constant - std::pow(r, alpha) + square * r * r
                          : r <= range ? beta * std::pow(range - r, 3) / r
                                       : 0;
      }
    salebra::Field heights = embedded(circulant).topLeftCorner(n, n);
    const double a = std::sqrt(2 * square) * normal_(engine_),
                 b = std::sqrt(2 * square) * normal_(engine_);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) heights(i, j) += step * (a * double(i) + b * double(j));
    return heights;
  }

 private:
  /// Gaussian numbers with a periodic covariance: white noise times the root of its spectrum.
  salebra::Field embedded(const salebra::Field& covariance) {
    using salebra::Index;
    const Index rows = covariance.rows(), columns = covariance.cols();
    salebra::RealFft2D<double> transform(rows, columns);
    const auto modes = static_cast<std::size_t>(rows * (columns / 2 + 1));
    std::vector<std::complex<double>> eigenvalues(modes), noise(modes);
    salebra::Field values = covariance;
    transform.forward(values.data(), eigenvalues.data());
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < columns; ++j) values(i, j) = normal_(engine_);
    transform.forward(values.data(), noise.data());
    const double scale = 1 / double(rows * columns);
    for (std::size_t k = 0; k < modes; ++k)
      noise[k] *= scale * std::sqrt(std::max(eigenvalues[k].real(), 0.0));
    transform.backward(noise.data(), values.data());
    return values;
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// Means over squares of k × k points, or over k points of a profile.
inline salebra::Field pixel_means(const salebra::Field& fine, salebra::Index k) {
  using salebra::Index;
  const Index ky = fine.cols() == 1 ? 1 : k;
  salebra::Field coarse(fine.rows() / k, fine.cols() / ky);
  for (Index i = 0; i < coarse.rows(); ++i)
    for (Index j = 0; j < coarse.cols(); ++j)
      coarse(i, j) = fine.block(k * i, ky * j, k, ky).mean();
  return coarse;
}
