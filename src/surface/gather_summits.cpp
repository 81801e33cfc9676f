// SPDX-License-Identifier: GPL-3.0-or-later
// Implements gather_summits.hpp: collects the summits of all processes in the first process.
#include "gather_summits.hpp"

#include <cstring>
#include <salebra/base/row_partition.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "base/memory.hpp"

namespace salebra {

SummitList detail::gathered(SummitList list, const Grid2D& grid) {
  const Communicator& communicator = list.communicator;
  if (communicator.alone()) return list;
  std::vector<Index> begins{0};
  for (const std::string& count : communicator.gather_all(std::to_string(list.summits.size())))
    begins.push_back(begins.back() + std::stoll(count));
  static_assert(std::is_trivially_copyable_v<Summit> && sizeof(Summit) % sizeof(double) == 0);
  constexpr Index width = sizeof(Summit) / sizeof(double);
  require_memory(grid, communicator.is_root() ? 3.0 * double(begins.back()) * sizeof(Summit) : 0,
                 "all summits in the first process", communicator);
  Field mine(Index(list.summits.size()), width);
  std::memcpy(mine.data(), list.summits.data(), list.summits.size() * sizeof(Summit));
  const Field all = salebra::gathered(RowPartition(communicator, begins), mine);
  SummitList whole{std::vector<Summit>(std::size_t(all.rows())), list.searched_area};
  std::memcpy(static_cast<void*>(whole.summits.data()), all.data(),
              whole.summits.size() * sizeof(Summit));
  return whole;
}

}  // namespace salebra
