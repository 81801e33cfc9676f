# SPDX-License-Identifier: GPL-3.0-or-later
# This system's compiler for the system in SALEBRA_OLD_ROOT, whose C library is older (packaging/wheel/build).
set(old_root $ENV{SALEBRA_OLD_ROOT})
set(CMAKE_SYSROOT ${old_root})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_CXX_FLAGS_INIT "-isystem ${CMAKE_CURRENT_LIST_DIR}/libstdc++")
# Named first, or the compiler takes its own libgomp and libgcc_s. Symbols of static libraries stay inside: another extension of the
# same process may have its own HDF5.
set(link "-L${old_root}/usr/lib/x86_64-linux-gnu -L${old_root}/lib/x86_64-linux-gnu -static-libstdc++ -Wl,--exclude-libs,ALL")
set(CMAKE_EXE_LINKER_FLAGS_INIT "${link}")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "${link}")
set(OpenMP_gomp_LIBRARY ${old_root}/usr/lib/x86_64-linux-gnu/libgomp.so CACHE FILEPATH "" FORCE)
