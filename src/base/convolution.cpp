// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <salebra/base/convolution.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "fftw.hpp"

namespace salebra {
namespace {

// Rows that are turned into columns together: 16 complex numbers of a column are one or more whole cache lines.
constexpr Index rows_at_once = 16;

// Added to the length of a column, so that equal rows of all columns do not fall into one set of the cache.
constexpr Index gap_between_columns = 8;

std::size_t count(Index number) { return static_cast<std::size_t>(number); }

}  // namespace

// The spectrum is kept column by column. A transform of contiguous numbers is about three times faster than one of strided
// numbers, and a column with its symbol stays in the first-level cache from the forward transform to the backward one.
template <class Real>
struct Convolution2D<Real>::Passes {
  using Api = detail::Fftw<Real>;
  using Complex = std::complex<Real>;

  Shape shape;
  int components;
  Index modes;                                // in y: the number of columns
  Index column_stride;                        // from one column to the next
  detail::FftwArray<Real, Complex> spectrum;  // [component][column][row]
  struct Table {
    detail::FftwArray<Real> values;  // [column][i = 0 … period_x/2], with 1/points of the transform
    Parity parity = Parity::even;
  };
  std::array<Table, 3> tables;  // K_00, K_01 = K_10, K_11
  detail::FftwPlan<Real> row_forward, row_backward, column_forward, column_backward;

  Passes(const Shape& fields, int number) : shape(fields), components(number) {
    require(shape.nx >= 1 && shape.ny >= 1, "nx, ny", std::min(shape.nx, shape.ny), "must be >= 1");
    require(shape.period_x >= shape.nx && shape.period_x < 1 << 24, "period_x", shape.period_x,
            "must be >= nx and below 2^24");
    require(shape.period_y >= shape.ny && shape.period_y < 1 << 24, "period_y", shape.period_y,
            "must be >= ny and below 2^24");
    require(components == 1 || components == 2, "components", components, "must be 1 or 2");
    modes = shape.period_y / 2 + 1;
    column_stride =
        (shape.period_x + gap_between_columns - 1) / gap_between_columns * gap_between_columns +
        gap_between_columns;
    spectrum = detail::fftw_array<Real, Complex>(count(components * modes * column_stride));
    make_plans();
  }

  // Room for one row, real or complex, so that the next begins on a new cache line.
  Index row_stride() const { return (modes + 15) / 16 * 16; }
  Index points() const { return shape.period_x * shape.period_y; }
  Index table_rows() const { return shape.period_x / 2 + 1; }
  Complex* column(int component, Index index) {
    return spectrum.get() + (component * modes + index) * column_stride;
  }
  static typename Api::Complex* raw(Complex* numbers) {
    return reinterpret_cast<typename Api::Complex*>(numbers);
  }

  void make_plans() {
    const auto row = detail::fftw_array<Real>(count(2 * row_stride()));
    const auto row_modes = detail::fftw_array<Real, Complex>(count(row_stride()));
    const auto scratch = detail::fftw_array<Real, Complex>(count(column_stride));
    const int ny = static_cast<int>(shape.period_y), nx = static_cast<int>(shape.period_x);
    // FFTW_ESTIMATE chooses the same plan, hence the same bits, in every run.
    row_forward = detail::plan<Real>(
        [&] { return Api::plan_r2c_1d(ny, row.get(), raw(row_modes.get()), FFTW_ESTIMATE); });
    row_backward = detail::plan<Real>(
        [&] { return Api::plan_c2r_1d(ny, raw(row_modes.get()), row.get(), FFTW_ESTIMATE); });
    column_forward = detail::plan<Real>([&] {
      return Api::plan_1d(nx, raw(spectrum.get()), raw(scratch.get()), FFTW_FORWARD, FFTW_ESTIMATE);
    });
    column_backward = detail::plan<Real>([&] {
      return Api::plan_1d(nx, raw(scratch.get()), raw(spectrum.get()), FFTW_BACKWARD,
                          FFTW_ESTIMATE);
    });
  }

  void set_symbol(int a, int b, const Symbol& symbol, Parity parity) {
    Table& table = tables[static_cast<std::size_t>(a + b)];
    table.parity = parity;
    table.values = detail::fftw_array<Real>(count(modes * table_rows()));
    const double in_all = static_cast<double>(points());
    parallel::for_slabs(
        modes,
        [&](Index begin, Index end) {
          for (Index j = begin; j < end; ++j)
            for (Index i = 0; i < table_rows(); ++i)
              table.values[count(j * table_rows() + i)] = static_cast<Real>(symbol(i, j) / in_all);
        },
        points());
  }

  // Rows of the fields, zero-padded to the period, into the columns.
  void rows_forward(const Real* const* fields) {
    parallel::for_slabs(
        shape.nx,
        [&](Index begin, Index end) {
          const auto row = detail::fftw_array<Real>(count(2 * row_stride()));
          const auto row_modes =
              detail::fftw_array<Real, Complex>(count(rows_at_once * row_stride()));
          for (int component = 0; component < components; ++component)
            for (Index first = begin; first < end; first += rows_at_once) {
              const Index rows = std::min(rows_at_once, end - first);
              for (Index i = 0; i < rows; ++i) {
                const Real* field = fields[component] + (first + i) * shape.ny;
                std::fill(std::copy(field, field + shape.ny, row.get()), row.get() + shape.period_y,
                          Real(0));
                Api::execute_r2c(row_forward.get(), row.get(),
                                 raw(row_modes.get() + i * row_stride()));
              }
              for (Index j = 0; j < modes; ++j) {
                Complex* to = column(component, j) + first;
                for (Index i = 0; i < rows; ++i) to[i] = row_modes[count(i * row_stride() + j)];
              }
            }
        },
        points());
  }

