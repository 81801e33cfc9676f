// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/parallel.hpp>

namespace salebra::detail {
namespace {

using std::numbers::pi;

std::size_t size_of(Index count) { return static_cast<std::size_t>(count); }

// The least number >= n without prime factors above 5: FFTW is fastest there.
Index fast_length(Index n) {
  for (Index length = std::max<Index>(n, 1);; ++length) {
    Index rest = length;
    for (const Index factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

Index padded_length(Index cells, Boundary boundary) {
  return boundary == Boundary::free ? fast_length(2 * cells) : cells;
}

// Signed wave number of mode i of n over length l.
double wave_number(Index i, Index n, double l) {
  return 2 * pi / l * static_cast<double>(i <= n / 2 ? i : i - n);
}
bool is_nyquist(Index i, Index n) { return n % 2 == 0 && i == n / 2; }

// Antiderivatives of 1/r, of x²/r³ (its second term) and of y²/r³ (its first) over a rectangle with a corner at (x, y).
double directed_term(double across, double along) {
  return across == 0 ? 0 : across * std::asinh(along / std::abs(across));
}

struct CornerSums {
  double isotropic, xx, yy, xy;
};

// ∬ over the cell centred at (x, y) of 1/r, x²/r³, y²/r³ and xy/r³ (PHYSICS section 5).
CornerSums corner_sums(double x, double y, double dx, double dy) {
  CornerSums sums{};
  for (const int i : {-1, 1})
    for (const int j : {-1, 1}) {
      const double corner_x = x + i * dx / 2, corner_y = y + j * dy / 2, sign = i * j;
      const double first = directed_term(corner_x, corner_y);
      const double second = directed_term(corner_y, corner_x);
      sums.isotropic += sign * (first + second);
      sums.xx += sign * second;
      sums.yy += sign * first;
      sums.xy -= sign * std::hypot(corner_x, corner_y);
    }
  return sums;
}

int component_count(Traction traction) { return traction == Traction::tangential ? 2 : 1; }

// Below this many points a team of threads costs more than it saves.
constexpr Index worth_threads = 1 << 14;

template <class Body>
void for_points(Index count, const Body& body) {
  if (count < worth_threads)
    body(Index{0}, count);
  else
    parallel::for_slabs(count, body);
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  const auto part = [&](Index begin, Index end) {
    double sum = 0;
    for (std::size_t i = size_of(begin); i < size_of(end); ++i) sum += a[i] * b[i];
    return sum;
  };
  const Index count = static_cast<Index>(a.size());
  return count < worth_threads ? part(0, count) : parallel::sum_slabs(count, part);
}

}  // namespace

bool CellWindow::contains(const CellWindow& other) const {
  return other.nx == 0 || (other.x0 >= x0 && other.y0 >= y0 && other.x0 + other.nx <= x0 + nx &&
                           other.y0 + other.ny <= y0 + ny);
}

CellWindow bounding_window(const ContactSet& cells) {
  Index x0 = cells.rows(), x1 = -1, y0 = cells.cols(), y1 = -1;
  for (Index ix = 0; ix < cells.rows(); ++ix)
    for (Index iy = 0; iy < cells.cols(); ++iy)
      if (cells(ix, iy)) {
        x0 = std::min(x0, ix);
        x1 = std::max(x1, ix);
        y0 = std::min(y0, iy);
        y1 = std::max(y1, iy);
      }
  return x1 < 0 ? CellWindow{} : CellWindow{x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

SurfaceResponse::SurfaceResponse(const Grid2D& grid, const Material& material, Boundary boundary,
                                 Traction traction, const CellWindow& window)
    : window_(window),
      fft_(padded_length(window.nx, boundary), padded_length(window.ny, boundary)),
      components_(component_count(traction)),
      loads_(size_of(components_ * fft_.nx() * fft_.ny())),
      values_(size_of(fft_.nx() * fft_.ny())),
      modes_x_(size_of(fft_.nx() * fft_.modes_y())),
      modes_y_(components_ == 2 ? modes_x_.size() : 0) {
  if (boundary == Boundary::periodic)
    make_periodic(grid, material, traction);
  else
    make_free(grid, material, traction);
}

void SurfaceResponse::make_periodic(const Grid2D& grid, const Material& material,
                                    Traction traction) {
  const Index modes_y = fft_.modes_y();
  symbol_xx_.assign(size_of(grid.nx * modes_y), 0);
  if (components_ == 2) symbol_yy_ = symbol_xy_ = symbol_xx_;
  const double normalisation = 1 / static_cast<double>(grid.points());
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < modes_y; ++j) {
      if (i == 0 && j == 0) continue;
      const std::size_t mode = size_of(i * modes_y + j);
      const double qx = wave_number(i, grid.nx, grid.lx), qy = wave_number(j, grid.ny, grid.ly);
      const double q = std::hypot(qx, qy);
      if (traction == Traction::normal) {
        symbol_xx_[mode] = 2 / (material.contact_modulus * q) * normalisation;
        continue;
      }
      const double scale = 2 * pi / q * normalisation;
      const double transverse = material.cerruti_isotropic + material.cerruti_directed;
      const double directed = material.cerruti_directed / (q * q);
      const double xx = scale * (transverse - directed * qx * qx);
      const double yy = scale * (transverse - directed * qy * qy);
      symbol_xx_[mode] = traction == Traction::along_y ? yy : xx;
      if (components_ == 1) continue;
      symbol_yy_[mode] = yy;
      // A Nyquist mode stands for both of its signs, whose cross terms cancel.
      const bool both_signs = is_nyquist(i, grid.nx) || is_nyquist(j, grid.ny);
      symbol_xy_[mode] = both_signs ? 0 : -scale * directed * qx * qy;
    }
}

void SurfaceResponse::make_free(const Grid2D& grid, const Material& material, Traction traction) {
  const Index rows = fft_.nx(), columns = fft_.ny();
  std::vector<double> xx(size_of(rows * columns)), yy, xy;
  if (components_ == 2) yy = xy = xx;
  const double c1 = material.cerruti_isotropic, c2 = material.cerruti_directed;
  parallel::for_slabs(window_.nx, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      for (Index j = 0; j < window_.ny; ++j) {
        const CornerSums sums = corner_sums(static_cast<double>(i) * grid.dx(),
                                            static_cast<double>(j) * grid.dy(), grid.dx(), grid.dy());
        // The three mirror images; each index is its own image on an axis.
        for (const bool mirror_x : {false, true})
          for (const bool mirror_y : {false, true}) {
            const Index row = mirror_x ? (rows - i) % rows : i;
            const Index column = mirror_y ? (columns - j) % columns : j;
            const std::size_t at = size_of(row * columns + column);
            if (traction == Traction::normal)
              xx[at] = sums.isotropic / (pi * material.contact_modulus);
            else
              xx[at] = c1 * sums.isotropic + c2 * (traction == Traction::along_y ? sums.yy : sums.xx);
            if (components_ == 1) continue;
            yy[at] = c1 * sums.isotropic + c2 * sums.yy;
            xy[at] = (mirror_x != mirror_y ? -1 : 1) * c2 * sums.xy;
          }
      }
  });
  transform_kernel(xx, symbol_xx_);
  if (components_ == 1) return;
  transform_kernel(yy, symbol_yy_);
  transform_kernel(xy, symbol_xy_);
}

void SurfaceResponse::transform_kernel(const std::vector<double>& kernel,
                                       std::vector<double>& symbol) {
  fft_.forward(kernel.data(), modes_x_.data());
  const double normalisation = 1 / static_cast<double>(kernel.size());
  symbol.resize(modes_x_.size());
  // Every kernel is even under (x, y) → (−x, −y), so that its transform is real.
  for (std::size_t mode = 0; mode < symbol.size(); ++mode)
    symbol[mode] = modes_x_[mode].real() * normalisation;
}

void SurfaceResponse::apply(const PointList& loaded, const double* tractions, const PointList& read,
                            double* displacements) {
  const std::size_t field_size = values_.size();
  const std::size_t loads = loaded.padded.size(), reads = read.padded.size();
  for (int c = 0; c < components_; ++c) {
    double* field = loads_.data() + size_of(c) * field_size;
    for (std::size_t k = 0; k < loads; ++k) field[loaded.padded[k]] = tractions[size_of(c) * loads + k];
    fft_.forward(field, c == 0 ? modes_x_.data() : modes_y_.data());
    for (std::size_t k = 0; k < loads; ++k) field[loaded.padded[k]] = 0;
  }
  const Index modes_y = fft_.modes_y();
  for_points(fft_.nx() * modes_y, [&](Index begin, Index end) {
    for (std::size_t m = size_of(begin); m < size_of(end); ++m) {
      if (components_ == 1) {
        modes_x_[m] *= symbol_xx_[m];
        continue;
      }
      const std::complex<double> x = modes_x_[m], y = modes_y_[m];
      modes_x_[m] = symbol_xx_[m] * x + symbol_xy_[m] * y;
      modes_y_[m] = symbol_xy_[m] * x + symbol_yy_[m] * y;
    }
  });
  for (int c = 0; c < components_; ++c) {
    fft_.backward(c == 0 ? modes_x_.data() : modes_y_.data(), values_.data());
    double* out = displacements + size_of(c) * reads;
    for (std::size_t k = 0; k < reads; ++k) out[k] = values_[size_of(read.padded[k])];
    ++fft_count_;
  }
}

StencilPreconditioner::StencilPreconditioner(const Grid2D& grid, Boundary boundary,
                                             const CellWindow& window)
    : window_(window),
      periodic_(boundary == Boundary::periodic),
      field_(size_of((window.nx + 2 * reach) * row_length())) {
  // |q| of a small lattice with the same cells: its real-space weights fall off like 1/r³.
  constexpr Index points = 64;
  RealFft2D<double> fft(points, points);
  std::vector<std::complex<double>> modes(size_of(points * fft.modes_y()));
  std::vector<double> weights(size_of(points * points));
  const double lx = points * grid.dx(), ly = points * grid.dy();
  const double largest = pi * std::hypot(1 / grid.dx(), 1 / grid.dy());
  for (Index i = 0; i < points; ++i)
    for (Index j = 0; j < fft.modes_y(); ++j)
      modes[size_of(i * fft.modes_y() + j)] =
          std::hypot(wave_number(i, points, lx), wave_number(j, points, ly)) /
          (largest * points * points);
  fft.backward(modes.data(), weights.data());
  std::vector<double> cut(weights.size(), 0.0);
  for (Index a = -reach; a <= reach; ++a)
    for (Index b = -reach; b <= reach; ++b) {
      const std::size_t at = size_of((a + points) % points * points + (b + points) % points);
      cut[at] = weights[at];
    }
  // Cutting must not cost positive definiteness, which it could for very elongated cells.
  fft.forward(cut.data(), modes.data());
  double least = 1;
  for (const auto& mode : modes) least = std::min(least, mode.real());
  constexpr double floor = 0.01;
  if (least < floor) cut[0] += floor - least;
  for (Index a = -reach; a <= reach; ++a)
    for (Index b = -reach; b <= reach; ++b)
      weights_[(a + reach) * width + b + reach] =
          cut[size_of((a + points) % points * points + (b + points) % points)];
}

void StencilPreconditioner::fill_ghosts() {
  const Index length = row_length();
  const auto wrap = [](Index i, Index n) { return ((i % n) + n) % n; };
  for (Index ix = 0; ix < window_.nx; ++ix) {
    double* row = field_.data() + (ix + reach) * length + reach;
    for (Index k = 1; k <= reach; ++k) {
      row[-k] = row[wrap(-k, window_.ny)];
      row[window_.ny + k - 1] = row[wrap(k - 1, window_.ny)];
    }
  }
  for (Index k = 1; k <= reach; ++k) {
    const auto copy_row = [&](Index from, Index to) {
      std::copy_n(field_.begin() + (from + reach) * length, length,
                  field_.begin() + (to + reach) * length);
    };
    copy_row(wrap(-k, window_.nx), -k);
    copy_row(wrap(k - 1, window_.nx), window_.nx + k - 1);
  }
}

void StencilPreconditioner::apply(const PointList& points, const double* in, double* out) {
  const Index length = row_length();
  for (std::size_t k = 0; k < points.haloed.size(); ++k) field_[size_of(points.haloed[k])] = in[k];
  if (periodic_) fill_ghosts();
  for_points(points.size(), [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const double* corner =
          field_.data() + points.haloed[size_of(k)] - reach * length - reach;
      double sum = 0;
      for (Index a = 0; a < width; ++a)
        for (Index b = 0; b < width; ++b) sum += weights_[a * width + b] * corner[a * length + b];
      out[k] = sum;
    }
  });
  for (const Index at : points.haloed) field_[size_of(at)] = 0;
}

ContactSystem::ContactSystem(const Grid2D& grid, const Material& material, Boundary boundary,
                             Traction traction, const CellWindow& window)
    : window_(window),
      response_(grid, material, boundary, traction, window),
      preconditioner_(grid, boundary, window) {}

PointList ContactSystem::points(const ContactSet& cells) const {
  PointList list;
  for (Index ix = window_.x0; ix < window_.x0 + window_.nx; ++ix)
    for (Index iy = window_.y0; iy < window_.y0 + window_.ny; ++iy)
      if (cells(ix, iy)) {
        list.cell.push_back(ix * cells.cols() + iy);
        list.padded.push_back(response_.padded_index(ix, iy));
        list.haloed.push_back(preconditioner_.haloed_index(ix, iy));
      }
  return list;
}

StickReport ContactSystem::solve(const PointList& points, const std::vector<double>& displacements,
                                 double tolerance, int max_iterations, const Progress& progress,
                                 std::vector<double>& tractions, std::vector<double>& misfit) {
  StickReport report;
  const int first_fft = response_.fft_count();
  const std::size_t unknowns = displacements.size();
  misfit = displacements;
  if (unknowns == 0) {
    report.converged = true;
    return report;
  }
  std::vector<double> response(unknowns), preconditioned(unknowns), direction(unknowns, 0.0);
  if (std::any_of(tractions.begin(), tractions.end(), [](double t) { return t != 0; })) {
    response_.apply(points, tractions.data(), points, response.data());
    for (std::size_t i = 0; i < unknowns; ++i) misfit[i] -= response[i];
  }
  const double root = std::sqrt(static_cast<double>(unknowns));
  double previous = 0;
  for (;;) {
    report.residual = std::sqrt(dot(misfit, misfit)) / root;
    report.converged = report.residual < tolerance;
    if (report.converged || report.iterations == max_iterations) break;
    if (progress && !progress({"stick", report.iterations / static_cast<double>(max_iterations),
                               report.iterations, report.residual})) {
      report.interrupted = true;
      break;
    }
    for (int c = 0; c < response_.components(); ++c) {
      const std::size_t offset = size_of(c * points.size());
      preconditioner_.apply(points, misfit.data() + offset, preconditioned.data() + offset);
    }
    const double weight = dot(misfit, preconditioned);
    const double beta = previous > 0 ? weight / previous : 0;
    previous = weight;
    for (std::size_t i = 0; i < unknowns; ++i)
      direction[i] = preconditioned[i] + beta * direction[i];
    response_.apply(points, direction.data(), points, response.data());
    const double curvature = dot(direction, response);
    if (!(curvature > 0)) break;  // round-off has used up the system's accuracy
    const double step = weight / curvature;
    for (std::size_t i = 0; i < unknowns; ++i) {
      tractions[i] += step * direction[i];
      misfit[i] -= step * response[i];
    }
    ++report.iterations;
  }
  report.fft_count = response_.fft_count() - first_fft;
  return report;
}

}  // namespace salebra::detail
