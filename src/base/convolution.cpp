// SPDX-License-Identifier: GPL-3.0-or-later
// Cyclic convolution of fields with stored kernels by FFT, two real rows in one complex transform.
#include "convolution.hpp"

#include <algorithm>
#include <optional>
#include <salebra/base/parallel.hpp>

#include "fftw.hpp"
#include "memory.hpp"
#include "spectrum_columns.hpp"
#include "spectrum_kernels.hpp"

namespace salebra {
namespace {

// Number of row pairs that are transposed together: the eight complex numbers that these pairs have
// in a column fill one or two cache lines.
constexpr Index pairs_at_once = 8;
// Number of rows in a block. Rows are paired within a block, and the eight pairs that are
// transposed together come from one block. Processes hold whole blocks, so the transforms do not
// depend on the number of processes.
constexpr Index rows_at_once = 2 * pairs_at_once;

// Padding of columns and rows, in complex numbers. Without padding, equal indices of different
// columns could map to one set of the cache.
constexpr Index gap = 8;

std::size_t count(Index number) { return static_cast<std::size_t>(number); }
Index padded(Index length) { return (length + gap - 1) / gap * gap + gap; }

}  // namespace

// Rows i and i + 8 of a block of 16 are transformed as the real and imaginary part of one complex
// row z, because FFTW's complex transform takes no longer than its real one. The spectrum is kept
// column by column: transforms of contiguous numbers are about three times faster than those of
// strided numbers, and a column with its symbol stays in the cache from the forward to the backward
// transform. With z_i(k) the number of row i in column k, columns k and −k of z give column k of
// the spectrum x of the real rows,
//     x_i = (z_i(k) + z_i(−k)*)/2,   x_{i+8} = (z_i(k) − z_i(−k)*)/2i,
// and column −k of x is the conjugate of column k. If the last block has fewer than 16 rows, its
// second half still holds the partners of its first half, and missing pairs are zero.
//
// With several processes, each holds blocks of rows and, for the pass over columns, a range of k
// together with all −k. The pass over rows writes the columns to the array [process that will
// transform the column][component][column][own block][pair], and an exchange collects each column
// from all processes in the array [process that has the rows][component][column][block of that
// process][pair]. The part of a process's own columns stays where the pass over rows wrote it.
template <class Real>
struct Convolution2D<Real>::Passes {
  using Api = detail::Fftw<Real>;
  using Complex = std::complex<Real>;

  const detail::SpectrumKernels<Real>& kernels = detail::spectrum_kernels<Real>();
  Shape shape;
  int components;
  RowPartition rows_of_all;
  // The columns k = low … low + low_count − 1 of a process, followed by their mirror images −k =
  // high … high + high_count − 1. A column that is its own mirror image (k = 0 or k = period_y/2)
  // occurs once.
  struct Columns {
    Index low = 0, low_count = 0, high = 0, high_count = 0;
    Index position = 0;  // start of this process's part in `by_rows`
    Index count() const { return low_count + high_count; }
    Index index(Index column) const {
      return column < low + low_count ? column - low : low_count + column - high;
    }
  };
  std::vector<Columns> columns_of;  // one entry per process
  struct Rows {
    Index first_block = 0, blocks = 0;
    Index stride = 0;    // distance between columns
    Index position = 0;  // start of its part in `by_columns`
  };
  std::vector<Rows> rows_of;  // one entry for each process
  Index received = 0;         // number of complex numbers received from other processes
  std::optional<Exchange> to_columns, to_rows;
  Complex* by_rows = nullptr;
  Complex* by_columns = nullptr;  // spectrum rows of other processes
  LargeArray<Complex> own_spectrum;
  struct Table {
    // [column of this process][i = 0 … table_rows() − 1], divided by 2·period_x·period_y
    std::shared_ptr<Real[]> values;
    Parity parity = Parity::even;
  };
  std::array<Table, 3> tables;  // symbols of K_00, K_01 = K_10, K_11
  struct Plans {
    detail::FftwPlan<Real> row_forward, row_backward, column_forward, column_backward;
  };
  std::shared_ptr<const Plans> plans;

  Passes(const Shape& fields, int number, const RowPartition& rows)
      : shape(fields), components(number), rows_of_all(rows) {
    require(shape.nx >= 1 && shape.ny >= 1, "nx, ny", std::min(shape.nx, shape.ny), "must be >= 1");
    require(shape.period_x >= shape.nx && shape.period_x < 1 << 24, "period_x", shape.period_x,
            "must be >= nx and below 2^24");
    require(shape.period_y >= shape.ny && shape.period_y < 1 << 24, "period_y", shape.period_y,
            "must be >= ny and below 2^24");
    require(components == 1 || components == 2, "components", components, "must be 1 or 2");
    require(rows.rows() == shape.nx, "rows", rows.rows(), "must be nx rows in all");
    spread_work();
    make_plans();
  }
  // The copy allocates its own memory for the spectrum.
  Passes(const Passes& other)
      : shape(other.shape),
        components(other.components),
        rows_of_all(other.rows_of_all),
        tables(other.tables),
        plans(other.plans) {
    spread_work();
  }

