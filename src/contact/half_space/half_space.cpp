// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic half-space kernels, normal and tangential, as convolutions; stencil of their inverse.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/half_space/half_space.hpp>
#include <vector>

#include "framed_field.hpp"
#include "normal_symbol.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

// a asinh(b/|a|), continued to a = 0.
double corner_term(double a, double b) { return a == 0 ? 0 : a * std::asinh(b / std::abs(a)); }

template <class Real>
typename Convolution2D<Real>::Shape shape_of(const Grid2D& grid, Boundary boundary) {
  if (boundary == Boundary::periodic) return {grid.nx, grid.ny, grid.nx, grid.ny};
  return {grid.nx, grid.ny, fast_transform_size(2 * grid.nx - 1),
          fast_transform_size(2 * grid.ny - 1)};
}

// Symbol of a kernel given by its value at the distance of (a, b) cells, on the period of the zero-padded convolution.
std::function<double(Index, Index)> padded_symbol(
    Index period_x, Index period_y, Parity parity,
    const std::function<double(Index, Index)>& kernel) {
  Field values(period_x, period_y);
  // Only distances below half a period are ever used. At half a period an odd kernel must be its own negative.
  const Index half_x = period_x / 2, half_y = period_y / 2;
  parallel::for_slabs(half_x + 1, [&](Index begin, Index end) {
    for (Index a = begin; a < end; ++a)
      for (Index b = 0; b <= half_y; ++b) {
        const bool own_mirror = 2 * a == period_x || 2 * b == period_y;
        const double value = parity == Parity::odd && own_mirror ? 0 : kernel(a, b);
        const double mirrored = parity == Parity::odd ? -value : value;
        const Index am = (period_x - a) % period_x, bm = (period_y - b) % period_y;
        values(a, b) = value;
        values(am, b) = am == a ? value : mirrored;
        values(a, bm) = bm == b ? value : mirrored;
        values(am, bm) = am == a ? values(a, bm) : (bm == b ? values(am, b) : value);
      }
  });
  RealFft2D<double> fft(period_x, period_y);
  const Index modes_y = fft.modes_y();
  const auto modes =
      large_array<std::complex<double>>(static_cast<std::size_t>(period_x * modes_y));
  fft.forward(values.data(), modes.get());
  auto symbol = std::make_shared<Field>(half_x + 1, modes_y);
  parallel::for_slabs(half_x + 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < modes_y; ++j)
        (*symbol)(i, j) = modes[static_cast<std::size_t>(i * modes_y + j)].real();
  });
  return [symbol](Index i, Index j) { return (*symbol)(i, j); };
}

struct WaveVector {
  double x, y, length;
  WaveVector(const Grid2D& grid, Index i, Index j)
      : x(2 * pi * static_cast<double>(i) / grid.lx),
        y(2 * pi * static_cast<double>(j) / grid.ly),
        length(std::hypot(x, y)) {}
};

}  // namespace

namespace {

// The corners' terms grow with the distance r and their sum falls with it: a part (r/cell)² of rounding, 1e-9 at 4096 cells. Far
// away the integrands are smooth over the cell, and nine Gauss points leave 4e-4 (cell/r)⁶.
constexpr double far_cells = 32;

CellIntegrals far_cell_integrals(double x, double y, double dx, double dy) {
  constexpr std::array<double, 3> places{-0.7745966692414834, 0, 0.7745966692414834};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  CellIntegrals sum;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double xi = x + places[i] * dx / 2, eta = y + places[j] * dy / 2;
      const double square = xi * xi + eta * eta;
      const double inverse = weights[i] * weights[j] * dx * dy / std::sqrt(square);
      sum.inverse_distance += inverse;
      sum.xx += inverse * xi * xi / square;
      sum.yy += inverse * eta * eta / square;
      sum.xy += inverse * xi * eta / square;
    }
  return sum;
}

}  // namespace

