# SPDX-License-Identifier: GPL-3.0-or-later
# The components of an installation: `program` has the program, its manual, study files and documentation, `development` the
# libraries, their headers and the files for find_package(salebra), and `mpi`, with SALEBRA_BUILD_MPI, the program salebra-mpi.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/salebra)

get_property(libraries GLOBAL PROPERTY SALEBRA_LIBRARIES)
install(TARGETS ${libraries} EXPORT salebraTargets COMPONENT development FILE_SET HEADERS COMPONENT development)
install(EXPORT salebraTargets NAMESPACE salebra:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(cmake/salebraConfig.cmake.in ${PROJECT_BINARY_DIR}/salebraConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/salebraConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/salebraConfig.cmake ${PROJECT_BINARY_DIR}/salebraConfigVersion.cmake
    ${CMAKE_CURRENT_LIST_DIR}/SalebraFind.cmake
  DESTINATION ${package_dir} COMPONENT development)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program FILES_MATCHING PATTERN "*.md"
  PATTERN "*.bib" PATTERN "*.png" PATTERN "*.svg" PATTERN static EXCLUDE)
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/data COMPONENT program FILES_MATCHING PATTERN "*.toml" PATTERN "*.txt" PATTERN "*.md"
  PATTERN reference EXCLUDE)

# cpack -G DEB makes salebra, libsalebra-dev and, with MPI, salebra-mpi. dpkg-shlibdeps finds the dependencies of the programs. Libraries
# are installed where Debian expects them if the tree is configured for /usr, as in the preset `package`.
set(CPACK_PACKAGE_NAME salebra)
set(CPACK_PACKAGE_VENDOR "The salebra developers")
set(CPACK_PACKAGE_CONTACT "The salebra developers <developers@salebra.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/SalebraDebian.cmake)
set(CPACK_SALEBRA_COPYRIGHT ${PROJECT_SOURCE_DIR}/packaging/debian/copyright)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET salebra_mpi_program)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME salebra)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Generates and measures rough surfaces, presses them by boundary elements\n and by Greenwood-Williamson's model, and computes the relaxation damping\n of oscillating contacts.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME salebra-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "salebra (= ${PROJECT_VERSION})")  # for the manual, study files and documentation
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS "openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION
  "salebra over the processes of MPI: generates and presses a surface that\n one machine does not hold.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsalebra-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "g++, libeigen3-dev (>= 3.4), libfftw3-dev (>= 3.3), libfmt-dev, libgsl-dev (>= 2.7), libhdf5-dev (>= 1.10), libpugixml-dev, libzip-dev, libtomlplusplus-dev, nlohmann-json3-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers of salebra, for CMake's find_package(salebra).")
include(CPack)
