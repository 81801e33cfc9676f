// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <salebra/base/error.hpp>
#include <type_traits>

namespace salebra::detail {

// Only FFTW's planner has shared state; this lock guards making and destroying plans.
std::mutex& fftw_planner_mutex();

// FFTW's functions for float and double under one set of names.
template <class Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Complex = fftw_complex;
  static constexpr auto plan_r2c_2d = fftw_plan_dft_r2c_2d;
  static constexpr auto plan_c2r_2d = fftw_plan_dft_c2r_2d;
  static constexpr auto plan_many_r2c = fftw_plan_many_dft_r2c;
  static constexpr auto plan_many_c2r = fftw_plan_many_dft_c2r;
  static constexpr auto plan_many = fftw_plan_many_dft;
  static constexpr auto plan_r2c_1d = fftw_plan_dft_r2c_1d;
  static constexpr auto plan_c2r_1d = fftw_plan_dft_c2r_1d;
  static constexpr auto plan_1d = fftw_plan_dft_1d;
  static constexpr auto execute_r2c = fftw_execute_dft_r2c;
  static constexpr auto execute_c2r = fftw_execute_dft_c2r;
  static constexpr auto execute = fftw_execute_dft;
  static constexpr auto destroy = fftw_destroy_plan;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Complex = fftwf_complex;
  static constexpr auto plan_r2c_2d = fftwf_plan_dft_r2c_2d;
  static constexpr auto plan_c2r_2d = fftwf_plan_dft_c2r_2d;
  static constexpr auto plan_many_r2c = fftwf_plan_many_dft_r2c;
  static constexpr auto plan_many_c2r = fftwf_plan_many_dft_c2r;
  static constexpr auto plan_many = fftwf_plan_many_dft;
  static constexpr auto plan_r2c_1d = fftwf_plan_dft_r2c_1d;
  static constexpr auto plan_c2r_1d = fftwf_plan_dft_c2r_1d;
  static constexpr auto plan_1d = fftwf_plan_dft_1d;
  static constexpr auto execute_r2c = fftwf_execute_dft_r2c;
  static constexpr auto execute_c2r = fftwf_execute_dft_c2r;
  static constexpr auto execute = fftwf_execute_dft;
  static constexpr auto destroy = fftwf_destroy_plan;
};

template <class Real>
struct DestroyPlan {
  void operator()(typename Fftw<Real>::Plan plan) const {
    const std::scoped_lock lock(fftw_planner_mutex());
    Fftw<Real>::destroy(plan);
  }
};

template <class Real>
using FftwPlan =
    std::unique_ptr<std::remove_pointer_t<typename Fftw<Real>::Plan>, DestroyPlan<Real>>;

// Whether an exception interrupted the making of a plan: a program may turn FFTW's lack of memory
// into an exception, which leaves the tables of FFTW's planner inconsistent.
template <class Real>
inline bool planner_is_broken = false;

// Calls `make`, which returns a plan of FFTW, under the lock of FFTW's planner.
template <class Real, class Make>
FftwPlan<Real> plan(Make make) {
  typename Fftw<Real>::Plan made = nullptr;
  {
    const std::scoped_lock lock(fftw_planner_mutex());
    if (planner_is_broken<Real>) throw std::bad_alloc();
    planner_is_broken<Real> = true;
    made = make();
    planner_is_broken<Real> = false;
  }
  if (!made) throw Error("fft: FFTW could not make a plan");
  return FftwPlan<Real>(made);
}

// Alignment for FFTW's widest SIMD code. fftw_malloc is not used because it would end the process
// if memory runs out.
inline constexpr std::align_val_t fftw_alignment{64};

struct ReleaseFftw {
  void operator()(void* memory) const { ::operator delete(memory, fftw_alignment); }
};

// An array that is not initialised: each memory page is placed near the processor of the thread
// that first writes to the page.
template <class Element>
using FftwArray = std::unique_ptr<Element[], ReleaseFftw>;

template <class Element>
FftwArray<Element> fftw_array(std::size_t size) {
  return FftwArray<Element>(
      static_cast<Element*>(::operator new(size * sizeof(Element), fftw_alignment)));
}

}  // namespace salebra::detail
