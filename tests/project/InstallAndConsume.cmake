# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D BUILD= -D SCRATCH= -D CONSUMER= -D GENERATOR= -D CXX= -D FLAGS= -P InstallAndConsume.cmake: installs the build into an
# empty folder, builds the project CONSUMER against nothing but that folder, and runs its programs.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${status}:\n${output}")
  endif()
endfunction()
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
step(${CMAKE_COMMAND} -S ${CONSUMER} -B ${SCRATCH}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${SCRATCH}/prefix
  -D CMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${FLAGS}")
step(${CMAKE_COMMAND} --build ${SCRATCH}/build)
file(GLOB programs ${SCRATCH}/build/run_*)
if(NOT programs)
  message(FATAL_ERROR "the consumer built no program")
endif()
foreach(program IN LISTS programs)
  step(${program})
endforeach()

# What find_package(salebra) says where something is missing, and what a part of it needs. asks(NAME STATUS TEXT CALL OPTION…): a project
# with this call ends so, and prints the TEXT.
function(asks name expected text call)
  file(WRITE ${SCRATCH}/${name}/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(asks CXX)
function(within_a_function)
  ${call}
  message(STATUS \"found: \${salebra_FOUND}, \${salebra_NOT_FOUND_MESSAGE}\")
endfunction()
within_a_function()
if(TARGET salebra::generators)
  add_executable(run_surface ${CONSUMER}/surface.cpp)
  target_link_libraries(run_surface PRIVATE salebra::generators)
endif()
")
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH}/${name} -B ${SCRATCH}/${name} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${SCRATCH}/prefix
      -D CMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${FLAGS}" ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(NOT status EQUAL expected OR NOT said MATCHES "${text}")
    message(FATAL_ERROR "${name}: should end with ${expected} and say '${text}', but ${status}:\n${said}")
  endif()
endfunction()
set(no_files)
foreach(package HDF5 GSL pugixml nlohmann_json tomlplusplus)
  list(APPEND no_files -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
asks(optional 0 "found: 0, report needs .*libzip, pugixml" "find_package(salebra 2.0 QUIET)" ${no_files}
  -D CMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
asks(modules 1 "salebra_FOUND to FALSE .* report needs pkg-config, FFTW" "find_package(salebra 2.0 REQUIRED)"
  -D CMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
asks(unknown 1 "nothing needs to be one of the components base generators salebra" "find_package(salebra 2.0 REQUIRED COMPONENTS nothing)")
asks(part 0 "found: 1" "find_package(salebra 2.0 REQUIRED COMPONENTS generators OPTIONAL_COMPONENTS io)" ${no_files})
step(${CMAKE_COMMAND} --build ${SCRATCH}/part)
step(${SCRATCH}/part/run_surface)
