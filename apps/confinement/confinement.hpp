// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/hdf5_runner.hpp"

/// What the program and the Python package install so that a file of a stranger can do no harm.
namespace salebra::confinement {

/// Carries a reading out in a child process that has the open file, a pipe to its parent, and
/// nothing else: no other descriptor and none to be opened, no process to be started, limits on
/// memory and processor time, and no core file. The parent takes plain bytes from the pipe and never calls HDF5 on the
/// file. Works with threads in the parent, and whatever the parent does with SIGCHLD.
/// throws  InvalidInput naming the file where the child dies, takes too long or refuses the file;
///         IoError where the system grants no child: then nothing is read
/// cost    a fork (0.1 ms, and 5 ms for each GB that the process holds) and two copies of what is
///         read
void run_confined(const Hdf5Reading& reading);

/// From now on all HDF5 files are read by run_confined().
void install();

}  // namespace salebra::confinement
