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

/// Which surfaces of a study one of several processes computes. Surfaces are counted over all
/// points of the parameter grid and all seeds, in their order.
struct Shard {
  std::size_t number = 0;
  std::size_t count = 0;  ///< 0: every surface that no other process has taken

  bool any() const { return count == 0; }
  /// place: from 0 on. The i-th surface, i from 1 on, belongs to the shard where i mod count =
  /// number mod count.
  bool holds(std::size_t place) const { return any() || (place + 1) % count == number % count; }
};

/// "3/8", with the number from 1 to 8 or, for schedulers that count from 0, from 0 to 7; or "any".
/// Throws InvalidInput.
Shard parse_shard(std::string_view text);
/// The inverse.
std::string to_text(const Shard& shard);

/// Where a kept realisation was computed.
struct PartOrigin {
  std::string version;     ///< of the program; empty: another form of the file
  std::string arithmetic;  ///< arithmetic() there
  std::string host;
  std::string shard;  ///< "3/8" or "any"; empty: of a run without shards

  bool operator==(const PartOrigin&) const = default;
};

constexpr void describe(auto&& visit, std::type_identity<PartOrigin>) {
  keep(visit, &PartOrigin::version, &PartOrigin::arithmetic, &PartOrigin::host, &PartOrigin::shard);
}

/// A folder with the finished realisations of a study, so that a study that was stopped, killed or
/// ran out of disk can go on: one file for each, complete or not there at all, with a checksum and
/// a key of everything that decides it. While the object lives, the folder is locked by flock(),
/// which ends with the process. One process has the folder alone, or any number of shards share it. Realisations are files that appear whole, and
/// the same bits whoever computes them: that several shards compute one is a waste, no fault.
class StudyParts {
 public:
  /// Creates the folder where it is not there. resume: a folder that holds realisations is
  /// accepted.
  /// Throws InvalidInput where it holds some and resume is false, and where another process has it;
  /// IoError where the folder cannot be created.
  StudyParts(const std::filesystem::path& folder, bool resume);
  /// Opens the folder for one of several processes that share it. Throws InvalidInput where a
  /// process has it alone. The folder stays when the object goes, and files that others write into
  /// it are left alone.
  static std::unique_ptr<StudyParts> of_shard(const std::filesystem::path& folder,
                                              const Shard& shard);
  /// Alone, to read realisations of any arithmetic(), since nothing is added to them. Throws
  /// InvalidInput while a shard runs.
  static std::unique_ptr<StudyParts> to_merge(const std::filesystem::path& folder);
  /// Unlocks; where it was had alone, a folder without realisations is removed.
  ~StudyParts();
  StudyParts(const StudyParts&) = delete;
  StudyParts& operator=(const StudyParts&) = delete;

  const std::filesystem::path& folder() const;
  /// The number of realisations in it, whatever they belong to.
  std::size_t count() const;

  /// Names the realisation: everything that decides it and nothing else.
  static std::uint64_t key(const StudyConfiguration& point, std::uint64_t seed);
  /// The keys of all realisations of a study, in ascending order.
  static std::vector<std::uint64_t> keys(const StudyConfiguration& study);
  bool holds(std::uint64_t key) const;
  /// Empty where there is none; a damaged one is removed and counts in damaged(). Throws
  /// InvalidInput for one of another arithmetic(), such as that of a processor with wider vectors:
  /// a study whose surfaces differ in their last digits is no study of either. Shards run where a
  /// scheduler sends them: for them and a merge it counts in origins() only.
  std::optional<Realisation> read(std::uint64_t key);
  /// On the disk when it returns; may be called by several threads. Throws IoError.
  void write(std::uint64_t key, const Realisation& realisation);
  int damaged() const;
  /// The origin of every realisation that read() returned.
  const std::vector<PartOrigin>& origins() const;
  /// Origins of the realisations in the folder that have none of these keys, in ascending order: of
  /// other settings, seeds or versions.
  std::vector<PartOrigin> others(std::span<const std::uint64_t> keys) const;

  /// Removes the folder with all that is in it: the study's result is safe elsewhere. only: where
  /// it has keys, realisations of others stay, and the folder with them.
  void discard(std::span<const std::uint64_t> only = {});

 private:
  enum class Use { resume, shard, merge };
  StudyParts(const std::filesystem::path& folder, Use use, const std::string& shard);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
