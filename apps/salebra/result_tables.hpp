// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <string>
#include <vector>

#include "results/columns.hpp"
#include "session.hpp"

namespace salebra::cli {

/// The quantity of a member of a JSON answer, by its name in the glossary. If the member belongs to
/// an object that is itself a quantity, it is this quantity: all members of
/// "decay_length_by_weights" are lengths, even the one called "force". object: name of the object;
/// empty: the answer itself.
Quantity quantity_of(const std::string& name, const std::string& object = "");

/// A column of numbers. Its meaning and unit are those of the quantity with its name in the
/// glossary; other_units replaces the unit.
struct ResultColumn {
  std::string name;  ///< such as "structure"
  std::vector<double> values;
  /// The unit of a spectral density in another convention; otherwise empty.
  std::string other_units = {};

  std::string units() const {
    return other_units.empty() ? std::string(si_unit(quantity_of(name).dimension)) : other_units;
  }
  std::string long_name() const { return std::string(quantity_of(name).long_name); }
};

/// Columns of equal length, of which the first is the coordinate of the others.
struct ResultTable {
  std::string name;
  std::vector<ResultColumn> columns;
  std::string note = {};  ///< for example on the normalisation; empty: none
};

/// The lists in a JSON object as columns of a table.
ResultTable table_of(const std::string& name, const Json& columns);
/// The columns of a vector of described structs, one row for each. Columns that are unknown in all
/// rows are left out. nominal_area: m²; 0 if unknown, so that columns per area are left out.
template <Described Row>
ResultTable table_of(const std::string& name, const std::vector<Row>& rows,
                     double nominal_area = 0) {
  return table_of(name, json_of(rows, nominal_area));
}

/// Writes an answer and tables to --output, in the format given by its extension:
///     .h5 .hdf5   the group `group` for the answer, and a group for each table, in which the first
///                 column is a dimension scale
///     .json       the answer with an object for each table, as --json prints it
///     .csv        the answer as lines name,value,unit,meaning; each table goes into a file of its
///                 own, FILE.<table>.csv
/// Throws InvalidInput for another extension, and as the writers of files do. All processes must
/// call; the first one writes.
void write_tables(const Session& session, const std::string& group, const Json& answer,
                  const std::vector<ResultTable>& tables);
/// Throws what write_tables() would throw before writing. tables: their names.
void require_tables(Session& session, const std::vector<std::string>& tables);

/// JSON of the answer with a further object for each table: {"x": […], "y": […], "units": {…},
/// "note": …}.
Json with_tables(Json answer, const std::vector<ResultTable>& tables);

/// Text of a table: a line with title and note, then the columns headed "name [unit]".
std::string to_text(const ResultTable& table);

}  // namespace salebra::cli
