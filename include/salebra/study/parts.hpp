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

/// A shard: the part of the surfaces of a study that one of several processes computes. Surfaces
/// are numbered over all points of the parameter grid and, within a point, over all seeds.
struct Shard {
  std::size_t number = 0;  ///< number of this shard
  std::size_t count = 0;   ///< number of shards; 0: every surface not yet taken

  bool any() const { return count == 0; }
  /// Whether the shard has the surface with this index, counted from 0: it belongs to the shard for
  /// which (index + 1) mod count = number mod count.
  bool holds(std::size_t index) const { return any() || (index + 1) % count == number % count; }
};

/// Parses "number/count", e.g. "3/8", or "any". The number runs from 1 to 8 or, for schedulers that
/// count from 0, from 0 to 7. Throws InvalidInput.
Shard parse_shard(std::string_view text);
/// Formats a shard as parse_shard() reads it.
std::string to_text(const Shard& shard);

/// Where a stored realisation was computed.
struct PartOrigin {
  std::string version;     ///< version of the program; empty: the file has another format
  std::string arithmetic;  ///< arithmetic() of the program that computed it
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
  /// Throws InvalidInput if it holds realisations and `resume` is false, and if another process has
  /// locked it; IoError if the folder cannot be created.
  StudyParts(const std::filesystem::path& folder, bool resume);
  /// Opens the folder for one of several processes that share it. Throws InvalidInput if another
  /// process has locked it alone. The destructor keeps the folder and files that others write into
  /// it.
  static std::unique_ptr<StudyParts> of_shard(const std::filesystem::path& folder,
                                              const Shard& shard);
  /// Locks the folder for this process alone, to read its realisations and merge them. They may
  /// come from any arithmetic(), because no further realisations are computed. Throws InvalidInput
  /// while a shard runs.
  static std::unique_ptr<StudyParts> to_merge(const std::filesystem::path& folder);
  /// Unlocks the folder. If this process had locked it alone and it has no realisations, the folder
  /// is removed.
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
  /// Reads a realisation; empty if there is none with this key. A damaged file is removed and
  /// counted in damaged(). Throws InvalidInput for a realisation computed with another
  /// arithmetic(), such as that of a processor with wider vectors, because surfaces of one study
  /// must not differ in their last digits. For shards, whose hosts a scheduler chooses, and for a
  /// merge, another arithmetic() is accepted and listed in origins().
  std::optional<Realisation> read(std::uint64_t key);
  /// Writes a realisation, which is on the disk when the function returns; several threads may call
  /// the function at once. Throws IoError.
  void write(std::uint64_t key, const Realisation& realisation);
  /// Number of damaged files that read() removed.
  int damaged() const;
  /// Origins of all realisations that read() returned.
  const std::vector<PartOrigin>& origins() const;
  /// Origins of the realisations in the folder whose key is not among `keys` (in ascending order);
  /// they belong to other settings, seeds or versions.
  std::vector<PartOrigin> others(std::span<const std::uint64_t> keys) const;

  /// Removes the folder with its content; call it once the result of the study is saved elsewhere.
  /// If `only` is not empty, only realisations with these keys are removed, and the folder stays if
  /// others are left.
  void discard(std::span<const std::uint64_t> only = {});

 private:
  enum class Use { resume, shard, merge };
  StudyParts(const std::filesystem::path& folder, Use use, const std::string& shard);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
