// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::cli {

/// Initialises the libraries that crash if memory runs out in their first call. Must be called
/// before the work of a command; takes 0.6 ms.
void prepare_for_scarce_memory();

}  // namespace salebra::cli
