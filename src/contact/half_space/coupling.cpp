// SPDX-License-Identifier: GPL-3.0-or-later
// Dundurs' coupling of two bodies, and the displacements that it adds: normal displacements by
// shear tractions, tangential displacements by pressures.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "base/fft.hpp"
#include "half_space.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

}  // namespace

double coupling_constant(const ElasticBody& first, const ElasticBody& second) {
  Material::of_bodies(first, second);  // throws if the elastic constants are invalid
  const auto of = [](const ElasticBody& body) {
    return (1 - 2 * body.poisson) / (4 * pi * body.shear());
  };
  return of(first) - of(second);
}

double coupling_constant(const Material& material) {
  require(std::isfinite(material.cerruti_isotropic) && std::isfinite(material.cerruti_directed),
          "material", material.cerruti_isotropic,
          "as Cerruti's constant does not determine the coupling; give Young's moduli and "
          "Poisson's ratios, or a contact modulus with Poisson's ratio");
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

// Normal displacement u_z = K_x * τ_x + K_y * τ_y by shear tractions τ, and tangential displacement
// u_t by the pressure p, −u_t = (K_x * p, K_y * p). One convolution with the kernels K_00 = K_x and
// K_01 = K_10 = K_y serves both displacements.
struct NormalTangentialCoupling::Parts {
  Grid2D grid;
  Convolution2D<double> kernels;

  Parts(const Grid2D& cells, double constant, Boundary boundary)
      : grid(cells), kernels(shape_of<double>(cells, boundary), 2) {
    if (boundary == Boundary::periodic)
      set_periodic(constant);
    else
      set_free(constant);
  }

  void set_periodic(double constant) {
    const auto set = [&](int component, Parity parity) {
      kernels.set_symbol(
          0, component,
          [this, constant, component](Index i, Index j) {
            const double qx = 2 * pi * static_cast<double>(i) / grid.lx;
            const double qy = 2 * pi * static_cast<double>(j) / grid.ly;
            // A Fourier mode at the Nyquist frequency of an axis is its own mirror image, so a
            // symbol that is odd along this axis is 0 there.
            const bool own_mirror = component == 0 ? 2 * i == grid.nx : 2 * j == grid.ny;
            if (own_mirror || (i == 0 && j == 0)) return 0.0;
            return -2 * pi * constant * (component == 0 ? qx : qy) / (qx * qx + qy * qy);
          },
          parity);
    };
    set(0, Parity::odd_along_x);
    set(1, Parity::odd_along_y);
  }

  void set_free(double constant) {
    const Index nx = kernels.shape().period_x, ny = kernels.shape().period_y;
    RealFft2D<double> fft(nx, ny);
    Field kernel(nx, ny);
    std::vector<std::complex<double>> modes(static_cast<std::size_t>(nx * fft.modes_y()));
    const auto set = [&](int component, Parity parity, auto integral) {
      parallel::for_slabs(nx, [&](Index begin, Index end) {
        for (Index a = begin; a < end; ++a)
          for (Index b = 0; b < ny; ++b) {
            // Values of the kernel at a distance of half a period are never used; with 0 there, the
            // kernel stays odd.
            const Index i = 2 * a > nx ? a - nx : a, j = 2 * b > ny ? b - ny : b;
            const bool halfway = component == 0 ? 2 * a == nx : 2 * b == ny;
            kernel(a, b) = halfway ? 0
                                   : constant * integral(static_cast<double>(i) * grid.dx(),
                                                         static_cast<double>(j) * grid.dy());
          }
      });
      fft.forward(kernel.data(), modes.data());
      kernels.set_symbol(
          0, component,
          [&](Index i, Index j) {
            return modes[static_cast<std::size_t>(i * fft.modes_y() + j)].imag();
          },
          parity);
    };
    set(0, Parity::odd_along_x,
        [&](double x, double y) { return cell_gradient_integral(x, y, grid.dx(), grid.dy()); });
    set(1, Parity::odd_along_y,
        [&](double x, double y) { return cell_gradient_integral(y, x, grid.dy(), grid.dx()); });
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
  Field displacement(p.grid.nx, p.grid.ny);
  p.kernels.apply(
      [&](int component, Index row, double*) {
        return (component == 0 ? traction.x : traction.y).data() + row * p.grid.ny;
      },
      [&](int component, Index row, const double* values) {
        if (component == 0) std::copy_n(values, p.grid.ny, displacement.data() + row * p.grid.ny);
      });
  return displacement;
}

TangentialField NormalTangentialCoupling::tangential_displacement(const Field& pressure) {
  Parts& p = *parts_;
  p.require_field(pressure, "pressure");
  TangentialField displacement{Field(p.grid.nx, p.grid.ny), Field(p.grid.nx, p.grid.ny)};
  p.kernels.apply(
      [&](int component, Index row, double*) {
        return component == 0 ? pressure.data() + row * p.grid.ny : nullptr;
      },
      [&](int component, Index row, const double* values) {
        double* to = (component == 0 ? displacement.x : displacement.y).data() + row * p.grid.ny;
        std::transform(values, values + p.grid.ny, to, std::negate<>());
      });
  return displacement;
}

}  // namespace salebra
