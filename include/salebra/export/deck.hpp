// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/export/unit_system.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <vector>

/// Contact laws as input files ("decks") of other programs (docs/howto/decks.md lists formats and
/// their manuals).
namespace salebra {

enum class DeckFormat { csv, json, calculix, abaqus, ansys, code_aster, jenkins, c_header };
template <>
struct EnumNames<DeckFormat> {
  static constexpr auto values = std::to_array<std::pair<DeckFormat, std::string_view>>(
      {{DeckFormat::csv, "csv"},
       {DeckFormat::json, "json"},
       {DeckFormat::calculix, "calculix"},
       {DeckFormat::abaqus, "abaqus"},
       {DeckFormat::ansys, "ansys"},
       {DeckFormat::code_aster, "code_aster"},
       {DeckFormat::jenkins, "jenkins"},
       {DeckFormat::c_header, "c_header"}});
};

/// Selects one of several surfaces for a deck. Low and high are whole surfaces, ranked by their
/// force at one clearance: 2.5 % of the surfaces are below low, and 2.5 % above high.
enum class DeckCase { mean, low, high };
template <>
struct EnumNames<DeckCase> {
  static constexpr auto values = std::to_array<std::pair<DeckCase, std::string_view>>(
      {{DeckCase::mean, "mean"}, {DeckCase::low, "low"}, {DeckCase::high, "high"}});
};

/// A law with the additional data that a deck needs.
struct DeckContact {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::shared_ptr<const ContactLaw> law;
  double nominal_area = unknown;  ///< A, m²
  double sample_area = unknown;  ///< area of the sample that the law was scaled from, m²; NaN: not
                                 ///< scaled
  /// δ for the stick slope and Jenkins sliders, m; NaN: not given.
  double indentation = unknown;
  double lowest = unknown, highest = unknown;  ///< range of δ in decks, m; NaN: all that is known
  double clearance_origin = 0;                 ///< clearance = clearance_origin − δ, m
  std::string clearance_from = {};             ///< reference of the clearance, as text
  double decay_length = unknown;               ///< l of an exponential law, m; NaN for other laws
  bool knows_tangential_stiffness = true;
};

/// Prepares a law for decks at an indentation, by default 0 for an exponential law. The clearance
/// is −δ.
DeckContact deck_contact(std::shared_ptr<const ContactLaw> law,
                         std::optional<double> indentation = {});

/// Computes the law of a contact and prepares it for decks. G*/E* of a curve may be NaN if it has
/// K_t, or if none is needed. A law without a table is used from 0.001 to 10 times the force of its
/// position.
///     clearance   from the mean gap ū of a curve; −δ of a curve without it and of an indenter; −δ
///                 of an exponential law, from the point where F is the first of its forces
/// Throws as solve() does, and for several positions.
DeckContact deck_contact(ContactProblem problem, const Context& context = {});

struct DeckProblem {
  std::vector<DeckContact> contacts;  ///< one, or one per surface of the same kind
  DeckFormat format = DeckFormat::csv;
  UnitSystem units = {};
  double friction_coefficient = DeckContact::unknown;  ///< μ > 0; NaN: decks without friction
  /// Area of the part, m²: laws of contacts with a known area are scaled to it; other laws are
  /// those of the part. NaN: the contacts are the parts.
  double nominal_area = DeckContact::unknown;
  /// Nominal pressures in decks, Pa; empty: the full range of the contacts.
  std::optional<std::pair<double, double>> pressure_window = {};
  int rows = 200;                ///< rows of a table, 4 to 100000; at most 198 for CalculiX, 19 for
                                 ///< Ansys
  DeckCase of = DeckCase::mean;  ///< for sliders and C header; other formats contain all three
  int sliders = 200;             ///< 2 to 100000; for a C header springs, 8 to 4096
  double min_force = 0.01;  ///< T/(μF) from which the loss of the Jenkins sliders is accurate
  std::string name = "contact";  ///< prefix of every name in a C header
  std::string source = {};       ///< source of the contacts, for the header
  std::string comment = {};       ///< additional sentence for the header
  Provenance provenance = {};
};

struct DeckSolution {
  std::string text;  ///< the deck
  int surfaces = 0;
  /// Maximum error of linear interpolation between the rows of the mean, relative to its pressure.
  double interpolation_error = DeckContact::unknown;
  double tangential_stiffness = DeckContact::unknown;  ///< total K_t of the Jenkins sliders, N/m
  double slip_force = DeckContact::unknown;            ///< total μF, N
  /// Relative error of the loss of the sliders at the smallest force.
  double loss_error = DeckContact::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<DeckSolution>) {
  using enum Dimension;
  using S = DeckSolution;
  visit(&S::text, Kept{"text", "the deck"});
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::interpolation_error,
        Quantity{"interpolation_error", dimensionless, "error of straight lines between rows"});
  visit(&S::tangential_stiffness, quantity::tangential_stiffness);
  visit(&S::slip_force, Kept{"slip_force", "tangential force at which all slips", force});
  visit(&S::loss_error,
        Quantity{"loss_error", dimensionless, "error of the loss at the smallest force"});
}

/// Writes the text of a deck:
///     const DeckSolution deck = solve(DeckProblem{.contacts = {deck_contact(law)},
///                                              .format = DeckFormat::abaqus});
/// Tables list the pressure p = F/A over clearance, monotone and convex: rows up to 1 % above a
/// straight line between others are moved to the line. Jenkins sliders: with ρ = K_t/K at δ,
/// springs of stiffness K_t' dζ slip from x = (μ/ρ)(δ − ζ) on, so the backbone is T' = K_t(δ −
/// ρx/μ) as in joint_loss(). One slider represents the springs between two displacements, with
/// their stiffness and force: T and T' are exact at each of these, K_t and μF in total. The loss
/// converges with order 2. A C header implements the steps of ContactElement without dependencies,
/// with its springs over the clearances of the deck; without μ it is in full stick.
/// throws  InvalidInput for a force that does not grow with approach, a curve that is not convex, a
///         missing area, K_t, position or coefficient of friction that the format needs, surfaces
///         without a common range, and numbers out of range
/// cost    rows or sliders times about ten evaluations of each law
DeckSolution solve(const DeckProblem& problem);

}  // namespace salebra
