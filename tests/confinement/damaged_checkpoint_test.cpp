// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of a cycle in which a bit has flipped, read as the program reads them: HDF5 itself
// may crash on one.
#include <catch2/catch.hpp>
#include <fstream>
#include <salebra/base/error.hpp>
#include <sstream>

#include "confinement/confinement.hpp"
#include "damping/islands.hpp"
#include "io/scratch.hpp"
#include "results/cycle_checkpoint.hpp"

using namespace salebra;

namespace {

const Grid2D grid{12, 9, 1.2e-3, 0.7e-3};

CycleResult cycle(CycleOptions options) {
  options.friction_coefficient = 0.3;
  options.steps = 8;
  options.max_periods = 2;
  return simulate_frictional_cycle(island_pressures(grid), grid,
                                   Material::of_contact_modulus(1e9, 0.3),
                                   trajectory_of(EqualFrequency{0.4, 1e-6, 0.9}, 0.5), options);
}

bool same(const CycleResult& a, const CycleResult& b) {
  return a.work_per_cycle == b.work_per_cycle && a.dissipated == b.dissipated &&
         a.relaxation_work == b.relaxation_work && a.contact_area_max == b.contact_area_max &&
         a.periods == b.periods && a.iterations == b.iterations && (a.loss == b.loss).all();
}

}  // namespace

TEST_CASE("A cycle goes on to the same bits from a checkpoint with a flipped bit, or refuses it",
          "[hostile]") {
  confinement::install();
  const Scratch scratch;
  std::vector<CycleState> states;
  const CycleResult whole =
      cycle({.on_state = [&](CycleState state) { states.push_back(std::move(state)); }});
  const CycleSettings settings{{"steps", "8"}};
  // In the second period, of which every field of the state is needed.
  write_cycle_checkpoint(scratch / "cycle.h5", std::span(states).subspan(12, 1), settings, {});
  std::ostringstream content;
  content << std::ifstream(scratch / "cycle.h5", std::ios::binary).rdbuf();
  const std::string bytes = content.str();

  int refused = 0, harmless = 0;
  // Half of the bytes are HDF5's own or not used. The stride is prime: each bit of a byte has its
  // turn.
  for (std::size_t bit = 5; bit < 8 * bytes.size(); bit += 1499) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    const auto file = scratch.file("damaged.h5", flipped);
    INFO("bit " << bit << " of " << 8 * bytes.size());
    try {
      const std::vector<CycleState> read = read_cycle_checkpoint(file, settings);
      REQUIRE(read.size() == 1);
      CHECK(same(cycle({.resume = &read.front()}), whole));
      ++harmless;
    } catch (const InvalidInput& error) {
      const std::string line = error.what();
      CHECK(line.find("damaged.h5: ") != std::string::npos);
      CHECK(line.find('\n') == std::string::npos);
      ++refused;
    }
  }
  INFO(refused << " refused, " << harmless << " harmless");
  CHECK(refused > 50);
  CHECK(harmless > 50);
}
