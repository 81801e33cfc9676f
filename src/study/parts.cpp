// SPDX-License-Identifier: GPL-3.0-or-later
// Folder of finished realisations from which an interrupted study resumes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/study/parts.hpp>
#include <string>
#include <vector>

#include "case_run.hpp"
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

std::string name_of(std::uint64_t key) { return fmt::format("{:016x}{}", key, suffix); }

/// Returns whether the name of the file is one of the keys, which must be in ascending order.
bool is_one_of(const std::filesystem::path& file, std::span<const std::uint64_t> keys) {
  std::uint64_t key = 0;
  const std::string stem = file.stem().string();
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), key, 16);
  return error == std::errc() && file.filename() == name_of(key) &&
         std::ranges::binary_search(keys, key);
}

std::string host() {
  std::array<char, 256> name = {};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// An error class of its own: a part computed with another arithmetic is refused, and not removed
/// as damaged.
class OtherArithmetic : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

std::filesystem::path created(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw IoError(folder.string() + ": cannot be created; check permissions and space");
  return folder;
}

/// Removes the files that killed processes left in a folder: half-written files or claims. Only a
/// process that uses the folder alone may call this. beginning: of the names of these files.
void remove_abandoned(const std::filesystem::path& folder, const std::string& beginning,
                      const char* extension = ".part") {
  std::vector<std::filesystem::path> abandoned;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == extension &&
        entry.path().filename().string().starts_with(beginning))
      abandoned.push_back(entry.path());
  std::error_code ignored;
  for (const std::filesystem::path& file : abandoned) std::filesystem::remove(file, ignored);
}

}  // namespace

struct StudyParts::State {
  State(const std::filesystem::path& where, Use purpose, const std::string& shard_text)
      : folder(created(where)),
        use(purpose),
        shard(shard_text),
        lock(std::make_unique<detail::StudyLock>(
            folder / "lock", use == Use::shard ? detail::StudyLock::Kind::shared
                                               : detail::StudyLock::Kind::alone)) {}

  std::filesystem::path file(std::uint64_t key) const { return folder / name_of(key); }

  std::filesystem::path folder;
  Use use;
  std::string shard;
  std::unique_ptr<detail::StudyLock> lock;
  std::atomic<int> damaged = 0;
  std::vector<PartOrigin> origins;
};

StudyParts::StudyParts(const std::filesystem::path& folder, Use use, const std::string& shard)
    : state_(std::make_unique<State>(folder, use, shard)) {
  if (use == Use::shard) return;
  // The result file next to the folder, and its report page, may also be half-written.
  const std::filesystem::path parent = folder.parent_path(), result = folder.stem();
  remove_abandoned(folder, ".");
  remove_abandoned(folder, "", detail::claim_suffix);
  for (const auto& file : {result, std::filesystem::path(result).replace_extension(".html")})
    remove_abandoned(parent.empty() ? "." : parent, "." + file.string() + ".");
}

StudyParts::StudyParts(const std::filesystem::path& folder, bool resume)
    : StudyParts(folder, Use::resume, "") {
  if (!resume && count() > 0) {
    throw InvalidInput(folder.string(),
                       fmt::format("holds {} finished surfaces of an earlier run; continue with "
                                   "`resume`, or remove the folder to start again",
                                   count()));
  }
}

std::unique_ptr<StudyParts> StudyParts::of_shard(const std::filesystem::path& folder,
                                                 const Shard& shard) {
  return std::unique_ptr<StudyParts>(new StudyParts(folder, Use::shard, to_text(shard)));
}

std::unique_ptr<StudyParts> StudyParts::to_merge(const std::filesystem::path& folder) {
  return std::unique_ptr<StudyParts>(new StudyParts(folder, Use::merge, ""));
}

StudyParts::~StudyParts() {
  state_->lock.reset();
  if (state_->use == Use::shard) return;
  std::error_code ignored;
  std::filesystem::remove(state_->folder, ignored);  // removes the folder only if it is empty
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

std::vector<std::uint64_t> StudyParts::keys(const StudyConfiguration& study) {
  std::vector<std::uint64_t> keys = detail::keys_of(parameter_combinations(study));
  std::ranges::sort(keys);
  return keys;
}

bool StudyParts::holds(std::uint64_t key) const {
  return std::filesystem::exists(state_->file(key));
}

std::optional<Realisation> StudyParts::read(std::uint64_t key) {
  const std::filesystem::path file = state_->file(key);
  if (!std::filesystem::exists(file)) return {};
  try {
    detail::Record record = detail::decode(detail::InputFile(file).content(), key);
    if (state_->use == Use::resume && record.origin.arithmetic != arithmetic())
      throw OtherArithmetic(
          state_->folder.string(),
          fmt::format("its surfaces were computed with {}, but this program computes with {}, so "
                      "the last digits differ; resume on the machine where the study was started, "
                      "or remove the folder to start again",
                      record.origin.arithmetic, arithmetic()));
    state_->origins.push_back(std::move(record.origin));
    return std::move(record.realisation);
  } catch (const OtherArithmetic&) {
    throw;
  } catch (const InvalidInput&) {
    ++state_->damaged;
    std::filesystem::remove(file);
    return {};
  }
}

void StudyParts::write(std::uint64_t key, const Realisation& realisation) {
  const bool shared = state_->use == Use::shard;
  if (shared && !std::filesystem::exists(state_->folder))
    throw IoError(
        fmt::format("{}: was removed while this shard ran, as happens when the study is merged or "
                    "started again; if the study is not finished, run the shard again",
                    state_->folder.string()));
  try {
    detail::AtomicFile file(state_->file(key), {.overwrite = true});
    file.write(detail::encode({{.version = std::string(version()),
                                .arithmetic = arithmetic(),
                                .host = host(),
                                .shard = state_->shard},
                               realisation},
                              key));
    file.commit();
  } catch (const IoError& error) {
    throw IoError(
        fmt::format("{}; the surfaces finished before are kept: free some disk space and {}",
                    error.what(), shared ? "run the shard again" : "continue with `resume`"));
  }
}

int StudyParts::damaged() const { return state_->damaged; }

const std::vector<PartOrigin>& StudyParts::origins() const { return state_->origins; }

std::vector<PartOrigin> StudyParts::others(std::span<const std::uint64_t> keys) const {
  std::vector<PartOrigin> found;
  for (const auto& entry : std::filesystem::directory_iterator(state_->folder))
    if (is_realisation(entry.path()) && !is_one_of(entry.path(), keys))
      found.push_back(
          detail::origin_of(detail::InputFile(entry.path()).content()).value_or(PartOrigin{}));
  return found;
}

void StudyParts::discard(std::span<const std::uint64_t> only) {
  for (const auto& entry : std::filesystem::directory_iterator(state_->folder))
    if (is_realisation(entry.path()) && (only.empty() || is_one_of(entry.path(), only)))
      std::filesystem::remove(entry.path());
}

}  // namespace salebra
