# SPDX-License-Identifier: GPL-3.0-or-later
# salebra_library(TARGET NAME [LIKE]): defines a library with the project's warnings, the alias salebra::NAME and an installed header set.
# LIKE: a target with the same compiler flags, whose precompiled headers this one reuses (salebra_parse_once).
# Public headers belong to the file set HEADERS; private headers are in src/, next to the sources.
function(salebra_library target alias)
  add_library(${target} STATIC)
  add_library(salebra::${alias} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${alias})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  salebra_warnings(${target})
  salebra_parse_once(${target} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY SALEBRA_LIBRARIES ${target})
endfunction()

function(salebra_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Wdouble-promotion $<$<BOOL:${SALEBRA_WERROR}>:-Werror>)
  # GCC 12 sees overlapping copies in std::string's own concatenation (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()

# GCC forgets which precompiled headers are system headers and then warns of overruns in std::string.
function(salebra_precompiled_warnings target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

# Common headers are precompiled once per target, and 32 sources are compiled as one, which instantiates shared templates once. With 30
# sources a compiler took 1.3 GB, with 18 it took 1.1 GB but 4 % more processor time. Names in unnamed namespaces must therefore be unique
# in a target. Every file still includes what it uses: development builds, with SALEBRA_WERROR, compile each file alone.
# CMAKE_UNITY_BUILD=OFF and CMAKE_DISABLE_PRECOMPILE_HEADERS switch these off, as in every project.
function(salebra_parse_once target)
  if(SALEBRA_WERROR)
    return()
  endif()
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 32)
  endif()
  # In a combined source a name may hide that of another file, and types of an unnamed namespace seem to come from an included file.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  if(ARGN)
    target_precompile_headers(${target} REUSE_FROM ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem>
      <fmt/format.h> <functional> <limits> <map> <memory> <numbers> <optional> <span> <sstream> <string> <string_view> <utility>
      <variant> <vector>)
  endif()
  salebra_precompiled_warnings(${target})
endfunction()

# salebra_compile_fast(TARGET [SOURCE…]): compiles a target with -O1, in two thirds of the time, unless the user chose an optimisation.
# It is for code that reads, writes and checks; numbers keep their bits. The SOURCEs are speed-critical and get -O2.
function(salebra_compile_fast target)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-O" AND CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    if(ARGN)
      # The precompiled headers have the other optimisation level: GCC 13 would reject them, with a warning.
      set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES
        COMPILE_OPTIONS $<$<CONFIG:Release>:-O2> SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endif()
endfunction()

# Examples and benchmarks spend most of their compile time on headers. The first program owns the precompiled headers, the others reuse them.
function(salebra_program_headers target)
  if(SALEBRA_WERROR)
    return()
  endif()
  get_property(owner GLOBAL PROPERTY SALEBRA_PROGRAM_HEADERS)
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map>
      <memory> <numbers> <optional> <span> <sstream> <string> <vector>)
    set_property(GLOBAL PROPERTY SALEBRA_PROGRAM_HEADERS ${target})
  endif()
  salebra_precompiled_warnings(${target})
endfunction()
