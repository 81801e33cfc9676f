// SPDX-License-Identifier: GPL-3.0-or-later
// Time stamp and versions of libraries for the provenance of a result.
#include <fftw3.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <zip.h>
#include <zlib.h>

#include <Eigen/Core>
#include <chrono>
#include <ctime>
#include <pugixml.hpp>
#include <salebra/io/provenance.hpp>
#include <string_view>

namespace salebra {

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", fmt::gmtime(std::time(nullptr)));
}

std::string library_versions() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  // fftw_version reads like "fftw-3.3.10-sse2-avx".
  std::string_view fftw(fftw_version);
  fftw.remove_prefix(fftw.find('-') + 1);
  return fmt::format("Eigen {}.{}.{}, FFTW {}, GSL {}, HDF5 {}.{}.{}", EIGEN_WORLD_VERSION,
                     EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, fftw.substr(0, fftw.find('-')),
                     gsl_version, major, minor, release);
}

std::string reader_versions() {
  return fmt::format("libzip {}, zlib {}, pugixml {}.{}", zip_libzip_version(), zlibVersion(),
                     PUGIXML_VERSION / 1000, PUGIXML_VERSION % 1000 / 10);
}

}  // namespace salebra
