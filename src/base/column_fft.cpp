// SPDX-License-Identifier: GPL-3.0-or-later
// Real field from the columns of its half-spectrum, so that no full complex array is held.
#include <algorithm>
#include <salebra/base/column_fft.hpp>
#include <salebra/base/loop_progress.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "fftw.hpp"

namespace salebra {
namespace {

using Api = detail::Fftw<double>;
using Complex = std::complex<double>;

// Columns that are copied to the rows together: 16 of them fill two cache lines of each row they touch.
constexpr Index block = 16;

constexpr const char* stage = "surface";

fftw_complex* fftw(Complex* values) { return reinterpret_cast<fftw_complex*>(values); }

// An odd length of columns would break the alignment of every second one.
Index column_pitch(Index nx) { return (nx + 3) / 4 * 4; }

// Plans differ in what alignment they need; every buffer here comes from FFTW's allocator, hence has the same.
detail::FftwPlan<double> plan_column(Index nx) {
  const auto buffer = detail::fftw_array<double, Complex>(static_cast<std::size_t>(nx));
  const int n = static_cast<int>(nx);
  return detail::plan<double>([&] {
    return Api::plan_many(1, &n, 1, fftw(buffer.get()), nullptr, 1, n, fftw(buffer.get()), nullptr,
                          1, n, FFTW_BACKWARD, FFTW_ESTIMATE);
  });
}

detail::FftwPlan<double> plan_row(Index ny) {
  const auto modes = detail::fftw_array<double, Complex>(static_cast<std::size_t>(ny / 2 + 1));
  const auto values = detail::fftw_array<double>(static_cast<std::size_t>(ny));
  const int n = static_cast<int>(ny);
  return detail::plan<double>([&] {
    return Api::plan_many_c2r(1, &n, 1, fftw(modes.get()), nullptr, 1, n / 2 + 1, values.get(),
                              nullptr, 1, n, FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  });
}

}  // namespace

Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress) {
  require(columns >= 1 && columns <= ny / 2 + 1, "columns", columns, "must lie in 1 … ny/2+1");
  Field field = uninitialised_field(nx, ny);
  touch_pages(field);
  // ny values hold ny/2 modes; where there is one more, it stands apart.
  const Index stored = std::min(columns, ny / 2);
  std::vector<Complex> last_column(static_cast<std::size_t>(columns > stored ? nx : 0));

  const Index pitch = column_pitch(nx);
  const auto column_plan = plan_column(nx);
  LoopProgress of_columns(progress, stage, columns, 0, 0.7);
  parallel::for_slabs((columns + block - 1) / block, [&](Index begin, Index end) {
    const auto buffer =
        detail::fftw_array<double, Complex>(static_cast<std::size_t>(block * pitch));
    for (Index group = begin; group < end && of_columns.running(); ++group) {
      const Index first = group * block, count = std::min(block, columns - first);
      for (Index k = 0; k < count; ++k) {
        Complex* modes = buffer.get() + k * pitch;
        column(first + k, {modes, static_cast<std::size_t>(nx)});
        Api::execute(column_plan.get(), fftw(modes), fftw(modes));
      }
      const Index within = std::min(count, stored - first);
      for (Index x = 0; x < nx; ++x) {
        double* row = field.data() + x * ny + 2 * first;
        for (Index k = 0; k < within; ++k) {
          row[2 * k] = buffer[static_cast<std::size_t>(k * pitch + x)].real();
          row[2 * k + 1] = buffer[static_cast<std::size_t>(k * pitch + x)].imag();
        }
      }
      if (within < count) std::copy_n(buffer.get() + within * pitch, nx, last_column.begin());
      of_columns.advance(count);
    }
  });
  of_columns.finish();

  const auto row_plan = plan_row(ny);
  LoopProgress of_rows(progress, stage, nx, 0.7, 1);
  parallel::for_slabs(nx, [&](Index begin, Index end) {
    const auto modes = detail::fftw_array<double, Complex>(static_cast<std::size_t>(ny / 2 + 1));
    const auto values = detail::fftw_array<double>(static_cast<std::size_t>(ny));
    for (Index x = begin; x < end && of_rows.running(); ++x) {
      double* row = field.data() + x * ny;
      std::copy_n(row, 2 * stored, reinterpret_cast<double*>(modes.get()));
      std::fill(modes.get() + stored, modes.get() + ny / 2 + 1, Complex{});
      if (columns > stored)
        modes[static_cast<std::size_t>(stored)] = last_column[static_cast<std::size_t>(x)];
      Api::execute_c2r(row_plan.get(), fftw(modes.get()), values.get());
      std::copy_n(values.get(), ny, row);
      of_rows.advance();
    }
  });
  of_rows.finish();
  return field;
}

std::size_t column_fft_memory(Index nx, Index ny) {
  const Index for_columns = block * column_pitch(nx), for_rows = ny / 2 + 1 + (ny + 1) / 2;
  const Index complex_values = nx + parallel::threads() * std::max(for_columns, for_rows);
  return static_cast<std::size_t>(nx * ny) * sizeof(double) +
         static_cast<std::size_t>(complex_values) * sizeof(Complex);
}

}  // namespace salebra
