# SPDX-License-Identifier: GPL-3.0-or-later
# What the build asks for: the libraries of SalebraFind.cmake and what else this configuration compiles with. All that is missing is
# reported at once. scripts/install-dependencies names the Debian packages.
include(SalebraFind)
set(salebra_missing "")
if(SALEBRA_ONLY_GENERATORS)
  salebra_find(generators)
else()
  salebra_find(report)
endif()
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h)
salebra_need(RANDOM123_INCLUDE_DIR "Random123 (-D RANDOM123_INCLUDE_DIR=FOLDER)")
if(SALEBRA_BUILD_MPI)
  find_package(MPI 3.0 QUIET COMPONENTS C)
  salebra_need(MPI_C_FOUND "MPI 3.0 or later (-D SALEBRA_BUILD_MPI=OFF does without)")
endif()
if(SALEBRA_BUILD_APPS AND NOT SALEBRA_ONLY_GENERATORS)
  find_package(CLI11 QUIET)
  salebra_need(CLI11_FOUND "CLI11 (-D SALEBRA_BUILD_APPS=OFF does without)")
endif()
if(SALEBRA_BUILD_TESTS)
  # Without a version, as Eigen.
  find_package(Catch2 QUIET)
  if(Catch2_FOUND AND Catch2_VERSION VERSION_LESS 2.13)
    set(Catch2_FOUND OFF)
  endif()
  salebra_need(Catch2_FOUND "Catch2 2.13 or later, or 3 (-D SALEBRA_BUILD_TESTS=OFF does without)")
endif()
if(salebra_missing)
  list(JOIN salebra_missing "\n  " lines)
  message(FATAL_ERROR "Missing, or too old, for building salebra:\n  ${lines}\n"
    "On Debian and Ubuntu, scripts/install-dependencies installs them; docs/install.md has the list. "
    "Libraries in a folder of their own are found with -D CMAKE_PREFIX_PATH=FOLDER.")
endif()
