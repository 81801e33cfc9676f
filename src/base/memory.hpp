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

/// An uninitialised field, on large pages if the system has them. With ordinary pages the first
/// touch of a field can take longer than its Fourier transform.
Field uninitialised_field(Index nx, Index ny);

/// Makes the system provide the memory of an uninitialised field, each page through one thread. If
/// a loop wrote to all rows at once, two threads could clear the same fresh page; for a field of
/// 4096 × 4096 points this wastes 6 ms per thread.
void touch_pages(Field& field);

/// Uninitialised memory, aligned to 64 bytes (a cache line, and the widest vector), on large pages
/// if it spans several and the system has them. Release it with std::free. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);

struct ReleaseLarge {
  void operator()(void* memory) const { std::free(memory); }
};
template <class Element>
using LargeArray = std::unique_ptr<Element[], ReleaseLarge>;

/// Uninitialised array from allocate_large(). Each memory page is placed near the processor of the
/// thread that first writes to the page.
template <class Element>
LargeArray<Element> large_array(std::size_t size) {
  static_assert(std::is_trivially_destructible_v<Element>);
  return LargeArray<Element>(static_cast<Element*>(allocate_large(size * sizeof(Element))));
}

/// Number of bytes that can be allocated without swapping, by the system's estimate, within the
/// limits of every memory cgroup above this process (version 1 or 2, as set by containers and batch
/// systems) and within RLIMIT_AS and RLIMIT_DATA. The total memory of the machine if /proc is not
/// mounted; 0 if unknown. Cost: about ten small files, 0.1 ms.
std::size_t available_memory();

/// Whether a number of bytes is below available_memory(). Always true below 64 MB, without a check.
bool fits_into_memory(double bytes);

/// Text with three digits: "721 MB", "1.44 GB", "281 TB".
std::string memory_text(double bytes);

/// Memory of the node that lacks most, among all nodes on which processes of a communicator run.
struct NodeMemory {
  std::string node;      ///< name of the node
  int nodes = 1;         ///< number of nodes of all processes
  double needed = 0;     ///< needed by all processes on the node, bytes
  double available = 0;  ///< to all processes on the node, bytes; 0: not known

  bool suffices() const;
};

/// Memory of the node that lacks most, if this process allocates `bytes` more and every other
/// process the number that it passes. The processes of a node share its memory. Collective.
NodeMemory memory_of_nodes(double bytes, const Communicator& communicator);

/// Throws InvalidInput "points: 4096 x 4096 need 721 MB of memory for WORK and 450 MB are
/// available; use fewer points" if the memory does not suffice. Call it before the work: a system
/// kills a process that exceeds a limit instead of refusing the allocation.
/// bytes         minimum that the work allocates in addition to what the process already has
/// communicator  the processes that each allocate `bytes`; the processes of a node share its
///               memory. All of them throw, and the message names the node and the number of
///               nodes that would suffice. Collective.
void require_memory(const Grid2D& grid, double bytes, std::string_view work,
                    const Communicator& communicator = {});

}  // namespace salebra