  // Sets the rows and columns that each process holds, and the exchanges between processes.
  void spread_work() {
    const int ranks = rows_of_all.communicator().size(), me = rows_of_all.communicator().rank();
    for (int rank = 0; rank < ranks; ++rank) {
      const Index begin = rows_of_all.begin_of(rank), end = rows_of_all.end_of(rank);
      require(begin % rows_at_once == 0 || begin == shape.nx, "rows", begin,
              "must begin with a block of 16");
      const Index blocks = (end - begin + rows_at_once - 1) / rows_at_once;
      rows_of.push_back({begin / rows_at_once, blocks, column_stride(blocks, ranks), 0});
    }
    const RowPartition columns = detail::spectrum_columns(rows_of_all, shape.period_y);
    for (int rank = 0; rank < ranks; ++rank) {
      const Index begin = columns.begin_of(rank), end = columns.end_of(rank);
      // Beginning and end of the columns k whose −k is another column: all but k = 0 and k =
      // period_y/2.
      const Index first = std::max<Index>(begin, 1),
                  last = 2 * (end - 1) == shape.period_y ? end - 1 : end;
      columns_of.push_back(
          {begin, end - begin, shape.period_y - last + 1, std::max<Index>(last - first, 0), 0});
    }
    const auto units = [&](int columns, int rows) {
      return std::int64_t{components} * columns_of[static_cast<std::size_t>(columns)].count() *
             rows_of[static_cast<std::size_t>(rows)].stride / gap;
    };
    std::vector<std::int64_t> away, here;
    Index away_offset = 0, here_offset = 0;
    for (int rank = 0; rank < ranks; ++rank) {
      away.push_back(units(rank, me));
      here.push_back(units(me, rank));
      if (rank == me) away.back() = here.back() = 0;
      columns_of[static_cast<std::size_t>(rank)].position = away_offset;
      rows_of[static_cast<std::size_t>(rank)].position = here_offset;
      away_offset += gap * away.back();
      here_offset += gap * here.back();
    }
    columns_of[static_cast<std::size_t>(me)].position = away_offset;  // after the others' parts
    received = here_offset;
    if (ranks == 1) return;
    to_columns.emplace(gap * sizeof(Complex), away, here);
    to_rows.emplace(gap * sizeof(Complex), here, away);
  }

  // Distance between the starts of two columns. Padding is sent too, so with several processes only
  // columns that fill whole memory pages are padded.
  static Index column_stride(Index blocks, int ranks) {
    const Index length = blocks * pairs_at_once;
    if (length == 0) return 0;
    const bool whole_pages = length * static_cast<Index>(sizeof(Complex)) % 4096 == 0;
    return ranks > 1 && !whole_pages ? length : padded(length);
  }
  const Rows& mine() const {
    return rows_of[static_cast<std::size_t>(rows_of_all.communicator().rank())];
  }
  const Columns& my_columns() const {
    return columns_of[static_cast<std::size_t>(rows_of_all.communicator().rank())];
  }
  // Number of points of the padded field that this process transforms.
  Index points() const { return mine().blocks * rows_at_once * shape.period_y; }
  std::size_t rows_size() const {
    return count(my_columns().position + components * my_columns().count() * mine().stride);
  }
  std::size_t spectrum_size() const { return rows_size() + count(received); }
  void place_spectrum(Complex* memory) {
    by_rows = memory;
    by_columns = memory + rows_size();
  }
  // Number of frequencies of a column in the table of a symbol; the others mirror them.
  Index table_rows(Parity parity = Parity::even) const {
    return parity == Parity::by_inversion ? shape.period_x : shape.period_x / 2 + 1;
  }
  // Number of pairs in a block of this process; with an odd number of rows, the last row has no
  // partner.
  Index pairs(Index block) const {
    return (std::min(rows_at_once, rows_of_all.count() - block * rows_at_once) + 1) / 2;
  }
  // Start of the given column, in the part that comes from the process with the given rows.
  Complex* column(int component, Index index, const Rows& rows) {
    Complex* part = &rows == &mine() ? by_rows + my_columns().position : by_columns + rows.position;
    return part + (component * my_columns().count() + my_columns().index(index)) * rows.stride;
  }
  // For a block of rows, calls body(first column, number of columns, destination of these columns)
  // for the runs of columns of all processes.
  template <class Body>
  void for_columns(int component, Index block, const Body& body) {
    const Index stride = mine().stride;
    for (const Columns& some : columns_of) {
      Complex* part =
          by_rows + some.position + component * some.count() * stride + block * pairs_at_once;
      if (some.low + some.low_count == some.high) {
        body(some.low, some.count(), part);
        continue;
      }
      body(some.low, some.low_count, part);
      body(some.high, some.high_count, part + some.low_count * stride);
    }
  }
  static Real* real(Complex* numbers) { return reinterpret_cast<Real*>(numbers); }
  static const Real* real(const Complex* numbers) { return reinterpret_cast<const Real*>(numbers); }
  static typename Api::Complex* raw(Complex* numbers) {
    return reinterpret_cast<typename Api::Complex*>(numbers);
  }

