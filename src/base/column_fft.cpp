// SPDX-License-Identifier: GPL-3.0-or-later
// Backward transform column by column, without a full complex array, and forward transform that
// yields columns of the half-spectrum.
#include "column_fft.hpp"

#include <algorithm>
#include <optional>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "fftw.hpp"
#include "loop_progress.hpp"
#include "memory.hpp"

namespace salebra {
namespace {

using Api = detail::Fftw<double>;
using Complex = std::complex<double>;

// Number of columns in a group, which are copied to the rows, and sent, together: 16 of them fill
// two cache lines of each row.
constexpr Index block = 16;

constexpr const char* stage = "surface";

fftw_complex* fftw(Complex* values) { return reinterpret_cast<fftw_complex*>(values); }

// Distance between the starts of two columns, in complex numbers: nx rounded up to a multiple of 4,
// so that every column is aligned like the first.
Index column_pitch(Index nx) { return (nx + 3) / 4 * 4; }

// An FFTW plan holds only for arrays aligned like those it was made for; all buffers in this file
// come from fftw_array() and are aligned alike.
detail::FftwPlan<double> plan_column(Index nx, int sign) {
  const auto buffer = detail::fftw_array<Complex>(static_cast<std::size_t>(nx));
  const int n = static_cast<int>(nx);
  return detail::plan<double>([&] {
    return Api::plan_many(1, &n, 1, fftw(buffer.get()), nullptr, 1, n, fftw(buffer.get()), nullptr,
                          1, n, sign, FFTW_ESTIMATE);
  });
}

detail::FftwPlan<double> plan_row(Index ny) {
  const auto modes = detail::fftw_array<Complex>(static_cast<std::size_t>(ny / 2 + 1));
  const auto values = detail::fftw_array<double>(static_cast<std::size_t>(ny));
  const int n = static_cast<int>(ny);
  return detail::plan<double>([&] {
    return Api::plan_many_c2r(1, &n, 1, fftw(modes.get()), nullptr, 1, n / 2 + 1, values.get(),
                              nullptr, 1, n, FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  });
}

detail::FftwPlan<double> plan_row_forward(Index ny) {
  const auto modes = detail::fftw_array<Complex>(static_cast<std::size_t>(ny / 2 + 1));
  const auto values = detail::fftw_array<double>(static_cast<std::size_t>(ny));
  return detail::plan<double>([&] {
    return Api::plan_r2c_1d(static_cast<int>(ny), values.get(), fftw(modes.get()),
                            FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  });
}

// Assigns groups of 16 columns to processes: with `ranks` processes, process `rank` makes the
// groups rank, rank + ranks, rank + 2·ranks and so on, `at_once` groups in each batch. A single
// process makes all groups in one batch.
struct Deal {
  Index groups, ranks, at_once, batches;

  Deal(Index ny, Index columns, const RowPartition& rows)
      : groups((columns + block - 1) / block), ranks(rows.communicator().size()) {
    const Index most = (groups + ranks - 1) / ranks;
    // A batch needs three buffers of 16 complex columns for each of its groups; `at_once` makes the
    // buffers together as large as ny/ranks real columns.
    at_once = ranks == 1 ? most : std::clamp<Index>(ny / (6 * block * ranks), 1, most);
    batches = (most + at_once - 1) / at_once;
  }
  Index group(Index rank, Index batch, Index k) const {
    return rank + (batch * at_once + k) * ranks;
  }
  Index count(Index rank, Index batch) const {
    return std::clamp<Index>((groups - rank + ranks - 1) / ranks - batch * at_once, 0, at_once);
  }
  // The exchange that sends the columns of a batch to the owners of the rows. A unit of the
  // exchange is one row of a group of columns. Units are sorted by process, then by group, then by
  // row.
  Exchange exchange(const RowPartition& rows, Index batch) const {
    const Index mine = count(rows.communicator().rank(), batch);
    std::vector<std::int64_t> sent, received;
    for (int rank = 0; rank < rows.communicator().size(); ++rank) {
      sent.push_back(mine * (rows.end_of(rank) - rows.begin_of(rank)));
      received.push_back(count(rank, batch) * rows.count());
    }
    return {block * sizeof(Complex), std::move(sent), std::move(received)};
  }
  // Number of columns that process `rank` makes in all batches, of `of_all` columns of all
  // processes.
  Index columns(Index rank, Index of_all) const {
    Index sum = 0;
    for (Index group = rank; group < groups; group += ranks)
      sum += std::min(block, of_all - group * block);
    return sum;
  }
};

class BackwardByColumns {
 public:
  BackwardByColumns(Index nx, Index ny, Index columns, const RowPartition& rows)
      : nx_(nx),
        ny_(ny),
        columns_(columns),
        stored_(std::min(columns, ny / 2)),
        rows_(rows),
        rank_(rows.communicator().rank()),
        alone_(rows.communicator().alone()),
        deal_(ny, columns, rows) {}

  // Allocates all memory except the few rows and columns that each thread needs for itself.
  void prepare() {
    field_ = uninitialised_field(rows_.count(), ny_);
    touch_pages(field_);
    if (columns_ > stored_) last_column_.resize(static_cast<std::size_t>(rows_.count()));
    column_plan_ = plan_column(nx_, FFTW_BACKWARD);
    row_plan_ = plan_row(ny_);
    if (alone_) return;
    const Index together = deal_.at_once * block;
    sent_ = large_array<Complex>(static_cast<std::size_t>(together * nx_));
    received_ =
        large_array<Complex>(static_cast<std::size_t>(deal_.ranks * together * rows_.count()));
  }

  void columns(const SpectrumColumn& column, const Progress& progress) {
    LoopProgress loop(progress, stage, deal_.columns(rank_, columns_), 0, 0.7);
    for (Index batch = 0; batch < deal_.batches; ++batch) {
      std::optional<Exchange> plan;
      collectively(rows_.communicator(), [&] {
        if (!alone_) plan.emplace(deal_.exchange(rows_, batch));
        make_columns(batch, column, plan, loop);
        loop.finish();
      });
      if (alone_) return;
      rows_.communicator().exchange(*plan, sent_.get(), received_.get());
      keep_received(batch, *plan);
    }
  }

  Field rows(const Progress& progress) {
    LoopProgress loop(progress, stage, rows_.count(), 0.7, 1);
    collectively(rows_.communicator(), [&] {
      parallel::for_slabs(rows_.count(), [&](Index begin, Index end) {
        const auto modes = detail::fftw_array<Complex>(static_cast<std::size_t>(ny_ / 2 + 1));
        const auto values = detail::fftw_array<double>(static_cast<std::size_t>(ny_));
        for (Index x = begin; x < end && loop.running(); ++x) {
          double* row = field_.data() + x * ny_;
          std::copy_n(row, 2 * stored_, reinterpret_cast<double*>(modes.get()));
          std::fill(modes.get() + stored_, modes.get() + ny_ / 2 + 1, Complex{});
          if (columns_ > stored_)
            modes[static_cast<std::size_t>(stored_)] = last_column_[static_cast<std::size_t>(x)];
          Api::execute_c2r(row_plan_.get(), fftw(modes.get()), values.get());
          std::copy_n(values.get(), ny_, row);
          loop.advance();
        }
      });
      loop.finish();
    });
    return std::move(field_);
  }

 private:
  Index columns_of(Index group) const { return std::min(block, columns_ - group * block); }

  // Fills and transforms the groups of this process, and stores them in the field or packs them for
  // sending.
  void make_columns(Index batch, const SpectrumColumn& column, const std::optional<Exchange>& plan,
                    LoopProgress& loop) {
    const Index pitch = column_pitch(nx_);
    parallel::for_slabs(deal_.count(rank_, batch), [&](Index begin, Index end) {
      const auto buffer = detail::fftw_array<Complex>(static_cast<std::size_t>(block * pitch));
      for (Index k = begin; k < end && loop.running(); ++k) {
        const Index group = deal_.group(rank_, batch, k), count = columns_of(group);
        for (Index j = 0; j < count; ++j) {
          Complex* modes = buffer.get() + j * pitch;
          column(group * block + j, {modes, static_cast<std::size_t>(nx_)});
          Api::execute(column_plan_.get(), fftw(modes), fftw(modes));
        }
        if (alone_) {
          keep(group, 0, nx_, [modes = buffer.get(), pitch](Index row, Index j) {
            return modes[row + j * pitch];
          });
        } else {
          pack(k, count, *plan, buffer.get(), pitch);
        }
        loop.advance(count);
      }
    });
  }

  // Packs group k of a batch for sending: one part for each receiving process, row by row.
  void pack(Index k, Index count, const Exchange& plan, const Complex* modes, Index pitch) {
    for (int rank = 0; rank < rows_.communicator().size(); ++rank) {
      const Index first = rows_.begin_of(rank), number = rows_.end_of(rank) - first;
      Complex* to = sent_.get() + (plan.sent_offset(rank) + k * number) * block;
      for (Index row = first; row < first + number; ++row, to += block) {
        for (Index j = 0; j < count; ++j) to[j] = modes[row + j * pitch];
        std::fill(to + count, to + block, Complex{});
      }
    }
  }

  void keep_received(Index batch, const Exchange& plan) {
    parallel::for_slabs(rows_.count(), [&](Index begin, Index end) {
      for (int rank = 0; rank < rows_.communicator().size(); ++rank)
        for (Index k = 0; k < deal_.count(rank, batch); ++k) {
          const Complex* modes =
              received_.get() + (plan.received_offset(rank) + k * rows_.count()) * block;
          keep(deal_.group(rank, batch, k), begin, end,
               [modes](Index row, Index j) { return modes[row * block + j]; });
        }
    });
  }

  // Stores the modes of a row in the memory of that row of the field until they are transformed.
  // The ny values of a row hold ny/2 complex modes; one further mode goes to last_column_. `mode`
  // is called as mode(row of this process, column of the group).
  template <class Mode>
  void keep(Index group, Index begin, Index end, const Mode& mode) {
    const Index first = group * block, count = columns_of(group),
                within = std::min(count, stored_ - first);
    for (Index x = begin; x < end; ++x) {
      double* row = field_.data() + x * ny_ + 2 * first;
      for (Index j = 0; j < within; ++j) {
        const Complex value = mode(x, j);
        row[2 * j] = value.real();
        row[2 * j + 1] = value.imag();
      }
      if (within < count) last_column_[static_cast<std::size_t>(x)] = mode(x, within);
    }
  }

  Index nx_, ny_, columns_, stored_;
  RowPartition rows_;
  int rank_;
  bool alone_;
  Deal deal_;
  Field field_;
  std::vector<Complex> last_column_;
  LargeArray<Complex> sent_, received_;
  detail::FftwPlan<double> column_plan_, row_plan_;
};

}  // namespace

Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress) {
  return backward_by_columns(nx, ny, columns, column, progress, RowPartition(nx));
}

Field backward_by_columns(Index nx, Index ny, Index columns, const SpectrumColumn& column,
                          const Progress& progress, const RowPartition& rows) {
  require(columns >= 1 && columns <= ny / 2 + 1, "columns", columns, "must lie in 1 … ny/2+1");
  require(rows.rows() == nx, "rows", rows.rows(), "must be nx rows in all");
  BackwardByColumns transform(nx, ny, columns, rows);
  collectively(rows.communicator(), [&] { transform.prepare(); });
  transform.columns(column, progress);
  return transform.rows(progress);
}

void forward_by_columns(Index nx, Index ny,
                        const std::function<void(Index row, std::span<double> values)>& row,
                        const SpectrumColumn& visit, const RowPartition& rows,
                        const RowPartition& columns) {
  require(rows.rows() == nx, "rows", rows.rows(), "must be nx rows in all");
  require(columns.rows() == ny / 2 + 1, "columns", columns.rows(), "must be ny/2+1 in all");
  const Index pitch = column_pitch(ny / 2 + 1);
  LargeArray<Complex> modes;
  detail::FftwPlan<double> column_plan;
  collectively(rows.communicator(), [&] {
    modes = large_array<Complex>(static_cast<std::size_t>(rows.count() * pitch));
    column_plan = plan_column(nx, FFTW_FORWARD);
    const auto row_plan = plan_row_forward(ny);
    parallel::for_slabs(rows.count(), [&](Index begin, Index end) {
      const auto values = large_array<double>(static_cast<std::size_t>(ny));
      for (Index k = begin; k < end; ++k) {
        row(k, {values.get(), static_cast<std::size_t>(ny)});
        Api::execute_r2c(row_plan.get(), values.get(), fftw(modes.get() + k * pitch));
      }
    });
  });
  visit_columns<Complex>(
      rows, columns,
      [&](Index k, Index first, Index count, Complex* to) {
        std::copy_n(modes.get() + k * pitch + first, count, to);
      },
      [&](Index j, std::span<Complex> column) {
        Api::execute(column_plan.get(), fftw(column.data()), fftw(column.data()));
        visit(j, column);
      });
}

std::size_t column_fft_memory(Index nx, Index ny, const RowPartition& rows) {
  const Index threads = parallel::threads(), columns = ny / 2 + 1;
  const Deal deal(ny, columns, rows);
  const Index for_columns = std::min(threads, deal.at_once) * block * column_pitch(nx),
              for_rows = threads * (columns + (ny + 1) / 2);
  Index complex_values = rows.count() + std::max(for_columns, for_rows);
  if (deal.ranks > 1) complex_values += deal.at_once * block * (nx + deal.ranks * rows.count());
  return static_cast<std::size_t>(rows.count() * ny) * sizeof(double) +
         static_cast<std::size_t>(complex_values) * sizeof(Complex);
}

}  // namespace salebra
