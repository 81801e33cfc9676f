# SPDX-License-Identifier: GPL-3.0-or-later
# CPack runs this over the files of each Debian package before it packs them: what Debian asks of packages, and of no other
# installation.
cmake_minimum_required(VERSION 3.25)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(documents ${root}/share/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  file(COPY ${CPACK_SALEBRA_COPYRIGHT} DESTINATION ${documents})
  # The copyright names the license, which is part of Debian. Debian's zsh looks into vendor-completions.
  file(REMOVE_RECURSE ${documents}/LICENSE ${root}/share/zsh/site-functions)
  file(WRITE ${documents}/changelog "salebra (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What changed is in the CHANGELOG.md of the package salebra.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  file(GLOB compressed ${root}/share/man/*/* ${documents}/changelog ${documents}/CHANGELOG.md)
  execute_process(COMMAND gzip -9 --no-name ${compressed} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
