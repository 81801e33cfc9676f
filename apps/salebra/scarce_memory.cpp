// SPDX-License-Identifier: GPL-3.0-or-later
// Guards against libraries that do not survive a failed allocation.
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

// FFTW ends the process through this function if an allocation in its planner fails. The dynamic
// linker looks it up in the program first, so this definition replaces that of FFTW.
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
  // HDF5's cleanup at exit crashes after a failed allocation, and so does its first call. The
  // cleanup is turned off, since all files are closed by then, and the first call is made now.
  H5dont_atexit();
  H5open();
}

}  // namespace salebra::cli
