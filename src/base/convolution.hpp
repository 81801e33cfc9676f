// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>

namespace salebra {

/// Symmetry of a kernel when x → −x or y → −y: even in x and y, odd in x and y, odd in x only, or
/// odd in y only. by_inversion: even only if both change together.
enum class Parity { even, odd, odd_along_x, odd_along_y, by_inversion };

/// Convolution of real fields x_b with real kernels K_ab, by one real Fourier transform forward and
/// one backward:
///     y_a = Σ_b K_ab * x_b,   a, b < components (1 or 2),   K_ab = K_ba.
/// A field of nx × ny points fills the first points of a period of period_x × period_y points; the
/// rest of the period is zero. If the period equals the field, the convolution is circular; with
/// period_x >= 2nx − 1 and period_y >= 2ny − 1 it is that of isolated fields. It takes three passes
/// over memory: rows, columns, rows. In the second pass each column stays in cache while it is
/// transformed, multiplied by the symbols and transformed back. The result has the same bits for
/// every thread count. An object may be used by one thread at a time. Memory during use:
/// sizeof(Real) bytes for each component and each of nx·period_y points, (2 − 1/P) times as much
/// with P processes; and for each symbol and each point of the period a quarter of sizeof(Real), or
/// half of it for a kernel that is by_inversion.
template <class Real>
class Convolution2D {
 public:
  struct Shape {
    Index nx = 0, ny = 0;              ///< size of the fields
    Index period_x = 0, period_y = 0;  ///< size of the transform; >= nx, ny
  };
  /// Fourier transform of one kernel K(a, b), the value at a distance of (a, b) points: Σ_ab K(a,
  /// b) exp(−2πi(ia/period_x + jb/period_y)) for 0 <= i <= period_x/2, 0 <= j <= period_y/2. For a
  /// kernel that is odd along one axis the transform is imaginary, and the symbol is 1/i times the
  /// transform. The kernel's Parity gives the symbol at negative i and j; by_inversion, the symbol is
  /// asked for 0 <= i < period_x, where i and i − period_x are one frequency.
  using Symbol = std::function<double(Index i, Index j)>;

  explicit Convolution2D(const Shape& shape, int components = 1);
  /// Distributes the work over the processes that share the nx rows. Fields, results and row
  /// indices are then those of this process; spectra and symbols are distributed by columns.
  /// apply() is collective and sends each number of a spectrum twice. The result has the same bits
  /// for every number of processes.
  Convolution2D(const Shape& shape, int components, const RowPartition& rows);
  /// The copy shares FFTW's plans, and the symbols that have been set, with `other`.
  Convolution2D(const Convolution2D& other);
  Convolution2D(Convolution2D&&) noexcept;
  Convolution2D& operator=(Convolution2D&&) noexcept;
  ~Convolution2D();

  const Shape& shape() const;
  /// Sets the symbol of the kernel K_ab = K_ba. Symbols are zero until set. `symbol` is called from
  /// several threads. A kernel that is odd along one axis requires two components, and then all
  /// kernels must be odd along one axis; likewise all kernels are by_inversion or none is.
  void set_symbol(int a, int b, const Symbol& symbol, Parity parity = Parity::even);

  /// Makes apply() keep its spectrum in the given memory, which must have spectrum_bytes() bytes
  /// and an alignment of 64 bytes. The caller may use this memory between two calls of apply().
  /// After nullptr, apply() allocates its own memory again.
  void keep_spectrum_in(void* memory);
  std::size_t spectrum_bytes() const;

  /// Convolution of a field of one component; `result` may equal `field`.
  void apply(const Real* field, Real* result);
  /// Convolution of a field of two components; each result may equal its field.
  void apply(const std::array<const Real*, 2>& fields, const std::array<Real*, 2>& results);

  /// Returns the ny numbers of a row of a component, either written into `buffer`, which has space
  /// for ny numbers, or stored elsewhere; nullptr means that all are zero.
  using RowSource = std::function<const Real*(int component, Index row, Real* buffer)>;
  /// Receives the ny numbers of a row of a component of the result, which are valid only during the
  /// call.
  using RowSink = std::function<void(int component, Index row, const Real* values)>;
  /// Convolution of fields that are not stored as a whole. Each row is requested from `source` once
  /// and delivered to `sink` once, by any thread and in any order; all requests precede the first
  /// delivery. Rows of zeros cost less than others.
  void apply(const RowSource& source, const RowSink& sink);

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

extern template class Convolution2D<float>;
extern template class Convolution2D<double>;

/// Smallest even n >= size of the form 2^a 3^b 5^c (1 for size <= 1), for which Fourier transforms
/// are fast.
Index fast_transform_size(Index size);

}  // namespace salebra
