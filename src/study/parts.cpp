// SPDX-License-Identifier: GPL-3.0-or-later
// Folder of finished realisations from which an interrupted study resumes.
#include <fmt/format.h>

#include <atomic>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/study/parts.hpp>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/input_file.hpp"
#include "realisation_record.hpp"
#include "study_lock.hpp"

namespace salebra {
namespace {

constexpr const char* suffix = ".realisation";

bool is_realisation(const std::filesystem::path& file) {
  return file.extension() == suffix && file.filename().string().front() != '.';
}

std::filesystem::path created(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw IoError(folder.string() + ": cannot be created; check permissions and space");
  return folder;
}

/// What a killed writer left half-way. Only for the holder of the lock, which says that no other is at work.
void remove_abandoned(const std::filesystem::path& folder, const std::string& beginning) {
  std::vector<std::filesystem::path> abandoned;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".part" &&
        entry.path().filename().string().starts_with(beginning))
      abandoned.push_back(entry.path());
  std::error_code ignored;
  for (const std::filesystem::path& file : abandoned) std::filesystem::remove(file, ignored);
}

}  // namespace

struct StudyParts::State {
  explicit State(const std::filesystem::path& where)
      : folder(created(where)), lock(std::make_unique<detail::StudyLock>(folder / "lock")) {}

  std::filesystem::path file(std::uint64_t key) const {
    return folder / fmt::format("{:016x}{}", key, suffix);
  }

  std::filesystem::path folder;
  std::unique_ptr<detail::StudyLock> lock;
  std::atomic<int> damaged = 0;
};

StudyParts::StudyParts(const std::filesystem::path& folder, bool resume)
    : state_(std::make_unique<State>(folder)) {
  // The result beside the folder may have been cut off too, and so may its page.
  const std::filesystem::path parent = folder.parent_path(), result = folder.stem();
  remove_abandoned(folder, ".");
  for (const auto& file : {result, std::filesystem::path(result).replace_extension(".html")})
    remove_abandoned(parent.empty() ? "." : parent, "." + file.string() + ".");
  if (!resume && count() > 0) {
    throw InvalidInput(fmt::format(
        "{}: holds {} finished surfaces of an earlier run; go on with them by `resume`, or "
        "remove the folder to begin anew",
        folder.string(), count()));
  }
}

StudyParts::~StudyParts() {
  state_->lock.reset();
  std::error_code ignored;
  std::filesystem::remove(state_->folder, ignored);  // only an empty one
}

const std::filesystem::path& StudyParts::folder() const { return state_->folder; }

std::size_t StudyParts::count() const {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(state_->folder))
    if (is_realisation(entry.path())) ++files;
  return files;
}

std::uint64_t StudyParts::key(const StudyConfiguration& point, std::uint64_t seed) {
  return detail::realisation_key(point, seed);
}

bool StudyParts::holds(std::uint64_t key) const {
  return std::filesystem::exists(state_->file(key));
}

std::optional<Realisation> StudyParts::read(std::uint64_t key) {
  const std::filesystem::path file = state_->file(key);
  if (!std::filesystem::exists(file)) return {};
  try {
    return detail::decode(detail::InputFile(file).content(), key);
  } catch (const detail::OtherArithmetic& other) {
    throw InvalidInput(fmt::format(
        "{}: its surfaces were computed by {}, and this program computes by {}: their last digits "
        "differ; resume where the study was begun, or remove the folder to begin anew",
        state_->folder.string(), other.what(), arithmetic()));
  } catch (const InvalidInput&) {
    ++state_->damaged;
    std::filesystem::remove(file);
    return {};
  }
}

void StudyParts::write(std::uint64_t key, const Realisation& realisation) {
  if (!state_->lock->held())
    throw Interrupted(state_->folder.string() + ": another process took the study over");
  try {
    detail::AtomicFile file(state_->file(key), {.overwrite = true});
    file.write(detail::encode(realisation, key));
    file.commit();
  } catch (const IoError& error) {
    throw IoError(
        fmt::format("{}; the surfaces finished before are kept: make room and go on with "
                    "`resume`",
                    error.what()));
  }
}

int StudyParts::damaged() const { return state_->damaged; }

void StudyParts::discard() {
  for (const auto& entry : std::filesystem::directory_iterator(state_->folder))
    if (is_realisation(entry.path())) std::filesystem::remove(entry.path());
}

}  // namespace salebra
