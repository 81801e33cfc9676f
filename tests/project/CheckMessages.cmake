# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT=<tree> -P CheckMessages.cmake: no text of the library or of the Python package names an option or a command of the
# program. They name arguments, as in "use fewer `steps`", and the program says what it calls them.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/src/*.[hc]pp ${ROOT}/include/*.hpp ${ROOT}/generators/src/*.[hc]pp
  ${ROOT}/generators/include/*.hpp ${ROOT}/python/src/*.[hc]pp ${ROOT}/python/salebra/*.py)
set(commands "compare|contact|convert|damper|damping|fit|generate|mdr|oscillate|report|sliding|statistics|study|verify")
set(seen 0)
foreach(file IN LISTS files)
  # Two run gnuplot and Chromium with their options, the third is a command line of its own.
  if(file STREQUAL src/figures/plot.cpp OR file STREQUAL src/report/print.cpp OR file STREQUAL python/salebra/_importing.py)
    continue()
  endif()
  file(STRINGS ${ROOT}/${file} lines REGEX "\"")
  foreach(line IN LISTS lines)
    math(EXPR seen "${seen} + 1")
    if(line MATCHES "^[^\"]*\"(.*)\"[^\"]*$")
      if(CMAKE_MATCH_1 MATCHES "(^|[^-a-z])--[a-z]" OR CMAKE_MATCH_1 MATCHES "(^|[^a-z.])salebra (${commands})($|[^a-z])")
        message(SEND_ERROR "${file}: a message names an option or a command: ${line}")
      endif()
    endif()
  endforeach()
endforeach()
if(seen LESS 1000)
  message(SEND_ERROR "only ${seen} texts were found below ${ROOT}: nothing was checked")
endif()
