// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <memory>
#include <salebra/base/grid.hpp>

namespace salebra {

/// Real two-dimensional discrete Fourier transform, unnormalised in both directions:
///     forward:  F(i, j) = Σ_ab f(a, b) exp(−2πi(ia/nx + jb/ny)),  i = 0 … nx−1, j = 0 … ny/2
///     backward: f(a, b) = Σ_ij F(i, j) exp(+2πi(ia/nx + jb/ny)) over the full Hermitian spectrum,
/// hence backward(forward(f)) = nx·ny·f. Fields are (nx, ny), half-spectra (nx, ny/2+1), both
/// contiguous with x as the first index. The result has the same bits for every thread count. Real
/// is float or double. FFTW's planner is not thread-safe, so planning is serialised. Several
/// threads may call forward() of one object at once, but only one thread backward().
template <class Real>
class RealFft2D {
 public:
  RealFft2D(Index nx, Index ny);
  RealFft2D(RealFft2D&&) noexcept;
  RealFft2D& operator=(RealFft2D&&) noexcept;
  ~RealFft2D();

  Index nx() const;
  Index ny() const;
  Index modes_y() const { return ny() / 2 + 1; }

  /// Reads field (nx, ny) and overwrites modes (nx, ny/2+1).
  void forward(const Real* field, std::complex<Real>* modes);
  /// Destroys modes and overwrites field.
  void backward(std::complex<Real>* modes, Real* field);

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

extern template class RealFft2D<float>;
extern template class RealFft2D<double>;

}  // namespace salebra
