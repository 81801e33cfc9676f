# SPDX-License-Identifier: GPL-3.0-or-later
# CPack runs this on the files of each Debian package before it packs them. It adds what Debian's policy requires of packages and other
# installations do not need.
cmake_minimum_required(VERSION 3.25)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(documents ${root}/share/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  file(COPY ${CPACK_SALEBRA_COPYRIGHT} DESTINATION ${documents})
  # The copyright file refers to the license text that Debian ships. Debian's zsh reads vendor-completions instead of site-functions.
  file(REMOVE_RECURSE ${documents}/LICENSE ${root}/share/zsh/site-functions)
  file(WRITE ${documents}/changelog "salebra (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What changed is in the CHANGELOG.md of the package salebra.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  file(GLOB compressed ${root}/share/man/*/* ${documents}/changelog ${documents}/CHANGELOG.md)
  execute_process(COMMAND gzip -9 --no-name ${compressed} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
