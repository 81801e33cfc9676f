# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the third-party libraries of salebra, for the build and, installed next to salebraConfig.cmake, for projects that link salebra.
# All come from the system; nothing is downloaded at configure time. Nothing here stops the configuration: salebra_missing lists the
# missing ones, with names and versions that a message can print.

# Each library uses only libraries listed before it.
set(salebra_libraries base generators salebra analysis io results study report)

# salebra_need(FOUND WHAT): notes WHAT as missing unless FOUND is true.
macro(salebra_need found what)
  if(NOT ${found})
    list(APPEND salebra_missing "${what}")
  endif()
endmacro()

# salebra_need_module(NAME MODULE WHAT): defines the target PkgConfig::NAME, or notes WHAT as missing.
macro(salebra_need_module name module what)
  if(PkgConfig_FOUND AND NOT TARGET PkgConfig::${name})
    pkg_check_modules(${name} QUIET IMPORTED_TARGET ${module})
  endif()
  if(NOT TARGET PkgConfig::${name})
    list(APPEND salebra_missing "${what}")
  endif()
endmacro()

# salebra_find(LIBRARY): finds the dependencies of this library and of all before it. Appends missing ones to salebra_missing.
macro(salebra_find library)
  list(FIND salebra_libraries ${library} salebra_rank)
  find_package(Threads QUIET)
  salebra_need(Threads_FOUND "POSIX threads")
  find_package(OpenMP QUIET COMPONENTS CXX)
  salebra_need(OpenMP_CXX_FOUND "OpenMP of the C++ compiler")
  # Without a version, because the packages of Eigen 3 and 5 each accept only their own major version.
  find_package(Eigen3 QUIET NO_MODULE)
  if(Eigen3_FOUND AND Eigen3_VERSION VERSION_LESS 3.4)
    set(Eigen3_FOUND OFF)
  endif()
  salebra_need(Eigen3_FOUND "Eigen 3.4 or later")
  find_package(fmt QUIET)
  salebra_need(fmt_FOUND "{fmt}")
  find_package(PkgConfig QUIET)
  salebra_need(PkgConfig_FOUND "pkg-config")
  salebra_need_module(FFTW3 fftw3 "FFTW 3 in double precision")
  salebra_need_module(FFTW3F fftw3f "FFTW 3 in single precision")
  if(salebra_rank GREATER 1)
    # CMake's module for GSL needs pkg-config.
    if(PkgConfig_FOUND)
      find_package(GSL 2.7 QUIET)
    endif()
    salebra_need(GSL_FOUND "GSL 2.7 or later")
  endif()
  if(salebra_rank GREATER 3)
    # CMake's module for HDF5 compiles a C program.
    if(NOT CMAKE_C_COMPILER_LOADED)
      include(CheckLanguage)
      check_language(C)
    endif()
    if(CMAKE_C_COMPILER)
      enable_language(C)
      find_package(HDF5 1.10 QUIET COMPONENTS C HL)
    endif()
    salebra_need(HDF5_FOUND "HDF5 1.10 or later for C, with its high-level library")
    # libzip's own CMake package needs its programs, which Debian packages separately.
    salebra_need_module(LIBZIP libzip "libzip")
    find_package(ZLIB QUIET)
    salebra_need(ZLIB_FOUND "zlib")
    find_package(pugixml QUIET)
    salebra_need(pugixml_FOUND "pugixml")
    find_package(nlohmann_json QUIET)
    salebra_need(nlohmann_json_FOUND "JSON for Modern C++ (nlohmann)")
  endif()
  if(salebra_rank GREATER 5)
    find_package(tomlplusplus QUIET)
    salebra_need(tomlplusplus_FOUND "toml++")
  endif()
endmacro()
