// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <salebra/base/convolution.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "fftw.hpp"

namespace salebra {
namespace {

// Columns that are transformed together: one row of a block is two cache lines.
template <class Real>
constexpr Index block_columns = 128 / static_cast<Index>(2 * sizeof(Real));

// Rows between the blocks, so that equal rows of all blocks do not fall into one set of the cache.
constexpr Index rows_between_blocks = 3;

std::size_t bytes_to(Index count) { return static_cast<std::size_t>(count); }

}  // namespace

template <class Real>
struct Convolution2D<Real>::Passes {
  using Api = detail::Fftw<Real>;
  using Complex = std::complex<Real>;
  static constexpr Index width = block_columns<Real>;

  Shape shape;
  int components;
  Index modes;                                // in y
  Index blocks;                               // of columns
  Index block_size;                           // complex numbers from one block to the next
  detail::FftwArray<Real, Complex> spectrum;  // [component][block][row][column of the block]
  struct Table {
    std::vector<Real>
        values;  // [block][i = 0 … period_x/2][column of the block], with 1/points of the transform
    Parity parity = Parity::even;
  };
  std::array<Table, 3> tables;  // K_00, K_01 = K_10, K_11
  detail::FftwPlan<Real> row_forward, row_backward, column_forward, column_backward;

  Passes(const Shape& fields, int count) : shape(fields), components(count) {
    require(shape.nx >= 1 && shape.ny >= 1, "nx, ny", std::min(shape.nx, shape.ny), "must be >= 1");
    require(shape.period_x >= shape.nx && shape.period_x < 1 << 24, "period_x", shape.period_x,
            "must be >= nx and below 2^24");
    require(shape.period_y >= shape.ny && shape.period_y < 1 << 24, "period_y", shape.period_y,
            "must be >= ny and below 2^24");
    require(components == 1 || components == 2, "components", components, "must be 1 or 2");
    modes = shape.period_y / 2 + 1;
    blocks = (modes + width - 1) / width;
    block_size = (shape.period_x + rows_between_blocks) * width;
    spectrum = detail::fftw_array<Real, Complex>(bytes_to(components * blocks * block_size));
    make_plans();
    // The last block has columns that no row fills: they are transformed with the others and must hold numbers.
    parallel::for_slabs(components * blocks, [&](Index begin, Index end) {
      std::fill(spectrum.get() + begin * block_size, spectrum.get() + end * block_size, Complex{});
    });
  }

  void make_plans() {
    const auto row = detail::fftw_array<Real>(bytes_to(row_length()));
    const auto row_modes = detail::fftw_array<Real, Complex>(bytes_to(blocks * width));
    auto* column = reinterpret_cast<typename Api::Complex*>(spectrum.get());
    auto* complex_row = reinterpret_cast<typename Api::Complex*>(row_modes.get());
    const int ny = static_cast<int>(shape.period_y), nx = static_cast<int>(shape.period_x);
    const int howmany = static_cast<int>(width);
    const unsigned flags = FFTW_ESTIMATE;
    row_forward = detail::plan<Real>([&] {
      return Api::plan_many_r2c(1, &ny, 1, row.get(), nullptr, 1, 0, complex_row, nullptr, 1, 0,
                                flags);
    });
    row_backward = detail::plan<Real>([&] {
      return Api::plan_many_c2r(1, &ny, 1, complex_row, nullptr, 1, 0, row.get(), nullptr, 1, 0,
                                flags);
    });
    column_forward = detail::plan<Real>([&] {
      return Api::plan_many(1, &nx, howmany, column, nullptr, howmany, 1, column, nullptr, howmany,
                            1, FFTW_FORWARD, flags);
    });
    column_backward = detail::plan<Real>([&] {
      return Api::plan_many(1, &nx, howmany, column, nullptr, howmany, 1, column, nullptr, howmany,
                            1, FFTW_BACKWARD, flags);
    });
  }

  Index row_length() const { return 2 * modes; }
  Index points() const { return shape.period_x * shape.period_y; }
  Complex* block(int component, Index index) {
    return spectrum.get() + (component * blocks + index) * block_size;
  }
  static int table_of(int a, int b) { return a + b; }

  void set_symbol(int a, int b, const Symbol& symbol, Parity parity) {
    Table& table = tables[static_cast<std::size_t>(table_of(a, b))];
    const Index rows = shape.period_x / 2 + 1;
    table.parity = parity;
    table.values.assign(bytes_to(blocks * rows * width), Real(0));
    const double modes_in_all =
        static_cast<double>(shape.period_x) * static_cast<double>(shape.period_y);
    parallel::for_slabs(
        blocks,
        [&](Index begin, Index end) {
          for (Index index = begin; index < end; ++index)
            for (Index i = 0; i < rows; ++i)
              for (Index c = 0; c < width && index * width + c < modes; ++c)
                table.values[bytes_to((index * rows + i) * width + c)] =
                    static_cast<Real>(symbol(i, index * width + c) / modes_in_all);
        },
        points());
  }

