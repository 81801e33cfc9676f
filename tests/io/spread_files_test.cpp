// SPDX-License-Identifier: GPL-3.0-or-later
#include <hdf5.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>

#include "ranks_in_threads.hpp"
#include "scratch.hpp"
#include "skipped.hpp"

using namespace salebra;
using Catch::Contains;
using salebra::testing::run_ranks;

namespace {

const Provenance provenance{.command_line = "salebra", .created = "2026-01-01T00:00:00Z"};

// A surface of arbitrary heights, or the rows of one process.
Surface surface_of(Index nx, Index ny, const Communicator& ranks = {}) {
  Surface surface{{nx, ny, 1e-6, 2e-6}, {}, true, "a test", ranks};
  const RowPartition partition = surface.partition();
  surface.heights.resize(partition.count(), ny);
  for (Index i = 0; i < partition.count(); ++i)
    for (Index j = 0; j < ny; ++j)
      surface.heights(i, j) =
          1e-9 * std::sin(1e3 * static_cast<double>((partition.begin() + i) * ny + j));
  return surface;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), {}};
}

// Describes the first difference of two files; empty if their bytes are equal.
std::string first_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::string first = content_of(a), second = content_of(b);
  if (first == second && !first.empty()) return "";
  const std::size_t size = std::min(first.size(), second.size());
  std::size_t at = 0;
  while (at < size && first[at] == second[at]) ++at;
  return "byte " + std::to_string(at) + ", sizes " + std::to_string(first.size()) + " and " +
         std::to_string(second.size());
}

bool same_bits(const Field& a, const double* b) {
  return a.size() == 0 ||
         std::memcmp(a.data(), b, static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

// Writes fields, and other data before, between and after them.
void write_results(const std::filesystem::path& file, const Surface& surface) {
  std::optional<ResultFile> results;
  const Field tripled = 3 * surface.heights;
  collectively(surface.communicator, [&] {
    results.emplace(file, provenance, WriteOptions{}, surface.communicator);
    ResultGroup group = results->group("contact");
    group.coordinate("x", positions(surface.grid.nx, 1), "m", "position");
    group.coordinate("y", positions(surface.grid.ny, 1), "m", "position");
    group.dataset("gap", surface.heights, "x", "y", "m", "gap");
    group.dataset("rounded", tripled, "x", "y", "Pa", "pressure", FieldType::float32);
    group.labels("model", {"bem", "größe"}, "model");
    group.dataset("pressure", tripled, "x", "y", "Pa", "pressure");
    group.scalar("force", 7, "N", "force");
    group.attribute("pressure", 1e6);
    results->group("other/deep").attribute("note", std::string(70'000, 'n'));
  });
  results->commit();
}

// The message of the exception, which all processes must throw.
std::string failure_on_all(int ranks, const std::function<void(const Communicator&)>& body) {
  std::vector<std::string> failures(static_cast<std::size_t>(ranks));
  run_ranks(ranks, [&](const Communicator& all) {
    try {
      body(all);
    } catch (const Error& error) {
      failures[static_cast<std::size_t>(all.rank())] = error.what();
    }
  });
  for (const std::string& failure : failures) CHECK(failure == failures.front());
  return failures.front();
}

bool hdf5_lacks_threads() {
  hbool_t threads = false;
  H5is_library_threadsafe(&threads);
  return testing::skipped(!threads, "this HDF5 library is not for threads");
}

}  // namespace

TEST_CASE("The file of a spread surface is byte for byte that of one process", "[spread]") {
  const Scratch scratch;
  // Fields smaller and larger than the blocks of HDF5 and of PagedFile. Some have processes
  // without rows.
  const auto [nx, ny] =
      GENERATE(std::pair<Index, Index>(16, 3), std::pair<Index, Index>(33, 7),
               std::pair<Index, Index>(128, 65), std::pair<Index, Index>(101, 512));
  write_surface(scratch / "alone.h5", surface_of(nx, ny), provenance);
  write_results(scratch / "alone-results.h5", surface_of(nx, ny));
  const Field expected = (3 * surface_of(nx, ny).heights).cast<float>().cast<double>();
  CHECK(same_bits(ResultReader(scratch / "alone-results.h5").field("contact/rounded"),
                  expected.data()));
  const int ranks = GENERATE(1, 2, 3, 4);
  run_ranks(ranks, [&, nx = nx, ny = ny](const Communicator& all) {
    const Surface surface = surface_of(nx, ny, all);
    write_surface(scratch / "spread.h5", surface, provenance);
    write_results(scratch / "spread-results.h5", surface);
  });
  CHECK(first_difference(scratch / "spread.h5", scratch / "alone.h5") == "");
  CHECK(first_difference(scratch / "spread-results.h5", scratch / "alone-results.h5") == "");
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}) == 4);
}

