// SPDX-License-Identifier: GPL-3.0-or-later
#include <fftw3.h>

#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <type_traits>

namespace salebra {
namespace {

// FFTW's planner, and only its planner, is shared state: one lock around making and destroying plans.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

// The two precisions of FFTW behind one set of names.
template <class Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Complex = fftw_complex;
  static constexpr auto plan_r2c = fftw_plan_dft_r2c_2d;
  static constexpr auto plan_c2r = fftw_plan_dft_c2r_2d;
  static constexpr auto execute_r2c = fftw_execute_dft_r2c;
  static constexpr auto execute_c2r = fftw_execute_dft_c2r;
  static constexpr auto destroy = fftw_destroy_plan;
  static constexpr auto allocate = fftw_malloc;
  static constexpr auto release = fftw_free;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Complex = fftwf_complex;
  static constexpr auto plan_r2c = fftwf_plan_dft_r2c_2d;
  static constexpr auto plan_c2r = fftwf_plan_dft_c2r_2d;
  static constexpr auto execute_r2c = fftwf_execute_dft_r2c;
  static constexpr auto execute_c2r = fftwf_execute_dft_c2r;
  static constexpr auto destroy = fftwf_destroy_plan;
  static constexpr auto allocate = fftwf_malloc;
  static constexpr auto release = fftwf_free;
};

}  // namespace

template <class Real>
struct RealFft2D<Real>::Plans {
  using Api = Fftw<Real>;
  Index nx, ny;
  typename Api::Plan forward = nullptr;
  typename Api::Plan backward = nullptr;

  Plans(Index rows, Index columns) : nx(rows), ny(columns) {
    require(nx >= 1 && nx < 1 << 24, "nx", nx, "must lie in 1 … 2^24");
    require(ny >= 1 && ny < 1 << 24, "ny", ny, "must lie in 1 … 2^24");
    // FFTW_ESTIMATE does not touch the arrays and, unlike FFTW_MEASURE, chooses the same plan in every run.
    const std::scoped_lock lock(planner_mutex());
    const std::size_t modes = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny / 2 + 1);
    auto* complex = static_cast<typename Api::Complex*>(
        Api::allocate(modes * sizeof(typename Api::Complex)));
    auto* real = static_cast<Real*>(Api::allocate(2 * modes * sizeof(Real)));
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    forward = Api::plan_r2c(static_cast<int>(nx), static_cast<int>(ny), real, complex,
                            flags | FFTW_PRESERVE_INPUT);
    backward = Api::plan_c2r(static_cast<int>(nx), static_cast<int>(ny), complex, real,
                             flags | FFTW_DESTROY_INPUT);
    Api::release(real);
    Api::release(complex);
    if (!forward || !backward) throw Error("fft: FFTW could not make a plan");
  }
  ~Plans() {
    const std::scoped_lock lock(planner_mutex());
    Api::destroy(forward);
    Api::destroy(backward);
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
  // FFTW_PRESERVE_INPUT: the cast only satisfies FFTW's signature.
  Fftw<Real>::execute_r2c(plans_->forward, const_cast<Real*>(field),
                          reinterpret_cast<typename Fftw<Real>::Complex*>(modes));
}

template <class Real>
void RealFft2D<Real>::backward(std::complex<Real>* modes, Real* field) {
  Fftw<Real>::execute_c2r(plans_->backward,
                          reinterpret_cast<typename Fftw<Real>::Complex*>(modes), field);
}

template class RealFft2D<float>;
template class RealFft2D<double>;

}  // namespace salebra
