// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a transform there and back, and of a contact, over processes:  mpirun -n R scaling_pair N THREADS REPEATS
// One line: processes, threads of each, milliseconds of a pair (median, least), seconds of a
// contact (median, least).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <vector>

#include "contact/half_space/half_space.hpp"
#include "mpi/mpi.hpp"

using namespace salebra;

namespace {

// Seconds by the clock from when all have begun to when the last has ended.
std::vector<double> seconds_of(const Communicator& communicator, int repeats,
                               const std::function<void()>& body) {
  std::vector<double> times;
  for (int k = 0; k <= repeats; ++k) {
    communicator.all_agree(true);
    const auto start = std::chrono::steady_clock::now();
    body();
    communicator.all_agree(true);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (k > 0) times.push_back(elapsed.count());  // the first one touches memory and makes plans
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  const mpi::Session session;
  const Communicator ranks = session.communicator();
  const Index n = argc > 1 ? std::atol(argv[1]) : 2048;
  parallel::set_threads(argc > 2 ? std::atoi(argv[2]) : 1);
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 9;
  const double side = static_cast<double>(n);
  const Grid2D grid{n, n, side, side};
  const RowPartition rows(ranks, n);

  auto compliance = normal_compliance<float>(grid, 1, Boundary::periodic, ranks);
  std::vector<float> field(static_cast<std::size_t>(rows.count() * n), 1.0f), result(field.size());
  const auto pair =
      seconds_of(ranks, repeats, [&] { compliance.apply(field.data(), result.data()); });

  // Waves from a quarter of the side to 8 cells, slope 0.1; this pressure brings some 2 % of the
  // cells into contact.
  const SelfAffineParameters parameters{.hurst = 0.8,
                                        .long_cutoff = side / 4,
                                        .rolloff = side / 4,
                                        .short_cutoff = 8,
                                        .rms_slope = 0.1};
  const Surface surface = filtered_noise(grid, SelfAffineSpectrum(parameters), 1, {}, ranks);
  const auto contact =
      seconds_of(ranks, std::max(1, repeats / 3), [&] { press(surface, 1, at_pressure(1e-3)); });
  if (ranks.is_root())
    std::printf("%ld %d %d %.2f %.2f %.3f %.3f\n", long(n), ranks.size(), parallel::threads(),
                1e3 * pair[pair.size() / 2], 1e3 * pair.front(), contact[contact.size() / 2],
                contact.front());
}
