// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/operating_point.hpp>

namespace salebra {

/// Numerical precision. `mixed` computes transforms in float, but the residual and the decision
/// that the solution has converged in double; `full` computes everything in double.
enum class Precision { mixed, full };

template <>
struct EnumNames<Precision> {
  static constexpr auto values = std::to_array<std::pair<Precision, std::string_view>>(
      {{Precision::mixed, "mixed"}, {Precision::full, "full"}});
};

struct NormalContactOptions {
  /// The solver stops at e_c = Σp(g − g_min)/(Σp · h_rms) < tolerance, with the pressure p and gap
  /// g of each cell and the smallest gap g_min; e_c is evaluated with exact transforms in double
  /// precision. 1e-14 to 1e-1. For a flat surface (h_rms = 0), h_rms is replaced by the
  /// indentation, or by pressure·√area/E*.
  double tolerance = 1e-10;
  int max_iterations = 1000;  ///< limit on the finest grid, >= 1
  Boundary boundary = Boundary::periodic;
  Precision precision = Precision::mixed;
  /// Hardness, Pa: a cell carries at most this pressure; at the hardness it sinks in plastically
  /// without further load.
  double hardness = std::numeric_limits<double>::infinity();
  /// Initial pressure for the iteration, Pa, >= 0, in the shape of the heights; nullptr: the solver
  /// starts from coarser grids. The field must outlive the call.
  const Field* initial_pressure = nullptr;
  Progress on_progress = {};
  /// Called between iterations on the finest grid with the current pressure, Pa, in the shape of
  /// the heights; a later call may start from it. Every process calls it at the same iteration; a
  /// sweep calls it from several threads. It does not change results. If it throws, it must throw
  /// on all processes.
  std::function<void(const Field& pressure)> on_checkpoint = {};
  double checkpoint_every = 600;  ///< interval, s, >= 0; 0: after each iteration
};

/// Result of a normal contact. Unless it converged, the numbers describe the last iterate and must
/// not be used.
struct NormalContactState {
  Field contact_pressure;    ///< (nx, ny) or the rows of this process, Pa, >= 0
  Field gap;                 ///< same shape, m, >= 0 within the tolerance; 0 at the hardness
  double mean_pressure = 0;  ///< Pa
  double force = 0;          ///< N
  double mean_gap = 0;       ///< ū: mean of gap over all cells, m
  /// Rigid approach from first touch, m; for a periodic, elastic contact it equals max h − mean h −
  /// ū with the heights h, plus the displacement C(0)·pressure of a body measured from its base.
  double indentation = 0;
  double contact_area_fraction = 0;  ///< cells with p > 0 over all cells
  double elastic_energy = 0;         ///< ½∫p u dA, J; periodic: with u measured from the datum
  Datum datum = Datum::mean_plane;   ///< of the displacements: of the body that was pressed
  double residual = 0;               ///< e_c reached (NormalContactOptions::tolerance)
  int iterations = 0;                ///< on the finest grid
  /// Forward-and-backward transform pairs on the finest grid, in float and double together.
  int fft_count = 0;
  /// Applications of the multilevel kernel on the finest grid; each replaces a transform pair.
  int multilevel_count = 0;
  Termination termination = Termination::iteration_limit;
  Communicator communicator = {};  ///< processes that share the fields, as for the surface

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<NormalContactState>) {
  using enum Dimension;
  using S = NormalContactState;
  visit(&S::contact_pressure,
        Quantity{"contact_pressure", Dimension::pressure, "contact pressure"});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::mean_pressure, Kept{"mean_pressure", "nominal pressure", Dimension::pressure});
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::indentation, Quantity{"indentation", length, "indentation"});
  visit(&S::contact_area_fraction,
        Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"});
  visit(&S::elastic_energy, Quantity{"elastic_energy", energy, "elastic energy"});
  visit(&S::datum, Kept{"datum", "what displacements are measured from"});
  visit(&S::residual, Quantity{"residual", dimensionless, "residual of the contact"});
  visit(&S::iterations, Quantity{"iterations", dimensionless, "iterations of the solver"});
  visit(&S::fft_count,
        Quantity{"fft_count", dimensionless, "Fourier transforms of the solver, in pairs"});
  visit(&S::multilevel_count,
        Quantity{"multilevel_count", dimensionless, "applications of the multilevel kernel"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether the contact converged"});
  visit(&S::communicator, Kept{});
}

/// Returns the cells with p > 0, e.g. to pass them to stick or punch solvers.
ContactSet contact_set(const NormalContactState& state);

/// Solves the frictionless contact of a rigid rough surface with an elastic half-space:
///     const NormalContactState state = press(surface, 1.1e11, at_pressure(2e8));
/// For a given nominal pressure it minimises
///     ½p·Gp − p·h  over all p with 0 <= p <= hardness and mean p = nominal pressure,
///     û(q) = 2 p̂(q)/(E*|q|), û(0) = 0 (periodic);
/// where h are the heights and u = Gp is the displacement under the pressure p. A force, mean gap
/// or indentation can be given instead of a pressure. The solver uses conjugate gradients on the
/// contact set, started from coarser grids, with a preconditioner that needs no transforms; unlike
/// the constrained conjugate gradients of Polonsky and Keer (1999), it does not restart when the
/// contact set changes. If the contact and its neighbourhood are a small part of a large grid, the
/// iterations apply a multilevel kernel of stencils (an approximation of G) instead of transforms,
/// and exact transforms only update the gap. For a surface distributed over processes the call is
/// collective, and all numbers have the same bits as in one process.
/// contact_modulus   E* > 0, Pa
/// point             pressure and force > 0, the pressure below the hardness; indentation > 0; mean
///                   gap between 0 and max h − mean h, for periodic elastic contacts only
/// throws            InvalidInput, before any computation, for invalid arguments; non-convergence
///                   is returned, not thrown
/// cost              15 to 100 iterations with one transform pair each, or with one application of
///                   the multilevel kernel each and 5 to 7 transform pairs in total; at a given
///                   mean gap 3 to 20 times as many iterations if more than 0.99 of the cells
///                   touch; 50 to 75 bytes per cell with heights and result, more for larger
///                   contacts (docs/performance.md)
NormalContactState press(const Surface& surface, double contact_modulus,
                         const OperatingPoint& point, const NormalContactOptions& options = {});

/// Solves the frictionless contact of a rigid rough surface with any linear body:
///     const Body coated = Body::layered({{5e-6, 3e9, 0.49}}, {.young = 210e9, .poisson = 0.3});
///     const NormalContactState state = press(surface, coated, at_pressure(2e8));
/// Like the above, with û(q) = C_n(|q|) p̂(q) and û(0) = C_n(0) p̂(0), which is 0 for a body that is
/// measured from its mean plane and uniform compression for one that is measured from its base
/// (Body::measured_from). Homogeneous half-spaces have the same bits as with their contact modulus.
/// Other bodies are periodic only, and all their iterations use transforms. An indentation from the
/// base has no upper limit if C_n(0) > 0. Throws InvalidInput also for Boundary::free, and if the
/// wave numbers of the grid exceed a table.
/// cost              as above, without the multilevel kernel, and 0.1 µs per layer and wave vector;
///                   a coating much stiffer than its base takes 10 times as many iterations
NormalContactState press(const Surface& surface, const Body& body, const OperatingPoint& point,
                         const NormalContactOptions& options = {});

/// Computes the normal stiffness K = dF/dδ, N/m, of the contact set {0 < p < hardness} of a state:
///     const double stiffness = normal_stiffness(state, surface.grid, 1.1e11);
/// It needs one linear solve with a fixed contact set. punch_pressure, if given, receives dp/dδ of
/// each cell, Pa/m (it is not changed if no solve was needed). Returns +infinity for a periodic
/// cell in full contact, and NaN if the solve did not converge within max_iterations or was
/// interrupted. Cost: as many iterations as the contact took, with one transform pair each, or,
/// with the multilevel kernel, three transform pairs in total.
double normal_stiffness(const NormalContactState& state, const Grid2D& grid, double contact_modulus,
                        const NormalContactOptions& options = {}, Field* punch_pressure = nullptr);

/// Normal stiffness of a contact with the body that was pressed, δ measured from the body's datum.
/// From a base, K is finite in full contact if C_n(0) > 0. Throws InvalidInput if the datum of the
/// state is another one.
double normal_stiffness(const NormalContactState& state, const Grid2D& grid, const Body& body,
                        const NormalContactOptions& options = {}, Field* punch_pressure = nullptr);

/// The pressure scale of a rough surface on a body, Pa: twice the rms pressure of full contact,
///     2 [∫ C(q)/C_n(q)² d²q]^½,
/// with the power spectral density C of the heights and the compliance C_n of the body. On a
/// half-space it is E*h' with the rms slope h' of the waves of the grid, in units of which contact
/// area and gap are nearly the same for all surfaces:
///     const double relative = 1e6 / pressure_scale(surface, coated);
/// Collective. The surface is continued periodically. Throws InvalidInput for waves beyond the table
/// of a body. Cost: an FFT, and one response for each wave.
double pressure_scale(const Surface& surface, const Body& body);

}  // namespace salebra
