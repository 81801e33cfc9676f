// SPDX-License-Identifier: GPL-3.0-or-later
// Tests offsets beyond 2^31 and 2^32 bytes and numbers, in a sparse file of which only some rows
// are written.
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/io/result_file.hpp>

#include "one_of_many.hpp"
#include "ranks_in_threads.hpp"
#include "scratch.hpp"
#include "skipped.hpp"

namespace {

bool takes_no_room_in_advance = false;

}  // namespace

// Replaces the C library's function: the test needs more space than disks have free, so it imitates
// a file system that cannot reserve space.
extern "C" int fallocate(int descriptor, int mode, off_t start, off_t size) {
  if (!takes_no_room_in_advance)
    return static_cast<int>(syscall(SYS_fallocate, descriptor, mode, start, size));
  errno = EOPNOTSUPP;
  return -1;
}
extern "C" int fallocate64(int, int, off64_t, off64_t) __attribute__((alias("fallocate")));

using namespace salebra;

namespace {

// The first and the last of many processes. The others do not exist; they would contribute zeros.
class FirstAndLast : public detail::Transport {
 public:
  FirstAndLast(Communicator both, int ranks) : both_(std::move(both)), ranks_(ranks) {}
  int rank() const override { return both_.is_root() ? 0 : ranks_ - 1; }
  int size() const override { return ranks_; }
  void broadcast(void* bytes, std::size_t count, int from) override {
    both_.broadcast(bytes, count, from == 0 ? 0 : 1);
  }
  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) override {
    std::size_t size = 0;
    for (const std::size_t part : bytes) size += part;
    std::memset(all, 0, size);
    std::string ends(bytes.front() + bytes.back(), '\0');
    both_.gather_all(mine, std::array{bytes.front(), bytes.back()}, ends.data());
    std::memcpy(all, ends.data(), bytes.front());
    std::memcpy(static_cast<char*>(all) + size - bytes.back(), ends.data() + bytes.front(),
                bytes.back());
  }
  void exchange(std::size_t, const void*, const Parts&, void*, const Parts&) override {
    throw Error("nobody exchanges");
  }
  std::shared_ptr<Transport> split(int) override { throw Error("nobody splits"); }

 private:
  Communicator both_;
  int ranks_;
};

constexpr Index columns = 65536;

// Integers that float represents exactly and that differ between neighbouring cells and between
// processes.
double value_at(Index row, Index column) {
  return static_cast<double>((row * 4099 + column * 7) % 8388593);
}

Field rows_of(const RowPartition& partition) {
  Field rows(partition.count(), columns);
  for (Index i = 0; i < partition.count(); ++i)
    for (Index j = 0; j < columns; ++j) rows(i, j) = value_at(partition.begin() + i, j);
  return rows;
}

bool has_holes(const Scratch& scratch) {
  const std::filesystem::path file = scratch.file("probe", "");
  std::filesystem::resize_file(file, 64 << 20);
  struct stat status {};
  const bool sparse = stat(file.c_str(), &status) == 0 && status.st_blocks < 1024;
  std::filesystem::remove(file);
  return sparse;
}

}  // namespace

TEST_CASE("Rows beyond 2^32 bytes and numbers of a file are written and read at their places",
          "[spread]") {
  const Scratch scratch;
  if (testing::skipped(!has_holes(scratch), "this file system has no sparse files")) return;
  // 4.4·10^9 numbers per field: 17 GB as float, then 35 GB as double. Each process has 80 rows.
  const Index rows = 66560;
  const int ranks = 832;
  const std::filesystem::path file = scratch / "large.h5";
  takes_no_room_in_advance = true;
  testing::run_ranks(2, [&](const Communicator& both) {
    const Communicator all(std::make_shared<FirstAndLast>(both, ranks));
    const RowPartition partition(all, rows);
    const Field mine = rows_of(partition);
    if (partition.count() != 80 ||
        (!all.is_root() && partition.begin() * columns <= Index{1} << 32))
      throw Error("other rows");
    std::optional<ResultFile> results;
    collectively(all, [&] {
      results.emplace(file, Provenance{}, WriteOptions{}, all);
      ResultGroup group = results->group("contact");
      group.coordinate("x", positions(rows, 1), "m", "position");
      group.coordinate("y", positions(columns, 1), "m", "position");
      group.dataset("pressure", mine, "x", "y", "Pa", "pressure", FieldType::float32);
      group.dataset("gap", mine, "x", "y", "m", "gap");
    });
    results->commit();
  });
  takes_no_room_in_advance = false;

  struct stat status {};
  REQUIRE(stat(file.c_str(), &status) == 0);
  CHECK(status.st_size > 12 * Index{rows} * columns);
  CHECK(status.st_blocks * 512 < status.st_size / 100);
  // One process after the other, since not every HDF5 library is thread-safe. A process in between
  // reads a hole.
  const ResultReader results(file);
  for (const int rank : {0, 416, ranks - 1})
    for (const char* name : {"contact/pressure", "contact/gap"}) {
      const auto process = std::make_shared<testing::OneOfMany>(rank, ranks);
      const RowPartition partition(Communicator(process), rows);
      const Field found = results.field(name, partition);
      const bool written = rank == 0 || rank == ranks - 1;
      REQUIRE(found.rows() == 80);
      CHECK((written ? (found == rows_of(partition)).all() : (found == 0).all()));
    }
}
