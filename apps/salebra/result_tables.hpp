// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <string>
#include <vector>

#include "results/columns.hpp"
#include "session.hpp"

namespace salebra::cli {

/// The quantity of a member of an answer, of the library's or of the program's own structs. Members
/// of an object that is itself a quantity share it: "decay_length_by_weights" holds lengths, one of
/// which is called "force". object: name of the object; empty: the answer.
Quantity quantity_of(const std::string& name, const std::string& object = "");

/// A column of numbers, whose meaning and, unless it says another, unit are those of the quantity
/// of its name.
struct ResultColumn {
  std::string name;  ///< "structure"
  std::vector<double> values;
  std::string other_units = {};  ///< of a spectral density in another convention

  std::string units() const {
    return other_units.empty() ? std::string(si_unit(quantity_of(name).dimension)) : other_units;
  }
  std::string long_name() const { return std::string(quantity_of(name).long_name); }
};

/// Columns of one length, the first of which is the coordinate.
struct ResultTable {
  std::string name;
  std::vector<ResultColumn> columns;
  std::string note = {};  ///< such as a normalisation; empty: none
};

/// The lists of an object as columns.
ResultTable table_of(const std::string& name, const Json& columns);
/// The columns of a vector of described rows; what is unknown in all of them is left out.
/// nominal_area: as in json_of.
template <Described Row>
ResultTable table_of(const std::string& name, const std::vector<Row>& rows,
                     double nominal_area = 0) {
  return table_of(name, json_of(rows, nominal_area));
}

/// An answer and tables, as --output asks for them by its extension:
///   .h5 .hdf5   a group `group` for the answer and one for each table, its first column a
///               dimension scale
///   .json       the answer with an object for each table, as --json prints it
///   .csv        the answer as lines name,value,unit,meaning, and beside it FILE.<table>.csv for
///               each table
/// Throws InvalidInput for another extension, and as the writers do. Collective: the root writes.
void write_tables(const Session& session, const std::string& group, const Json& answer,
                  const std::vector<ResultTable>& tables);
/// Throws what write_tables would throw at its start.
void require_tables(Session& session, const std::vector<std::string>& tables);

/// The answer with an object for each table: {"x": […], "y": […], "units": {…}, "note": …}.
Json with_tables(Json answer, const std::vector<ResultTable>& tables);

/// Text for people: title with note, then columns headed "name [unit]".
std::string to_text(const ResultTable& table);

}  // namespace salebra::cli
