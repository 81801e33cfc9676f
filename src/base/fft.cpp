// SPDX-License-Identifier: GPL-3.0-or-later
// Two-dimensional real-to-complex FFT in float and double, by FFTW; the lock of FFTW's planner.
#include "fft.hpp"

#include "fftw.hpp"

namespace salebra {

std::mutex& detail::fftw_planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

template <class Real>
struct RealFft2D<Real>::Plans {
  using Api = detail::Fftw<Real>;
  Index nx, ny;
  detail::FftwPlan<Real> forward, backward;

  Plans(Index rows, Index columns) : nx(rows), ny(columns) {
    require(nx >= 1 && nx < 1 << 24, "nx", nx, "must lie in 1 … 2^24");
    require(ny >= 1 && ny < 1 << 24, "ny", ny, "must lie in 1 … 2^24");
    const auto modes = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny / 2 + 1);
    const auto complex = detail::fftw_array<typename Api::Complex>(modes);
    const auto real = detail::fftw_array<Real>(2 * modes);
    // FFTW_ESTIMATE does not touch the arrays and, unlike FFTW_MEASURE, chooses the same plan in
    // every run. FFTW_UNALIGNED costs up to half of the speed, but lets one plan serve every array:
    // with a second plan for aligned arrays, the bits would depend on an address.
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    forward = detail::plan<Real>([&] {
      return Api::plan_r2c_2d(static_cast<int>(nx), static_cast<int>(ny), real.get(), complex.get(),
                              flags | FFTW_PRESERVE_INPUT);
    });
    backward = detail::plan<Real>([&] {
      return Api::plan_c2r_2d(static_cast<int>(nx), static_cast<int>(ny), complex.get(), real.get(),
                              flags | FFTW_DESTROY_INPUT);
    });
  }
};

template <class Real>
RealFft2D<Real>::RealFft2D(Index nx, Index ny) : plans_(std::make_unique<Plans>(nx, ny)) {}
template <class Real>
RealFft2D<Real>::RealFft2D(RealFft2D&&) noexcept = default;
template <class Real>
RealFft2D<Real>& RealFft2D<Real>::operator=(RealFft2D&&) noexcept = default;
template <class Real>
RealFft2D<Real>::~RealFft2D() = default;

template <class Real>
Index RealFft2D<Real>::nx() const {
  return plans_->nx;
}
template <class Real>
Index RealFft2D<Real>::ny() const {
  return plans_->ny;
}

template <class Real>
void RealFft2D<Real>::forward(const Real* field, std::complex<Real>* modes) {
  // The plan has FFTW_PRESERVE_INPUT, so FFTW does not write to `field`; the cast only satisfies
  // FFTW's signature.
  detail::Fftw<Real>::execute_r2c(plans_->forward.get(), const_cast<Real*>(field),
                                  reinterpret_cast<typename detail::Fftw<Real>::Complex*>(modes));
}

template <class Real>
void RealFft2D<Real>::backward(std::complex<Real>* modes, Real* field) {
  detail::Fftw<Real>::execute_c2r(plans_->backward.get(),
                                  reinterpret_cast<typename detail::Fftw<Real>::Complex*>(modes),
                                  field);
}

template class RealFft2D<float>;
template class RealFft2D<double>;

}  // namespace salebra
