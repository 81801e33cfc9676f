// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/contact/normal/adhesion.hpp>

/// Plastic first loading: the highest parts of a surface yield and leave a residual surface.
///     const ResidualSurface left = after_first_loading(surface, 1.1e11, 2e8, {.hardness = 2e9});
/// Pressures are limited to the hardness H. Where p = H, the surface sinks in by
///     w = h − max h + δ − Gp >= 0,   0 elsewhere,
/// with the pressure p, its displacement Gp (G as in press()), the heights h and the indentation δ.
/// The residual heights h − w satisfy the conditions of an elastic contact under the same
/// pressures. Unloading, and every later cycle below the load of the first loading, is therefore
/// the elastic contact of the residual surface, which replaces the original surface in all later
/// calls. Reloading follows the unloading curve up to the load of the first loading. The bodies are
/// elastic and perfectly plastic: there is no hardening and no pile-up next to the contact. The
/// model is that of Almqvist et al. (2007); Johnson (1985), section 6.4, treats the unloading of a
/// sphere.
namespace salebra {

/// Results of a first loading; NaN if there was none.
struct FirstLoading {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double pressure = unknown;               ///< largest nominal pressure, Pa
  double yielded_area_fraction = unknown;  ///< cells with p = H over all cells
  double mean_plastic_depth = unknown;     ///< mean plastic depth w over all cells, m
  double max_plastic_depth = unknown;      ///< largest plastic depth w, m

  bool yielded() const { return yielded_area_fraction > 0; }
};

constexpr void describe(auto&& visit, std::type_identity<FirstLoading>) {
  using enum Dimension;
  using S = FirstLoading;
  visit(&S::pressure, Quantity{"first_loading_pressure", Dimension::pressure,
                               "largest nominal pressure of the plastic first loading"});
  visit(&S::yielded_area_fraction,
        Quantity{"yielded_area_fraction", dimensionless,
                 "area that carried the hardness in the first loading over nominal area"});
  visit(&S::mean_plastic_depth,
        Quantity{"mean_plastic_depth", length,
                 "depth that the first loading left, mean over the nominal area"});
  visit(&S::max_plastic_depth,
        Quantity{"max_plastic_depth", length, "largest depth that the first loading left"});
}

/// The surface after a first loading; the original surface unless converged.
struct ResidualSurface {
  Surface surface;
  FirstLoading first_loading = {};
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

/// Computes the residual surface after a contact with a hardness. Heights of cells with a pressure
/// below the hardness are not changed at all.
/// state    result of press() for this surface, modulus and options
/// throws   InvalidInput for a state of another grid
/// cost     one transform pair in double; 24 bytes per cell
ResidualSurface residual_surface(Surface surface, double contact_modulus,
                                 const NormalContactState& state,
                                 const NormalContactOptions& options);

/// Computes the residual surface after an adhesive first loading, from a state of press_adhesive()
/// with the same arguments and `options` as its AdhesiveContactOptions::contact.
ResidualSurface residual_surface(Surface surface, double contact_modulus,
                                 const AdhesiveContactState& state, const Adhesion& adhesion,
                                 const NormalContactOptions& options);

/// Computes the residual surface after a first loading to a nominal pressure, followed by an
/// oscillation of the indentation about that state.
/// options            include the hardness; if it is infinite, nothing yields
/// normal_amplitude   amplitude u_z >= 0 of the oscillation, m. The first loading ends at the
///                    largest load of the oscillation, which is the load of the residual surface at
///                    an indentation larger by u_z; it is found by iteration to a relative accuracy
///                    of 1e-3. If u_z leads to full contact of a periodic surface, the oscillation
///                    has no loss, and the first loading ends at the nominal pressure.
/// throws             InvalidInput, before any computation, wherever press() does, also for a
///                    hardness not above the mean pressure; and, during the computation, if the
///                    largest mean pressure of the oscillation is not below the hardness
/// cost               one contact; with an amplitude > 0 six to ten contacts, each started from the
///                    previous one
ResidualSurface after_first_loading(Surface surface, double contact_modulus,
                                    double nominal_pressure, const NormalContactOptions& options,
                                    double normal_amplitude = 0);

}  // namespace salebra
