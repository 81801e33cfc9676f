// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>

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
/// file and line for unknown or missing keys and for constants that the body refuses, and for a
/// [[relaxation]] table (read_viscoelastic_body()).
Body read_body(const std::filesystem::path& file);

/// A linear body that relaxes as a whole.
struct ViscoelasticBody {
  Body body;               ///< the relaxed response
  PronySeries relaxation;  ///< of which only G_k/G∞ and τ_k count; without terms: elastic
};

/// Reads a body as read_body() does, whose file may also have the terms of a Prony series:
///     [[relaxation]]            # G(t) = G∞ (1 + Σ weight·exp(−t/time)), with the moduli above as
///     weight = 0.8              # the relaxed ones G∞; any number of terms
///     time = "2ms"
/// The series holds for all layers and the base. Throws InvalidInput also unless each weight and
/// time is > 0.
ViscoelasticBody read_viscoelastic_body(const std::filesystem::path& file);

}  // namespace salebra
