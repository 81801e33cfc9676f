// SPDX-License-Identifier: GPL-3.0-or-later
// Build and environment of the program.
#include "version_text.hpp"

#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <salebra/base/parallel.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/report/report.hpp>

#include "revision.inc"

namespace salebra::cli {

std::string_view source_revision() { return revision_of_sources; }

std::string version_text(const Launch& launch) {
  utsname system{};
  uname(&system);
  std::string text = fmt::format("{} {}\n", launch.name, version());
  const auto line = [&text](std::string_view name, std::string_view value) {
    text += fmt::format("{:<11}{}\n", name, value);
  };
  line("revision", source_revision().empty() ? "not known" : source_revision());
  line("arithmetic", arithmetic());
  line("libraries", fmt::format("{}, {}, fmt {}.{}.{}", library_versions(), reader_versions(),
                                FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  line("build", fmt::format("{}, {}", SALEBRA_BUILD_TYPE,
                            can_report() ? "with reports" : "without plotly.js: no reports"));
  line("threads", std::to_string(parallel::threads()));
  line("processes", launch.mpi.empty()
                        ? "one"
                        : fmt::format("{} by {}", launch.communicator.size(), launch.mpi));
  line("system", fmt::format("{} {} {}, glibc {}", system.sysname, system.release, system.machine,
                             gnu_get_libc_version()));
  return text;
}

}  // namespace salebra::cli