  // Rows of the fields, zero-padded to the period, into the blocks.
  void rows_forward(const Real* const* fields) {
    parallel::for_slabs(
        shape.nx,
        [&](Index begin, Index end) {
          const auto row = detail::fftw_array<Real>(bytes_to(row_length()));
          const auto row_modes = detail::fftw_array<Real, Complex>(bytes_to(blocks * width));
          for (int component = 0; component < components; ++component)
            for (Index i = begin; i < end; ++i) {
              const Real* field = fields[component] + i * shape.ny;
              std::fill(std::copy(field, field + shape.ny, row.get()), row.get() + shape.period_y,
                        Real(0));
              Api::execute_r2c(row_forward.get(), row.get(),
                               reinterpret_cast<typename Api::Complex*>(row_modes.get()));
              for (Index index = 0; index < blocks; ++index) {
                const Complex* from = row_modes.get() + index * width;
                std::copy(from, from + std::min(width, modes - index * width),
                          block(component, index) + i * width);
              }
            }
        },
        points());
  }

  void columns() {
    parallel::for_slabs(
        blocks,
        [&](Index begin, Index end) {
          for (Index index = begin; index < end; ++index) {
            for (int component = 0; component < components; ++component) {
              Complex* column = block(component, index);
              std::fill(column + shape.nx * width, column + shape.period_x * width, Complex{});
              transform(column_forward, column);
            }
            if (components == 1) {
              multiply(index);
            } else {
              multiply_pair(index);
            }
            for (int component = 0; component < components; ++component)
              transform(column_backward, block(component, index));
          }
        },
        points());
  }

  void transform(const detail::FftwPlan<Real>& plan, Complex* column) {
    auto* data = reinterpret_cast<typename Api::Complex*>(column);
    Api::execute(plan.get(), data, data);
  }

  // The symbol of row i, and its sign there.
  const Real* symbol_row(const Table& table, Index index, Index i) const {
    const Index rows = shape.period_x / 2 + 1;
    return table.values.data() + (index * rows + std::min(i, shape.period_x - i)) * width;
  }
  Real sign(const Table& table, Index i) const {
    return table.parity == Parity::odd && i > shape.period_x / 2 ? Real(-1) : Real(1);
  }

  void multiply(Index index) {
    Complex* column = block(0, index);
    for (Index i = 0; i < shape.period_x; ++i) {
      const Real* symbol = symbol_row(tables[0], index, i);
      Complex* mode = column + i * width;
      const Real factor = sign(tables[0], i);
      for (Index c = 0; c < width; ++c) mode[c] *= factor * symbol[c];
    }
  }

  void multiply_pair(Index index) {
    for (Index i = 0; i < shape.period_x; ++i) {
      std::array<const Real*, 3> symbol;
      std::array<Real, 3> factor;
      for (std::size_t t = 0; t < 3; ++t) {
        symbol[t] = symbol_row(tables[t], index, i);
        factor[t] = sign(tables[t], i);
      }
      Complex* first = block(0, index) + i * width;
      Complex* second = block(1, index) + i * width;
      for (Index c = 0; c < width; ++c) {
        const Complex x = first[c], y = second[c];
        const Real mixed = factor[1] * symbol[1][c];
        first[c] = factor[0] * symbol[0][c] * x + mixed * y;
        second[c] = mixed * x + factor[2] * symbol[2][c] * y;
      }
    }
  }

  void rows_backward(Real* const* results) {
    parallel::for_slabs(
        shape.nx,
        [&](Index begin, Index end) {
          const auto row = detail::fftw_array<Real>(bytes_to(row_length()));
          const auto row_modes = detail::fftw_array<Real, Complex>(bytes_to(blocks * width));
          for (int component = 0; component < components; ++component)
            for (Index i = begin; i < end; ++i) {
              for (Index index = 0; index < blocks; ++index) {
                const Complex* from = block(component, index) + i * width;
                std::copy(from, from + width, row_modes.get() + index * width);
              }
              Api::execute_c2r(row_backward.get(),
                               reinterpret_cast<typename Api::Complex*>(row_modes.get()),
                               row.get());
              std::copy(row.get(), row.get() + shape.ny, results[component] + i * shape.ny);
            }
        },
        points());
  }

  void apply(const Real* const* fields, Real* const* results) {
    for (int t = 0; t < (components == 1 ? 1 : 3); ++t)
      if (Table& table = tables[static_cast<std::size_t>(t)]; table.values.empty())
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
