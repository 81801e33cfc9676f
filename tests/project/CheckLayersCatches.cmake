# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D SCRATCH=<folder> -P CheckLayersCatches.cmake: the layering test passes a sound tree and fails each planted fault.
cmake_minimum_required(VERSION 3.25)

# check(EXPECTED MESSAGE FILE LINE): a tree of one sound file and FILE, which holds LINE, gives MESSAGE; empty means it passes.
function(check message file line)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/include/salebra/contact/sound.hpp "#include <salebra/base/grid.hpp>\n")
  file(WRITE ${SCRATCH}/${file} "${line}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -D ROOT=${SCRATCH} -P ${CMAKE_CURRENT_LIST_DIR}/CheckLayers.cmake
    RESULT_VARIABLE status ERROR_VARIABLE errors OUTPUT_QUIET)
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
  if(message STREQUAL "" AND NOT status EQUAL 0)
    message(SEND_ERROR "${file} with ${line} should pass, but: ${errors}")
  elseif(NOT message STREQUAL "" AND (status EQUAL 0 OR NOT errors MATCHES "${message}"))
    message(SEND_ERROR "${file} with ${line} should fail with '${message}', but status ${status}: ${errors}")
  endif()
endfunction()

check("" src/damping/closed_form.cpp "#include <salebra/contact/law.hpp>")
check("" src/contact/normal.cpp "#include <salebra/contact/half_space.hpp>")
check("" src/contact/sweep.cpp "#include <salebra/contact/normal.hpp>")
check("layers only look down" src/contact/law.cpp "#include <salebra/damping/oscillation.hpp>")
check("layers only look down" include/salebra/base/grid.hpp "#  include <salebra/surface/moments.hpp>")
check("layers only look down" generators/src/spectrum.cpp "#include <salebra/contact/law.hpp>")
check("layers only look down" src/io/hdf5.cpp "#include \"../study/run.hpp\"")
check("layers only look down" src/io/hdf5.cpp "#include \"study/run.hpp\"")
check("contact models never include" src/contact/mdr.cpp "#include <salebra/contact/normal.hpp>")
check("contact models never include" src/contact/greenwood_williamson.cpp "#include <salebra/contact/mdr.hpp>")
check("contact models never include" include/salebra/contact/normal.hpp "#include <salebra/contact/greenwood_williamson.hpp>")
check("contact models never include" src/contact/normal_pcg.cpp "#include \"greenwood_williamson_heights.hpp\"")
check("stands in no layer" src/utils/misc.cpp "#include <vector>")
file(REMOVE_RECURSE ${SCRATCH})
