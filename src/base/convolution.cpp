// SPDX-License-Identifier: GPL-3.0-or-later
// Cyclic convolution of fields with stored kernels by FFT, two real rows in one complex transform.
#include <algorithm>
#include <salebra/base/convolution.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>

#include "fftw.hpp"
#include "spectrum_kernels.hpp"

namespace salebra {
namespace {

// Pairs of rows that are turned into columns together: eight complex numbers of a column are one or two whole cache lines.
constexpr Index pairs_at_once = 8;
// Rows are paired within blocks of so many, and a unit of eight numbers of a column belongs to one block. A process that has whole blocks
// of the rows therefore transforms what any other number of processes would.
constexpr Index rows_at_once = 2 * pairs_at_once;

// Added to the lengths of columns and rows, so that equal places of all of them do not fall into one set of the cache.
constexpr Index gap = 8;

std::size_t count(Index number) { return static_cast<std::size_t>(number); }
Index padded(Index length) { return (length + gap - 1) / gap * gap + gap; }

}  // namespace

// Rows i and i + 8 of a block of 16 are transformed as the real and the imaginary part of one complex row z, because FFTW's complex
// transform takes no longer than its real one. The spectrum is kept column by column: a transform of contiguous numbers is about three
// times faster than one of strided numbers, and a column with its symbol stays in the cache from the forward transform to the
// backward one. There, columns k and −k of z give column k of the field,
//     x_i = (z_i(k) + z_i(−k)*)/2,   x_{i+8} = (z_i(k) − z_i(−k)*)/2i,
// which is all that is needed, since that of −k is its conjugate. The last block may have fewer rows, of which the second half are the
// partners of the first; what is missing of its eight pairs is zero.
template <class Real>
struct Convolution2D<Real>::Passes {
  using Api = detail::Fftw<Real>;
  using Complex = std::complex<Real>;

  const detail::SpectrumKernels<Real>& kernels = detail::spectrum_kernels<Real>();
  Shape shape;
  int components;
  Index blocks;                 // of rows
  Index modes;                  // columns of the field's half-spectrum
  Index column_stride;          // from one column of z to the next
  Complex* spectrum = nullptr;  // [component][column of z][block][pair]
  LargeArray<Complex> own_spectrum;
  struct Table {
    LargeArray<Real> values;  // [column][i = 0 … period_x/2], over 2·points of the transform
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
    blocks = (shape.nx + rows_at_once - 1) / rows_at_once;
    modes = shape.period_y / 2 + 1;
    column_stride = padded(blocks * pairs_at_once);
    make_plans();
  }

  Index points() const { return shape.period_x * shape.period_y; }
  std::size_t spectrum_size() const { return count(components * shape.period_y * column_stride); }
  Index table_rows() const { return shape.period_x / 2 + 1; }
  // Pairs of a block; the last of an odd number of rows is without partner.
  Index pairs(Index block) const {
    return (std::min(rows_at_once, shape.nx - block * rows_at_once) + 1) / 2;
  }
  Complex* column(int component, Index index) {
    return spectrum + (component * shape.period_y + index) * column_stride;
  }
  static Real* real(Complex* numbers) { return reinterpret_cast<Real*>(numbers); }
  static const Real* real(const Complex* numbers) { return reinterpret_cast<const Real*>(numbers); }
  static typename Api::Complex* raw(Complex* numbers) {
    return reinterpret_cast<typename Api::Complex*>(numbers);
  }

  void make_plans() {
    // FFTW_ESTIMATE chooses the same plan, hence the same bits, in every run; arrays of another alignment than these are never used.
    const auto make = [](Index length, int sign) {
      const auto from = large_array<Complex>(count(length)),
                 to = large_array<Complex>(count(length));
      return detail::plan<Real>([&] {
        return Api::plan_1d(static_cast<int>(length), raw(from.get()), raw(to.get()), sign,
                            FFTW_ESTIMATE);
      });
    };
    row_forward = make(shape.period_y, FFTW_FORWARD);
    row_backward = make(shape.period_y, FFTW_BACKWARD);
    column_forward = make(shape.period_x, FFTW_FORWARD);
    column_backward = make(shape.period_x, FFTW_BACKWARD);
  }

