# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the libraries of SalebraFind.cmake and the other requirements of this configuration, and reports all missing ones at once.
# scripts/install-dependencies names the Debian packages.
include(SalebraFind)
set(salebra_missing "")
# Clang 14 and 15 can neither capture a structured binding in a lambda nor initialise an aggregate in parentheses, so the code avoids both.
set(compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
string(REGEX MATCH "^(GNU ([1-9]|1[01])|Clang ([1-9]|1[0-3]))[.]" old "${compiler}")
if(old)
  list(APPEND salebra_missing "a compiler of C++20: GCC 12 or later, or Clang 14 or later (this is ${compiler})")
endif()
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
  # Without a version, as for Eigen in SalebraFind.cmake.
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

# HDF5 is linked statically into targets that ask for it: the shared library loads network libraries, for files on servers, which take 40 %
# of the program's start. A Python extension needs position-independent code, which static libraries may lack.
if(NOT SALEBRA_ONLY_GENERATORS)
  option(SALEBRA_HDF5_ARCHIVE "Link HDF5's archives into the program, where there are any" ON)
  # Only the folder of the shared library is searched, so that headers and archive have the same version.
  string(REGEX REPLACE "/[^/;]*(;.*)?$" "" beside "${HDF5_C_LIBRARIES}")
  find_library(HDF5_ARCHIVE NAMES libhdf5.a PATHS ${beside} NO_DEFAULT_PATH)
  find_library(HDF5_HL_ARCHIVE NAMES libhdf5_hl.a PATHS ${beside} NO_DEFAULT_PATH)
  set(archives ${HDF5_HL_ARCHIVE} ${HDF5_ARCHIVE} ZLIB::ZLIB sz m ${CMAKE_DL_LIBS})
  set(shared hdf5::hdf5_hl hdf5::hdf5)
  if(SALEBRA_HDF5_ARCHIVE AND HDF5_ARCHIVE AND HDF5_HL_ARCHIVE)
    include(CheckCSourceCompiles)
    set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIRS})
    set(CMAKE_REQUIRED_LIBRARIES ${archives})
    check_c_source_compiles("#include <hdf5.h>\n#include <hdf5_hl.h>\nint main(void) { return H5open() + H5LTfind_dataset(0, \"\"); }"
      HDF5_ARCHIVES_SUFFICE)
    unset(CMAKE_REQUIRED_INCLUDES)
    unset(CMAKE_REQUIRED_LIBRARIES)
  endif()
  if(NOT (SALEBRA_HDF5_ARCHIVE AND HDF5_ARCHIVES_SUFFICE))
    set(archives ${shared})
  endif()
  add_library(salebra_hdf5 INTERFACE)
  target_include_directories(salebra_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
  target_compile_definitions(salebra_hdf5 INTERFACE ${HDF5_DEFINITIONS})
  target_link_libraries(salebra_hdf5 INTERFACE
    "$<IF:$<BOOL:$<TARGET_PROPERTY:SALEBRA_HDF5_ARCHIVE>>,${archives},${shared}>")
endif()