  void make_plans() {
    // FFTW_ESTIMATE chooses the same plan, hence the same bits, in every run. All later arrays have
    // the alignment of the arrays that the plans are made with.
    const auto make = [](Index length, int sign) {
      const auto from = large_array<Complex>(count(length)),
                 to = large_array<Complex>(count(length));
      return detail::plan<Real>([&] {
        return Api::plan_1d(static_cast<int>(length), raw(from.get()), raw(to.get()), sign,
                            FFTW_ESTIMATE);
      });
    };
    plans = std::make_shared<const Plans>(
        Plans{make(shape.period_y, FFTW_FORWARD), make(shape.period_y, FFTW_BACKWARD),
              make(shape.period_x, FFTW_FORWARD), make(shape.period_x, FFTW_BACKWARD)});
  }

  void set_symbol(int a, int b, const Symbol& symbol, Parity parity) {
    Table& table = tables[static_cast<std::size_t>(a + b)];
    table.parity = parity;
    const Index first = my_columns().low, number = my_columns().low_count;
    const Index rows = table_rows(parity);
    table.values = large_array<Real>(count(number * rows));
    const double in_all = 2 * static_cast<double>(shape.period_x * shape.period_y);
    parallel::for_slabs(
        number,
        [&](Index begin, Index end) {
          for (Index j = begin; j < end; ++j)
            for (Index i = 0; i < rows; ++i)
              table.values[count(j * rows + i)] = static_cast<Real>(symbol(i, first + j) / in_all);
        },
        points());
  }

  // Memory of a thread for the work on a block of rows.
  struct Buffers {
    LargeArray<Complex> row, rows;  // one row; the rows of all pairs, `stride` apart
    LargeArray<Real> near, far;     // the two real rows of a pair
    Index stride;
  };

  // Calls body(block, buffers) for the blocks of rows of this process.
  template <class Body>
  void for_blocks(const Body& body) {
    const Index stride = padded(shape.period_y);
    parallel::for_slabs(
        mine().blocks,
        [&](Index begin, Index end) {
          const Buffers buffers{large_array<Complex>(count(stride)),
                                large_array<Complex>(count(pairs_at_once * stride)),
                                large_array<Real>(count(shape.ny)),
                                large_array<Real>(count(shape.ny)), stride};
          for (Index block = begin; block < end; ++block) body(block, buffers);
        },
        points());
  }

  // Transforms the rows forward along y; source(component, row, buffer) is a RowSource.
  template <class Source>
  void rows_forward(const Source& source) {
    for_blocks([&](Index block, const Buffers& buffers) {
      const Index first = block * rows_at_once, paired = pairs(block);
      for (int component = 0; component < components; ++component) {
        for (Index i = 0; i < pairs_at_once; ++i) {
          Complex* to = buffers.rows.get() + i * buffers.stride;
          const Index row = first + i, partner = row + paired;
          const Real* near = i < paired ? source(component, row, buffers.near.get()) : nullptr;
          const Real* far = i < paired && partner < rows_of_all.count()
                                ? source(component, partner, buffers.far.get())
                                : nullptr;
          if (!near && !far) {
            std::fill_n(to, shape.period_y, Complex{});
            continue;
          }
          if (!near) {
            std::fill_n(buffers.near.get(), shape.ny, Real(0));
            near = buffers.near.get();
          }
          kernels.interleave(near, far, shape.ny, real(buffers.row.get()));
          std::fill(buffers.row.get() + shape.ny, buffers.row.get() + shape.period_y, Complex{});
          Api::execute(plans->row_forward.get(), raw(buffers.row.get()), raw(to));
        }
        for_columns(component, block, [&](Index first_column, Index number, Complex* to) {
          kernels.to_columns(real(buffers.rows.get() + first_column), buffers.stride, number,
                             real(to), mine().stride);
        });
      }
    });
  }

