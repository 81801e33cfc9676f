// SPDX-License-Identifier: GPL-3.0-or-later
// The content of an HDF5 file as plain values, which a runner reads and hands over.
#include "hdf5_document.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <salebra/base/parallel.hpp>

#include "base/archive.hpp"
#include "hdf5_runner.hpp"
#include "loaded_surface.hpp"

namespace salebra {
namespace {

std::atomic<Hdf5Runner> runner = nullptr;

void run(const Hdf5Reading& reading) {
  if (const Hdf5Runner installed = runner) return installed(reading);
  reading.read([&](std::span<const std::byte> bytes) {
    if (!bytes.empty())
      std::memcpy(reading.location(bytes.size()).data(), bytes.data(), bytes.size());
  });
}

}  // namespace

void set_hdf5_runner(Hdf5Runner installed) { runner = installed; }

namespace detail::hdf5 {
namespace {

/// Path in normal form: one slash before each name; "/" for the root.
std::string normal(std::string_view path) {
  std::string result;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (end > begin) result += "/" + std::string(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return result.empty() ? "/" : result;
}

const AttributeValue* attribute_of(const Object& object, std::string_view name) {
  for (const auto& [known, value] : object.attributes)
    if (known == name) return &value;
  return nullptr;
}

Hdf5Reading reading_of(const InputFile& file, std::uint64_t bytes) {
  // Processor time that a runner may use. Even a slow machine unpacks and converts 40 MB/s; if a
  // file takes longer, it is damaged and has sent HDF5 into an endless loop.
  constexpr std::uint64_t slowest = 40'000'000, least = 5;
  Hdf5Reading reading;
  reading.file = file.path();
  reading.descriptor = file.descriptor();
  reading.memory = (std::uint64_t{192} << 20) + 48 * file.size();
  reading.seconds = least + (file.size() + bytes) / slowest;
  reading.alone = alone;
  return reading;
}

[[noreturn]] void wrong_answer(const std::filesystem::path& file) {
  refuse(file, "makes the HDF5 library return wrong values; it is damaged");
}

/// Whether the properties of an object are possible in a file of this size. They may come from a
/// child process that the file has compromised.
bool is_sound(const Object& object, std::uint64_t file_size) {
  const auto known = [](Object::Kind kind) { return kind <= Object::Kind::refused; };
  if (!known(object.kind)) return false;
  for (const auto& [name, kind] : object.members)
    if (!known(kind)) return false;
  if (!object.refusal.empty()) return !object.numbers;
  std::uint64_t doubles = sizeof(double);
  for (const std::uint64_t extent : object.shape)
    if (__builtin_mul_overflow(doubles, extent, &doubles)) return false;
  if (object.location && (doubles > file_size || *object.location > file_size - doubles))
    return false;
  return doubles <= max_bytes(file_size) &&
         (!object.numbers || object.numbers->size() == object.count());
}

}  // namespace

std::uint64_t Object::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t extent : shape) product *= extent;
  return product;
}

std::optional<double> Object::number(std::string_view attribute) const {
  const AttributeValue* value = attribute_of(*this, attribute);
  const auto* number = value ? std::get_if<double>(value) : nullptr;
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<std::string> Object::text(std::string_view attribute) const {
  const AttributeValue* value = attribute_of(*this, attribute);
  const auto* text = value ? std::get_if<std::string>(value) : nullptr;
  return text ? std::optional(*text) : std::nullopt;
}

std::uint64_t max_bytes(std::uint64_t file_size) {
  return (std::uint64_t{128} << 20) + 32 * file_size;
}

Document::Document(InputFile file) : file_(std::move(file)) {
  if (!file_.is_hdf5()) refuse(path(), "is not an HDF5 file; name one");
  std::string bytes;
  Hdf5Reading reading = reading_of(file_, 0);
  reading.read = [&](const HandOver& hand_over) { read_outline(file_, hand_over); };
  reading.location = [&](std::size_t count) {
    if (count > max_bytes(file_.size()) - bytes.size())
      refuse(path(), "has a structure larger than its content; it is damaged");
    bytes.resize(bytes.size() + count);
    return std::as_writable_bytes(std::span(bytes)).last(count);
  };
  run(reading);
  try {
    for (auto& [name, object] : from_bytes<Objects>(bytes, path().string())) {
      if (!is_sound(object, file_.size())) wrong_answer(path());
      objects_.insert_or_assign(std::move(name), std::move(object));
    }
  } catch (const InvalidInput&) {
    wrong_answer(path());
  }
  if (!objects_.contains("/")) wrong_answer(path());
}

std::string former_name(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> renamed[] = {
      {"solution", "answer"},       {"assumptions", "premises"},    {"_springs", "_levels"},
      {"intervals", "levels"},      {"max_spot_", "largest_spot_"}, {"_at_min_gap", "_closest"},
      {"_at_max_gap", "_farthest"}, {"verdicts", "conditions"},     {"ensemble_warnings", "flags"}};
  std::string former(name);
  for (const auto& [now, before] : renamed)
    if (const auto at = former.find(now); at != std::string::npos)
      former.replace(at, now.size(), before);
  return former;
}

const Object* Document::find(std::string_view path) const {
  auto found = objects_.find(normal(path));
  if (found == objects_.end()) found = objects_.find(normal(former_name(path)));
  return found == objects_.end() ? nullptr : &found->second;
}

const Object& Document::group(const std::string& path) const {
  const Object* object = find(path);
  if (!object) refuse(file_.path(), "has no group " + path + "; was it written by salebra?");
  if (!object->refusal.empty()) refuse(file_.path(), "has a " + path + " that " + object->refusal);
  if (object->kind != Object::Kind::group) refuse(file_.path(), "has no group in " + path);
  return *object;
}

const Object& Document::dataset(const std::string& path) const {
  const Object* object = find(path);
  if (!object) refuse(file_.path(), "has no dataset " + path + "; was it written by salebra?");
  if (object->kind == Object::Kind::refused)
    refuse(file_.path(), "has a " + path + " that " + object->refusal);
  if (object->kind == Object::Kind::group)
    refuse(file_.path(), "has a group instead of a dataset in " + path);
  return *object;
}

const Object& Document::numeric(const std::string& path) const {
  const Object& object = dataset(path);
  if (object.kind != Object::Kind::numbers)
    refuse(file_.path(), "has a dataset " + path + " that is not of real numbers; store float64");
  if (!object.refusal.empty())
    refuse(file_.path(), "has a dataset " + path + " that " + object.refusal);
  return object;
}

void Document::numbers(const std::string& path, std::span<double> values) const {
  const Object& object = numeric(path);
  if (values.size() != object.count())
    refuse(file_.path(), "has " + std::to_string(object.count()) + " values in " + path);
  if (object.numbers) {
    std::ranges::copy(*object.numbers, values.begin());
    return;
  }
  read(path, object, 0, object.shape.empty() ? 1 : object.shape[0], values);
}

void Document::rows(const std::string& path, const RowPartition& partition,
                    std::span<double> values) const {
  const Object& object = numeric(path);
  const auto begin = static_cast<std::uint64_t>(partition.begin()),
             end = static_cast<std::uint64_t>(partition.end());
  if (object.shape.size() != 2 || object.shape[0] != static_cast<std::uint64_t>(partition.rows()) ||
      values.size() != (end - begin) * object.shape[1])
    refuse(file_.path(), "has other rows in " + path);
  if (values.empty()) return;
  if (object.numbers) {
    std::ranges::copy(std::span(*object.numbers).subspan(begin * object.shape[1], values.size()),
                      values.begin());
    return;
  }
  read(path, object, begin, end, values);
}

void Document::read(const std::string& path, const Object& object, std::uint64_t begin,
                    std::uint64_t end, std::span<double> values) const {
  if (object.location && !values.empty()) {
    const std::size_t row = values.size() / (end - begin);
    return parallel::for_slabs(
        static_cast<Index>(end - begin),
        [&](Index first, Index last) {
          const std::size_t before = static_cast<std::size_t>(first) * row;
          const auto part = values.subspan(before, static_cast<std::size_t>(last) * row - before);
          file_.read(*object.location + (begin * row + before) * sizeof(double),
                     std::as_writable_bytes(part));
        },
        static_cast<Index>(values.size()));
  }
  Hdf5Reading reading = reading_of(file_, values.size_bytes());
  reading.read = [&](const HandOver& hand_over) {
    read_numbers(file_, normal(path), object.shape, begin, end, hand_over);
  };
  std::size_t filled = 0;
  reading.location = [&](std::size_t count) {
    if (count > values.size_bytes() - filled) wrong_answer(file_.path());
    filled += count;
    return std::as_writable_bytes(values).subspan(filled - count, count);
  };
  run(reading);
  if (filled != values.size_bytes()) wrong_answer(file_.path());
}

}  // namespace detail::hdf5
}  // namespace salebra
