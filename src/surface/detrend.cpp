// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/QR>
#include <cmath>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>

namespace salebra {
namespace {

/// Coordinates that run from −1 to 1 keep the normal equations well conditioned for any size and
/// shape of the grid.
double centred(Index i, Index n) {
  return n > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0 : 0.0;
}

void subtract_plane(Surface& surface) {
  const auto [nx, ny] = std::pair(surface.grid.nx, surface.grid.ny);
  const double mean = height_statistics(surface).mean;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Index ix = 0; ix < nx; ++ix) {
    for (Index iy = 0; iy < ny; ++iy) {
      const double height = surface.heights(ix, iy);
      if (std::isnan(height)) continue;
      const Eigen::Vector3d basis(1, centred(ix, nx), centred(iy, ny));
      normal += basis * basis.transpose();
      right += basis * (height - mean);
    }
  }
  const Eigen::Vector3d plane = normal.completeOrthogonalDecomposition().solve(right);
  for (Index ix = 0; ix < nx; ++ix)
    for (Index iy = 0; iy < ny; ++iy)
      surface.heights(ix, iy) -=
          mean + plane(0) + plane(1) * centred(ix, nx) + plane(2) * centred(iy, ny);
}

}  // namespace

Detrend customary_detrend(const Surface& surface) {
  return surface.periodic ? Detrend::mean : Detrend::plane;
}

Surface detrended(Surface surface, Detrend method) {
  switch (method) {
    case Detrend::none:
      break;
    case Detrend::mean:
      surface.heights -= height_statistics(surface).mean;
      break;
    case Detrend::plane:
      subtract_plane(surface);
      break;
  }
  return surface;
}

}  // namespace salebra
