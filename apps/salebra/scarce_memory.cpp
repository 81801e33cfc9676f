// SPDX-License-Identifier: GPL-3.0-or-later
// What the program makes of libraries that do not survive a failed allocation.
#include "scarce_memory.hpp"

#include <hdf5.h>

#include <cstdlib>
#include <new>
#include <string_view>

namespace {

[[noreturn]] void fail_assertion(const char* file) {
  if (std::string_view(file).ends_with("alloc.c")) throw std::bad_alloc();
  std::abort();
}

}  // namespace

// FFTW's planner ends the process where it gets no memory, by a function that the dynamic linker
// looks up in the program first.
extern "C" {
[[noreturn]] void fftw_assertion_failed(const char*, int, const char* file) {
  fail_assertion(file);
}
[[noreturn]] void fftwf_assertion_failed(const char*, int, const char* file) {
  fail_assertion(file);
}
}

namespace salebra::cli {

void prepare_for_scarce_memory() {
  // HDF5's cleanup at exit crashes after a failed allocation, as its first call does. All files are
  // closed by then.
  H5dont_atexit();
  H5open();
}

}  // namespace salebra::cli
