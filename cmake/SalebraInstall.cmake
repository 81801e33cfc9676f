# SPDX-License-Identifier: GPL-3.0-or-later
# The installed package: libraries with their headers, the program, and what find_package(salebra) needs.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/salebra)

get_property(libraries GLOBAL PROPERTY SALEBRA_LIBRARIES)
install(TARGETS ${libraries} EXPORT salebraTargets FILE_SET HEADERS)
install(EXPORT salebraTargets NAMESPACE salebra:: DESTINATION ${package_dir})
configure_package_config_file(cmake/salebraConfig.cmake.in ${PROJECT_BINARY_DIR}/salebraConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/salebraConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/salebraConfig.cmake ${PROJECT_BINARY_DIR}/salebraConfigVersion.cmake
  DESTINATION ${package_dir})
