// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <salebra/base/communicator.hpp>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <type_traits>

namespace salebra {

/// A field that is not initialised, on large pages where the system has them: the first touch of a
/// field of ordinary pages can take longer than its Fourier transform.
Field uninitialised_field(Index nx, Index ny);

/// Makes the system provide the memory of a field that is not initialised, each page by one thread.
/// Where a loop writes to all rows at once, threads that meet on a fresh page clear it both, and
/// one of them unnecessarily: at 4096² that is 6 ms of each thread.
void touch_pages(Field& field);

/// Memory that is not initialised, on boundaries of 64 bytes (a cache line, and the widest vector),
/// on large pages where it fills several and the system has them. std::free releases it. Throws
/// std::bad_alloc.
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

/// Bytes that new data can take: without swapping, as the system estimates it, within the limits of
/// every memory cgroup above this process (version 1 or 2, as containers and batch systems set
/// them) and within RLIMIT_AS and RLIMIT_DATA. All that the machine has where /proc is not mounted,
/// and 0 where the system does not say. Cost: some ten small files, 0.1 ms.
std::size_t available_memory();

/// Whether so many bytes are below available_memory(). True for less than 64 MB, which is not asked
/// for.
bool fits_into_memory(double bytes);

/// "721 MB", "1.44 GB", "281 TB": three digits.
std::string memory_text(double bytes);

/// Memory of the machine on which it is shortest, of those that the processes of a communicator run
/// on.
struct NodeMemory {
  std::string node;      ///< its name
  int nodes = 1;         ///< machines of all processes
  double needed = 0;     ///< by the processes there together, bytes
  double available = 0;  ///< to them, bytes; 0: not known

  bool suffices() const;
};

/// bytes: what this process is about to take. The processes of a machine share its memory.
/// Collective.
NodeMemory memory_of_nodes(double bytes, const Communicator& communicator);

/// Throws InvalidInput "points: 4096 x 4096 need 721 MB of memory for WORK and 450 MB are
/// available; use fewer points" where bytes do not fit: asked before the work, since the system
/// kills a process that uses memory beyond a limit instead of refusing it. bytes: the minimum that
/// the work takes in addition to what the process has. ranks: processes that each take bytes of
/// their own, those of a machine from the same memory; all of them throw, and name the machine and
/// how many of its kind would do. Collective.
void require_memory(const Grid2D& grid, double bytes, std::string_view work,
                    const Communicator& communicator = {});

}  // namespace salebra
