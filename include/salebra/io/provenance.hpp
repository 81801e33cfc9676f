// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace salebra {

/// Provenance of a file, stored as attributes at its root together with the versions of the program
/// and its libraries, e.g. `Provenance{.seed = 1, .started = utc_now()}`.
struct Provenance {
  std::string command_line;           ///< as typed; empty if a library call made the file
  std::string configuration;          ///< full text of the configuration, including defaults
  std::optional<std::uint64_t> seed;  ///< seed of the first realisation
  std::string started;     ///< when the run began, ISO 8601 in UTC; empty: not known, not written
  std::string created;     ///< ISO 8601 in UTC; empty: time when the file is created
  std::string arithmetic;  ///< arithmetic used for the results; empty: arithmetic() of this program
  std::string revision;    ///< commit of the program's sources; empty: not known, not written
};

/// Returns the current time in UTC, as "2026-01-31T12:34:56Z".
std::string utc_now();

/// Returns the names and versions of the libraries on which the last digits of a result depend,
/// e.g. "Eigen 3.4.0, FFTW 3.3.10, GSL 2.7.1, HDF5 1.10.8".
std::string library_versions();

/// Returns the names and versions of the libraries that read surface files, e.g. "libzip 1.7.3,
/// zlib 1.2.13, pugixml 1.13".
std::string reader_versions();

}  // namespace salebra
