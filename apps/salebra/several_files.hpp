// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/units.hpp>
#include <string>
#include <vector>

#include "session.hpp"

/// One command on several surfaces: a table with a row for each file, or for each file and load.
namespace salebra::cli {

/// Whether names mean several surfaces: more than one name, a folder, or a pattern such as "*.sur".
bool are_several(const std::vector<std::string>& names);
/// The files of the names. A folder stands for its files, without hidden ones and without the
/// sidecars of NumPy arrays. A name with *, ?, [ or { that is no file is expanded as by a shell. A
/// file that is named twice counts once. Throws InvalidInput for an empty folder and for a pattern
/// without files. field: name of the argument in messages.
std::vector<std::string> files_of(const std::vector<std::string>& names, const std::string& field);

/// Option --csv of commands that take several surfaces.
void add_table_file(Command& command, std::string& file);

/// What a command gives for one file: its JSON answer, or the reason of its failure.
struct FileAnswer {
  std::string file;
  Json answer;
  std::string failure;
};

/// A column of the table. It is left out of the text if no file has a value.
struct FileColumn {
  std::string heading;  ///< in the text; empty: only in the CSV file
  std::string name;     ///< in the CSV file; empty: only in the text
  /// The value for a file and a load; a text, boolean or number. Null if it is not known.
  std::function<Json(const Json& answer, std::size_t load)> value;
  Dimension dimension = Dimension::dimensionless;
  bool averaged = true;   ///< whether mean and spread between the files have a meaning
  double scale = 1;       ///< the text shows the value times this number
  std::string unit = {};  ///< of the CSV file, if `dimension` has no such unit
};

/// A column with a member of the answer, such as "areal.Sq", with the dimension of its quantity. Of
/// a list it is the element of the load.
FileColumn column(const std::string& heading, const std::string& path, const std::string& name,
                  bool averaged = true);
/// The member of an answer, or for a list its element; null if there is none.
Json member(const Json& answer, const std::string& path, std::size_t load);

/// A table of several surfaces has one direction of the tangential motion, so that its rows can be
/// compared: the value of --direction or, by default, along x. Throws InvalidInput for both.
std::string one_direction(const std::string& direction);

struct FileTable {
  std::vector<FileColumn> columns;
  /// Rows of each file. The first column then tells them apart if its heading is load_heading.
  std::size_t loads = 1;
  std::string load_heading = "pressure";
  bool interval = false;  ///< whether to print the 95 % interval of each mean
  std::string csv = {};   ///< file of --csv; empty: none
  std::string note = {};  ///< printed below the text if the first averaged column lacks a number
};

/// Adds the damping constant per nominal area with its relative error, the part of it that is
/// caused by slip, and the damping constant without slip. path: of the object with the numbers of a
/// loss, such as "damping."; area: the nominal area of an answer, m²
void add_damping_columns(FileTable& table, const std::string& path,
                         const std::function<double(const Json& answer, std::size_t load)>& area);

/// Runs a command for each file and answers with the table of all: as text with mean and standard
/// deviation between the files, with --json as an array of the answers, with --csv as a file. A file
/// that fails does not stop the others; the reasons follow the table. Throws an Error if some files
/// failed, InvalidInput if all did, and the exception of the first one if all failed for the same
/// reason. After an interruption the files that were finished are answered.
/// run: runs the command for one file; it calls session.answer() once
void answer_files(const std::vector<std::string>& files, const FileTable& table, Session& session,
                  const std::function<void(const std::string& file)>& run);

/// Why an option is refused that a table of several surfaces cannot have, also one of a single
/// surface that --csv asks for.
constexpr const char* takes_one_surface =
    "takes one surface, not a table of several; name one file and leave out --csv";

/// Throws InvalidInput if an option is given that a table of several surfaces cannot have.
void require_options_of_one(const Session& session,
                            const std::vector<std::pair<bool, const char*>>& others);

}  // namespace salebra::cli
