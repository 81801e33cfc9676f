// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic half-space kernels, normal and tangential, as convolutions; stencil that approximates the
// inverse of the normal kernel.
#include "half_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <span>
#include <vector>

#include "base/fft.hpp"
#include "base/memory.hpp"
#include "base/spectrum_columns.hpp"
#include "halo_field.hpp"
#include "normal_symbol.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

// a asinh(b/|a|), which tends to 0 as a → 0.
double corner_term(double a, double b) { return a == 0 ? 0 : a * std::asinh(b / std::abs(a)); }

// Fourier transform of a kernel on the period of a convolution padded with zeros. The kernel is
// given by its value at the distance of (a, b) cells, and is either even along both axes or odd
// along both. Each process transforms some rows 0 … period_x/2 along y, which gives real or
// imaginary numbers; columns are computed from these rows.
class KernelTransform {
 public:
  KernelTransform(Index period_x, Index period_y, Parity parity, const Communicator& communicator,
                  const std::function<double(Index, Index)>& kernel)
      : period_x_(period_x), odd_(parity == Parity::odd), rows_(communicator, period_x / 2 + 1) {
    RealFft2D<double> along_y(1, period_y);
    collectively(communicator, [&] {
      transformed_ = uninitialised_field(rows_.count(), along_y.modes_y());
      parallel::for_slabs(rows_.count(), [&](Index begin, Index end) {
        std::vector<double> line(static_cast<std::size_t>(period_y));
        Modes modes(static_cast<std::size_t>(along_y.modes_y()));
        for (Index row = begin; row < end; ++row) {
          const Index a = rows_.begin() + row;
          // Only values at distances below half a period are used. At half a period an odd kernel
          // must equal its own negative, hence 0.
          fill(line, period_y / 2 + 1, [&](Index b) {
            return odd_ && (2 * a == period_x || 2 * b == period_y) ? 0 : kernel(a, b);
          });
          along_y.forward(line.data(), modes.data());
          for (Index j = 0; j < along_y.modes_y(); ++j) {
            const std::complex<double>& mode = modes[static_cast<std::size_t>(j)];
            transformed_(row, j) = odd_ ? mode.imag() : mode.real();
          }
        }
      });
    });
  }

  // Implements NormalSymbol::columns: computes any columns of the symbol.
  Field columns(const RowPartition& positions,
                const std::function<Index(Index position)>& column_at) const {
    RealFft2D<double> along_x(1, period_x_);
    Field symbol;
    collectively(positions.communicator(),
                 [&] { symbol = uninitialised_field(positions.count(), along_x.modes_y()); });
    visit_columns<double>(
        rows_, positions,
        [&](Index row, Index first, Index count, double* to) {
          for (Index k = 0; k < count; ++k) to[k] = transformed_(row, column_at(first + k));
        },
        [&](Index position, std::span<double> half) {
          std::vector<double> line(static_cast<std::size_t>(period_x_));
          Modes modes(static_cast<std::size_t>(along_x.modes_y()));
          fill(line, period_x_ / 2 + 1, [&](Index a) { return half[static_cast<std::size_t>(a)]; });
          along_x.forward(line.data(), modes.data());
          for (Index i = 0; i < along_x.modes_y(); ++i) {
            const std::complex<double>& mode = modes[static_cast<std::size_t>(i)];
            symbol(position - positions.begin(), i) = odd_ ? -mode.imag() : mode.real();
          }
        });
    return symbol;
  }

 private:
  using Modes = std::vector<std::complex<double>>;

  // Fills a line with one period of a sequence: elements 0 … count − 1 are value(0) … value(count −
  // 1), and element period − k mirrors element k, with the sign reversed if the kernel is odd.
  template <class Value>
  void fill(std::vector<double>& line, Index count, const Value& value) const {
    const std::size_t period = line.size();
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      line[k] = value(static_cast<Index>(k));
      if (k > 0 && 2 * k != period) line[period - k] = odd_ ? -line[k] : line[k];
    }
  }

  Index period_x_;
  bool odd_;
  RowPartition rows_;
  Field transformed_;
};