  // Transforms the rows backward along y. target(component, row, buffer) returns the memory that
  // receives the row of the result; done(component, row, values) is called after the row was
  // written.
  template <class Place, class Done>
  void rows_backward(const Place& target, const Done& done) {
    for_blocks([&](Index block, const Buffers& buffers) {
      const Index first = block * rows_at_once, paired = pairs(block);
      for (int component = 0; component < components; ++component) {
        for_columns(component, block, [&](Index first_column, Index number, const Complex* from) {
          kernels.to_rows(real(from), mine().stride, number,
                          real(buffers.rows.get() + first_column), buffers.stride);
        });
        for (Index i = 0; i < paired; ++i) {
          Api::execute(plans->row_backward.get(), raw(buffers.rows.get() + i * buffers.stride),
                       raw(buffers.row.get()));
          const Index row = first + i, partner = row + paired;
          Real* near = target(component, row, buffers.near.get());
          Real* far = partner < rows_of_all.count() ? target(component, partner, buffers.far.get())
                                                    : nullptr;
          kernels.split(real(buffers.row.get()), shape.ny, near, far);
          done(component, row, near);
          if (far) done(component, partner, far);
        }
      }
    });
  }

  void columns() {
    const Index first = my_columns().low;
    parallel::for_slabs(
        my_columns().low_count,
        [&](Index begin, Index end) {
          const Index stride = padded(shape.period_x);
          const auto numbers = large_array<Complex>(count(stride));
          const auto scratch = large_array<Complex>(count(components * stride));
          for (Index j = begin; j < end; ++j) {
            const Index k = first + j, mirrored = k == 0 ? 0 : shape.period_y - k;
            for (int component = 0; component < components; ++component) {
              for (const Rows& rows : rows_of)
                separate(column(component, k, rows), column(component, mirrored, rows), rows,
                         numbers.get());
              std::fill(numbers.get() + shape.nx, numbers.get() + shape.period_x, Complex{});
              Api::execute(plans->column_forward.get(), raw(numbers.get()),
                           raw(scratch.get() + component * stride));
            }
            if (components == 1) {
              multiply(j, scratch.get());
            } else {
              multiply_pair(j, scratch.get(), scratch.get() + stride);
            }
            for (int component = 0; component < components; ++component) {
              Api::execute(plans->column_backward.get(), raw(scratch.get() + component * stride),
                           raw(numbers.get()));
              for (const Rows& rows : rows_of)
                join(numbers.get(), rows, column(component, k, rows),
                     column(component, mirrored, rows));
            }
          }
        },
        points());
  }

  // Number of full blocks of 16 rows that a process has.
  Index whole_blocks(const Rows& rows) const {
    return std::min(rows.blocks, shape.nx / rows_at_once - rows.first_block);
  }

  // Computes 2·x on the rows of a process from columns z(k) and z(−k), where x is column k of the
  // spectrum of the real rows.
  void separate(const Complex* z, const Complex* mirrored, const Rows& rows, Complex* x) const {
    x += rows.first_block * rows_at_once;
    kernels.separate(real(z), real(mirrored), whole_blocks(rows), real(x));
    for_last_pairs(rows, [&](Index pair, Index row, Index partner, bool has_partner) {
      const Complex other = std::conj(mirrored[pair]), difference = z[pair] - other;
      x[row] = z[pair] + other;
      if (has_partner) x[partner] = {difference.imag(), -difference.real()};
    });
  }

  // Inverse of separate(): computes columns z(k) and z(−k) on the rows of a process from column x.
  void join(const Complex* x, const Rows& rows, Complex* z, Complex* mirrored) const {
    x += rows.first_block * rows_at_once;
    const Index whole = whole_blocks(rows);
    if (z == mirrored) {
      // In a column that is its own mirror image, the spectrum of a real row is real.
      for (Index block = 0; block < whole; ++block)
        for (Index i = 0; i < pairs_at_once; ++i)
          z[block * pairs_at_once + i] = {x[block * rows_at_once + i].real(),
                                          x[block * rows_at_once + pairs_at_once + i].real()};
    } else {
      kernels.join(real(x), whole, real(z), real(mirrored));
    }
    for_last_pairs(rows, [&](Index pair, Index row, Index partner, bool has_partner) {
      const Complex near = x[row], far = has_partner ? x[partner] : Complex{};
      if (z == mirrored) {
        z[pair] = {near.real(), far.real()};
      } else {
        z[pair] = {near.real() - far.imag(), near.imag() + far.real()};
        mirrored[pair] = {near.real() + far.imag(), far.real() - near.imag()};
      }
    });
  }

