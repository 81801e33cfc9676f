# SPDX-License-Identifier: GPL-3.0-or-later
# The third-party libraries that salebra's libraries use, for the build and, installed beside salebraConfig.cmake, for projects
# that link them. Every one comes from the system; nothing is downloaded at configure time. Nothing here ends the configuration: what
# is missing is listed, by names and versions that a message can print.

# Each library uses some of those before it, and no later one.
set(salebra_libraries base generators salebra analysis io results study report)

# salebra_need(FOUND WHAT): notes WHAT as missing unless FOUND is true.
macro(salebra_need found what)
  if(NOT ${found})
    list(APPEND salebra_missing "${what}")
  endif()
endmacro()

# salebra_need_module(NAME MODULE WHAT): the target PkgConfig::NAME.
macro(salebra_need_module name module what)
  if(PkgConfig_FOUND AND NOT TARGET PkgConfig::${name})
    pkg_check_modules(${name} QUIET IMPORTED_TARGET ${module})
  endif()
  if(NOT TARGET PkgConfig::${name})
    list(APPEND salebra_missing "${what}")
  endif()
endmacro()

# salebra_find(LIBRARY): looks for what this library and those before it use. Appends what is missing to salebra_missing.
macro(salebra_find library)
  list(FIND salebra_libraries ${library} salebra_rank)
  find_package(Threads QUIET)
  salebra_need(Threads_FOUND "POSIX threads")
  find_package(OpenMP QUIET COMPONENTS CXX)
  salebra_need(OpenMP_CXX_FOUND "OpenMP of the C++ compiler")
  # Without a version: the packages of Eigen 3 and 5 each accept none but their own.
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
    # CMake's module for GSL asks pkg-config.
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
    # libzip's own CMake package asks for its programs, which Debian packs apart.
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
