// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// HDF5 files that nobody writes by accident, made by the HDF5 library itself.
namespace hostile {

/// What must not be read: a text of 64 bytes that no message and no output may hold.
extern const std::string secret;

struct File {
  std::string name;
  bool readable = false;  ///< a file that must be read all the same
  std::string expected;   ///< part of the message where it is not
};

/// Writes all of them to a folder in which secret.txt and pipe lie, and says what they are.
std::vector<File> write_hdf5_files(const std::filesystem::path& folder);

/// Changes of a result file that was written whole. A name is a path from the root.
void set_text(const std::filesystem::path& file, const std::string& object,
              const std::string& attribute, const std::string& text);
void set_numbers(const std::filesystem::path& file, const std::string& dataset,
                 const std::vector<double>& values, std::size_t rows = 0);
void remove(const std::filesystem::path& file, const std::string& name);

}  // namespace hostile
