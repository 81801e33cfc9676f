// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/premises.hpp>
#include <string>
#include <variant>
#include <vector>

/// Which contact is asked about: a law, or what a law is made of, and where the contact stands.
namespace salebra {

/// The caller of a question while it is being answered.
struct Context {
  Progress on_progress = {};
  /// Looked at wherever a law is evaluated, so that every search and quadrature over it stops,
  /// whether or not it reports progress: true throws Interrupted. Empty: never.
  std::function<bool()> stopped = {};
};

/// A quantity that says where a contact stands.
enum class Standing { normal_force, indentation, pressure, mean_gap };

template <>
struct Words<Standing> {
  static constexpr auto values = std::to_array<std::pair<Standing, std::string_view>>(
      {{Standing::normal_force, "normal_force"},
       {Standing::indentation, "indentation"},
       {Standing::pressure, "pressure"},
       {Standing::mean_gap, "mean_gap"}});
};

/// Where contacts stand: one value of the quantity, or several.
struct Standings {
  Standing quantity = Standing::normal_force;
  std::vector<double> values = {};  ///< N, m, Pa
};

/// F = F0 exp(δ/l) about the first of its forces: F'' = F/l² whatever F0 is.
struct ExponentialContact {
  double decay_length = 0;   ///< l > 0, m
  double modulus_ratio = 0;  ///< G*/E* > 0
  std::vector<double> normal_force = {};
};

/// An axisymmetric indenter, at normal forces or indentations.
struct IndenterContact {
  std::shared_ptr<const IndenterProfile> profile;
  Material material;
  Standings at;
};

/// A curve that was computed before or measured, at any quantity that it has.
struct CurveContact {
  ForceCurve curve;
  double modulus_ratio = 0;  ///< G*/E* > 0, for what the curve has no K_t of
  Standings at;
  std::string source = {};  ///< what messages call the curve: its file
};

/// A surface, whose law is swept: thirteen contacts about each pressure.
struct SurfaceContact {
  Surface surface;
  Material material;
  std::vector<double> pressure = {};  ///< nominal, Pa
  /// First loading to the largest of them, and by an oscillation about it; Pa. None: elastic.
  std::optional<double> hardness = {};
  double normal_amplitude = 0;  ///< of that oscillation, m
};

using ContactQuestion =
    std::variant<ExponentialContact, IndenterContact, CurveContact, SurfaceContact>;

/// The law of a contact, where it stands on it, and what it was made from.
struct ContactAnswer {
  std::unique_ptr<const ContactLaw> law;
  std::vector<Position> positions;                 ///< on it
  std::optional<ForceCurve> curve = {};            ///< that the law was made from
  std::optional<Surface> surface = {};             ///< that was swept; the residual one, if any
  std::optional<FirstLoading> first_loading = {};  ///< that left it
  std::vector<std::string> doubts = {};            ///< allowed and most likely a slip, in words

  /// The sample of the curve whose load is nearest to the first position.
  std::size_t load() const;
  double nominal_area() const { return curve ? curve->nominal_area : 0; }  ///< m²; 0: not known
  /// The facts at a mean indentation and at the deepest one, with what the law, the curve and the
  /// first loading say.
  ContactFacts facts_at(ContactFacts facts, double indentation, double deepest) const;
  /// Judges a loss whose slip and amplitude are computed, not left out: the premises of slip, of a
  /// slow motion and of a small amplitude hold, without a value, and the others are judged.
  Premises premises_beside_slip(double indentation, const Oscillation& motion,
                                const ContactFacts& known) const;
};

/// The law and the positions.
/// throws  InvalidInput for values that are not > 0, positions beyond a curve, and as the laws,
///         after_first_loading() and sweep_pressures() do; NotConverged, Interrupted
/// cost    of a surface some thirteen contacts in full stick for each pressure, and the first
///         loading
ContactAnswer ask(ContactQuestion question, const Context& context = {});

/// The law alone, for a motion that brings its own indentations; standings are not looked at. A
/// surface has none.
std::unique_ptr<const ContactLaw> law_of(const ContactQuestion& question,
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

/// What a law says of an indentation, m. Throws as the law.
LawState state_of(const ContactLaw& law, double indentation);
IndenterState state_of(const IndenterLaw& law, double indentation);

/// The summits of a surface with adhesion.
struct MeanSummit {
  double tabor = ForceSample::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<MeanSummit>) {
  visit(&MeanSummit::tabor,
        Quantity{"tabor", Dimension::dimensionless, "Tabor's parameter of the mean summit"});
}

/// Of the mean radius that the moments of the surface give its summits [Nayak (1971)]; unknown where
/// they are not those of a random surface, or nothing adheres.
MeanSummit mean_summit(const Surface& surface, const Adhesion& adhesion, double contact_modulus);

/// Puts the residual surface of the first loading in place of the surface, and returns what flowed;
/// without a hardness nothing.
/// contact  boundary, tolerance and progress
/// throws   NotConverged, Interrupted, and as after_first_loading()
std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude = 0);

/// A table of radii beyond 1 m, most likely in another unit, or so coarse that the indentation at
/// this contact radius changes by more than 5 % without every other point.
std::vector<std::string> doubts_of_profile(const IndenterProfile& profile, double contact_radius);

}  // namespace salebra