  void columns() {
    parallel::for_slabs(
        modes,
        [&](Index begin, Index end) {
          const auto scratch = detail::fftw_array<Real, Complex>(count(components * column_stride));
          for (Index j = begin; j < end; ++j) {
            for (int component = 0; component < components; ++component) {
              Complex* numbers = column(component, j);
              std::fill(numbers + shape.nx, numbers + shape.period_x, Complex{});
              Api::execute(column_forward.get(), raw(numbers),
                           raw(scratch.get() + component * column_stride));
            }
            if (components == 1) {
              multiply(j, scratch.get());
            } else {
              multiply_pair(j, scratch.get(), scratch.get() + column_stride);
            }
            for (int component = 0; component < components; ++component)
              Api::execute(column_backward.get(), raw(scratch.get() + component * column_stride),
                           raw(column(component, j)));
          }
        },
        points());
  }

  void multiply(Index j, Complex* numbers) const {
    const Real* symbol = tables[0].values.get() + j * table_rows();
    const Real sign = tables[0].parity == Parity::odd ? Real(-1) : Real(1);
    for (Index i = 0; i < table_rows(); ++i) numbers[i] *= symbol[i];
    for (Index i = 1; i < shape.period_x - shape.period_x / 2; ++i)
      numbers[shape.period_x - i] *= sign * symbol[i];
  }

  void multiply_pair(Index j, Complex* first, Complex* second) const {
    std::array<const Real*, 3> symbol;
    std::array<Real, 3> sign;
    for (std::size_t t = 0; t < 3; ++t) {
      symbol[t] = tables[t].values.get() + j * table_rows();
      sign[t] = tables[t].parity == Parity::odd ? Real(-1) : Real(1);
    }
    const auto at = [&](Index place, Index i, Real s0, Real s1, Real s2) {
      const Complex x = first[place], y = second[place];
      first[place] = s0 * symbol[0][i] * x + s1 * symbol[1][i] * y;
      second[place] = s1 * symbol[1][i] * x + s2 * symbol[2][i] * y;
    };
    for (Index i = 0; i < table_rows(); ++i) at(i, i, 1, 1, 1);
    for (Index i = 1; i < shape.period_x - shape.period_x / 2; ++i)
      at(shape.period_x - i, i, sign[0], sign[1], sign[2]);
  }

  void rows_backward(Real* const* results) {
    parallel::for_slabs(
        shape.nx,
        [&](Index begin, Index end) {
          const auto row = detail::fftw_array<Real>(count(2 * row_stride()));
          const auto row_modes =
              detail::fftw_array<Real, Complex>(count(rows_at_once * row_stride()));
          for (int component = 0; component < components; ++component)
            for (Index first = begin; first < end; first += rows_at_once) {
              const Index rows = std::min(rows_at_once, end - first);
              for (Index j = 0; j < modes; ++j) {
                const Complex* from = column(component, j) + first;
                for (Index i = 0; i < rows; ++i) row_modes[count(i * row_stride() + j)] = from[i];
              }
              for (Index i = 0; i < rows; ++i) {
                Api::execute_c2r(row_backward.get(), raw(row_modes.get() + i * row_stride()),
                                 row.get());
                std::copy(row.get(), row.get() + shape.ny,
                          results[component] + (first + i) * shape.ny);
              }
            }
        },
        points());
  }

  void apply(const Real* const* fields, Real* const* results) {
    for (int t = 0; t < (components == 1 ? 1 : 3); ++t)
      if (tables[static_cast<std::size_t>(t)].values == nullptr)
        set_symbol(
            t / 2, t - t / 2, [](Index, Index) { return 0.0; }, Parity::even);
    rows_forward(fields);
    columns();
    rows_backward(results);
  }
};

template <class Real>
Convolution2D<Real>::Convolution2D(const Shape& shape, int components)
    : passes_(std::make_unique<Passes>(shape, components)) {}
template <class Real>
Convolution2D<Real>::Convolution2D(Convolution2D&&) noexcept = default;
template <class Real>
Convolution2D<Real>& Convolution2D<Real>::operator=(Convolution2D&&) noexcept = default;
template <class Real>
Convolution2D<Real>::~Convolution2D() = default;

template <class Real>
const typename Convolution2D<Real>::Shape& Convolution2D<Real>::shape() const {
  return passes_->shape;
}

template <class Real>
void Convolution2D<Real>::set_symbol(int a, int b, const Symbol& symbol, Parity parity) {
  require(a >= 0 && a < passes_->components && b >= 0 && b < passes_->components, "component",
          std::max(a, b), "must be below the number of components");
  passes_->set_symbol(a, b, symbol, parity);
}

template <class Real>
void Convolution2D<Real>::apply(const Real* field, Real* result) {
  require(passes_->components == 1, "components", passes_->components,
          "must be 1 to transform one field");
  passes_->apply(&field, &result);
}

template <class Real>
void Convolution2D<Real>::apply(const std::array<const Real*, 2>& fields,
                                const std::array<Real*, 2>& results) {
  require(passes_->components == 2, "components", passes_->components,
          "must be 2 to transform two fields");
  passes_->apply(fields.data(), results.data());
}

template class Convolution2D<float>;
template class Convolution2D<double>;

Index fast_transform_size(Index size) {
  if (size <= 1) return 1;
  for (Index candidate = size + size % 2;; candidate += 2) {
    Index rest = candidate;
    for (const Index factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return candidate;
  }
}

}  // namespace salebra
