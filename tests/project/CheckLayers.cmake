# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT=<tree> -P CheckLayers.cmake: fails where a file includes a header of a higher layer than its own, or, inside
# contact/, of a room that its own room must not see. A file's layer and room are the folders that it stands in.
cmake_minimum_required(VERSION 3.25)
set(layers base generators surface contact damping analysis io results study figures export report mpi apps salebra.hpp)

# The rooms of contact/, and which others each of them sees: folders, and single files of that name.
set(rooms half_space/ law/ normal/ asperity/ mdr/ tangential/ theories. sweep. operating_point.)
set(half_space_sees)                                  # the elastic bodies: their constants, kernels and loads
set(law_sees)                                         # what every model returns: ForceCurve and ContactLaw
set(normal_sees half_space operating_point)           # pressures by boundary elements
set(asperity_sees half_space law)                     # summits
set(mdr_sees half_space law)                          # axisymmetric indenters
set(theories_sees half_space law)                     # closed theories
set(tangential_sees half_space normal)                # tractions with and without slip
set(sweep_sees half_space law normal tangential)      # a surface's force curve
set(operating_point_sees)                             # the control quantity and its value

file(GLOB_RECURSE files RELATIVE ${ROOT}
  ${ROOT}/include/*.[hc]pp ${ROOT}/src/*.[hc]pp ${ROOT}/src/*.inl ${ROOT}/generators/*.[hc]pp ${ROOT}/apps/*.[hc]pp)
list(FILTER files EXCLUDE REGEX "^generators/tests/")  # tests may look at anything
set(seen 0)
list(FIND layers mpi mpi)

# layer_of(path out): the rank of the first layer that a folder of the path names; the facade salebra.hpp is one by itself, of users alone.
function(layer_of path out)
  string(REPLACE "/" ";" folders "${path}")
  foreach(folder IN LISTS folders)
    list(FIND layers "${folder}" rank)
    if(rank GREATER_EQUAL 0)
      set(${out} ${rank} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${out} -1 PARENT_SCOPE)
endfunction()

# room_of(path out): the folder or file below contact/, or empty for a path elsewhere.
function(room_of path out)
  set(${out} "" PARENT_SCOPE)
  if(path MATCHES "^(include/salebra|salebra|src)/contact/([a-z_]+[./])")
    set(${out} ${CMAKE_MATCH_2} PARENT_SCOPE)
  endif()
endfunction()

foreach(file IN LISTS files)
  layer_of(${file} here)
  if(here EQUAL -1)
    message(SEND_ERROR "${file} stands in no layer (${layers})")
    continue()
  endif()
  room_of(${file} this_room)
  if(this_room AND NOT this_room IN_LIST rooms)
    message(SEND_ERROR "${file} stands in no room of contact (${rooms})")
    continue()
  endif()
  get_filename_component(folder ${file} DIRECTORY)
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(line MATCHES "[<\"](salebra/[^>\"]+)[>\"]")
      set(target ${CMAKE_MATCH_1})
    elseif(line MATCHES "\"([^\"]+)\"")
      # A private header: relative to the file, else to src/ ("base/numerics/quadrature.hpp").
      set(target ${CMAKE_MATCH_1})
      if(NOT target MATCHES "^[a-z_]+/" OR EXISTS ${ROOT}/${folder}/${target})
        cmake_path(SET target NORMALIZE "${folder}/${target}")
      else()
        set(target src/${target})
      endif()
    else()
      continue()
    endif()
    math(EXPR seen "${seen} + 1")
    layer_of(${target} there)
    if(there GREATER here)
      message(SEND_ERROR "${file} must not ${line}: layers only look down (${layers})")
    endif()
    if(here EQUAL mpi AND there GREATER 0 AND there LESS mpi)
      message(SEND_ERROR "${file} must not ${line}: mpi sees only base")
    endif()
    room_of(${target} that_room)
    if(this_room AND that_room AND NOT this_room STREQUAL that_room)
      string(REGEX REPLACE "[./]$" "" this_name ${this_room})
      string(REGEX REPLACE "[./]$" "" that_name ${that_room})
      if(NOT that_name IN_LIST ${this_name}_sees)
        message(SEND_ERROR "${file} must not ${line}: contact/${this_name} sees only ${${this_name}_sees}")
      endif()
    endif()
  endforeach()
endforeach()
if(seen EQUAL 0)
  message(SEND_ERROR "no include of the project was found below ${ROOT}: nothing was checked")
endif()