  // Calls body(pair, row, partner, whether the partner row exists) for the pairs of a last block
  // that has fewer than 16 rows; row and partner count from the first row of the process.
  template <class Body>
  void for_last_pairs(const Rows& rows, const Body& body) const {
    const Index whole = whole_blocks(rows);
    if (whole == rows.blocks) return;
    const Index left = shape.nx % rows_at_once, paired = (left + 1) / 2;
    for (Index i = 0; i < paired; ++i)
      body(whole * pairs_at_once + i, whole * rows_at_once + i, whole * rows_at_once + paired + i,
           paired + i < left);
  }

  static bool odd_along_x(Parity parity) {
    return parity == Parity::odd || parity == Parity::odd_along_x;
  }
  static bool imaginary(Parity parity) {
    return parity == Parity::odd_along_x || parity == Parity::odd_along_y;
  }

  void multiply(Index j, Complex* numbers) const {
    const Index rows = table_rows(tables[0].parity);
    kernels.multiply(real(numbers), rows, shape.period_x - rows,
                     odd_along_x(tables[0].parity) ? Real(-1) : Real(1),
                     tables[0].values.get() + j * rows);
  }

  void multiply_pair(Index j, Complex* first, Complex* second) const {
    std::array<const Real*, 3> symbol;
    std::array<Real, 3> sign;
    for (std::size_t t = 0; t < 3; ++t) {
      symbol[t] = tables[t].values.get() + j * table_rows(tables[t].parity);
      sign[t] = odd_along_x(tables[t].parity) ? Real(-1) : Real(1);
    }
    const bool whole = tables[0].parity == Parity::by_inversion;
    const auto at = [&](Index position, Index i, Real s0, Real s1, Real s2) {
      const Complex x = first[position], y = second[position];
      first[position] = s0 * symbol[0][i] * x + s1 * symbol[1][i] * y;
      second[position] = s1 * symbol[1][i] * x + s2 * symbol[2][i] * y;
    };
    for (Index i = 0; i < table_rows(tables[0].parity); ++i) at(i, i, 1, 1, 1);
    for (Index i = 1; i < shape.period_x - shape.period_x / 2 && !whole; ++i)
      at(shape.period_x - i, i, sign[0], sign[1], sign[2]);
    if (!imaginary(tables[0].parity)) return;
    for (Complex* numbers : {first, second})
      for (Index i = 0; i < shape.period_x; ++i)
        numbers[i] = {-numbers[i].imag(), numbers[i].real()};
  }

  template <class Source, class Place, class Done>
  void apply(const Source& source, const Place& target, const Done& done) {
    for (int t = 0; t < (components == 1 ? 1 : 3); ++t)
      if (tables[static_cast<std::size_t>(t)].values == nullptr)
        set_symbol(t / 2, t - t / 2, [](Index, Index) { return 0.0; }, tables[0].parity);
    if (!by_rows) {
      own_spectrum = large_array<Complex>(spectrum_size());
      place_spectrum(own_spectrum.get());
    }
    rows_forward(source);
    if (to_columns) rows_of_all.communicator().exchange(*to_columns, by_rows, by_columns);
    columns();
    if (to_rows) rows_of_all.communicator().exchange(*to_rows, by_columns, by_rows);
    rows_backward(target, done);
  }

  void apply(const Real* const* fields, Real* const* results) {
    apply([&](int component, Index row, Real*) { return fields[component] + row * shape.ny; },
          [&](int component, Index row, Real*) { return results[component] + row * shape.ny; },
          [](int, Index, const Real*) {});
  }
};

template <class Real>
Convolution2D<Real>::Convolution2D(const Shape& shape, int components)
    : Convolution2D(shape, components, RowPartition(shape.nx)) {}
template <class Real>
Convolution2D<Real>::Convolution2D(const Shape& shape, int components, const RowPartition& rows)
    : passes_(std::make_unique<Passes>(shape, components, rows)) {}
template <class Real>
Convolution2D<Real>::Convolution2D(const Convolution2D& other)
    : passes_(std::make_unique<Passes>(*other.passes_)) {}
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
  require(passes_->components == 2 || !Passes::imaginary(parity), "parity", "odd along one axis",
          "needs two components");
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
  passes_->apply(source, [](int, Index, Real* buffer) { return buffer; }, sink);
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
  if (memory) {
    passes_->place_spectrum(static_cast<std::complex<Real>*>(memory));
  } else {
    passes_->by_rows = passes_->by_columns = nullptr;
  }
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
