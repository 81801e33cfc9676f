// SPDX-License-Identifier: GPL-3.0-or-later
// A disk and an HDF5 library that keep other values than they were given: what was written is read
// back and refused.
#include <dlfcn.h>
#include <hdf5.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <salebra/base/error.hpp>
#include <salebra/io/write_surface.hpp>
#include <vector>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

enum class Fault { none, disk, datasets };
Fault fault = Fault::none;

Surface example() { return {{2, 2, 1e-6, 1e-6}, Field::Constant(2, 2, 1e-9), true, "constant"}; }

}  // namespace

// In place of the functions of the C library and of HDF5, for the whole program.
extern "C" {

ssize_t pread(int descriptor, void* bytes, size_t size, off_t place) {
  const ssize_t count = syscall(SYS_pread64, descriptor, bytes, size, place);
  if (fault == Fault::disk && count > 0) *static_cast<char*>(bytes) ^= 1;
  return count;
}

herr_t H5Dwrite(hid_t dataset, hid_t type, hid_t memory, hid_t file, hid_t transfer,
                const void* values) {
  static const auto original = reinterpret_cast<decltype(&H5Dwrite)>(dlsym(RTLD_NEXT, "H5Dwrite"));
  if (fault != Fault::datasets || H5Tequal(type, H5T_NATIVE_DOUBLE) <= 0)
    return original(dataset, type, memory, file, transfer, values);
  const hid_t space = H5Dget_space(dataset);
  const auto* given = static_cast<const double*>(values);
  std::vector<double> other(given, given + H5Sget_simple_extent_npoints(space));
  H5Sclose(space);
  other.back() *= 2;
  return original(dataset, type, memory, file, transfer, other.data());
}

}  // extern "C"

TEST_CASE("What a disk or HDF5 keeps differently is refused, and the file before it stays",
          "[write]") {
  const Scratch scratch;
  const auto file = scratch / "surface.h5";
  std::ofstream(file) << "before";
  const auto [kind, message] = GENERATE(
      table<Fault, std::string>({{Fault::disk, "the disk returns other bytes than were written"},
                                 {Fault::datasets, "holds other values than it was given"}}));
  fault = kind;
  CHECK_THROWS_WITH(write_surface(file, example(), {}, {.overwrite = true}), Contains(message));
  fault = Fault::none;
  std::string text;
  std::getline(std::ifstream(file), text);
  CHECK(text == "before");
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}) == 1);
  CHECK_NOTHROW(write_surface(file, example(), {}, {.overwrite = true}));
}
