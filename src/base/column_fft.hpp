// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/row_partition.hpp>
#include <span>

namespace salebra {

/// Writes column j of a half-spectrum, F(0 … nx−1, j), into the span, or reads it from the span. It
/// is called from several threads at once.
using SpectrumColumn = std::function<void(Index j, std::span<std::complex<double>> column)>;

/// The backward transform of RealFft2D for a spectrum that is computed on demand and that is zero
/// in all columns j >= columns, such as that of a surface with a short cut-off:
///     f(a, b) = Σ_ij F(i, j) exp(2πi(ia/nx + jb/ny)),   F(−i, −j) = F*(i, j).
/// Columns of zeros are neither stored nor transformed. The memory of the result holds the
/// transformed columns until the rows are transformed, so the function needs only a few rows and
/// columns per thread in addition to the nx·ny values.
/// columns   1 … ny/2+1; the columns j = 0 and, for even ny, j = ny/2 must be Hermitian in i
/// progress  stage "surface", after every few columns and each row; a stop throws Interrupted
/// cost      `columns` complex transforms of length nx, nx real ones of length ny; parallel; same
///           bits for every thread count
Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress = {});

/// backward_by_columns() over P processes that share the nx rows. Returns the rows of this process,
/// (rows.count(), ny), with the same bits for every P. Each process makes every P-th group of 16
/// columns, because columns near a cut-off take less work to fill, and sends its groups in batches
/// to the owners of the rows. The buffers of a batch take at most as much memory as the rows of a
/// process, or 768·nx bytes if that is more.
/// column    called only for the columns of this process
/// progress  of the columns and rows of this process; a stop or any other failure on one process
///           throws on all of them
/// throws    as above, and InvalidInput if `rows` does not have nx rows in all
/// cost      collective; each of P processes sends and receives 16·nx·columns/P bytes
Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress, const RowPartition& rows);

/// The forward transform of RealFft2D over processes that share the nx rows; the field is read row
/// by row:
///     F(i, j) = Σ_ab f(a, b) exp(−2πi(ia/nx + jb/ny)),   j = 0 … ny/2.
/// row      writes the values of a row of this process; called from several threads at once
/// visit    receives the columns j that `columns` assigns to this process, in the order of
///          visit_columns(); same bits for every number of processes
/// columns  distribution of the ny/2+1 columns over the processes
/// cost     collective; each process stores 8 bytes for each of its points, sends them once, and
///          holds the buffers of visit_columns()
void forward_by_columns(Index nx, Index ny,
                        const std::function<void(Index row, std::span<double> values)>& row,
                        const SpectrumColumn& visit, const RowPartition& rows,
                        const RowPartition& columns);

/// Peak memory of backward_by_columns in this process with the current number of threads, in bytes,
/// including the result.
std::size_t column_fft_memory(Index nx, Index ny, const RowPartition& rows);

}  // namespace salebra