CellIntegrals cell_integrals(double x, double y, double dx, double dy) {
  if (std::max(std::abs(x), std::abs(y)) > far_cells * std::max(dx, dy))
    return far_cell_integrals(x, y, dx, dy);
  CellIntegrals sum;
  for (const int side_x : {-1, 1})
    for (const int side_y : {-1, 1}) {
      const double xi = x + side_x * dx / 2, eta = y + side_y * dy / 2;
      const double sign = side_x * side_y;
      const double along_x = corner_term(eta, xi), along_y = corner_term(xi, eta);
      sum.xx += sign * along_x;
      sum.yy += sign * along_y;
      sum.xy -= sign * std::hypot(xi, eta);
    }
  sum.inverse_distance = sum.xx + sum.yy;
  return sum;
}

namespace detail {

NormalSymbol normal_symbol(const Grid2D& grid, double contact_modulus, Boundary boundary) {
  grid.validate();
  require_positive(contact_modulus, "contact_modulus");
  const auto shape = shape_of<double>(grid, boundary);
  NormalSymbol symbol{shape.period_x, shape.period_y, {}};
  if (boundary == Boundary::periodic) {
    const double x = 2 * pi / grid.lx, y = 2 * pi / grid.ly;
    symbol.value = [=](Index i, Index j) {
      const double qx = x * static_cast<double>(i), qy = y * static_cast<double>(j);
      return i == 0 && j == 0 ? 0 : 2 / (contact_modulus * std::sqrt(qx * qx + qy * qy));
    };
  } else {
    symbol.value =
        padded_symbol(shape.period_x, shape.period_y, Parity::even, [&](Index a, Index b) {
          const double x = static_cast<double>(a) * grid.dx(),
                       y = static_cast<double>(b) * grid.dy();
          return cell_integrals(x, y, grid.dx(), grid.dy()).inverse_distance /
                 (pi * contact_modulus);
        });
  }
  return symbol;
}

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const Share& rows) {
  Convolution2D<Real> compliance({grid.nx, grid.ny, symbol.period_x, symbol.period_y}, 1, rows);
  compliance.set_symbol(0, 0, symbol.value);
  return compliance;
}

template Convolution2D<float> normal_compliance<float>(const Grid2D&, const NormalSymbol&,
                                                       const Share&);
template Convolution2D<double> normal_compliance<double>(const Grid2D&, const NormalSymbol&,
                                                         const Share&);

}  // namespace detail

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, double contact_modulus, Boundary boundary,
                                      const Communicator& ranks) {
  return detail::normal_compliance<Real>(
      grid, detail::normal_symbol(grid, contact_modulus, boundary), Share(ranks, grid.nx));
}

template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Material& material,
                                          Boundary boundary, const Communicator& ranks) {
  grid.validate();
  const double isotropic = material.cerruti_isotropic, directed = material.cerruti_directed;
  require(std::isfinite(isotropic) && std::isfinite(directed), "tangential_modulus",
          material.tangential_modulus,
          "does not give Cerruti's constants; name the bodies or Poisson's ratio");
  const auto shape = shape_of<Real>(grid, boundary);
  Convolution2D<Real> compliance(shape, 2, Share(ranks, grid.nx));
  if (boundary == Boundary::periodic) {
    const auto along = [=](double component, double length) {
      return length == 0 ? 0
                         : 2 * pi / length *
                               (isotropic + directed -
                                directed * component * component / (length * length));
    };
    compliance.set_symbol(0, 0, [=](Index i, Index j) {
      const WaveVector q(grid, i, j);
      return along(q.x, q.length);
    });
    compliance.set_symbol(1, 1, [=](Index i, Index j) {
      const WaveVector q(grid, i, j);
      return along(q.y, q.length);
    });
    compliance.set_symbol(
        0, 1,
        [=](Index i, Index j) {
          const WaveVector q(grid, i, j);
          // A mode on a Nyquist line is its own mirror image, so that an odd symbol vanishes there.
          if (2 * i == grid.nx || 2 * j == grid.ny || q.length == 0) return 0.0;
          return -2 * pi * directed * q.x * q.y / (q.length * q.length * q.length);
        },
        Parity::odd);
  } else {
    const auto set = [&](int a, int b, Parity parity, auto value) {
      compliance.set_symbol(
          a, b,
          padded_symbol(shape.period_x, shape.period_y, parity,
                        [&](Index i, Index j) {
                          const double x = static_cast<double>(i) * grid.dx();
                          const double y = static_cast<double>(j) * grid.dy();
                          return value(cell_integrals(x, y, grid.dx(), grid.dy()));
                        }),
          parity);
    };
    set(0, 0, Parity::even, [=](const CellIntegrals& cell) {
      return isotropic * cell.inverse_distance + directed * cell.xx;
    });
    set(1, 1, Parity::even, [=](const CellIntegrals& cell) {
      return isotropic * cell.inverse_distance + directed * cell.yy;
    });
    set(0, 1, Parity::odd, [=](const CellIntegrals& cell) { return directed * cell.xy; });
  }
  return compliance;
}