// Returns the symbol of a kernel, valid only in the columns of this process.
std::function<double(Index, Index)> symbol_of(const KernelTransform& kernel,
                                              const RowPartition& rows, Index period_y) {
  const RowPartition columns = detail::spectrum_columns(rows, period_y);
  const auto symbol =
      std::make_shared<Field>(kernel.columns(columns, [](Index position) { return position; }));
  return [symbol, first = columns.begin()](Index i, Index j) { return (*symbol)(j - first, i); };
}

struct WaveVector {
  double x, y, length;
  // i may also be given as nx − i, for the frequency −i.
  WaveVector(const Grid2D& grid, Index i, Index j)
      : x(2 * pi * static_cast<double>(2 * i > grid.nx ? i - grid.nx : i) / grid.lx),
        y(2 * pi * static_cast<double>(j) / grid.ly),
        length(std::hypot(x, y)) {}
};

// The symbol of a body on a periodic grid, from a number at a wave vector that it has at the opposite
// one too. A mode at the Nyquist frequency of x or y is its own mirror image, so that the numbers of
// both are averaged there.
template <class Number>
Convolution2D<double>::Symbol symbol_by_inversion(const Grid2D& grid, const Number& number) {
  return [=](Index i, Index j) {
    const WaveVector q(grid, i, j);
    const bool own_image = 2 * i == grid.nx || 2 * j == grid.ny;
    return own_image ? (number(q.x, q.y) + number(-q.x, q.y)) / 2 : number(q.x, q.y);
  };
}

}  // namespace

