# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D ROOT=<tree> -P CheckPurpose.cmake: the second line of each .cpp, below the license, says what the file implements.
# Tests are left out: their names and test cases say it.
cmake_minimum_required(VERSION 3.25)
set(globs)
foreach(folder src generators/src apps python/src bench examples)
  list(APPEND globs ${ROOT}/${folder}/*.cpp)
endforeach()
file(GLOB_RECURSE files LIST_DIRECTORIES false ${globs})
foreach(file IN LISTS files)
  file(READ ${file} head LIMIT 400)
  if(NOT head MATCHES "^// SPDX-License-Identifier: [^\n]*\n// [^ \n][^\n][^\n][^\n]")
    message(SEND_ERROR "${file}: the second line must be '// <what this file implements>'")
  endif()
endforeach()
list(LENGTH files count)
if(count EQUAL 0)
  message(SEND_ERROR "no source was found below ${ROOT}: nothing was checked")
endif()
