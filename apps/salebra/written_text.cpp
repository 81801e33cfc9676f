// SPDX-License-Identifier: GPL-3.0-or-later
// Answer that is a text for another program: to a file or to stdout.
#include "written_text.hpp"

#include <fstream>
#include <salebra/base/error.hpp>

namespace salebra::cli {

void answer_text(const std::string& text, Session& session) {
  if (!session.has_output()) return session.answer({{"text", text}}, text);
  std::ofstream stream(session.output(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw IoError(session.output().string() + ": cannot be written; check the folder and the disk");
  session.answer({{"file", session.output().string()}}, "");
}

}  // namespace salebra::cli
