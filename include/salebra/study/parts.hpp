// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/study/realisation.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// The surfaces of a study that one of several processes computes. Surfaces are numbered over all
/// points of the parameter grid and all seeds, in their order.
struct Shard {
  std::size_t number = 0;
  std::size_t count = 0;  ///< 0: every surface that no other process has taken

  bool any() const { return count == 0; }
  /// Whether the shard has the surface with index `place`, counted from 0. The i-th surface,
  /// counted from 1, belongs to the shard where i mod count = number mod count.
  bool holds(std::size_t location) const { return any() || (location + 1) % count == number % count; }
};

/// Parses "3/8", with the number from 1 to 8 or, for schedulers that count from 0, from 0 to 7; or
/// "any". Throws InvalidInput.
Shard parse_shard(std::string_view text);
/// Formats a shard as parse_shard() reads it.
std::string to_text(const Shard& shard);

/// Where a stored realisation was computed.
struct PartOrigin {
  std::string version;     ///< version of the program; empty: the file has another format
  std::string arithmetic;  ///< arithmetic() of that machine
  std::string host;
  std::string shard;  ///< "3/8" or "any"; empty: a run without shards

  bool operator==(const PartOrigin&) const = default;
};

constexpr void describe(auto&& visit, std::type_identity<PartOrigin>) {
  keep(visit, &PartOrigin::version, &PartOrigin::arithmetic, &PartOrigin::host, &PartOrigin::shard);
}

/// A folder with the finished realisations of a study, from which a study continues after a stop, a
/// crash or a full disk.
///
///     StudyParts parts("study.parts", true);
///     StudyResult result = run_study(study, {.parts = &parts});
///
/// There is one file per realisation, complete or absent, with a checksum and a key of everything
/// that determines it. While the object exists, the folder is locked by flock(), which ends with
/// the process: either one process has the folder alone, or any number of shards share it. A
/// realisation has the same bits whoever computes it, so two shards that compute the same one waste
/// time but do no harm.
class StudyParts {
 public:
  /// Creates the folder if needed. With `resume` it may hold realisations already.
  /// Throws InvalidInput where it holds some and resume is false, and where another process has
  /// locked it; IoError where the folder cannot be created.
  StudyParts(const std::filesystem::path& folder, bool resume);
  /// Opens the folder for one of several processes that share it. Throws InvalidInput where a
  /// process has it alone. The destructor keeps the folder and files that others write into it.
  static std::unique_ptr<StudyParts> of_shard(const std::filesystem::path& folder,
                                              const Shard& shard);
  /// Locks the folder alone to read realisations of any arithmetic(), since none are added. Throws
  /// InvalidInput while a shard runs.
  static std::unique_ptr<StudyParts> to_merge(const std::filesystem::path& folder);
  /// Unlocks the folder. A folder locked alone is removed if it has no realisations.
  ~StudyParts();
  StudyParts(const StudyParts&) = delete;
  StudyParts& operator=(const StudyParts&) = delete;

  const std::filesystem::path& folder() const;
  /// Number of realisations in the folder, whatever study they belong to.
  std::size_t count() const;

  /// Key of a realisation, from everything that determines it and nothing else.
  static std::uint64_t key(const StudyConfiguration& point, std::uint64_t seed);
  /// Keys of all realisations of a study, in ascending order.
  static std::vector<std::uint64_t> keys(const StudyConfiguration& study);
  bool holds(std::uint64_t key) const;
  /// Reads a realisation; empty where there is none. A damaged file is removed and counts in
  /// damaged(). Throws InvalidInput for one of another arithmetic(), such as that of a processor
  /// with wider vectors: surfaces of one study must not differ in their last digits. For shards,
  /// which run on the hosts that a scheduler chooses, and for a merge, another arithmetic() only
  /// shows in origins().
  std::optional<Realisation> read(std::uint64_t key);
  /// Writes a realisation, which is on the disk when the function returns; several threads may call
  /// it. Throws IoError.
  void write(std::uint64_t key, const Realisation& realisation);
  int damaged() const;
  /// Origins of all realisations that read() returned.
  const std::vector<PartOrigin>& origins() const;
  /// Origins of the realisations in the folder that have none of these keys (in ascending order),
  /// from other settings, seeds or versions.
  std::vector<PartOrigin> others(std::span<const std::uint64_t> keys) const;

  /// Removes the folder with its content, once the result of the study is saved elsewhere. If
  /// `only` has keys, other realisations stay, and the folder with them.
  void discard(std::span<const std::uint64_t> only = {});

 private:
  enum class Use { resume, shard, merge };
  StudyParts(const std::filesystem::path& folder, Use use, const std::string& shard);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
