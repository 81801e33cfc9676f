# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT=<tree> -P CheckLibraries.cmake: libraries that take seconds to compile are included by the sources listed here and by
# no other, for each of forty files would pay for them again. So is MPI, which the rest must build without.
cmake_minimum_required(VERSION 3.25)
set(libraries CLI/ nlohmann/ toml[+][+]/ Eigen/[^C] mpi[.]h>)
set(CLI/_in apps/salebra/program.cpp)
set(nlohmann/_in src/io/json.cpp src/io/npy.cpp)
set(toml[+][+]/_in src/study/toml_reader.cpp)
set(mpi[.]h>_in src/mpi/mpi.hpp)
set(Eigen/[^C]_in src/surface/fill.cpp)  # decompositions; Eigen/Core has the arrays

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/include/*.[hc]pp ${ROOT}/src/*.[hc]pp ${ROOT}/src/*.inl
  ${ROOT}/generators/include/*.hpp ${ROOT}/generators/src/*.[hc]pp ${ROOT}/apps/*.[hc]pp ${ROOT}/python/src/*.[hc]pp)
set(seen 0)
foreach(file IN LISTS files)
  foreach(library IN LISTS libraries)
    file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]${library}")
    if(NOT lines)
      continue()
    endif()
    math(EXPR seen "${seen} + 1")
    if(NOT file IN_LIST ${library}_in)
      message(SEND_ERROR "${file} must not ${lines}: only ${${library}_in} may")
    endif()
  endforeach()
endforeach()
if(seen LESS 6)
  message(SEND_ERROR "only ${seen} of 6 sources below ${ROOT} include their library: the list is out of date")
endif()
