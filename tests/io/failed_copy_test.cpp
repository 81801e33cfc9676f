// SPDX-License-Identifier: GPL-3.0-or-later
// Copies values while each allocation fails in turn: the copy must throw std::bad_alloc and leave
// nothing incomplete.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "io/hdf5_document.hpp"
#include "io/json.hpp"

using salebra::Json;

namespace {
constexpr long never = -1;
long allocations_left = never;
}  // namespace

// Not inlined: GCC would warn that free() does not match new.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (allocations_left != never && allocations_left-- == 0) {
    allocations_left = never;
    throw std::bad_alloc();
  }
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

/// Lets the first, second, … allocation of `work` fail, which must throw std::bad_alloc, until the
/// work succeeds. Returns the number of failures.
template <class Work>
long failures_before(Work work) {
  for (long n = 0; n < 1000; ++n) {
    allocations_left = n;
    try {
      work();
      allocations_left = never;
      return n;
    } catch (const std::bad_alloc&) {
      allocations_left = never;
    }
  }
  return never;
}

const std::string long_text = "a text that does not fit into the object of a string";

}  // namespace

TEST_CASE("A JSON value is copied or the copy throws", "[json]") {
  const Json text(long_text), numbers(std::vector<double>{1, 2, 3});
  const Json nested = {{"a key beyond short strings", {{long_text, text}, {"n", numbers}}}};
  CHECK(failures_before([&] { const Json copy = text; }) == 1);     // the characters
  CHECK(failures_before([&] { const Json copy = numbers; }) == 1);  // the array
  // Two objects, two keys, the text, the array.
  CHECK(failures_before([&] { const Json copy = nested; }) == 6);
  CHECK(failures_before([&] {
          Json made;
          made["first"]["second"] = nested;
          made["list"].push_back(nested);
        }) > 12);
}

TEST_CASE("The attributes of an HDF5 object are copied or the copy throws", "[hdf5]") {
  salebra::detail::hdf5::Object object;
  object.attributes = {{"unit", long_text}, {"size", 1.0}};
  CHECK(failures_before([&] { const auto copy = object; }) == 2);  // the list, the text
}
