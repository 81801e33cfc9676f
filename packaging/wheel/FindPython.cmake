# SPDX-License-Identifier: GPL-3.0-or-later
# In place of CMake's module, which wants headers and interpreter of one version: the headers of SALEBRA_WHEEL_PYTHON in the older
# system, and an interpreter that runs here. Python 3.12 and later get the stable ABI, for which nanobind asks for Python::SABIModule.
set(Python_FOUND ON)
set(Python_VERSION ${SALEBRA_WHEEL_PYTHON})
set(Python_INTERPRETER_ID Python)
string(REPLACE "." "" digits ${SALEBRA_WHEEL_PYTHON})
set(Python_SOABI cpython-${digits}-x86_64-linux-gnu)
set(Python_INCLUDE_DIRS ${CMAKE_SYSROOT}/usr/include/python${SALEBRA_WHEEL_PYTHON})
if(NOT TARGET Python::Interpreter)
  add_executable(Python::Interpreter IMPORTED)
  set_target_properties(Python::Interpreter PROPERTIES IMPORTED_LOCATION ${Python_EXECUTABLE})
  add_library(Python::Module INTERFACE IMPORTED)
  set_target_properties(Python::Module PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${Python_INCLUDE_DIRS})
  add_library(Python::SABIModule ALIAS Python::Module)
endif()
