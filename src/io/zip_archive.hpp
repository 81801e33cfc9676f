// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace salebra::detail {

struct ZipMember {
  std::string name, content;
};

/// The bytes of a ZIP archive with these members, dated 1980-01-01, so that the same members give
/// the same bytes. Throws IoError if libzip cannot make it.
std::string zip_archive(const std::vector<ZipMember>& members);

}  // namespace salebra::detail
