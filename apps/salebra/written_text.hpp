// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "session.hpp"

namespace salebra::cli {

/// An answer that is a text for another program: to --output where one is given, else to stdout;
/// with --json as its member `text`.
/// Throws IoError where it cannot be written.
void answer_text(const std::string& text, Session& session);

}  // namespace salebra::cli
