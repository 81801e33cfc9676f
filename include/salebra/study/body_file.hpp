// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/contact/half_space/body.hpp>

namespace salebra {

/// Reads a body from a TOML file:
///     const Body coated = read_body("coating.toml");
/// with the file
///     [[layer]]                 # any number, from the surface down
///     thickness = "5um"
///     young = "3GPa"
///     poisson = 0.49
///     [base]                    # left out: rigid; without layers: the half-space itself
///     young = "210GPa"
///     poisson = 0.3
/// In their place, [graded] has modulus, depth, exponent and poisson (GradedHalfSpace), and
/// [anisotropic] has c11, c33, c13, c44 and c66 (TransverseStiffness). The key `datum` at the top,
/// mean_plane (default) or base, says what displacements are measured from. Throws InvalidInput with
/// file and line for unknown or missing keys and for constants that the body refuses.
Body read_body(const std::filesystem::path& file);

}  // namespace salebra