namespace {

// Distance, in cells, beyond which Gauss quadrature replaces the closed form. The closed form is a
// sum of terms at the four corners of the cell. These terms grow with the distance r while their
// sum falls, so the relative error is (r/cell)² times rounding, 1e-9 at 4096 cells. Far away the
// integrands are smooth over the cell, and nine Gauss points have an error of 4e-4 (cell/r)⁶.
constexpr double far_cells = 32;

CellIntegrals far_cell_integrals(double x, double y, double dx, double dy) {
  constexpr std::array<double, 3> positions{-0.7745966692414834, 0, 0.7745966692414834};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  CellIntegrals sum;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double xi = x + positions[i] * dx / 2, eta = y + positions[j] * dy / 2;
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

NormalResponse::NormalResponse(const Body& pressed, const Grid2D& physical, bool with_uniform)
    : body(pressed),
      cell(std::sqrt(physical.cell_area())),
      modulus(reference_modulus(pressed, physical)),
      uniform(with_uniform) {}

bool NormalResponse::operator==(const NormalResponse& other) const {
  const bool same_body = body && other.body ? body->same_as(*other.body) : !body && !other.body;
  return same_body && uniform == other.uniform && contact_modulus == other.contact_modulus &&
         cell == other.cell && modulus == other.modulus;
}

void require_pressable(const Body& body, const Grid2D& grid, Boundary boundary) {
  grid.validate();
  require(boundary == Boundary::periodic, "boundary", name_of(boundary),
          "is for half-spaces only; a layered, graded, anisotropic or tabulated body needs a "
          "periodic surface");
  body.compliance(2 * pi / std::max(grid.lx, grid.ly));
  body.compliance(pi * std::hypot(1 / grid.dx(), 1 / grid.dy()));
}

double reference_modulus(const Body& body, const Grid2D& grid) {
  const double q = pi / std::sqrt(grid.cell_area());
  return 2 / (q * body.compliance(q).normal);
}

namespace {

// A wave vector, lengthened to that of the longest wave of the grid: a table of a body need not reach
// further.
struct WaveOfGrid {
  double x, y;
  WaveOfGrid(const Grid2D& grid, double qx, double qy) {
    const double factor = std::max(1.0, 2 * pi / std::max(grid.lx, grid.ly) / std::hypot(qx, qy));
    x = factor * qx, y = factor * qy;
  }
};

// The mean of a response at (qx, qy) and (−qx, qy), which differ only if the body is directional.
template <class Response>
double mean_of_sides(const Body& body, const WaveOfGrid& q, const Response& response) {
  return body.is_directional() ? (response(q.x, q.y) + response(-q.x, q.y)) / 2
                               : response(q.x, q.y);
}

}  // namespace

double cell_compliance(const Grid2D& grid, const NormalResponse& response) {
  if (!response.body) return salebra::cell_compliance(grid, response.contact_modulus);
  // The mean of the compliance over the wave vectors of the grid, sampled at midpoints.
  constexpr int samples = 32;
  double sum = 0;
  for (int a = 0; a < samples; ++a)
    for (int b = 0; b < samples; ++b)
      sum += mean_of_sides(*response.body,
                           WaveOfGrid(grid, pi / samples * (a + 0.5) / grid.dx(),
                                      pi / samples * (b + 0.5) / grid.dy()),
                           [&](double qx, double qy) { return response.compliance(qx, qy); });
  return sum / (samples * samples);
}

InverseStencil inverse_stencil(const Grid2D& grid, const NormalResponse& response) {
  if (!response.body) return InverseStencil(grid);
  return InverseStencil(grid, [&](double qx, double qy) {
    return mean_of_sides(*response.body, WaveOfGrid(grid, qx, qy),
                         [&](double x, double y) { return 1 / response.compliance(x, y); });
  });
}

InverseStencil tangential_inverse_stencil(const Grid2D& grid, const Body& body) {
  return InverseStencil(grid, [&](double qx, double qy) {
    return mean_of_sides(body, WaveOfGrid(grid, qx, qy), [&](double x, double y) {
      const SurfaceCompliance c = body.compliance(x, y);
      return 2 / (c.in_plane + c.across);
    });
  });
}

NormalSymbol normal_symbol(const Grid2D& grid, const NormalResponse& response, Boundary boundary,
                           const RowPartition& rows) {
  grid.validate();
  const double contact_modulus = response.contact_modulus;
  require_positive(contact_modulus, "contact_modulus");
  const auto shape = shape_of<double>(grid, boundary);
  NormalSymbol symbol{shape.period_x, shape.period_y, {}, {}};
  if (response.body && response.body->is_directional()) {
    symbol.parity = Parity::by_inversion;
    symbol.value = symbol_by_inversion(
        grid, [=](double qx, double qy) { return response.compliance(qx, qy); });
  } else if (response.body) {
    symbol.value = [=](Index i, Index j) {
      const WaveVector q(grid, i, j);
      return response.compliance(q.x, q.y);
    };
  } else if (boundary == Boundary::periodic) {
    const double x = 2 * pi / grid.lx, y = 2 * pi / grid.ly;
    symbol.value = [=](Index i, Index j) {
      const double qx = x * static_cast<double>(i), qy = y * static_cast<double>(j);
      return i == 0 && j == 0 ? 0 : 2 / (contact_modulus * std::sqrt(qx * qx + qy * qy));
    };
  } else {
    const auto kernel = std::make_shared<KernelTransform>(
        shape.period_x, shape.period_y, Parity::even, rows.communicator(), [&](Index a, Index b) {
          const double x = static_cast<double>(a) * grid.dx(),
                       y = static_cast<double>(b) * grid.dy();
          return cell_integrals(x, y, grid.dx(), grid.dy()).inverse_distance /
                 (pi * contact_modulus);
        });
    symbol.value = symbol_of(*kernel, rows, shape.period_y);
    symbol.columns = [kernel](const RowPartition& positions, const auto& column_at) {
      return kernel->columns(positions, column_at);
    };
  }
  return symbol;
}

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, const NormalSymbol& symbol,
                                      const RowPartition& rows) {
  Convolution2D<Real> compliance({grid.nx, grid.ny, symbol.period_x, symbol.period_y}, 1, rows);
  compliance.set_symbol(0, 0, symbol.value, symbol.parity);
  return compliance;
}

template Convolution2D<float> normal_compliance<float>(const Grid2D&, const NormalSymbol&,
                                                       const RowPartition&);
template Convolution2D<double> normal_compliance<double>(const Grid2D&, const NormalSymbol&,
                                                         const RowPartition&);

}  // namespace detail

