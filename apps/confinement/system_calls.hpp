// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra::confinement {

/// From now on, and for good, this process may read `input` by pread, write to `output`, allocate
/// memory and end; any other system call fails with EPERM. Returns false, with nothing changed,
/// where the system has no seccomp or its processor is not known.
bool restrict_system_calls(int input, int output);

}  // namespace salebra::confinement
