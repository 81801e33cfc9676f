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
