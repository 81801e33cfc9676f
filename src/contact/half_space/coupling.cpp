// SPDX-License-Identifier: GPL-3.0-or-later
// Dundurs' coupling of two bodies, and the displacements it adds across normal and tangential.
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "base/fft.hpp"

namespace salebra {
namespace {

using std::numbers::pi;
using Modes = std::vector<std::complex<double>>;

}  // namespace

double coupling_constant(const ElasticBody& first, const ElasticBody& second) {
  Material::of_bodies(first, second);  // for its checks
  const auto of = [](const ElasticBody& body) {
    return (1 - 2 * body.poisson) / (4 * pi * body.shear());
  };
  return of(first) - of(second);
}

double coupling_constant(const Material& material) {
  require(
      std::isfinite(material.cerruti_isotropic) && std::isfinite(material.cerruti_directed),
      "material", material.cerruti_isotropic,
      "as Cerruti's constant does not determine the coupling; give Young's moduli and Poisson's "
      "ratios, or a contact modulus with Poisson's ratio");
  return (material.cerruti_isotropic - material.cerruti_directed) / 2;
}

double dundurs_constant(double contact_modulus, double coupling) {
  return pi * contact_modulus * coupling;
}

double cell_gradient_integral(double x, double y, double dx, double dy) {
  double sum = 0;
  for (const int side_x : {-1, 1})
    for (const int side_y : {-1, 1}) {
      const double xi = x + side_x * dx / 2, eta = y + side_y * dy / 2;
      const double square = xi * xi + eta * eta;
      const double logarithm = square > 0 ? eta / 2 * std::log(square) : 0;
      const double angle = xi != 0 ? xi * std::atan(eta / xi) : 0;
      sum += side_x * side_y * (logarithm + angle);
    }
  return sum;
}

struct NormalTangentialCoupling::Parts {
  Grid2D grid;
  RealFft2D<double> fft;
  Modes kernel_x, kernel_y;  // of u_z under τ, over the number of points
  Field padded;
  Modes modes, second_modes;

  Parts(const Grid2D& cells, double constant, Boundary boundary)
      : grid(cells),
        fft(boundary == Boundary::periodic ? cells.nx : fast_transform_size(2 * cells.nx - 1),
            boundary == Boundary::periodic ? cells.ny : fast_transform_size(2 * cells.ny - 1)),
        padded(Field::Zero(fft.nx(), fft.ny())) {
    modes.resize(static_cast<std::size_t>(fft.nx() * fft.modes_y()));
    second_modes = modes;
    if (boundary == Boundary::periodic)
      set_periodic(constant);
    else
      set_free(constant);
    for (Modes* kernel : {&kernel_x, &kernel_y})
      for (std::complex<double>& mode : *kernel) mode /= static_cast<double>(padded.size());
  }

  void set_periodic(double constant) {
    kernel_x.resize(modes.size());
    kernel_y.resize(modes.size());
    for (Index i = 0; i < grid.nx; ++i)
      for (Index j = 0; j < fft.modes_y(); ++j) {
        // A mode on a Nyquist line is its own mirror image, so that an odd symbol vanishes there.
        const Index signed_i = 2 * i > grid.nx ? i - grid.nx : i;
        const double qx = 2 * pi * static_cast<double>(signed_i) / grid.lx;
        const double qy = 2 * pi * static_cast<double>(j) / grid.ly;
        const double square = qx * qx + qy * qy;
        const auto at = static_cast<std::size_t>(i * fft.modes_y() + j);
        const auto symbol = [&](double q, bool own_mirror) {
          return own_mirror || square == 0
                     ? std::complex<double>{}
                     : std::complex<double>{0, -2 * pi * constant * q / square};
        };
        kernel_x[at] = symbol(qx, 2 * i == grid.nx);
        kernel_y[at] = symbol(qy, 2 * j == grid.ny);
      }
  }

  void set_free(double constant) {
    const auto transform = [&](Modes& kernel, auto integral) {
      const Index half_x = fft.nx() / 2, half_y = fft.ny() / 2;
      parallel::for_slabs(fft.nx(), [&](Index begin, Index end) {
        for (Index a = begin; a < end; ++a)
          for (Index b = 0; b < fft.ny(); ++b) {
            // Distances of half a period are never used.
            const Index i = a > half_x ? a - fft.nx() : a, j = b > half_y ? b - fft.ny() : b;
            padded(a, b) = constant * integral(static_cast<double>(i) * grid.dx(),
                                               static_cast<double>(j) * grid.dy());
          }
      });
      kernel.resize(modes.size());
      fft.forward(padded.data(), kernel.data());
    };
    transform(kernel_x, [&](double x, double y) {
      return cell_gradient_integral(x, y, grid.dx(), grid.dy());
    });
    transform(kernel_y, [&](double x, double y) {
      return cell_gradient_integral(y, x, grid.dy(), grid.dx());
    });
    padded.setZero();
  }

  void forward(const Field& field, Modes& to) {
    padded.topLeftCorner(grid.nx, grid.ny) = field;
    fft.forward(padded.data(), to.data());
  }
  Field backward(Modes& from) {
    fft.backward(from.data(), padded.data());
    Field field = padded.topLeftCorner(grid.nx, grid.ny);
    padded.setZero();
    return field;
  }
  void require_field(const Field& field, const char* name) const {
    require(field.rows() == grid.nx && field.cols() == grid.ny, name, field.size(),
            "values do not match the grid; give nx × ny values");
  }
};

NormalTangentialCoupling::NormalTangentialCoupling(const Grid2D& grid, double coupling,
                                                   Boundary boundary) {
  grid.validate();
  require(std::isfinite(coupling), "coupling", coupling, "must be finite");
  parts_ = std::make_unique<Parts>(grid, coupling, boundary);
}
NormalTangentialCoupling::NormalTangentialCoupling(NormalTangentialCoupling&&) noexcept = default;
NormalTangentialCoupling& NormalTangentialCoupling::operator=(NormalTangentialCoupling&&) noexcept =
    default;
NormalTangentialCoupling::~NormalTangentialCoupling() = default;

Field NormalTangentialCoupling::normal_displacement(const TangentialField& traction) {
  Parts& p = *parts_;
  p.require_field(traction.x, "traction");
  p.require_field(traction.y, "traction");
  p.forward(traction.x, p.modes);
  p.forward(traction.y, p.second_modes);
  for (std::size_t k = 0; k < p.modes.size(); ++k)
    p.modes[k] = p.kernel_x[k] * p.modes[k] + p.kernel_y[k] * p.second_modes[k];
  return p.backward(p.modes);
}

TangentialField NormalTangentialCoupling::tangential_displacement(const Field& pressure) {
  Parts& p = *parts_;
  p.require_field(pressure, "pressure");
  p.forward(pressure, p.modes);
  for (std::size_t k = 0; k < p.modes.size(); ++k) {
    p.second_modes[k] = -p.kernel_y[k] * p.modes[k];
    p.modes[k] *= -p.kernel_x[k];
  }
  TangentialField displacement;
  displacement.x = p.backward(p.modes);
  displacement.y = p.backward(p.second_modes);
  return displacement;
}

}  // namespace salebra
