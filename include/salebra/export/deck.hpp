// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/export/unit_system.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/analysis/contact.hpp>
#include <string>
#include <vector>

/// Contact laws as input of other programs (docs/howto/decks.md has formats and their manuals).
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

/// Which of several surfaces a deck is of. Low and high are whole surfaces, ranked by their force at
/// one clearance: 2.5 % of them are below the one, and above the other.
enum class DeckCase { mean, low, high };
template <>
struct EnumNames<DeckCase> {
  static constexpr auto values = std::to_array<std::pair<DeckCase, std::string_view>>(
      {{DeckCase::mean, "mean"}, {DeckCase::low, "low"}, {DeckCase::high, "high"}});
};

/// A law, with what a deck needs to know beside it.
struct DeckContact {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::shared_ptr<const ContactLaw> law;
  double nominal_area = unknown;  ///< A, m²
  double sample_area = unknown;   ///< of the sample that the law was scaled from, m²; NaN: of none
  /// δ of the stick slope and of Jenkins' sliders, m; NaN: none was named.
  double indentation = unknown;
  double lowest = unknown, highest = unknown;  ///< δ that decks hold, m; NaN: as far as is known
  double clearance_origin = 0;                 ///< clearance = this − δ, m
  std::string clearance_from = {};             ///< what it is measured from, in words
  double decay_length = unknown;               ///< l of an exponential law, m; NaN: another law
  bool knows_tangential_stiffness = true;
};

/// Decks of a law at an indentation, 0 of an exponential law where none is given. The clearance is
/// −δ.
DeckContact deck_contact(std::shared_ptr<const ContactLaw> law,
                         std::optional<double> indentation = {});

/// The law of a contact as decks take it. G*/E* of a curve may be NaN where it has K_t, or where
/// none is needed. A law without a table is taken from a thousandth to ten times the force of its
/// position.
///     clearance   of a curve with mean gaps ū; of another curve and of an indenter −δ; of the
///                 exponential law −δ, from where F is the first of its forces
/// throws  as solve(); for several positions
DeckContact deck_contact(ContactProblem problem, const Context& context = {});

struct DeckProblem {
  std::vector<DeckContact> contacts;  ///< one, or those of several surfaces of one kind
  DeckFormat format = DeckFormat::csv;
  UnitSystem units = {};
  double friction_coefficient = DeckContact::unknown;  ///< μ > 0; NaN: decks without friction
  /// Of the part, m²: laws of contacts whose area is known are scaled to it, and laws of others are
  /// those of the part. NaN: the contacts are the parts.
  double nominal_area = DeckContact::unknown;
  /// Nominal pressures that decks hold, Pa; none: as far as the contacts go.
  std::optional<std::pair<double, double>> pressure_window = {};
  int rows = 200;                ///< of a table, 4 to 100000; of CalculiX at most 198, of Ansys 19
  DeckCase of = DeckCase::mean;  ///< of sliders and of a C header; the other formats hold all three
  int sliders = 200;             ///< 2 to 100000; of a C header levels, 8 to 4096
  double smallest_force = 0.01;  ///< T/(μF) from which the loss of Jenkins' sliders is right
  std::string name = "contact";  ///< with which every name of a C header begins
  std::string source = {};       ///< of the contacts, for the header
  std::string remark = {};       ///< a sentence more in the header
  Provenance provenance = {};
};

struct DeckSolution {
  std::string text;  ///< the deck
  int surfaces = 0;
  /// Largest error of straight lines between the rows of the mean over its pressure.
  double interpolation_error = DeckContact::unknown;
  double tangential_stiffness = DeckContact::unknown;  ///< K_t of Jenkins' sliders together, N/m
  double slip_force = DeckContact::unknown;            ///< μF of them, N
  /// What the loss of the sliders at the smallest force is off by, over the loss.
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

/// The text of a deck. Tables are of pressure p = F/A over clearance, monotone and convex: of rows
/// that lie above a straight line between others, by at most 1 %, the line is taken.
/// Jenkins' sliders: with ρ = K_t/K at δ, springs of the contact of stiffness K_t' dζ slip from x =
/// (μ/ρ)(δ − ζ) on, so that the backbone is T' = K_t(δ − ρx/μ) as in joint_loss(). A slider stands
/// for those between two displacements, with their stiffness and their force: T and T' are met at
/// each of these exactly, K_t and μF by all sliders together. Loss converges with order 2.
/// A C header has the steps of ContactElement without dependencies, its levels over the clearances
/// of the deck; without μ it is in full stick.
/// throws  InvalidInput for a force that does not grow with approach, a curve that is not convex, an
///         area, K_t, position or coefficient of friction that the format needs and nobody gave,
///         surfaces without a common range, and numbers out of range
/// cost    rows or sliders times some ten evaluations of each law
DeckSolution solve(const DeckProblem& problem);

}  // namespace salebra
