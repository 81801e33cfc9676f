// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::cli {

/// Starts the libraries that crash where their first call gets no memory. To be called before the
/// work; 0.6 ms.
void prepare_for_scarce_memory();

}  // namespace salebra::cli
