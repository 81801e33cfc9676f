// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing of its own: CMakeLists.txt precompiles what every test includes with it.
