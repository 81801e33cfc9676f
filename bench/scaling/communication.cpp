// SPDX-License-Identifier: GPL-3.0-or-later
// What one of many processes sends, counted at the plans that the library makes, beside the model
// of docs/scaling.md.
//   scaling_communication [N [RANKS...]]
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "contact/half_space/multilevel_kernel.hpp"
#include "contact/half_space/normal_symbol.hpp"
#include "contact/normal/tile_sums.hpp"
#include "one_of_many.hpp"

using namespace salebra;
using salebra::testing::OneOfMany;

namespace {

// The multilevel kernel's symbol is made by each process as a whole, for larger grids in half a minute and
// more.
constexpr Index max_for_multilevel = 16384;

void count(Index n, int ranks) {
  // A process in the middle has neighbours on both sides.
  const auto transport = std::make_shared<OneOfMany>(ranks / 2, ranks);
  const Communicator all(transport);
  const RowPartition rows(all, n);
  if (rows.count() < 16) {
    std::printf("%6ld %5d  slabs of fewer than 16 rows\n", long(n), ranks);
    return;
  }
  const auto reset = [&] { transport->exchanged = transport->gathered = {}; };
  const double cells = static_cast<double>(n) * static_cast<double>(n), of_others = 1 - 1.0 / ranks;

  Convolution2D<float> pair({n, n, n, n}, 1, rows);
  reset();
  pair.apply([](int, Index, float*) -> const float* { return nullptr; },
             [](int, Index, const float*) {});
  const auto of_pair = transport->exchanged;
  const double model = 8 * cells / ranks * of_others;

  detail::HaloField<float> field(rows.count(), n);
  const RowExchange halo = detail::halo_rows(rows, Boundary::periodic);
  reset();
  field.fill_halo(Boundary::periodic, halo);
  const auto of_halo = transport->exchanged;

  reset();
  parallel::map_blocks<detail::PreconditionSums>(
      rows, [](Index, Index) { return detail::PreconditionSums{}; });
  const auto of_sums = transport->gathered;

  std::printf("%6ld %5d %5ld %10.3f %10.3f %6ld %6d %8.3f %8.3f %7.1f", long(n), ranks,
              long(rows.count()), of_pair.sent / 1e6, model / 1e6, of_pair.messages,
              2 * (ranks - 1), of_halo.sent / 1e6, 24 * static_cast<double>(n) / 1e6,
              of_sums.sent / 1e3);
  if (n <= max_for_multilevel) {
    const Grid2D grid{n, n, static_cast<double>(n), static_cast<double>(n)};
    auto multilevel = detail::MultilevelKernel::make(
        grid, rows, detail::normal_symbol(grid, 1, Boundary::periodic, rows), 1,
        Boundary::periodic);
    multilevel->list_tiles(std::vector<unsigned char>(
        static_cast<std::size_t>(rows.count() * detail::tiles_across(n)), 0));
    reset();
    multilevel->descend(field);
    std::printf(" %9.3f %6ld", transport->exchanged.sent / 1e6, transport->exchanged.messages);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  parallel::set_threads(0);
  std::vector<Index> sizes{4096, 16384, 65536};
  if (argc > 1) sizes = {std::atol(argv[1])};
  std::vector<int> ranks{16, 64, 256, 1024};
  if (argc > 2) ranks.clear();
  for (int k = 2; k < argc; ++k) ranks.push_back(std::atoi(argv[k]));
  std::printf(
      "sent by one process; a pair is a transform there and back, in float\n"
      "%6s %5s %5s %10s %10s %6s %6s %8s %8s %7s %9s %6s\n",
      "N", "ranks", "rows", "pair, MB", "model", "mess.", "model", "halo MB", "model", "sums kB",
      "multilevel MB", "mess.");
  for (const Index n : sizes)
    for (const int count_of_ranks : ranks) count(n, count_of_ranks);
}
