// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/operating_point.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/surface/lay.hpp>
#include <string>
#include <variant>
#include <vector>

/// The contact of a problem: a contact law, or the data from which a law is computed, and its
/// operating points.
namespace salebra {

/// Callbacks to the caller while a problem is solved.
struct Context {
  Progress on_progress = {};
  /// Called at every evaluation of a contact law; if it returns true, Interrupted is thrown.
  /// Searches and quadratures over a law can thus be stopped even if they do not report progress.
  /// Empty: never stops.
  std::function<bool()> stopped = {};
};

/// Contact with the exponential law F = F0 exp(δ/l), where F0 is the first entry of normal_force.
/// (F'' = F/l² does not depend on the choice of F0.)
struct ExponentialContact {
  double decay_length = 0;                ///< l > 0, m
  double modulus_ratio = 0;               ///< G*/E* > 0
  std::vector<double> normal_force = {};  ///< operating points, N
};

/// A contact of an axisymmetric indenter; `at` gives forces or indentations as operating points.
struct IndenterContact {
  std::shared_ptr<const IndenterProfile> profile;
  Material material;
  OperatingPoints at;
};

/// A computed or measured force curve, with operating points in any control quantity that the curve
/// contains.
struct CurveContact {
  ForceCurve curve;
  double modulus_ratio = 0;  ///< G*/E* > 0, used where the curve has no K_t; NaN: not known
  OperatingPoints at;
  std::string source = {};  ///< name of the curve in messages, e.g. its file
  /// Which of the directions of its K_t to use: an angle, or `automatic` for all of them.
  DirectionChoice direction = LayDirection::automatic;
};

/// A surface, whose contact law comes from a sweep of thirteen loads about each pressure, and of
/// further loads as far as the oscillation presses or lifts it.
struct SurfaceContact {
  Surface surface;
  Body body;                          ///< a Material, or any Body under a periodic surface
  std::vector<double> pressure = {};  ///< nominal pressures, Pa
  /// Hardness, Pa, for a plastic first loading up to the largest pressure plus an oscillation about
  /// it, of half-spaces only. Empty: elastic.
  std::optional<double> hardness = {};
  double normal_amplitude = 0;  ///< amplitude of the oscillation about each pressure, m
  Hold hold = Hold::automatic;  ///< the mean value that this oscillation keeps
  /// Direction of the tangential motion, from the x axis, rad or by the lay of the surface.
  DirectionChoice direction = 0.0;
};

using ContactProblem =
    std::variant<ExponentialContact, IndenterContact, CurveContact, SurfaceContact>;

/// The law of a contact, its operating points, and the data behind it.
struct ContactSolution {
  std::unique_ptr<const ContactLaw> law;
  std::vector<OperatingPoint> points;    ///< operating points on the law
  std::optional<ForceCurve> curve = {};  ///< curve from which the law was made
  std::optional<Surface> surface = {};   ///< swept surface, residual after a first loading
  std::optional<FirstLoading> first_loading = {};  ///< first loading that left the residual surface
  std::vector<std::string> warnings = {};          ///< warnings: the input is valid but suspicious
  /// For a surface with a normal amplitude: the mean value that the oscillation keeps.
  Hold hold = Hold::automatic;

