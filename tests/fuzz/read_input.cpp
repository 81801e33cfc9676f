// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_input.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/io/number_table.hpp>
#include <stdexcept>

#include "../../src/io/loaded_surface.hpp"
#include "../../src/io/x3p.hpp"

namespace salebra::fuzz {
namespace {

/// A file, in memory where the system has such a folder, for what is read through a path.
class ScratchFile {
 public:
  ScratchFile() {
    const std::filesystem::path memory = "/dev/shm";
    name_ = (std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path()) /
            "salebra-fuzz-XXXXXX";
    descriptor_ = mkstemp(name_.data());
    if (descriptor_ < 0) throw std::runtime_error("no scratch file");
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() {
    close(descriptor_);
    unlink(name_.c_str());
  }

  void fill(const std::string& content) {
    if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, content.data(), content.size(), 0) !=
                                              static_cast<ssize_t>(content.size()))
      throw std::runtime_error("cannot fill the scratch file");
  }
  const std::string& path() const { return name_; }

 private:
  std::string name_;
  int descriptor_ = -1;
};

void require_possible(const Surface& surface) {
  surface.grid.validate();
  if (surface.heights.rows() != surface.grid.nx || surface.heights.cols() != surface.grid.ny ||
      surface.heights.isInf().any())
    throw std::logic_error("a reader returned a surface that cannot be");
}

using Reader = detail::LoadedSurface (*)(const std::filesystem::path&, std::string_view);

void complete(const std::string& name, detail::LoadedSurface loaded) {
  // Sizes that a file states are judged; where it states none, they are given.
  ReadOptions options;
  if (!loaded.size_x) options.size_x = 1;
  if (!loaded.size_y) options.size_y = 1;
  require_possible(detail::completed(name, std::move(loaded), options));
}

template <Reader reader>
void read_with(const std::string& input) {
  complete("input", reader("input", input));
}

/// Members of an X3P archive without the archive: its checksums would leave nothing to a mutation. The input is main.xml and the
/// heights, parted by a NUL byte; the mask, where one is asked for, is the end of the heights.
void read_x3p_parts(const std::string& input) {
  const auto parted = input.find('\0');
  const std::string xml = input.substr(0, parted),
                    data = parted == std::string::npos ? "" : input.substr(parted + 1);
  const auto member = [&](const std::string& name,
                          std::optional<std::uint64_t> bytes) -> std::optional<std::string> {
    if (name == "main.xml") return xml;
    if (!bytes) return {};
    if (*bytes > data.size()) detail::refuse("input", "declares more than it holds");
    return name.ends_with("valid.bin") ? data.substr(data.size() - *bytes) : data.substr(0, *bytes);
  };
  complete("input", detail::x3p_surface("input", member));
}

void read_through_file(const std::string& input,
                       const std::function<void(const std::filesystem::path&)>& read) {
  static ScratchFile file;
  file.fill(input);
  read(file.path());
}

/// The fourth byte is the version: 1, 2 or 5.
void read_netcdf(std::string input) {
  if (input.size() < 4) input.resize(4);
  if (input[3] != 1 && input[3] != 5) input[3] = 2;
  read_with<detail::read_netcdf>(input);
}

struct Target {
  std::string_view head;  ///< put in place of the first bytes
  std::function<void(const std::string&)> read;
};

const std::map<std::string, Target, std::less<>>& targets() {
  static const std::map<std::string, Target, std::less<>> all{
      {"text", {"", read_with<detail::read_text>}},
      {"npy", {std::string_view("\x93NUMPY"), read_with<detail::read_npy>}},
      {"gsf", {"Gwyddion Simple Field 1.0\n", read_with<detail::read_gsf>}},
      {"gxyzf", {"Gwyddion XYZ Field 1.0\n", read_with<detail::read_gxyzf>}},
      {"netcdf", {"CDF", read_netcdf}},
      {"sur", {"DIGITAL SURF", read_with<detail::read_sur>}},
      {"x3p", {"PK\x03\x04", read_with<detail::read_x3p>}},
      {"x3p-parts", {"", read_x3p_parts}},
      {"any", {"", read_with<detail::read_content>}},
      {"table",
       {"",
        [](const std::string& input) {
          read_through_file(input, [](const auto& file) { read_number_table(file, 2); });
        }}},
      {"curve",
       {"",
        [](const std::string& input) {
          read_through_file(input, [](const auto& file) { read_force_curve(file); });
        }}},
      {"hdf5",
       {std::string_view("\x89HDF\r\n\x1a\n"),
        [](const std::string& input) {
          read_through_file(
              input, [](const auto& file) { complete(file.string(), detail::read_hdf5(file)); });
        }}},
  };
  return all;
}

}  // namespace

const std::vector<std::string>& readers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, target] : targets()) all.push_back(name);
    return all;
  }();
  return names;
}

bool read_input(std::string_view reader, std::string input) {
  const auto found = targets().find(reader);
  if (found == targets().end()) throw std::logic_error("no such reader: " + std::string(reader));
  const std::string_view head = found->second.head;
  if (input.size() < head.size()) input.resize(head.size());
  input.replace(0, head.size(), head);
  try {
    found->second.read(input);
    return true;
  } catch (const InvalidInput& error) {
    if (std::string_view(error.what()).find_first_of("\n\r\x1b") != std::string_view::npos)
      throw std::logic_error("a message of several lines or with control characters");
    return false;
  }
}

}  // namespace salebra::fuzz
