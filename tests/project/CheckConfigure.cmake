# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT= -D SCRATCH= -D CXX= -P CheckConfigure.cmake: what others' build systems set is honoured. Configures alone, for Ninja,
# and reads what would be compiled.
cmake_minimum_required(VERSION 3.25)
find_program(ninja ninja)
if(NOT ninja)
  message("skipped: no ninja")
  return()
endif()
file(REMOVE_RECURSE ${SCRATCH})
# configured(OUT SOURCE OPTION…): the commands of a build with these options.
function(configured out source)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${SCRATCH}/${out} -G Ninja -D CMAKE_CXX_COMPILER=${CXX} ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${out} with ${ARGN}\n${said}")
  endif()
  file(READ ${SCRATCH}/${out}/build.ninja commands)
  set(${out} "${commands}" PARENT_SCOPE)
endfunction()
# lacks(COMMANDS PATTERN) and has(COMMANDS PATTERN), by the name of the variable.
function(lacks commands pattern)
  if("${${commands}}" MATCHES "${pattern}")
    message(SEND_ERROR "${commands}: has ${CMAKE_MATCH_0}")
  endif()
endfunction()
function(has commands pattern)
  if(NOT "${${commands}}" MATCHES "${pattern}")
    message(SEND_ERROR "${commands}: lacks ${pattern}")
  endif()
endfunction()

configured(by_default ${ROOT} -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS= -D SALEBRA_BUILD_TESTS=OFF)
has(by_default "src/io/CMakeFiles/salebra_io[.]dir/Unity/unity_0_cxx")
has(by_default " -O3 -DNDEBUG [^\n]* -O1")

# As packagers call it.
configured(packager ${ROOT} -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS=-O2 -D CMAKE_UNITY_BUILD=OFF -D BUILD_TESTING=OFF
  -D BUILD_SHARED_LIBS=ON -D CMAKE_CXX_STANDARD=23)
has(packager "src/io/CMakeFiles/salebra_io[.]dir/hdf5_read[.]cpp[.]o")
has(packager " -O2 ")
has(packager "-std=(c[+][+]23|c[+][+]2b)")
lacks(packager "Unity/unity")
lacks(packager " -O1")
lacks(packager "test_base")
lacks(packager "libsalebra[.]so")  # they link statically; the config file says so

# Within another project: the libraries, and nothing that the program or the tests need.
file(WRITE ${SCRATCH}/outer/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(outer C CXX)
add_subdirectory(${ROOT} salebra)
add_library(ours INTERFACE)
target_link_libraries(ours INTERFACE salebra::study)
if(CMAKE_BUILD_TYPE)
  message(FATAL_ERROR \"the build type of another project was set\")
endif()
")
configured(embedded ${SCRATCH}/outer -D CMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -D CMAKE_DISABLE_FIND_PACKAGE_Catch2=ON)
has(embedded "libsalebra_study[.]a")
lacks(embedded "salebra_program|test_base|salebra_confinement|example_01")