TEST_CASE("Processes read their rows of a surface in any format", "[spread]") {
  if (hdf5_lacks_threads()) return;
  const Scratch scratch;
  // Small fields are read with the outline of a file, large ones by rows.
  const Surface whole = surface_of(GENERATE(17, 301), 250);
  const std::string name = GENERATE("surface.h5", "surface.txt", "surface.npy");
  write_surface(scratch / name, whole);
  const Surface read = read_surface(scratch / name);
  const int ranks = GENERATE(1, 2, 3, 4);
  run_ranks(ranks, [&](const Communicator& all) {
    const Surface rows = read_surface(scratch / name, {}, all);
    const RowPartition partition = rows.partition();
    if (rows.grid != read.grid || rows.periodic != read.periodic || rows.origin != read.origin)
      throw Error("another surface");
    if (rows.heights.rows() != partition.count() ||
        !same_bits(rows.heights, read.heights.data() + partition.begin() * read.grid.ny))
      throw Error("other heights");
  });
}

TEST_CASE("Processes read their rows of packed fields and of small ones", "[spread]") {
  if (hdf5_lacks_threads()) return;
  const Scratch scratch;
  const std::filesystem::path file = scratch / "packed.h5";
  const Index nx = GENERATE(2, 301), ny = 250;
  std::vector<float> values;
  for (Index k = 0; k < nx * ny; ++k) values.push_back(static_cast<float>(k));
  {
    const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hsize_t shape[] = {static_cast<hsize_t>(nx), static_cast<hsize_t>(ny)},
                  chunk[] = {static_cast<hsize_t>(std::min<Index>(nx, 7)), 11};
    const hid_t space = H5Screate_simple(2, shape, nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(properties, 2, chunk);
    H5Pset_deflate(properties, 4);
    const hid_t dataset =
        H5Dcreate2(made, "p", H5T_IEEE_F32LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(dataset);
    H5Pclose(properties);
    H5Sclose(space);
    H5Fclose(made);
  }
  run_ranks(GENERATE(1, 3), [&](const Communicator& all) {
    const RowPartition partition(all, nx);
    const Field rows = ResultReader(file).field("p", partition);
    for (Index k = 0; k < rows.size(); ++k)
      if (rows.data()[k] != static_cast<double>(partition.begin() * ny + k))
        throw Error("another row");
  });
}

TEST_CASE("A failure of one process while a file is written is thrown on all and leaves nothing",
          "[spread]") {
  const Scratch scratch;
  const int ranks = GENERATE(2, 3, 4);
  // The last process has rows of another surface, which shows after all others have written theirs.
  const std::string wrong = failure_on_all(ranks, [&](const Communicator& all) {
    Surface surface = surface_of(100, 50, all);
    if (all.rank() == ranks - 1) surface.heights.conservativeResize(3, 50);
    write_results(scratch / "out.h5", surface);
  });
  CHECK_THAT(wrong, Contains("are not those of this process"));
  CHECK(std::filesystem::is_empty(scratch.folder()));

  const std::string shape = failure_on_all(ranks, [&](const Communicator& all) {
    Surface surface = surface_of(100, 50, all);
    if (all.rank() == ranks - 1) surface.heights.conservativeResize(3, 50);
    write_surface(scratch / "out.h5", surface);
  });
  CHECK_THAT(shape, Contains("points do not match the grid"));

  // The root has no space on the disk.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10'000;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string full = failure_on_all(ranks, [&](const Communicator& all) {
    write_surface(scratch / "out.h5", surface_of(100, 50, all));
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old);
  CHECK_THAT(full, Contains("cannot be written"));
  CHECK(std::filesystem::is_empty(scratch.folder()));

  // The file exists, which only the root checks.
  scratch.file("out.h5", "there");
  const std::string taken = failure_on_all(ranks, [&](const Communicator& all) {
    write_surface(scratch / "out.h5", surface_of(100, 50, all));
  });
  CHECK_THAT(taken, Contains("exists; name another file"));
  CHECK(content_of(scratch / "out.h5") == "there");

  const std::string absent = failure_on_all(
      ranks, [&](const Communicator& all) { read_surface(scratch / "none.h5", {}, all); });
  CHECK_THAT(absent, Contains("none.h5"));
  const std::string text = failure_on_all(ranks, [&](const Communicator& all) {
    write_surface(scratch / "out.txt", surface_of(100, 50, all));
  });
  CHECK_THAT(text, Contains("needs it whole"));
}

TEST_CASE("A file over processes replaces another one only where that is wanted", "[spread]") {
  const Scratch scratch;
  scratch.file("out.h5", "there");
  run_ranks(3, [&](const Communicator& all) {
    write_surface(scratch / "out.h5", surface_of(100, 50, all), provenance, {.overwrite = true});
  });
  write_surface(scratch / "alone.h5", surface_of(100, 50), provenance);
  CHECK(first_difference(scratch / "out.h5", scratch / "alone.h5") == "");
}
