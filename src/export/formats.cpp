// SPDX-License-Identifier: GPL-3.0-or-later
// Decks in the formats of other programs, one function for each format.
#include "formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>

#include "base/printable.hpp"
#include "c_header.hpp"
#include "fmu.hpp"
#include "io/json.hpp"

namespace salebra::detail {
namespace {

/// Writes a number in at most 20 characters, since CalculiX and Abaqus read no more. Writes as many
/// digits as fit, but no more than distinguish a number from its neighbours.
std::string number(double value) {
  constexpr std::size_t most = 20;
  std::string text = fmt::format("{}", value);
  for (int digits = 16; text.size() > most; --digits) text = fmt::format("{:.{}g}", value, digits);
  return text;
}

/// Throws InvalidInput if the numbers of a column do not increase after rounding to the digits that
/// the other program reads. That program would see a step, or refuse the deck. what: name of the
/// column.
void require_rising(const Deck& deck, const std::vector<double>& column, const char* what) {
  for (std::size_t i = 1; i < column.size(); ++i)
    require(
        column[i] > column[i - 1], "rows", deck.clearance.size(),
        fmt::format(
            "are too many: two have the same {} {} in all digits that are read; give fewer, or {}",
            what, column[i],
            deck.problem.pressure_window ? "widen `pressure_window`"
                                         : "count the indentation from nearer to the contact"));
}

std::string comments(const Deck& deck, const CommentStyle& style) {
  std::string text;
  for (const std::string& sentence : deck.header) text += comment(sentence, style);
  return text;
}

/// Throws InvalidInput if the approach or a pressure does not increase at full precision.
void require_rising(const Deck& deck) {
  std::vector<double> approach = deck.clearance;
  for (double& value : approach) value = -value;
  require_rising(deck, approach, "approach");
  for (const DeckLaw& law : deck.laws) require_rising(deck, law.pressure, "pressure");
}

std::string csv(const Deck& deck) {
  require_rising(deck);
  std::string text = comments(deck, {"#"}) + "clearance";
  std::vector<const std::vector<double>*> columns{&deck.clearance};
  const auto column = [&](const std::string& name, const std::vector<double>& values) {
    if (values.empty()) return;
    text += "," + name;
    columns.push_back(&values);
  };
  for (const DeckLaw& law : deck.laws) {
    const std::string end = deck.laws.size() > 1 ? "_" + law.name : "";
    column("pressure" + end, law.pressure);
    column("normal_stiffness" + end, law.normal_stiffness);
    column("tangential_stiffness" + end, law.tangential_stiffness);
    column("thermal_conductance" + end, law.conductance);
  }
  text += "\n";
  for (std::size_t i = 0; i < deck.clearance.size(); ++i)
    for (std::size_t k = 0; k < columns.size(); ++k)
      text += fmt::format("{}{}", (*columns[k])[i], k + 1 < columns.size() ? "," : "\n");
  return text;
}

/// A deck as JSON. docs/howto/decks.md describes its members.
std::string json(const Deck& deck) {
  require_rising(deck);
  const DeckProblem& problem = deck.problem;
  Json laws = Json::object();
  for (const DeckLaw& law : deck.laws) {
    Json one{{"surfaces", law.what},
             {"pressure", law.pressure},
             {"normal_stiffness", law.normal_stiffness}};
    if (!law.tangential_stiffness.empty()) one["tangential_stiffness"] = law.tangential_stiffness;
    if (deck.has_conductance()) one["thermal_conductance"] = law.conductance;
    if (deck.has_friction()) {
      one["stick_slope"] = law.stick_slope;
      one["elastic_slip"] = law.elastic_slip;
    }
    laws[law.name] = one;
  }
  Json object{{"format", "salebra contact law 1"},
              {"license", "MIT-0"},
              {"version", version()},
              {"revision", problem.provenance.revision},
              {"header", deck.header},
              {"units", Json{{"length", problem.units.length},
                             {"mass", problem.units.mass},
                             {"time", problem.units.time}}},
              {"clearance_from", problem.contacts.front().clearance_from},
              {"clearance", deck.clearance},
              {"laws", laws}};
  if (deck.has_friction()) object["friction_coefficient"] = problem.friction_coefficient;
  return object.dump(1) + "\n";
}

std::string upper_case(std::string name) {
  std::ranges::transform(name, name.begin(), [](char c) { return char(std::toupper(c)); });
  return "SALEBRA_" + name;
}

struct DeckRow {
  std::string displacement, pressure;
};

/// The rows of a table in ascending order of displacement; the first has no pressure. zero: the
/// clearance that counts as displacement 0. steps > 0: adds a row at this many times the last
/// spacing beyond the last row, with the slope of the last two.
std::vector<DeckRow> rows_of(const Deck& deck, const DeckLaw& law, double zero, double steps = 0) {
  std::vector<double> displacement{zero - first_clearance(deck)}, pressure{0};
  for (std::size_t i = law.pressure.front() > 0 ? 0 : 1; i < deck.clearance.size(); ++i) {
    displacement.push_back(zero - deck.clearance[i]);
    pressure.push_back(law.pressure[i]);
  }
  const auto go_on = [&](std::vector<double>& column) {
    column.push_back(column.back() + steps * (column.back() - column[column.size() - 2]));
  };
  if (steps > 0) go_on(displacement), go_on(pressure);
  std::vector<DeckRow> rows;
  const auto print = [](double& value) {
    const std::string text = number(value);
    std::from_chars(text.data(), text.data() + text.size(), value);
    return text;
  };
  for (std::size_t i = 0; i < displacement.size(); ++i)
    rows.push_back({print(displacement[i]), print(pressure[i])});
  require_rising(deck, displacement, "displacement");
  require_rising(deck, pressure, "pressure");
  return rows;
}

/// Lines "pressure, overclosure" of a table.
std::string overclosures(const std::vector<DeckRow>& rows) {
  std::string text;
  for (const DeckRow& row : rows) text += fmt::format("{}, {}\n", row.pressure, row.displacement);
  return text;
}

/// The conductance over the pressure, a line for each row: `row` is a format of pressure and
/// conductance. Without pressure there is no conductance.
std::string conductances_of(const Deck& deck, const DeckLaw& law, const char* row) {
  const std::vector<DeckRow> rows = rows_of(deck, law, first_clearance(deck));
  // A law that does not begin without pressure has gained such a row.
  const std::size_t added = law.pressure.front() > 0 ? 1 : 0;
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += fmt::format(fmt::runtime(row), rows[i].pressure,
                        i > 0 ? number(law.conductance[i - added]) : "0");
  return text;
}

/// CalculiX CrunchiX User's Manual, *SURFACE BEHAVIOR and *FRICTION. EXPONENTIAL takes the pressure
/// p0 at clearance 0 and the clearance c0 at which the pressure is 1 % of p0: p = p0 exp(−g ln
/// 100/c0) at the clearance g. TABULAR takes pressure and overclosure (the negative of the
/// clearance). Outside the table the pressure stays constant, so a further row continues the last
/// slope. The springs of a table begin to act at a clearance of 1e-3 in any unit, so overclosure is
/// measured from the clearance where the pressure begins. *FRICTION takes μ and the stick slope, a
/// force per volume. In version 2.20, TYPE=NODE TO SURFACE follows both keywords; SURFACE TO
/// SURFACE has no force before the surfaces touch, and stops if a table has more than some twenty
/// rows. *GAP CONDUCTANCE takes conductance and pressure; version 2.20 computes the pressure of a
/// heat step for EXPONENTIAL, but passes no heat with TABULAR.
std::string calculix(const Deck& deck) {
  require_that(
      !deck.has_conductance() || !std::isnan(deck.exponential_length), "conductivity",
      "given, but CalculiX passes no heat where the pressure is a table, only where the law "
      "is exponential");
  std::string text = comments(deck, {"**"}) + "** For *CONTACT PAIR, TYPE=NODE TO SURFACE.\n";
  for (const DeckLaw& law : deck.laws) {
    text += fmt::format("** {}: {}\n", law.name, law.what);
    const std::string name = fmt::format("*SURFACE INTERACTION, NAME={}\n", upper_case(law.name));
    if (!std::isnan(deck.exponential_length)) {
      text += fmt::format("{}*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n{}, {}\n", name,
                          number(deck.exponential_length * std::log(100.)),
                          number(deck.exponential_pressure));
    } else {
      const double zero = first_clearance(deck), steps = 10 * double(deck.clearance.size() - 1);
      text += fmt::format(
          "** Draw the surfaces so that they touch where their clearance is {}:\n"
          "** overclosure = {} - clearance.\n{}*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n{}",
          number(zero), number(zero), name, overclosures(rows_of(deck, law, zero, steps)));
    }
    if (deck.has_friction())
      text += fmt::format("*FRICTION\n{}, {}\n", number(deck.problem.friction_coefficient),
                          number(law.stick_slope));
    if (deck.has_conductance())
      text += "*GAP CONDUCTANCE\n" + conductances_of(deck, law, "{1}, {0}\n");
  }
  return text;
}

/// Abaqus Keywords Reference Guide, *SURFACE BEHAVIOR: TABULAR takes pressure and overclosure in
/// ascending order of overclosure, the first row with pressure 0, and continues the last slope. The
/// EXPONENTIAL of Abaqus reaches pressure 0 at a finite clearance g, and so is not the function
/// exp(−g/l). *FRICTION with ELASTIC SLIP is a penalty method: the stick stiffness is μp divided by
/// the elastic slip. *GAP CONDUCTANCE takes conductance and
/// pressure.
std::string abaqus(const Deck& deck) {
  std::string text = comments(deck, {"**"});
  for (const DeckLaw& law : deck.laws) {
    text += fmt::format(
        "** {}: {}\n*SURFACE INTERACTION, NAME={}\n*SURFACE BEHAVIOR, "
        "PRESSURE-OVERCLOSURE=TABULAR\n{}",
        law.name, law.what, upper_case(law.name), overclosures(rows_of(deck, law, 0)));
    if (deck.has_friction())
      text += fmt::format("*FRICTION, ELASTIC SLIP={}\n{},\n", number(law.elastic_slip),
                          number(deck.problem.friction_coefficient));
    if (deck.has_conductance())
      text += "*GAP CONDUCTANCE, PRESSURE\n" + conductances_of(deck, law, "{1}, {0}\n");
  }
  return text;
}

/// Ansys Element Reference, COMBIN39: the real constants D1, F1, … D20, F20 are the displacements
/// and forces of at most 20 points of a curve through the origin, and the last slope continues.
/// KEYOPT(1) = 0 unloads along the curve, KEYOPT(2) = 1 has no force in compression. With node I
/// above and node J below, an approach of the bodies elongates the element. A `$` separates
/// commands on a line.
std::string ansys(const Deck& deck) {
  std::string text = comments(deck, {"!", {"$"}});
  text +=
      "! One spring for each pair of nodes of both surfaces, I of the upper, J of the lower\n"
      "! one, in the direction of KEYOPT(3) (3: z). Normal law only.\n"
      "SALEBRA_AREA = 1.0  ! area of the surface that belongs to a pair of nodes\n";
  int type = 101;
  for (const DeckLaw& law : deck.laws) {
    const double first = first_clearance(deck);
    text += fmt::format(
        "! {}: {}. Without displacement the surfaces are {} apart.\n"
        "ET,{},COMBIN39\nKEYOPT,{},1,0\nKEYOPT,{},2,1\nKEYOPT,{},3,3\nR,{},0,0",
        law.name, law.what, number(first), type, type, type, type, type);
    const std::vector<DeckRow> rows = rows_of(deck, law, first);
    for (std::size_t i = 1; i < rows.size(); ++i)
      text += fmt::format("{}{},{}*SALEBRA_AREA", i % 3 == 0 ? "\nRMORE," : ",",
                          rows[i].displacement, rows[i].pressure);
    text += "\n";
    ++type;
  }
  return text;
}

/// Code_Aster R5.03.17, relation CHOC_ELAS_TRAC (material DIS_CHOC_ELAS), and U4.43.01: FX is a
/// function of DX, linear between points, strictly increasing from (0, 0), and not defined for DX <
/// 0. Contact begins where the length of the discrete element is DIST_1 + DIST_2. Names of objects
/// have at most eight letters.
std::string code_aster(const Deck& deck) {
  std::string text = comments(deck, {"#"});
  text +=
      "# One discrete element DIS_T on a SEG2 for each pair of nodes of both surfaces, along\n"
      "# the normal, with RELATION='CHOC_ELAS_TRAC'. Normal law only.\n"
      "area = 1.0  # of the surface that belongs to a pair of nodes\n";
  for (const DeckLaw& law : deck.laws) {
    const double first = first_clearance(deck);
    text += fmt::format("# {}: {}\ntab{} = (\n    (0.0, 0.0),\n", law.name, law.what, law.name);
    const std::vector<DeckRow> rows = rows_of(deck, law, first);
    for (std::size_t i = 1; i < rows.size(); ++i)
      text += fmt::format("    ({}, {}),\n", rows[i].displacement, rows[i].pressure);
    text += fmt::format(
        ")\nfun{0} = DEFI_FONCTION(\n    NOM_PARA='DX', INTERPOL='LIN', PROL_GAUCHE='EXCLU', "
        "PROL_DROITE='LINEAIRE',\n    VALE=[value for dx, p in tab{0} for value in (dx, area * "
        "p)])\nmat{0} = DEFI_MATERIAU(DIS_CHOC_ELAS=_F(FX=fun{0}, DIST_1={1}, DIST_2=0.0))\n",
        law.name, number(first));
  }
  return text;
}

/// MOOSE, syntax/Contact and PenaltyFrictionUserObject: with formulation = mortar_penalty the
/// pressure is `penalty` times the penetration, and the tangential stress penalty_friction times the
/// slip, up to friction_coefficient times the pressure. GapHeatTransfer reads the material property
/// gap_conductance<appended_property_name> and its derivative ..._dT;
/// PiecewiseLinearInterpolationMaterial makes one of a variable by a table, constant beyond it.
std::string moose(const Deck& deck) {
  std::string text = comments(deck, {"#"});
  std::string contact, materials;
  for (const DeckLaw& law : deck.laws) {
    const std::string name = "salebra_" + law.name;
    if (deck.has_friction())
      contact += fmt::format(
          "  [{}]  # {}; elastic slip {}\n    # add: primary, secondary\n"
          "    formulation = mortar_penalty\n    model = coulomb\n    friction_coefficient = {}\n"
          "    penalty = {}\n    penalty_friction = {}\n  []\n",
          name, law.what, number(law.elastic_slip), number(deck.problem.friction_coefficient),
          number(law.normal_slope), number(law.stick_slope));
    if (!deck.has_conductance()) continue;
    std::string pressure, conductance;
    const std::string end = "\n         ";
    pressure = conductances_of(deck, law, "{0}\n         ");
    conductance = conductances_of(deck, law, "{1}\n         ");
    pressure.resize(pressure.size() - end.size());
    conductance.resize(conductance.size() - end.size());
    materials += fmt::format(
        "  [{0}]  # {1}\n    # add: boundary\n    type = PiecewiseLinearInterpolationMaterial\n"
        "    property = gap_conductance_{0}\n    variable = contact_pressure\n    x = '{2}'\n"
        "    y = '{3}'\n  []\n  [{0}_dT]\n    # add: boundary\n    type = GenericConstantMaterial\n"
        "    prop_names = gap_conductance_{0}_dT\n    prop_values = 0\n  []\n",
        name, law.what, pressure, conductance);
  }
  if (deck.has_friction())
    text +=
        "# penalty and penalty_friction are the stiffnesses per area at the mean pressure of the\n"
        "# operating point: the normal law of MOOSE is linear.\n[Contact]\n" +
        contact + "[]\n";
  if (deck.has_conductance())
    text +=
        "# For the boundary condition GapHeatTransfer with appended_property_name = "
        "_salebra_mean;\n"
        "# contact_pressure: the variable with the pressure.\n[Materials]\n" +
        materials + "[]\n";
  return text;
}

/// Elmer, HeatSolver with discontinuous Galerkin: Heat Gap Coefficient of a boundary condition, which
/// may be a table of a variable (ElmerSolver Manual, section on keyword syntax), linear beyond its
/// ends.
std::string elmer(const Deck& deck) {
  const auto asked = std::ranges::find(deck.laws, name_of(deck.problem.of), &DeckLaw::name);
  const DeckLaw& law = asked == deck.laws.end() ? deck.laws.front() : *asked;
  return comments(deck, {"!"}) +
         fmt::format(
             "! {}: {}\n! For the Boundary Condition of the contact, with a heat solver of\n"
             "! discontinuous Galerkin; Contact Pressure: the variable with the pressure.\n"
             "  Heat Gap = Logical True\n  Heat Gap Coefficient = Variable \"Contact Pressure\"\n"
             "    Real\n{}    End\n",
             law.name, law.what, conductances_of(deck, law, "      {} {}\n"));
}

std::string jenkins(const Deck& deck) {
  std::string text = comments(deck, {"#"}) + "stiffness,slider_force\n";
  for (const Slider& slider : deck.sliders)
    text += fmt::format("{},{}\n", slider.stiffness, slider.slider_force);
  return text;
}

}  // namespace

std::string header_of_c(const Deck& deck) {
  const UnitSystem& units = deck.problem.units;
  return c_header(*deck.springs, {.name = deck.problem.name,
                                  .comment = deck.header,
                                  .length_unit = units.in_si(Dimension::length),
                                  .force_unit = units.in_si(Dimension::force)});
}

bool Deck::has_friction() const { return !std::isnan(problem.friction_coefficient); }

std::string comment(std::string_view sentence, const CommentStyle& style) {
  constexpr std::size_t most = 76;
  std::string rest = printable_line(sentence);
  for (const std::string_view sign : style.forbidden)
    for (std::size_t at = rest.find(sign); at != std::string::npos; at = rest.find(sign, at))
      rest.replace(at, 1, fmt::format("\\x{:02x}", static_cast<unsigned char>(sign.front())));
  std::string text, line;
  const auto end_line = [&] {
    text += fmt::format("{} {}\n", style.mark, line);
    line = " ";
  };
  while (!rest.empty()) {
    std::size_t end = std::min(rest.find(' '), rest.size());
    if (!line.empty() && line.size() + 1 + end > most) end_line();
    // Other programs split a line that is too long, and would take its second part for a command.
    for (; end > most; end = std::min(rest.find(' '), rest.size())) {
      std::size_t cut = most;
      while ((rest[cut] & 0xc0) == 0x80) --cut;  // does not split a character of UTF-8
      line += rest.substr(0, cut);
      rest.erase(0, cut);
      end_line();
    }
    line += (line.empty() ? "" : " ") + rest.substr(0, end);
    rest.erase(0, std::min(end + 1, rest.size()));
  }
  end_line();
  return text;
}

double first_clearance(const Deck& deck) {
  double tail = 0;
  for (const DeckLaw& law : deck.laws)
    if (law.pressure.front() > 0)
      tail = std::max(tail, law.pressure.front() / law.normal_stiffness.front());
  return deck.clearance.front() + tail;
}

const DeckWriter& writer_of(DeckFormat format) {
  static constexpr std::array writers{
      DeckWriter{DeckFormat::csv, csv, DeckContent::table, 100000, true},
      DeckWriter{DeckFormat::json, json, DeckContent::table, 100000, true},
      DeckWriter{DeckFormat::calculix, calculix, DeckContent::table, 198, true},
      DeckWriter{DeckFormat::abaqus, abaqus, DeckContent::table, 100000, true},
      DeckWriter{DeckFormat::ansys, ansys, DeckContent::table, 19},
      DeckWriter{DeckFormat::code_aster, code_aster},
      DeckWriter{DeckFormat::moose, moose, DeckContent::table, 100000, true},
      DeckWriter{DeckFormat::elmer, elmer, DeckContent::table, 100000, true},
      DeckWriter{DeckFormat::jenkins, jenkins, DeckContent::sliders},
      DeckWriter{DeckFormat::c_header, header_of_c, DeckContent::springs},
      DeckWriter{DeckFormat::fmu, fmu, DeckContent::springs},
  };
  return *std::ranges::find(writers, format, &DeckWriter::format);
}

}  // namespace salebra::detail