  void set_symbol(int a, int b, const Symbol& symbol, Parity parity) {
    Table& table = tables[static_cast<std::size_t>(a + b)];
    table.parity = parity;
    table.values = large_array<Real>(count(modes * table_rows()));
    const double in_all = 2 * static_cast<double>(points());
    parallel::for_slabs(
        modes,
        [&](Index begin, Index end) {
          for (Index j = begin; j < end; ++j)
            for (Index i = 0; i < table_rows(); ++i)
              table.values[count(j * table_rows() + i)] = static_cast<Real>(symbol(i, j) / in_all);
        },
        points());
  }

  // Room for the work on a block.
  struct Room {
    LargeArray<Complex> row, rows;  // one row, and those of all pairs with stride between them
    LargeArray<Real> near, far;     // of the two real rows of a pair
    Index stride;
  };

  // body(block, room) for the blocks of rows.
  template <class Body>
  void for_blocks(const Body& body) {
    const Index stride = padded(shape.period_y);
    parallel::for_slabs(
        blocks,
        [&](Index begin, Index end) {
          const Room room{large_array<Complex>(count(stride)),
                          large_array<Complex>(count(pairs_at_once * stride)),
                          large_array<Real>(count(shape.ny)), large_array<Real>(count(shape.ny)),
                          stride};
          for (Index block = begin; block < end; ++block) body(block, room);
        },
        points());
  }

  // source(component, row, room) as RowSource.
  template <class Source>
  void rows_forward(const Source& source) {
    for_blocks([&](Index block, const Room& room) {
      const Index first = block * rows_at_once, paired = pairs(block);
      for (int component = 0; component < components; ++component) {
        for (Index i = 0; i < pairs_at_once; ++i) {
          Complex* to = room.rows.get() + i * room.stride;
          const Index row = first + i, partner = row + paired;
          const Real* near = i < paired ? source(component, row, room.near.get()) : nullptr;
          const Real* far = i < paired && partner < shape.nx
                                ? source(component, partner, room.far.get())
                                : nullptr;
          if (!near && !far) {
            std::fill_n(to, shape.period_y, Complex{});
            continue;
          }
          if (!near) {
            std::fill_n(room.near.get(), shape.ny, Real(0));
            near = room.near.get();
          }
          kernels.interleave(near, far, shape.ny, real(room.row.get()));
          std::fill(room.row.get() + shape.ny, room.row.get() + shape.period_y, Complex{});
          Api::execute(row_forward.get(), raw(room.row.get()), raw(to));
        }
        kernels.to_columns(real(room.rows.get()), room.stride, shape.period_y,
                           real(column(component, 0) + block * pairs_at_once), column_stride);
      }
    });
  }

  // place(component, row, room) says where a row is to be, and done(component, row, values) is told when it is there.
  template <class Place, class Done>
  void rows_backward(const Place& place, const Done& done) {
    for_blocks([&](Index block, const Room& room) {
      const Index first = block * rows_at_once, paired = pairs(block);
      for (int component = 0; component < components; ++component) {
        kernels.to_rows(real(column(component, 0) + block * pairs_at_once), column_stride,
                        shape.period_y, real(room.rows.get()), room.stride);
        for (Index i = 0; i < paired; ++i) {
          Api::execute(row_backward.get(), raw(room.rows.get() + i * room.stride),
                       raw(room.row.get()));
          const Index row = first + i, partner = row + paired;
          Real* near = place(component, row, room.near.get());
          Real* far = partner < shape.nx ? place(component, partner, room.far.get()) : nullptr;
          kernels.split(real(room.row.get()), shape.ny, near, far);
          done(component, row, near);
          if (far) done(component, partner, far);
        }
      }
    });
  }

  void columns() {
    parallel::for_slabs(
        modes,
        [&](Index begin, Index end) {
          const Index stride = padded(shape.period_x);
          const auto numbers = large_array<Complex>(count(stride));
          const auto scratch = large_array<Complex>(count(components * stride));
          for (Index k = begin; k < end; ++k) {
            const Index mirrored = k == 0 ? 0 : shape.period_y - k;
            for (int component = 0; component < components; ++component) {
              separate(column(component, k), column(component, mirrored), numbers.get());
              Api::execute(column_forward.get(), raw(numbers.get()),
                           raw(scratch.get() + component * stride));
            }
            if (components == 1) {
              multiply(k, scratch.get());
            } else {
              multiply_pair(k, scratch.get(), scratch.get() + stride);
            }
            for (int component = 0; component < components; ++component) {
              Api::execute(column_backward.get(), raw(scratch.get() + component * stride),
                           raw(numbers.get()));
              join(numbers.get(), column(component, k), column(component, mirrored));
            }
          }
        },
        points());
  }

