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

/// Writes column j of a half-spectrum, F(0 … nx−1, j), into the span, or takes it from there;
/// called from several threads at once.
using SpectrumColumn = std::function<void(Index j, std::span<std::complex<double>> column)>;

/// The backward transform of RealFft2D for a spectrum that is made as it is needed and of which
/// only the columns j < columns are not zero, such as that of a surface with a short cut-off:
///     f(a, b) = Σ_ij F(i, j) exp(2πi(ia/nx + jb/ny)),   F(−i, −j) = F*(i, j).
/// Columns of zeros are neither stored nor transformed, and transformed columns wait for the
/// transform of the rows in the memory of the result: beside the nx·ny values it takes a few rows
/// and columns for each thread.
/// columns   1 … ny/2+1; the columns j = 0 and, for even ny, j = ny/2 must be Hermitian in i
/// progress  "surface", after every few columns and each row; a stop throws Interrupted
/// cost      columns complex transforms of length nx, nx real ones of length ny; parallel; same
///           bits for every thread count
Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress = {});

/// Does so over the processes of a share of the nx rows. Returns the rows of this process,
/// (rows.count(), ny), with the same bits for every number of processes. Each process makes every
/// ranks-th group of 16 columns, because those near a cut-off are less work to fill. It sends them
/// to the owners of the rows in batches. The buffers of a batch take at most as much memory as the
/// rows of a process, or 768·nx bytes where that is more.
/// column    called for the columns of this process alone
/// progress  of the columns and rows of this process; a stop on any process, or any other failure,
///           is thrown on all of them
/// throws    InvalidInput also where rows has another number of rows than nx
/// cost      collective; each process sends and receives 16·nx·columns/ranks bytes
Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress, const RowPartition& rows);

/// The forward transform of RealFft2D over the processes of a share of the nx rows, of a field that
/// is read row by row:
///     F(i, j) = Σ_ab f(a, b) exp(−2πi(ia/nx + jb/ny)),   j = 0 … ny/2.
/// row      writes a row of this process; called from several threads at once
/// visit    takes column j of those that this process owns by `columns`, in the order of
///          visit_columns; same bits for every number of processes
/// columns  who owns which of the ny/2+1 columns
/// cost     collective; 8 bytes for each point in this process and the buffers of visit_columns;
///          each process sends that much once
void forward_by_columns(Index nx, Index ny,
                        const std::function<void(Index row, std::span<double> values)>& row,
                        const SpectrumColumn& visit, const RowPartition& rows, const RowPartition& columns);

/// Peak memory of backward_by_columns in this process with the present number of threads, bytes,
/// result included.
std::size_t column_fft_memory(Index nx, Index ny, const RowPartition& rows);

}  // namespace salebra
