// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/study/realisation.hpp>
#include <vector>

namespace salebra {

/// A folder with the finished realisations of a study, so that a study that was stopped, killed or ran out of disk can go on: one file
/// for each, complete or not there at all, with a checksum and a key of everything that decides it. While the object lives, the
/// folder is locked: by a file that link() creates, with host, process and its start time, touched every few seconds. A lock is
/// taken over when its process is gone, where that is one of this host; that of another host when it has not been touched for a minute,
/// by the clock of the file system.
class StudyParts {
 public:
  /// Creates the folder where it is not there. resume: a folder that holds realisations is accepted.
  /// Throws InvalidInput where it holds some and resume is false, and where another process has it; IoError where the folder cannot be
  /// created.
  StudyParts(const std::filesystem::path& folder, bool resume);
  /// Unlocks; a folder without realisations is removed.
  ~StudyParts();
  StudyParts(const StudyParts&) = delete;
  StudyParts& operator=(const StudyParts&) = delete;

  const std::filesystem::path& folder() const;
  /// The number of realisations in it, whatever they belong to.
  std::size_t count() const;

  /// Names the realisation: everything that decides it and nothing else.
  static std::uint64_t key(const StudyConfiguration& point, std::uint64_t seed);
  bool holds(std::uint64_t key) const;
  /// Empty where there is none; a damaged one is removed and counts in damaged(). Throws InvalidInput for one of another arithmetic(),
  /// such as that of a processor with wider vectors: a study whose surfaces differ in their last digits is no study of either.
  std::optional<Realisation> read(std::uint64_t key);
  /// On the disk when it returns; may be called by several threads. Throws IoError, and Interrupted where another process
  /// took the lock over.
  void write(std::uint64_t key, const Realisation& realisation);
  int damaged() const;

  /// Removes the folder with all that is in it: the study's result is safe elsewhere.
  void discard();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
