// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace salebra {

/// What a file says of its own making, as attributes at its root, beside the program, its version
/// and those of its libraries.
struct Provenance {
  std::string command_line;           ///< as typed; empty when a library call made the file
  std::string configuration;          ///< full text of the configuration, defaults filled in
  std::optional<std::uint64_t> seed;  ///< of the first realisation
  std::string started;     ///< when the run began, ISO 8601 in UTC; empty: not known, not written
  std::string created;     ///< ISO 8601 in UTC; empty: when the file is begun
  std::string arithmetic;  ///< that computed the results; empty: arithmetic() of this program
  std::string revision;    ///< commit of the program's sources; empty: not known, not written
};

/// Now, as "2026-01-31T12:34:56Z".
std::string utc_now();

/// "Eigen 3.4.0, FFTW 3.3.10, GSL 2.7.1, HDF5 1.10.8": the libraries in use, which the last digits
/// of a result depend on.
std::string library_versions();

/// "libzip 1.7.3, zlib 1.2.13, pugixml 1.13": what files of surfaces are read with.
std::string reader_versions();

}  // namespace salebra
