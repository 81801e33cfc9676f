// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::cli {

/// From now on, surfaces of formats that the library does not know are read through salebra-import,
/// a program of the Python package, where it is on the PATH. Where it is not, the refusal says how to
/// get it.
void install_import_helper();

}  // namespace salebra::cli
