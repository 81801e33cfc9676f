# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D SOURCE=FOLDER -D FILE=revision.inc -P revision.cmake: writes which commit FOLDER holds, where that changed. Empty where FOLDER is no
# clone, or git is missing.
set(revision "")
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)
  # Without the tags that a clone may have; without a lock, which would be in the way of a commit at the same time.
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 ${git} describe --always --exclude=* --abbrev=12 --dirty=-modified
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "constexpr std::string_view revision_of_sources = \"${revision}\";\n")
