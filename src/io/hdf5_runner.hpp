// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace salebra {

/// One read of an open HDF5 file. A runner carries it out.
struct Hdf5Reading {
  /// Name of the file in messages; the file is not opened again by this name.
  std::filesystem::path file;
  int descriptor = -1;  ///< of the open file, the only one that `read` reads
  /// Memory that `read` may need in addition to that of the process, bytes.
  std::uint64_t memory = 0;
  std::uint64_t seconds = 0;  ///< processor time that `read` may need, s

  /// Calls HDF5, and passes the content of the file to hand_over() as plain bytes, in pieces.
  /// Throws InvalidInput naming the file.
  std::function<void(const std::function<void(std::span<const std::byte>)>& hand_over)> read;
  /// Returns the memory for the next piece, which has this size. Throws InvalidInput if the pieces
  /// together exceed the size that was requested.
  std::function<std::span<std::byte>(std::size_t)> location;
  /// Calls its argument while no other thread of the process is inside HDF5. A child process that
  /// is forked in this call can then use HDF5.
  std::function<void(const std::function<void()>&)> alone;
};

/// Calls `read` of a Hdf5Reading, and copies each piece that it hands over to the memory that
/// `location` returns, in order. Throws InvalidInput naming the file if the file is at fault,
/// IoError if the system is.
using Hdf5Runner = void (*)(const Hdf5Reading&);

/// Sets the runner that reads all HDF5 files from now on. With nullptr, the default, the calling
/// process reads them itself. HDF5 1.10 has memory errors that a damaged or hostile file can
/// trigger, so without a runner every HDF5 file that is read must be trusted. The program and the
/// Python package install a runner that reads in a confined child process (docs/reliability.md).
/// The library alone never starts a process.
void set_hdf5_runner(Hdf5Runner runner);

}  // namespace salebra