template Convolution2D<float> normal_compliance<float>(const Grid2D&, double, Boundary,
                                                       const Communicator&);
template Convolution2D<double> normal_compliance<double>(const Grid2D&, double, Boundary,
                                                         const Communicator&);
template Convolution2D<float> tangential_compliance<float>(const Grid2D&, const Material&, Boundary,
                                                           const Communicator&);
template Convolution2D<double> tangential_compliance<double>(const Grid2D&, const Material&,
                                                             Boundary, const Communicator&);

double cell_compliance(const Grid2D& grid, double contact_modulus) {
  // The mean of 2/(E*q) over the wave vectors that the grid has, |q_x| < π/dx, |q_y| < π/dy, as an integral.
  const double qx = pi / grid.dx(), qy = pi / grid.dy();
  const double integral = 4 * (corner_term(qx, qy) + corner_term(qy, qx));
  return 2 / contact_modulus * integral / (4 * qx * qy);
}

InverseStencil::InverseStencil(const Grid2D& grid) {
  // |q|/2 sampled on a torus of 64 × 64 cells: far larger than the stencil, small enough to be free.
  constexpr int torus = 64;
  std::array<double, torus> cosine;
  for (int k = 0; k < torus; ++k)
    cosine[static_cast<std::size_t>(k)] = std::cos(2 * pi * k / torus);
  const auto wave = [&](int i, int j) {
    return cosine[static_cast<std::size_t>((i * j % torus + torus) % torus)];
  };
  std::array<std::array<double, torus>, torus> symbol;
  for (int a = 0; a < torus; ++a)
    for (int b = 0; b < torus; ++b)
      symbol[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
          pi / torus *
          std::hypot(std::min(a, torus - a) / grid.dx(), std::min(b, torus - b) / grid.dy());
  weights_.fill(0);
  for (int i = 0; i <= radius; ++i)
    for (int a = 0; a < torus; ++a)
      for (int j = 0; j <= radius; ++j) {
        double sum = 0;
        for (int b = 0; b < torus; ++b)
          sum += symbol[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] * wave(b, j);
        weights_[index(i, j)] += sum * wave(a, i) / (torus * torus);
      }
  for (int i = -radius; i <= radius; ++i)
    for (int j = -radius; j <= radius; ++j)
      weights_[index(i, j)] = weights_[index(std::abs(i), std::abs(j))];
  // Cutting may leave the transform negative somewhere (long cells): lift the centre until it is positive.
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a <= torus / 2; ++a)
    for (int b = 0; b <= torus / 2; ++b) {
      double sum = 0;
      for (int i = -radius; i <= radius; ++i)
        for (int j = -radius; j <= radius; ++j) sum += weight(i, j) * wave(a, i) * wave(b, j);
      least = std::min(least, sum);
    }
  const double wanted = 0.01 * weight(0, 0);
  if (least < wanted) weights_[index(0, 0)] += wanted - least;
}

void InverseStencil::apply(const Share& rows, const Field& mask, const Field& r, Boundary boundary,
                           Field& z) const {
  static_assert(radius <= detail::frame);
  const Index nx = r.rows(), ny = r.cols();
  detail::FramedField<double> framed(nx, ny);
  parallel::for_slabs(nx, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < ny; ++j)
        if (mask(i, j) > 0) framed.row(i)[j] = r(i, j);
  });
  framed.fill_frame(boundary, detail::frame_rows(rows, boundary));
  z.resize(nx, ny);
  parallel::for_slabs(nx, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < ny; ++j) {
        double sum = 0;
        if (mask(i, j) > 0)
          for (int a = -radius; a <= radius; ++a)
            for (int b = -radius; b <= radius; ++b)
              sum += weights_[index(a, b)] * framed.row(i + a)[j + b];
        z(i, j) = sum;
      }
  });
}

}  // namespace salebra
