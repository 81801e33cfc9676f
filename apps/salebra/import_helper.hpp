// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::cli {

/// Makes the library read surfaces of unknown formats through salebra-import, a program of the
/// Python package, if it is on the PATH. If not, the error says how to install it.
void install_import_helper();

}  // namespace salebra::cli
