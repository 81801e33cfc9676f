// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace salebra {

/// One reading of an open HDF5 file, which a runner carries out.
struct Hdf5Reading {
  std::filesystem::path file;  ///< to be named in messages; it is not opened again
  int descriptor = -1;         ///< the open file: `read` reads this and nothing else
  std::uint64_t memory = 0;    ///< bytes that `read` may need beyond what the process has
  std::uint64_t seconds = 0;   ///< processor time that `read` may need, s

  /// Calls HDF5 and hands over what it found, as plain bytes in pieces. Throws InvalidInput naming
  /// the file.
  std::function<void(const std::function<void(std::span<const std::byte>)>& hand_over)> read;
  /// Where the next so many bytes of those belong. Throws InvalidInput for more than were
  /// requested.
  std::function<std::span<std::byte>(std::size_t)> location;
  /// Calls its argument while no other thread of the process is inside HDF5, hence in a state that
  /// a child process can go on from.
  std::function<void(const std::function<void()>&)> alone;
};

/// Carries a reading out: calls `read`, and copies what it hands over to `place`, in order and
/// whole.
/// Throws InvalidInput naming the file where that fails because of the file, IoError where it fails
/// because of the system.
using Hdf5Runner = void (*)(const Hdf5Reading&);

/// Who carries out all readings of HDF5 files from now on; nullptr, as at the start: the calling
/// process itself. HDF5 1.10 has memory errors that a damaged or hostile file triggers. Without a
/// runner, every HDF5 file that is read must therefore be trusted. The program and the Python
/// package install a runner that reads in a confined child process (docs/reliability.md); a library
/// call never starts a process on its own.
void set_hdf5_runner(Hdf5Runner runner);

}  // namespace salebra