  // 2·x from z(k) and z(−k), zero-padded to the period.
  void separate(const Complex* z, const Complex* mirrored, Complex* x) const {
    const Index whole = shape.nx / rows_at_once;
    kernels.separate(real(z), real(mirrored), whole, real(x));
    for_last_pairs([&](Index pair, Index row, Index partner) {
      const Complex other = std::conj(mirrored[pair]), difference = z[pair] - other;
      x[row] = z[pair] + other;
      if (partner < shape.nx) x[partner] = {difference.imag(), -difference.real()};
    });
    std::fill(x + shape.nx, x + shape.period_x, Complex{});
  }

  // z(k) and z(−k) from x.
  void join(const Complex* x, Complex* z, Complex* mirrored) const {
    const Index whole = shape.nx / rows_at_once;
    if (z == mirrored) {
      // The spectrum of a real row is real here.
      for (Index block = 0; block < whole; ++block)
        for (Index i = 0; i < pairs_at_once; ++i)
          z[block * pairs_at_once + i] = {x[block * rows_at_once + i].real(),
                                          x[block * rows_at_once + pairs_at_once + i].real()};
    } else {
      kernels.join(real(x), whole, real(z), real(mirrored));
    }
    for_last_pairs([&](Index pair, Index row, Index partner) {
      const Complex near = x[row], far = partner < shape.nx ? x[partner] : Complex{};
      if (z == mirrored) {
        z[pair] = {near.real(), far.real()};
      } else {
        z[pair] = {near.real() - far.imag(), near.imag() + far.real()};
        mirrored[pair] = {near.real() + far.imag(), far.real() - near.imag()};
      }
    });
  }

  // body(pair, row, partner) for the pairs of a block that is not full.
  template <class Body>
  void for_last_pairs(const Body& body) const {
    const Index whole = shape.nx / rows_at_once;
    if (whole == blocks) return;
    for (Index i = 0; i < pairs(whole); ++i)
      body(whole * pairs_at_once + i, whole * rows_at_once + i,
           whole * rows_at_once + pairs(whole) + i);
  }

  void multiply(Index j, Complex* numbers) const {
    kernels.multiply(real(numbers), table_rows(), shape.period_x - table_rows(),
                     tables[0].parity == Parity::odd ? Real(-1) : Real(1),
                     tables[0].values.get() + j * table_rows());
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

  template <class Source, class Place, class Done>
  void apply(const Source& source, const Place& place, const Done& done) {
    for (int t = 0; t < (components == 1 ? 1 : 3); ++t)
      if (tables[static_cast<std::size_t>(t)].values == nullptr)
        set_symbol(
            t / 2, t - t / 2, [](Index, Index) { return 0.0; }, Parity::even);
    if (!spectrum) {
      own_spectrum = large_array<Complex>(spectrum_size());
      spectrum = own_spectrum.get();
    }
    rows_forward(source);
    columns();
    rows_backward(place, done);
  }

  void apply(const Real* const* fields, Real* const* results) {
    apply([&](int component, Index row, Real*) { return fields[component] + row * shape.ny; },
          [&](int component, Index row, Real*) { return results[component] + row * shape.ny; },
          [](int, Index, const Real*) {});
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
void Convolution2D<Real>::apply(const RowSource& source, const RowSink& sink) {
  passes_->apply(
      source, [](int, Index, Real* room) { return room; }, sink);
}

template <class Real>
void Convolution2D<Real>::apply(const std::array<const Real*, 2>& fields,
                                const std::array<Real*, 2>& results) {
  require(passes_->components == 2, "components", passes_->components,
          "must be 2 to transform two fields");
  passes_->apply(fields.data(), results.data());
}

template <class Real>
std::size_t Convolution2D<Real>::spectrum_bytes() const {
  return passes_->spectrum_size() * sizeof(std::complex<Real>);
}

template <class Real>
void Convolution2D<Real>::keep_spectrum_in(void* memory) {
  passes_->own_spectrum.reset();
  passes_->spectrum = static_cast<std::complex<Real>*>(memory);
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
