# SPDX-License-Identifier: GPL-3.0-or-later
# Every third-party library comes from the system; nothing is downloaded at configure time.
# scripts/install-dependencies names the Debian packages.
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(FFTW3F REQUIRED IMPORTED_TARGET fftw3f)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
if(SALEBRA_ONLY_GENERATORS)
  return()
endif()
find_package(GSL 2.7 REQUIRED)
find_package(HDF5 1.10 REQUIRED COMPONENTS C HL)
# libzip's own CMake package asks for its programs, which Debian packs apart.
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
find_package(pugixml REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
if(SALEBRA_BUILD_APPS)
  find_package(CLI11 REQUIRED)
endif()
