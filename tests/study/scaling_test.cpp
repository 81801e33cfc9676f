// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the growth of peak memory with the number of surfaces, loads, steps and points.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/study_file.hpp>
#include <string>

#include "io/scratch.hpp"
#include "small_study.hpp"

using namespace salebra;

namespace {

double status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return 1024 * std::stod(line.substr(name.size()));
  return std::nan("");
}

/// Growth of the resident memory of a separate process above its start, bytes. It uses one thread,
/// so that the memory does not depend on the sharing between threads, and a forked process has none
/// of its parent's threads.
double peak_growth(const std::function<void()>& work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    parallel::set_threads(1);
    // 5: resets the peak of getrusage(2) and VmHWM, proc_pid_clear_refs(5).
    std::ofstream("/proc/self/clear_refs") << 5 << std::flush;
    const double before = status_bytes("VmRSS:");
    work();
    const double growth = status_bytes("VmHWM:") - before;
    _exit(write(ends[1], &growth, sizeof growth) == sizeof growth ? 0 : 1);
  }
  close(ends[1]);
  double growth = std::nan("");
  const bool told = read(ends[0], &growth, sizeof growth) == sizeof growth;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(told);
  REQUIRE(status == 0);
  return growth;
}

Surface rough(Index points) {
  parallel::set_threads(1);  // a team of threads would not exist after fork()
  return filtered_noise(
      {points, points, 4e-6, 4e-6},
      SelfAffineSpectrum(
          {.hurst = 0.8, .rolloff = 1e-6, .short_cutoff = 0.5e-6, .rms_height = 1e-8}),
      1);
}

const Material material = Material::of_contact_modulus(1e10, 0.3);

}  // namespace

TEST_CASE("The memory of a study grows with its surfaces as their samples do", "[scaling]") {
  // Surfaces like those of a study, with four loads and three models, but without the contacts,
  // which would take the time.
  StudyConfiguration study = parse_study_configuration(study_text("seeds = [1]", 4), "four.toml");
  study.stick = false;
  const auto written = [&](std::size_t surfaces) {
    return peak_growth([&, surfaces] {
      const Scratch scratch;
      std::vector<StudyResult> results{run_study(study)};
      StudyResult& result = results.front();
      result.realisations.reserve(surfaces);
      Realisation other = result.realisations.front();
      other.picture = {};
      for (std::size_t i = 1; i < surfaces; ++i) {
        other.seed = i + 1;
        other.of(ContactModel::bem).fit.decay_length = (1 + 1e-3 * std::sin(double(i))) * 3e-9;
        result.realisations.push_back(other);
      }
      write_ensembles(scratch / "study.h5", results);
    });
  };
  const double few = written(300), many = written(600), more = written(900);
  INFO(few << ' ' << many << ' ' << more);
  // Per surface: the Realisation itself, 0.8 kB; three models of 0.4 kB, and for each of four loads
  // 3 × 224 bytes of samples and 140 of patches: 5.4 kB, and up to 2 kB of the heap. The file holds 4 kB of this, and goes to
  // the disk while it is made. The bootstrap's table took 4000 bytes for each surface and each
  // smaller number of surfaces, 3 MB for each of the last 300.
  CHECK((more - few) / 600 < 8.5e3);
  // Linear: the second 300 take as much as the first, up to two megabytes of the heap.
  CHECK(more - many < many - few + 2e6);
}

TEST_CASE("The memory of a file of results does not grow with its datasets", "[scaling]") {
  const auto written = [](int datasets) {
    return peak_growth([datasets] {
      const Scratch scratch;
      ResultFile results(scratch / "results.h5", {});
      ResultGroup group = results.group("group");
      const std::vector<double> values(20000, 1.5);
      group.index("x", values.size(), "position");
      for (int k = 0; k < datasets; ++k)
        group.dataset("y" + std::to_string(k), values, {"x"}, "m", "height");
      results.commit();
    });
  };
  // 160 kB each, of which HDF5 keeps some 16 in its cache of headers and references.
  CHECK(written(260) - written(20) < 240 * 40e3);
}

TEST_CASE("A text of points is read without being in memory", "[scaling]") {
  const Scratch scratch;
  constexpr Index n = 1024;
  write_surface(scratch / "points.xyz", rough(n));
  const double growth = peak_growth([&] { read_surface(scratch / "points.xyz"); });
  // Three coordinates, the height on its grid and a byte that marks it are 33 bytes. With so few
  // points the heap also keeps the list before its last doubling, 16 bytes per point. The text has
  // 57.
  CHECK(growth < 60. * n * n);
  CHECK(growth > 32. * n * n);  // otherwise nothing was measured
}

TEST_CASE("The memory of a sweep does not grow with its loads", "[scaling]") {
  const Surface surface = rough(256);
  const auto swept = [&](int loads) {
    return peak_growth([&, loads] {
      std::vector<double> pressures;
      for (int k = 0; k < loads; ++k) pressures.push_back(1e6 * std::pow(1.006, k));
      sweep_pressures(surface, material, pressures, {.concurrent_loads = 1});
    });
  };
  // A field of 65536 cells alone would be 0.5 MB per load; only samples of 72 bytes may grow. Loads
  // run one at a time, because with two, more loads mean more chances that both are at their peak
  // at once. Steps of the heap, up to 1.3 MB, depend on the layout of a run and not on a load.
  CHECK(swept(208) - swept(16) < 192 * 10e3);
}

TEST_CASE("The memory of a simulated cycle grows by half a byte a cell and step", "[scaling]") {
  constexpr Index n = 256;
  const Grid2D grid{n, n, 1e-6, 1e-6};
  const ContactSets intervals = [&](double indentation) {
    ContactSetAt level{ContactSet(n, n), indentation, true};
    for (Index ix = 0; ix < n; ++ix)
      for (Index iy = 0; iy < n; ++iy)
        level.contact(ix, iy) =
            std::hypot(double(ix) - n / 2., double(iy) - n / 2.) < n / 4. * indentation / 1e-8;
    return level;
  };
  const auto simulated = [&](int steps) {
    return peak_growth([&, steps] {
      const EqualFrequency motion{.normal_amplitude = 5e-9,
                                  .tangential_amplitude = 1e-9,
                                  .phase = std::numbers::pi / 2,
                                  .angular_frequency = 1};
      simulate_cycle(intervals, grid, material, trajectory_of(motion, 1e-8),
                     {.steps = steps, .max_periods = 1, .stick = {.tolerance = 1e-2}});
    });
  };
  // Takes many steps, because the memory pools of the solves grow with the largest sets and leave
  // gaps in the heap, up to a megabyte in all.
  const double each = (simulated(256) - simulated(32)) / 224;
  // The falling half reuses the sets of the rising half: half a set of one byte per cell. A field
  // of doubles would be 8 bytes.
  CHECK(each < 0.5 * n * n * 1.25);
}

TEST_CASE("The memory of a contact is 43 bytes a cell and its result's", "[scaling]") {
  const auto pressed = [&](Index points) {
    const Surface surface = rough(points);
    return peak_growth([&] { press(surface, 1e10, at_pressure(2e7)); });
  };
  const double each = (pressed(1024) - pressed(512)) / (1024. * 1024 - 512. * 512);
  // docs/reliability.md, "Memory": 43 with contact on a tenth of the cells, half of it for tiles.
  // Large pages add up to 2 MB for each of some ten arrays, 25 bytes per cell here.
  CHECK(each < 70);
  CHECK(each > 20);  // otherwise nothing was measured
}
