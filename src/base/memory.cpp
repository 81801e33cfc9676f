// SPDX-License-Identifier: GPL-3.0-or-later
// Large-page allocation, uninitialised fields, and the memory available on the machine.
#include "memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <new>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "memory_limits.hpp"
#if defined(__linux__)
#include <sys/mman.h>
#include <sys/sysinfo.h>
#endif

namespace salebra {

namespace {

constexpr double not_asked_for = 64e6;  // bytes: smaller demands are granted
constexpr std::size_t large_page = std::size_t(2) << 20;

void advise_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  // The status of madvise() is ignored: large pages change the speed, not the results.
  constexpr std::uintptr_t page = 4096;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const auto begin = (address + page - 1) / page * page, end = (address + bytes) / page * page;
  if (end >= begin + large_page)
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace

void* allocate_large(std::size_t bytes) {
  constexpr std::size_t cache_line = 64;
  const std::size_t alignment = bytes >= large_page ? large_page : cache_line;
  // aligned_alloc() requires a multiple of the alignment; the memory beyond `bytes` is never
  // touched.
  void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
  advise_large_pages(memory, (bytes + cache_line - 1) / cache_line * cache_line);
  return memory;
}

Field uninitialised_field(Index nx, Index ny) {
  Field field(nx, ny);
  advise_large_pages(field.data(), static_cast<std::size_t>(field.size()) * sizeof(double));
  return field;
}

void touch_pages(Field& field) {
  constexpr Index per_page = 4096 / sizeof(double);
  parallel::for_slabs((field.size() + per_page - 1) / per_page,
                      [&](Index begin, Index end) {
                        for (Index page = begin; page < end; ++page)
                          field.data()[page * per_page] = 0;
                      },
                      field.size());
}

std::size_t available_memory() {
  if (const auto left = detail::memory_left("/")) return static_cast<std::size_t>(*left);
#if defined(__linux__)
  // Without /proc, e.g. in a minimal container, the total memory of the machine is still a limit.
  struct sysinfo machine {};
  if (sysinfo(&machine) == 0)
    return static_cast<std::size_t>(machine.totalram) * static_cast<std::size_t>(machine.mem_unit);
#endif
  return 0;
}

bool fits_into_memory(double bytes) {
  if (bytes < not_asked_for) return true;
  const double available = static_cast<double>(available_memory());
  return available == 0 || bytes <= available;
}

std::string memory_text(double bytes) {
  for (const auto& [unit, size] :
       {std::pair{"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}, {"PB", 1e15}})
    if (bytes < 999.5 * size) return fmt::format("{:.3g} {}", bytes / size, unit);
  return fmt::format("{:.3g} EB", bytes / 1e18);
}

bool NodeMemory::suffices() const {
  return needed < not_asked_for || available == 0 || needed <= available;
}

NodeMemory memory_of_nodes(double bytes, const Communicator& communicator) {
  const auto own = static_cast<double>(available_memory());
  if (communicator.alone()) return {"", 1, bytes, own};
  struct {
    char node[256] = "";
    double needed = 0, shared = 0, own = 0;
  } mine;
  gethostname(mine.node, sizeof mine.node - 1);
  mine.needed = bytes;
  mine.shared = static_cast<double>(detail::shared_memory_left("/").value_or(0));
  mine.own = own;
  std::vector<decltype(mine)> all(static_cast<std::size_t>(communicator.size()));
  communicator.gather_all(&mine, std::vector<std::size_t>(all.size(), sizeof mine), all.data());
  std::vector<detail::ProcessMemory> processes;
  for (const auto& one : all) processes.push_back({one.node, one.needed, one.shared, one.own});
  return detail::shortest_memory(processes);
}

void require_memory(const Grid2D& grid, double bytes, std::string_view work,
                    const Communicator& communicator) {
  if (communicator.alone() && bytes < not_asked_for) return;
  const NodeMemory memory = memory_of_nodes(bytes, communicator);
  if (memory.suffices()) return;
  const std::string where =
      memory.nodes > 1 ? fmt::format(" on node {}, one of {},", memory.node, memory.nodes) : "";
  const std::string more =
      communicator.alone()
          ? ""
          : fmt::format("{:.0f} nodes, or ",
                        std::ceil(memory.nodes * memory.needed / memory.available));
  throw InvalidInput(
      "points", fmt::format("{} x {}", grid.nx, grid.ny),
      fmt::format("need {} of memory for {}{} and {} are available{}; use {}fewer "
                  "points",
                  memory_text(memory.needed), work, where, memory_text(memory.available),
                  where.empty() ? "" : " there", more));
}

}  // namespace salebra
