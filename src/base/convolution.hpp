// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>

namespace salebra {

/// What a kernel does under x → −x and under y → −y: even or odd under each, or odd under one.
enum class Parity { even, odd, odd_along_x, odd_along_y };

/// Convolution of real fields with real kernels, by one real transform forward and one backward:
///     y_a = Σ_b K_ab * x_b,   a, b < components (1 or 2),   K_ab = K_ba.
/// A field (nx, ny) fills the first points of a period (period_x, period_y) and the rest is zero:
/// with period = n the convolution is circular, with period >= 2n − 1 it is that of isolated
/// fields. Three passes over memory: rows, then columns, each of which stays in cache while it is
/// transformed, multiplied by the symbols and transformed back, then rows. The result has the same
/// bits for every thread count. One object may run in one thread at a time. Memory: sizeof(Real)
/// bytes for each component and each of nx·period_y points while it is in use, (2 − 1/P) times as
/// many over P processes, and a quarter of that for each symbol and each point of the period.
template <class Real>
class Convolution2D {
 public:
  struct Shape {
    Index nx = 0, ny = 0;              ///< of the fields
    Index period_x = 0, period_y = 0;  ///< of the transform; >= nx, ny
  };
  /// The kernel's transform Σ_ab K(a, b) exp(−2πi(ia/period_x + jb/period_y)) for 0 <= i <=
  /// period_x/2, 0 <= j <= period_y/2: real, or 1/i of it where it is imaginary, of kernels that
  /// are odd along one axis. Parity says what it is at negative i, j.
  using Symbol = std::function<double(Index i, Index j)>;

  explicit Convolution2D(const Shape& shape, int components = 1);
  /// Spreads the work over the processes of a share of the nx rows. Fields, results and the numbers
  /// of rows are then those of this process; spectra and symbols are spread by columns. apply() is
  /// collective and sends each number of a spectrum twice. The result has the same bits for every
  /// number of processes.
  Convolution2D(const Shape& shape, int components, const RowPartition& rows);
  /// Shares the symbols that have been set, and the plans, which are not made again.
  Convolution2D(const Convolution2D& other);
  Convolution2D(Convolution2D&&) noexcept;
  Convolution2D& operator=(Convolution2D&&) noexcept;
  ~Convolution2D();

  const Shape& shape() const;
  /// K_ab and K_ba. Symbols are zero until set. `symbol` is called from several threads. Kernels
  /// that are odd along one axis are for two components, and then all are.
  void set_symbol(int a, int b, const Symbol& symbol, Parity parity = Parity::even);

  /// Lets apply() keep its spectrum in the memory given, of at least spectrum_bytes() on a boundary
  /// of 64 bytes, which is the caller's to use between two calls; nullptr: in memory of its own
  /// again.
  void keep_spectrum_in(void* memory);
  std::size_t spectrum_bytes() const;

  /// One component. result may be field itself.
  void apply(const Real* field, Real* result);
  /// Two components.
  void apply(const std::array<const Real*, 2>& fields, const std::array<Real*, 2>& results);

  /// Where the ny numbers of a row of a component are: in `room`, which takes ny numbers, or
  /// elsewhere; nullptr: all are zero.
  using RowSource = std::function<const Real*(int component, Index row, Real* buffer)>;
  /// Takes the ny numbers of a row of a component of the result, which are gone afterwards.
  using RowSink = std::function<void(int component, Index row, const Real* values)>;
  /// Fields and results that are nowhere as a whole: each row is asked for once and handed over
  /// once, by any thread and in any order, all of the fields before any of the results. Rows of
  /// zeros cost less than others.
  void apply(const RowSource& source, const RowSink& sink);

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

extern template class Convolution2D<float>;
extern template class Convolution2D<double>;

/// Least n >= size of the form 2^a 3^b 5^c (even if size > 1): transforms of such lengths are fast.
Index fast_transform_size(Index size);

}  // namespace salebra
