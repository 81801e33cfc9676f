// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <salebra/base/grid.hpp>
#include <type_traits>

namespace salebra {

/// A field that is not initialised, on large pages where the system has them: the first touch of a field of ordinary pages can
/// take longer than its Fourier transform.
Field uninitialised_field(Index nx, Index ny);

/// Makes the system provide the memory of a field that is not initialised, each page by one thread. Where a loop writes to all rows at
/// once, threads that meet on a fresh page clear it both, and one of them unnecessarily: at 4096² that is 6 ms of each thread.
void touch_pages(Field& field);

/// Memory that is not initialised, on boundaries of 64 bytes (a cache line, and the widest vector), on large pages where it fills
/// several and the system has them. std::free releases it. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);

struct ReleaseLarge {
  void operator()(void* memory) const { std::free(memory); }
};
template <class Element>
using LargeArray = std::unique_ptr<Element[], ReleaseLarge>;

/// Room for size elements of allocate_large. Pages belong to the thread that first writes to them.
template <class Element>
LargeArray<Element> large_array(std::size_t size) {
  static_assert(std::is_trivially_destructible_v<Element>);
  return LargeArray<Element>(static_cast<Element*>(allocate_large(size * sizeof(Element))));
}

/// Bytes that new data can take without swapping, as the system estimates it; all that the machine has where /proc is not
/// mounted, and 0 where the system does not say.
std::size_t available_memory();

}  // namespace salebra