  /// Index of the sample of the curve whose load is nearest to the first operating point.
  std::size_t load() const;
  double nominal_area() const { return curve ? curve->nominal_area : 0; }  ///< m²; 0: not known
  /// Direction of K_t of the law, from the x axis, rad; NaN if K_t has no direction.
  double direction() const { return curve ? curve->direction() : ForceSample::unknown; }
  /// Adds to `parameters` those that follow from the law, the curve and the first loading, at the
  /// mean indentation `indentation` and at the indentation `deepest`.
  ContactParameters parameters_at(ContactParameters parameters, double indentation,
                                  double deepest) const;
  /// Checks the assumptions of a loss that includes slip and finite amplitude: the assumptions of
  /// no slip, slow motion and small amplitude get the verdict `holds` without a value; all other
  /// assumptions are checked.
  Assumptions assumptions_beside_slip(double indentation, const Oscillation& motion,
                                      const ContactParameters& known) const;
};

/// Computes the law and the operating points of a contact.
///
///     ContactSolution contact = solve(SurfaceContact{surface, material, {1e6, 5e6}});
///
/// throws  InvalidInput for values that are not > 0, for operating points outside a curve, for
///         several directions, and wherever the laws, after_first_loading() and sweep_pressures()
///         do; NotConverged, Interrupted
/// cost    for a surface some thirteen contacts in full stick for each pressure, and the first
///         loading
ContactSolution solve(ContactProblem problem, const Context& context = {});
/// The same in each direction of the tangential motion that the problem asks for: one solution for
/// each, `across` before `along`. Contacts are solved once for all directions.
///     std::vector<ContactSolution> contacts = solve_directions(
///         SurfaceContact{.surface = surface, .body = material, .pressure = {1e6},
///                        .direction = LayDirection::both});
std::vector<ContactSolution> solve_directions(ContactProblem problem, const Context& context = {});

/// Returns the law alone, for a motion with its own indentations; operating points are ignored.
/// Throws InvalidInput for a surface, which has no law before a sweep.
std::unique_ptr<const ContactLaw> law_of(const ContactProblem& problem,
                                         const Context& context = {});

/// A contact at rest.
struct LawState {
  double force = 0;                 ///< F, N
  double indentation = 0;           ///< δ, m
  double normal_stiffness = 0;      ///< K, N/m
  double tangential_stiffness = 0;  ///< K_t, N/m
};

constexpr void describe(auto&& visit, std::type_identity<LawState>) {
  using S = LawState;
  visit(&S::force, quantity::force);
  visit(&S::indentation, quantity::indentation);
  visit(&S::normal_stiffness, quantity::normal_stiffness);
  visit(&S::tangential_stiffness, quantity::tangential_stiffness);
}

/// An axisymmetric contact at rest.
struct IndenterState : LawState {
  double contact_radius = 0;   ///< a, m
  double force_curvature = 0;  ///< F'', N/m²
};

constexpr void describe(auto&& visit, std::type_identity<IndenterState>) {
  using S = IndenterState;
  describe(visit, std::type_identity<LawState>{});
  visit(&S::contact_radius, Quantity{"contact_radius", Dimension::length, "contact radius"});
  visit(&S::force_curvature, quantity::force_curvature);
}

/// Returns the state of a law at an indentation, m. Throws InvalidInput outside the range of the
/// law.
LawState state_of(const ContactLaw& law, double indentation);
IndenterState state_of(const IndenterLaw& law, double indentation);

/// Mean summit of a surface with adhesion.
struct MeanSummit {
  double tabor = ForceSample::unknown;  ///< Tabor's parameter
};

constexpr void describe(auto&& visit, std::type_identity<MeanSummit>) {
  visit(&MeanSummit::tabor,
        Quantity{"tabor", Dimension::dimensionless, "Tabor's parameter of the mean summit"});
}

/// Returns Tabor's parameter for the mean summit radius from the moments of the surface [Nayak
/// (1971)]; unknown if the moments cannot be those of a random surface, and without adhesion.
MeanSummit mean_summit(const Surface& surface, const Adhesion& adhesion, double contact_modulus);

/// Replaces the surface by the residual surface of the first loading and returns that loading;
/// without a hardness it does nothing.
/// contact  boundary, tolerance and progress of the contact solves
/// throws   NotConverged, Interrupted, and InvalidInput wherever after_first_loading() does
std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude = 0,
                                       Hold hold = Hold::indentation);

/// Returns warnings about a tabulated profile: for radii above 1 m, which are most likely in
/// another unit, and for a table so coarse that omitting every other point changes the indentation
/// at this contact radius by more than 5 %.
std::vector<std::string> warnings_of_profile(const IndenterProfile& profile, double contact_radius);

}  // namespace salebra
