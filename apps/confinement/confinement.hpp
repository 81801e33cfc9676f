// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/hdf5_runner.hpp"

/// Reads untrusted files so that they can do no harm. The program and the Python package install
/// it.
namespace salebra::confinement {

/// Reads a file in a child process that has only the open file and a pipe to its parent. The child
/// cannot open descriptors, start processes or write a core file, and its memory and processor time
/// are limited. The parent takes plain bytes from the pipe and never calls HDF5 on the file. This
/// works with threads in the parent, and with any handling of SIGCHLD.
/// throws  InvalidInput that names the file if the child dies, takes too long or refuses the file;
///         IoError if the system cannot start a child; then nothing is read
/// cost    a fork (0.1 ms, and 5 ms for each GB that the parent holds) and two copies of the
///         bytes read
void run_confined(const Hdf5Reading& reading);

/// Makes the library read all HDF5 files by run_confined().
void install();

}  // namespace salebra::confinement