template <class Real>
Convolution2D<Real> normal_compliance(const Grid2D& grid, double contact_modulus, Boundary boundary,
                                      const Communicator& communicator) {
  const RowPartition rows(communicator, grid.nx);
  return detail::normal_compliance<Real>(
      grid, detail::normal_symbol(grid, contact_modulus, boundary, rows), rows);
}

namespace {

/// Sets the symbols of a tangential response. along(component, length): of a traction along an axis,
/// of which the wave vector has this component. mixed(q): of x by a traction along y.
template <class Real, class Along, class Mixed>
void set_tangential_symbols(Convolution2D<Real>& compliance, const Grid2D& grid, const Along& along,
                            const Mixed& mixed) {
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
        // A Fourier mode at the Nyquist frequency of x or y is its own mirror image, so an odd
        // symbol is 0 there.
        return 2 * i == grid.nx || 2 * j == grid.ny || q.length == 0 ? 0.0 : mixed(q);
      },
      Parity::odd);
}

}  // namespace

template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Material& material,
                                          Boundary boundary, const Communicator& communicator) {
  grid.validate();
  const double isotropic = material.cerruti_isotropic, directed = material.cerruti_directed;
  require(std::isfinite(isotropic) && std::isfinite(directed), "tangential_modulus",
          material.tangential_modulus,
          "does not determine Cerruti's constants; give the bodies or Poisson's ratio");
  const auto shape = shape_of<Real>(grid, boundary);
  const RowPartition rows(communicator, grid.nx);
  Convolution2D<Real> compliance(shape, 2, rows);
  if (boundary == Boundary::periodic) {
    const auto along = [=](double component, double length) {
      return length == 0 ? 0
                         : 2 * pi / length *
                               (isotropic + directed -
                                directed * component * component / (length * length));
    };
    set_tangential_symbols(compliance, grid, along, [=](const WaveVector& q) {
      return -2 * pi * directed * q.x * q.y / (q.length * q.length * q.length);
    });
  } else {
    const auto set = [&](int a, int b, Parity parity, auto value) {
      compliance.set_symbol(
          a, b,
          symbol_of(KernelTransform(shape.period_x, shape.period_y, parity, communicator,
                                    [&](Index i, Index j) {
                                      const double x = static_cast<double>(i) * grid.dx();
                                      const double y = static_cast<double>(j) * grid.dy();
                                      return value(cell_integrals(x, y, grid.dx(), grid.dy()));
                                    }),
                    rows, shape.period_y),
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

template <class Real>
Convolution2D<Real> tangential_compliance(const Grid2D& grid, const Body& body,
                                          const Communicator& communicator) {
  Convolution2D<Real> compliance(shape_of<Real>(grid, Boundary::periodic), 2,
                                 RowPartition(communicator, grid.nx));
  if (body.is_directional()) {
    const auto set = [&](int a, int b, const auto& element) {
      compliance.set_symbol(
          a, b,
          symbol_by_inversion(grid,
                              [=](double qx, double qy) {
                                const double square = qx * qx + qy * qy;
                                const SurfaceCompliance c = body.compliance(qx, qy);
                                if (square == 0) return a == b ? c.in_plane : 0.0;
                                return element(c, qx * qx / square, qy * qy / square,
                                               qx * qy / square);
                              }),
          Parity::by_inversion);
    };
    set(0, 0, [](const SurfaceCompliance& c, double xx, double yy, double xy) {
      return c.in_plane * xx + c.across * yy - 2 * c.mixed * xy;
    });
    set(1, 1, [](const SurfaceCompliance& c, double xx, double yy, double xy) {
      return c.in_plane * yy + c.across * xx + 2 * c.mixed * xy;
    });
    set(0, 1, [](const SurfaceCompliance& c, double xx, double yy, double xy) {
      return (c.in_plane - c.across) * xy + c.mixed * (xx - yy);
    });
    return compliance;
  }
  const auto along = [=](double component, double length) {
    const SurfaceCompliance c = body.compliance(length);
    return length == 0
               ? c.in_plane
               : c.across + (c.in_plane - c.across) * component * component / (length * length);
  };
  set_tangential_symbols(compliance, grid, along, [=](const WaveVector& q) {
    const SurfaceCompliance c = body.compliance(q.length);
    return (c.in_plane - c.across) * q.x * q.y / (q.length * q.length);
  });
  return compliance;
}

template Convolution2D<double> tangential_compliance<double>(const Grid2D&, const Body&,
                                                             const Communicator&);
template Convolution2D<float> normal_compliance<float>(const Grid2D&, double, Boundary,
                                                       const Communicator&);
template Convolution2D<double> normal_compliance<double>(const Grid2D&, double, Boundary,
                                                         const Communicator&);
template Convolution2D<float> tangential_compliance<float>(const Grid2D&, const Material&, Boundary,
                                                           const Communicator&);
template Convolution2D<double> tangential_compliance<double>(const Grid2D&, const Material&,
                                                             Boundary, const Communicator&);

double cell_compliance(const Grid2D& grid, double contact_modulus) {
  // The displacement of a cell is the mean of 2/(E*q) over the wave vectors of the grid, |q_x| <
  // π/dx and |q_y| < π/dy, as an integral.
  const double qx = pi / grid.dx(), qy = pi / grid.dy();
  const double integral = 4 * (corner_term(qx, qy) + corner_term(qy, qx));
  return 2 / contact_modulus * integral / (4 * qx * qy);
}

namespace {

// The symbol of a stencil is sampled on a periodic grid of 64 × 64 cells, which is far larger than
// the stencil and takes negligible time.
constexpr int torus = 64;

}  // namespace

InverseStencil::InverseStencil(const Grid2D& grid) {
  set_weights(grid, [](double x, double y) { return pi / torus * std::hypot(x, y); });
}

InverseStencil::InverseStencil(const Grid2D& grid,
                               const std::function<double(double qx, double qy)>& symbol) {
  set_weights(grid,
              [&](double x, double y) { return symbol(2 * pi / torus * x, 2 * pi / torus * y); });
}

void InverseStencil::set_weights(const Grid2D& grid,
                                 const std::function<double(double x, double y)>& inverse) {
  std::array<double, torus> cosine;
  for (int k = 0; k < torus; ++k)
    cosine[static_cast<std::size_t>(k)] = std::cos(2 * pi * k / torus);
  const auto wave = [&](int i, int j) {
    return cosine[static_cast<std::size_t>((i * j % torus + torus) % torus)];
  };
  std::array<std::array<double, torus>, torus> symbol;
  const auto at = [](int a) { return static_cast<std::size_t>(a % torus); };
  for (int a = 0; a <= torus / 2; ++a)
    for (int b = 0; b <= torus / 2; ++b) {
      const double value = a == 0 && b == 0 ? 0 : inverse(a / grid.dx(), b / grid.dy());
      for (const int i : {a, torus - a})
        for (const int j : {b, torus - b}) symbol[at(i)][at(j)] = value;
    }
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
  // If cells are long, the truncation to 7 × 7 weights may make the transform of the stencil
  // negative somewhere; then the weight of the centre is raised until the transform is positive.
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

void InverseStencil::apply(const RowPartition& rows, const Field& mask, const Field& r,
                           Boundary boundary, Field& z) const {
  static_assert(radius <= detail::halo);
  const Index nx = r.rows(), ny = r.cols();
  detail::HaloField<double> with_halo(nx, ny);
  parallel::for_slabs(nx, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < ny; ++j)
        if (mask(i, j) > 0) with_halo.row(i)[j] = r(i, j);
  });
  with_halo.fill_halo(boundary, detail::halo_rows(rows, boundary));
  z.resize(nx, ny);
  parallel::for_slabs(nx, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < ny; ++j) {
        double sum = 0;
        if (mask(i, j) > 0)
          for (int a = -radius; a <= radius; ++a)
            for (int b = -radius; b <= radius; ++b)
              sum += weights_[index(a, b)] * with_halo.row(i + a)[j + b];
        z(i, j) = sum;
      }
  });
}

}  // namespace salebra
