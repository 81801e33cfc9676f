// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <fstream>
#include <limits>
#include <salebra/base/memory.hpp>
#include <string>
#if defined(__linux__)
#include <sys/mman.h>
#include <sys/sysinfo.h>
#endif

namespace salebra {

Field uninitialised_field(Index nx, Index ny) {
  Field field(nx, ny);
#if defined(__linux__)
  // Advice only: what the system makes of it changes no result, hence the status is of no use.
  constexpr std::uintptr_t page = 4096;
  const auto begin = (reinterpret_cast<std::uintptr_t>(field.data()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(field.data() + field.size()) / page * page;
  constexpr std::uintptr_t large_page = 2u << 20;
  if (end > begin + large_page) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
  return field;
}

std::size_t available_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::string name;
  std::size_t kibibytes = 0;
  while (meminfo >> name >> kibibytes) {
    if (name == "MemAvailable:") return kibibytes * 1024;
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
#if defined(__linux__)
  // Without /proc, as in a bare chroot, the memory that the machine has in all is still a limit.
  struct sysinfo machine {};
  if (sysinfo(&machine) == 0)
    return static_cast<std::size_t>(machine.totalram) * static_cast<std::size_t>(machine.mem_unit);
#endif
  return 0;
}

}  // namespace salebra
