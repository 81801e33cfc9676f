# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT= -D SCRATCH= -D GENERATOR= -D CXX= -P CheckFind.cmake: which libraries a configuration accepts, and what it says of
# those that are missing. Packages of other versions than this system's are imitated by their CMake files alone.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
file(WRITE ${SCRATCH}/source/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(find C CXX)
list(APPEND CMAKE_MODULE_PATH ${ROOT}/cmake)
include(SalebraDependencies)
message(STATUS \"all found: Eigen \${Eigen3_VERSION}, Catch2 \${Catch2_VERSION}\")
")

# imitate(PACKAGE VERSION FILE): its version file accepts requests for its own major version and for none.
function(imitate package version file)
  string(REGEX MATCH "^[0-9]+" major ${version})
  set(folder ${SCRATCH}/${package}-${version})
  file(WRITE ${folder}/${package}Config.cmake "${file}")
  file(WRITE ${folder}/${package}ConfigVersion.cmake "set(PACKAGE_VERSION ${version})
if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_MAJOR EQUAL ${major})
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
")
endfunction()
imitate(Eigen3 5.0.1 "add_library(Eigen3::Eigen INTERFACE IMPORTED)")
imitate(Eigen3 3.3.9 "add_library(Eigen3::Eigen INTERFACE IMPORTED)")
imitate(Catch2 3.4.0 "add_library(Catch2::Catch2WithMain INTERFACE IMPORTED)")
imitate(Catch2 2.9.0 "add_library(Catch2::Catch2 INTERFACE IMPORTED)")

# check(NAME SUCCEEDS TEXT OPTION…): a configuration with these options succeeds or not, and prints the TEXT.
function(check name succeeds text)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH}/source -B ${SCRATCH}/build-${name} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX}
      ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if((status EQUAL 0 AND NOT succeeds) OR (NOT status EQUAL 0 AND succeeds))
    message(SEND_ERROR "${name}: status ${status}\n${said}")
  elseif(NOT said MATCHES "${text}")
    message(SEND_ERROR "${name}: does not say '${text}' but\n${said}")
  endif()
endfunction()

check(newer TRUE "all found: Eigen 5[.]0[.]1, Catch2 3[.]4[.]0" -D SALEBRA_BUILD_TESTS=ON -D Eigen3_DIR=${SCRATCH}/Eigen3-5.0.1
  -D Catch2_DIR=${SCRATCH}/Catch2-3.4.0)
check(older FALSE "too old, for building salebra: Eigen 3[.]4 or later Catch2 2[.]13 or later, or 3 [(]-D SALEBRA_BUILD_TESTS=OFF"
  -D SALEBRA_BUILD_TESTS=ON -D Eigen3_DIR=${SCRATCH}/Eigen3-3.3.9 -D Catch2_DIR=${SCRATCH}/Catch2-2.9.0)
set(absent)
foreach(package Catch2 CLI11 GSL HDF5 pugixml nlohmann_json tomlplusplus)
  list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
# Every one is named, in one message.
check(absent FALSE "GSL 2[.]7 or later HDF5 1[.]10 .* pugixml JSON .* toml[+][+] CLI11 .*docs/install[.]md" ${absent} -D SALEBRA_BUILD_APPS=ON)
check(modules FALSE "pkg-config FFTW 3 in double precision FFTW 3 in single precision GSL .*libzip" -D CMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
# The generators need none of these.
check(generators TRUE "all found" ${absent} -D SALEBRA_ONLY_GENERATORS=ON)
