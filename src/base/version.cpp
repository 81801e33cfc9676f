// SPDX-License-Identifier: GPL-3.0-or-later
// Version string of the library.
#include <salebra/base/version.hpp>

namespace salebra {

std::string_view version() { return SALEBRA_VERSION; }

}  // namespace salebra
