// SPDX-License-Identifier: GPL-3.0-or-later
// Collective calls of the processes that share a surface, and failures that all processes learn of.
#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>
#include <salebra/base/communicator.hpp>
#include <salebra/base/error.hpp>

namespace salebra {
namespace {

constexpr std::int64_t max_units = 2147483647;

std::vector<std::int64_t> places_of(const std::vector<std::int64_t>& counts) {
  std::vector<std::int64_t> offsets(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), offsets.begin() + 1);
  return offsets;
}

// Encodes a failure as text: a letter for its class, and its parts, each after a zero byte.
std::string joined(char kind, std::initializer_list<std::string> parts) {
  std::string text(1, kind);
  for (const std::string& part : parts) text += '\0' + part;
  return text;
}

std::vector<std::string> parted(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = text.find('\0'); at != std::string::npos;) {
    const std::size_t next = text.find('\0', at + 1);
    parts.push_back(
        text.substr(at + 1, next == std::string::npos ? std::string::npos : next - at - 1));
    at = next;
  }
  return parts;
}

std::string failure_of(const std::function<void()>& body) {
  try {
    body();
    return {};
  } catch (const InvalidInput& error) {
    const std::string demand =
        error.remedy().empty() ? error.constraint() : error.constraint() + "; " + error.remedy();
    return joined('v', {error.field(), error.value(), demand});
  } catch (const IoError& error) {
    return joined('w', {error.what()});
  } catch (const NotConverged& error) {
    return joined('n', {error.what()});
  } catch (const Interrupted& error) {
    return joined('i', {error.what()});
  } catch (const std::bad_alloc&) {
    return joined('m', {""});
  } catch (const std::exception& error) {
    return joined('e', {error.what()});
  }
}

[[noreturn]] void fail(const std::string& failure) {
  const auto parts = parted(failure);
  switch (failure.front()) {
    case 'v':
      throw InvalidInput(parts[0], parts[1], parts[2]);
    case 'w':
      throw IoError(parts[0]);
    case 'n':
      throw NotConverged(parts[0]);
    case 'i':
      throw Interrupted(parts[0]);
    case 'm':
      throw std::bad_alloc();
    default:
      throw Error(parts[0]);
  }
}

}  // namespace

Exchange::Exchange(std::size_t unit, std::vector<std::int64_t> sent,
                   std::vector<std::int64_t> received)
    : unit_(unit),
      sent_(std::move(sent)),
      received_(std::move(received)),
      sent_offsets_(places_of(sent_)),
      received_offsets_(places_of(received_)) {
  for (const std::int64_t units : {sent_units(), received_units()})
    require(units <= max_units, "exchange", units,
            "must not have more than 2147483647 units in a process; use more processes");
}

void Communicator::broadcast(void* bytes, std::size_t count, int from) const {
  if (!alone()) transport_->broadcast(bytes, count, from);
}

void Communicator::gather_all(const void* mine, std::span<const std::size_t> bytes,
                              void* all) const {
  if (alone()) {
    std::memcpy(all, mine, bytes.front());
  } else {
    transport_->gather_all(mine, bytes, all);
  }
}

std::vector<std::string> Communicator::gather_all(const std::string& mine) const {
  if (alone()) return {mine};
  const auto count = static_cast<std::size_t>(size());
  const std::size_t length = mine.size();
  std::vector<std::size_t> lengths(count);
  gather_all(&length, std::vector<std::size_t>(count, sizeof length), lengths.data());
  std::string all(std::accumulate(lengths.begin(), lengths.end(), std::size_t{0}), '\0');
  gather_all(mine.data(), lengths, all.data());
  std::vector<std::string> texts;
  std::size_t at = 0;
  for (const std::size_t size : lengths) {
    texts.push_back(all.substr(at, size));
    at += size;
  }
  return texts;
}

bool Communicator::all_agree(bool yes) const { return min_of(yes ? 1 : 0) > 0; }

double Communicator::min_of(double mine) const {
  if (alone()) return mine;
  const std::vector<std::size_t> one(static_cast<std::size_t>(size()), sizeof mine);
  std::vector<double> all(one.size());
  gather_all(&mine, one, all.data());
  return *std::min_element(all.begin(), all.end());
}

void Communicator::exchange(const Exchange& plan, const void* from, void* to) const {
  if (alone()) {
    std::memcpy(to, from, plan.unit_ * static_cast<std::size_t>(plan.sent_units()));
  } else {
    transport_->exchange(plan.unit_, from, {plan.sent_, plan.sent_offsets_}, to,
                         {plan.received_, plan.received_offsets_});
  }
}

Communicator Communicator::split(int group) const {
  return alone() ? *this : Communicator(transport_->split(group));
}

Groups::Groups(const Communicator& all, int count) : all_(all), own_(all), count_(count) {
  require(count >= 1 && count <= all.size(), "groups", count,
          "must lie between 1 and the number of processes");
  if (count == 1) return;
  index_ = static_cast<int>(std::int64_t{all.rank()} * count / all.size());
  own_ = all.split(index_);
}

void collectively(const Communicator& communicator, const std::function<void()>& body) {
  if (communicator.alone()) return body();
  for (const std::string& failure : communicator.gather_all(failure_of(body)))
    if (!failure.empty()) fail(failure);
}

}  // namespace salebra
